#include "ui/pages/export_page.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>

#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"
#include "core/study/track_design.h"
#include "core/track/print_solid.h"
#include "tests/ui/session/session_fixture.h"
#include "tests/ui/window/window_user.h"
#include "ui/look/message_bar.h"
#include "ui/pages/value_edit.h"

using namespace trapwright;

namespace {

constexpr double kMm = base::kMillimetre;
constexpr int kPatience = 60000;  // [ms] for what happens in the background, on a busy machine

/// The window with a study open at the Export page, and what a user does there.
struct User : tests::WindowUser {
    User(const session::SessionFixture& studies, const std::string& name)
        : WindowUser(studies.environment()) {
        (void)open(studies.path(name), "export");
    }

    QString state() { return find<QLabel>("export.state")->text(); }
    QString reason(const QString& field) {
        auto* label = find<QLabel>("reason.print." + field);
        return label->isHidden() ? QString() : label->text();
    }
    bool waitForSolid() {
        return QTest::qWaitFor([&] { return action("export.stl")->isEnabled(); }, kPatience);
    }
    void type(const QString& field, const QString& text) {
        auto* edit = find<QLineEdit>("field.print." + field);
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }
    /// Answers the question for a file.
    bool exportTo(const QString& format, const QString& path) {
        action("export." + format)->trigger();
        auto* dialog = find<QFileDialog>("dialog.file");
        if (dialog == nullptr) return false;
        emit dialog->fileSelected(path);
        dialog->close();
        return QTest::qWaitFor([&] { return find<QFileDialog>("dialog.file") == nullptr; }, kPatience);
    }
    /// What core makes of the individual that was chosen, or else of that which the last selection puts
    /// first.
    geometry::TriangleMesh buildSelected(const track::PrintOptions& options) {
        const study::SelectionEntry& first = session()->selections().back().entries.front();
        const auto chosen = session()->chosen();
        const auto winner = chosen ? session()->loadWinner(chosen->generation, chosen->individual)
                                   : session()->loadWinner(first.generation, first.individual);
        const auto track = study::decodeTrack(session()->settings().track, winner.value().record.chromosome);
        return track::buildPrintSolid(track.value(), options).value();
    }
};

}  // namespace

class ExportPageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
        qputenv("XDG_DATA_HOME", folder_.filePath("data").toLocal8Bit());
        QCoreApplication::setOrganizationName("Trapwright");
        QCoreApplication::setApplicationName("export_page_test");

        const auto learned = studies_.create("learned.trap", session::smallSettings());
        QVERIFY(learned && session::learnToTheEnd(*learned));
        learned->startSelection();
        QVERIFY(session::waitForState(*learned, session::RunState::idle));
        QCOMPARE(learned->selections().size(), 1U);

        study::Settings settings = session::smallSettings(1);
        settings.track.shape.type = track::FeederType::bowl;
        const auto bowl = studies_.create("bowl.trap", settings);
        QVERIFY(bowl && session::learnToTheEnd(*bowl));
        QVERIFY(studies_.create("new.trap", session::smallSettings()));
    }

    void init() {
        QSettings().clear();
        QSettings().setValue("folders/print", folder_.path());
    }

    void selectedTrackIsExportedAndReadsBack_data() {
        QTest::addColumn<QString>("format");
        QTest::newRow("STL") << "stl";
        QTest::newRow("3MF") << "3mf";
    }

    void selectedTrackIsExportedAndReadsBack() {
        QFETCH(QString, format);
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        QVERIFY(user.find<QComboBox>("export.track")->currentText().startsWith("Selected, place 1"));
        user.type("wallHeight", "5");
        user.find<QCheckBox>("print.flange")->click();
        user.type("boltDiameter", "3.4");
        QVERIFY(user.waitForSolid());

        const QString path = folder_.filePath("track." + format);
        QVERIFY(user.exportTo(format, path));
        QVERIFY(QTest::qWaitFor([&] { return user.state().contains("Read back"); }, kPatience));
        const auto mesh =
            format == "stl" ? geometry::readStl(path.toStdString()) : geometry::read3mf(path.toStdString());
        QVERIFY(mesh.ok());
        const geometry::MeshReport report = geometry::checkMesh(*mesh);
        QVERIFY(report.isSolid());
        QCOMPARE(report.nonManifoldEdges, 0);

        track::PrintOptions options;
        options.wallHeight = 5 * kMm;
        options.flange = true;
        options.boltDiameter = 3.4 * kMm;
        const geometry::TriangleMesh expected = user.buildSelected(options);
        QVERIFY(std::abs(report.volume / geometry::checkMesh(expected).volume - 1.0) < 1e-5);
        const base::Vec3 difference =
            geometry::calcBoundingBox(*mesh).size() - geometry::calcBoundingBox(expected).size();
        QVERIFY(difference.norm() < 1e-6);
        // The scene shows the same.
        QVERIFY(user.scene().solid);
        QCOMPARE(user.scene().solid->triangles.size(), expected.triangles.size());
    }

    void anotherWinnerCanBePicked() {
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        const auto before = user.scene().solid;
        auto* tracks = user.find<QComboBox>("export.track");
        // Two of the selection, then the winner of each generation.
        QCOMPARE(tracks->count(), 2 + 3);
        tracks->setFocus();
        QTest::keyClick(tracks, Qt::Key_End);
        QVERIFY(!user.action("export.stl")->isEnabled());
        QVERIFY(user.waitForSolid());
        QVERIFY(user.scene().solid != before);
    }

    void newestEditWins() {
        User user(studies_, "learned.trap");
        for (const char* height : {"3", "4", "5", "6", "7"})
            user.type("wallHeight", height);
        QVERIFY(user.waitForSolid());
        track::PrintOptions options;
        options.wallHeight = 7 * kMm;
        const geometry::Box got = geometry::calcBoundingBox(*user.scene().solid);
        QVERIFY((got.high - geometry::calcBoundingBox(user.buildSelected(options)).high).norm() < 1e-12);
    }

    void badValueIsMarkedAndNothingIsExported() {
        User user(studies_, "learned.trap");
        user.find<QCheckBox>("print.flange")->click();
        QVERIFY(user.waitForSolid());
        user.type("flangeThickness", "9");
        QVERIFY(QTest::qWaitFor([&] { return !user.reason("flangeThickness").isEmpty(); }, kPatience));
        QVERIFY(user.reason("flangeThickness").contains("at most the base thickness"));
        QVERIFY(!user.action("export.stl")->isEnabled());
        QVERIFY(!user.action("export.3mf")->isEnabled());
        // A thicker base mends it as well.
        user.type("baseThickness", "10");
        QVERIFY(user.waitForSolid());
        QVERIFY(user.reason("flangeThickness").isEmpty());
        user.type("wallHeight", "abc");
        QVERIFY(user.waitForSolid());
    }

    void thinWallsAreListedAndMarked() {
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        user.type("wallHeight", "5");
        user.type("wallThickness", "0.5");
        user.type("thinnestWall", "0.9");
        QVERIFY(user.waitForSolid());
        auto* list = user.find<QListWidget>("print.flaws");
        QVERIFY(list->isVisible());
        QVERIFY(list->count() >= 2);
        QVERIFY(list->item(0)->text().startsWith("Thin wall, 0.5 mm"));
        QCOMPARE(user.scene().highlights.size(), static_cast<std::size_t>(list->count()));
        const scene::Highlight second = user.scene().highlights[1];
        QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(1)).center());
        QCOMPARE(user.scene().highlights.size(), 1U);
        QVERIFY(user.scene().highlights.front() == second);
        QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(1)).center());
        QCOMPARE(user.scene().highlights.size(), static_cast<std::size_t>(list->count()));
        // Another page's scene has no marks of this one.
        user.window.showPage("track");
        QVERIFY(!user.scene().solid);
        QVERIFY(user.scene().highlights.empty());
    }

    void folderThatCannotBeWrittenIsToldOf() {
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        // A folder that is a file cannot be written by anyone, not even by root.
        const QString path = folder_.filePath("no-folder/track.stl");
        QVERIFY(QFile(folder_.filePath("no-folder")).open(QIODevice::WriteOnly));
        QVERIFY(user.exportTo("stl", path));
        auto* messages = user.find<look::MessageBar>("messageBar");
        QVERIFY(QTest::qWaitFor([&] { return messages->text().contains(path); }, kPatience));
        QVERIFY(user.state().isEmpty());
        QVERIFY(user.action("export.stl")->isEnabled());
    }

    void bowlGetsAnInsert() {
        User user(studies_, "bowl.trap");
        QVERIFY(user.waitForSolid());
        auto* mount = user.find<QCheckBox>("print.flange");
        QCOMPARE(mount->text(), QString("Insert for the bowl"));
        QVERIFY(!user.find<QLineEdit>("field.print.insertRadius")->isVisibleTo(&user.window));
        mount->click();
        QVERIFY(user.find<QLineEdit>("field.print.insertRadius")->isVisibleTo(&user.window));
        user.type("insertRadius", "260");
        QVERIFY(user.waitForSolid());
        double farthest = 0.0;
        for (const base::Vec3& v : user.scene().solid->vertices)
            farthest = std::max(farthest, std::hypot(v.x(), v.y()));
        QVERIFY(std::abs(farthest - 260 * kMm) < 1e-9);
    }

    void withoutGenerationsItSaysWhatIsMissing() {
        User user(studies_, "new.trap");
        QVERIFY(user.find<QLabel>("export.empty")->isVisible());
        QVERIFY(!user.action("export.stl")->isEnabled());
        QVERIFY(!user.find<QComboBox>("export.track")->isVisible());
    }

 private:
    QTemporaryDir folder_;
    session::SessionFixture studies_;
};

int main(int argc, char** argv) {
    // Qt's own file dialog keeps its last folder beside the user's settings and looks into the files there.
    const QTemporaryDir settings;
    qputenv("XDG_CONFIG_HOME", settings.path().toLocal8Bit());
    QApplication application(argc, argv);
    ExportPageTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "export_page_test.moc"
