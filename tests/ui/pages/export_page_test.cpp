#include "ui/pages/export_page.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>

#include "core/base/resources.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"
#include "core/part/cad_export.h"
#include "core/study/track_design.h"
#include "core/track/print_solid.h"
#include "core/track/printer.h"
#include "core/workflow/example_studies.h"
#include "tests/core/study/flawed_track.h"
#include "tests/ui/session/session_fixture.h"
#include "tests/ui/window/window_user.h"
#include "ui/look/message_bar.h"
#include "ui/look/text.h"
#include "ui/pages/value_edit.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

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
    /// Picks the entry that begins so, in any case.
    void choose(const QString& list, const QString& text) {
        auto* box = find<QComboBox>(list);
        const int place = box->findText(text, Qt::MatchStartsWith);
        box->setCurrentIndex(place);
        emit box->activated(place);
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
        // It would ask before it replaces a file, and take no folder that is none.
        QFile::remove(path);
        if (QFileInfo(QFileInfo(path).path()).isDir()) {
            dialog->selectFile(path);
            QMetaObject::invokeMethod(dialog, "accept");
        } else {
            emit dialog->filesSelected({path});
            dialog->close();
        }
        return QTest::qWaitFor([&] { return find<QFileDialog>("dialog.file") == nullptr; }, kPatience);
    }
    /// What core makes of the individual that was chosen, or else of that which the last selection puts
    /// first.
    geometry::TriangleMesh buildSelected(const track::PrintOptions& options) {
        const study::SelectionEntry& first = session()->runs().selections().back().entries.front();
        const auto chosen = session()->runs().chosen();
        const auto winner =
            chosen ? session()->runs().loadIndividual(*chosen) : session()->runs().loadIndividual(first);
        const auto track =
            study::decodeTrack(session()->design().settings().track, winner.value().record.design);
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
        learned->runs().startSelection();
        QVERIFY(session::waitForState(*learned, session::RunState::idle));
        QCOMPARE(learned->runs().selections().size(), 1U);

        study::Settings settings = session::smallSettings(1);
        settings.track.shape.type = track::FeederType::bowl;
        const auto bowl = studies_.create("bowl.trap", settings);
        QVERIFY(bowl && session::learnToTheEnd(*bowl));
        QVERIFY(studies_.create("new.trap", session::smallSettings()));
    }

    void init() {
        QSettings().clear();
        QSettings().setValue("folders/print", folder_.path());
        std::filesystem::remove_all(printers());
        // Few of the parts of these studies succeed; who exports does not want to be asked.
        QSettings().setValue("print/leastSuccess", 0.0);
    }

    void selectedTrackIsExportedAndReadsBack_data() {
        QTest::addColumn<QString>("format");
        QTest::newRow("STL") << "stl";
        QTest::newRow("3MF") << "3mf";
        QTest::newRow("STEP") << "step";
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
        track::PrintOptions options;
        options.wallHeight = 5 * kMm;
        options.flange = true;
        options.boltDiameter = 3.4 * kMm;
        const geometry::TriangleMesh expected = user.buildSelected(options);
        const double volume = geometry::checkMesh(expected).volume;
        const base::Vec3 size = geometry::calcBoundingBox(expected).size();
        if (format == "step") {
            const auto contents = part::inspectStep(path.toStdString());
            QVERIFY(contents.ok() && contents->valid);
            QCOMPARE(contents->solids, 1);
            QVERIFY(std::abs(contents->volume / volume - 1.0) < 1e-6);
            QVERIFY((contents->size - size).norm() < 1e-6);
        } else {
            const auto mesh = format == "stl" ? geometry::readStl(path.toStdString())
                                              : geometry::read3mf(path.toStdString());
            QVERIFY(mesh.ok());
            const geometry::MeshReport report = geometry::checkMesh(*mesh);
            QVERIFY(report.isSolid());
            QCOMPARE(report.nonManifoldEdges, 0);
            QVERIFY(std::abs(report.volume / volume - 1.0) < 1e-5);
            QVERIFY((geometry::calcBoundingBox(*mesh).size() - size).norm() < 1e-6);
        }
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

    void asksBelowTheLeastSuccess() {
        QSettings().setValue("print/leastSuccess", 1.0);
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        user.choose("export.track", "Selected, place 1");
        QVERIFY(user.waitForSolid());
        const study::SelectionEntry& first = user.session()->runs().selections().back().entries.front();
        QVERIFY(first.oriented < first.trials);
        const QString percent = look::numberText(100.0 * first.oriented / first.trials) + " %";
        QVERIFY2(user.text("print.check.success").contains(percent),
                 qPrintable(percent + " in: " + user.text("print.check.success")));
        QVERIFY(user.text("print.check.success").contains("below 100 %"));

        user.action("export.stl")->trigger();
        auto* question = user.find<QMessageBox>("dialog.success");
        QVERIFY(question != nullptr);
        QVERIFY(question->text().contains(percent));
        question->reject();
        QVERIFY(user.find<QFileDialog>("dialog.file") == nullptr);
        QVERIFY(
            QTest::qWaitFor([&] { return user.find<QMessageBox>("dialog.success") == nullptr; }, kPatience));
        user.action("export.stl")->trigger();
        user.find<QPushButton>("dialog.success.export")->click();
        auto* dialog = user.find<QFileDialog>("dialog.file");
        QVERIFY(dialog != nullptr);
        // Not the name that the file of the part may have.
        QVERIFY2(dialog->selectedFiles().value(0).endsWith("learned-track.stl"),
                 qPrintable(dialog->selectedFiles().value(0)));
        dialog->close();
        QVERIFY(QTest::qWaitFor([&] { return user.find<QFileDialog>("dialog.file") == nullptr; }, kPatience));

        // What the user wants less of is not asked for, and is remembered.
        user.type("leastSuccess", "0");
        QVERIFY(!user.text("print.check.success").contains("below"));
        QVERIFY(user.exportTo("stl", folder_.filePath("unasked.stl")));
        QCOMPARE(QSettings().value("print/leastSuccess").toDouble(), 0.0);
    }

    void printerIsChosenAndRemembered() {
        {
            User user(studies_, "learned.trap");
            QVERIFY(user.waitForSolid());
            auto* printers = user.find<QComboBox>("print.printer");
            QCOMPARE(printers->currentText(), QString("Prusa MK4"));
            QVERIFY(user.text("print.check.bed").contains("Prusa MK4"));
            user.choose("print.printer", "UltiMaker S5");
            QVERIFY(user.waitForSolid());
            QVERIFY(user.text("print.printer.about").contains("330 × 240 mm"));
            QVERIFY(user.text("print.check.bed").contains("fits UltiMaker S5"));
        }
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        QCOMPARE(user.find<QComboBox>("print.printer")->currentText(), QString("UltiMaker S5"));
    }

    void ownPrinterIsMadeEditedAndRemoved() {
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        const auto edit = [&](const QString& action, const QString& title, const QString& bedX) {
            user.action(action)->trigger();
            user.find<QLineEdit>("printer.title")->setText(title);
            user.find<QLineEdit>("printer.bedX")->setText(bedX);
            user.find<QPushButton>("printer.save")->click();
        };
        edit("printer.new", "...", "120");
        QVERIFY(user.text("printer.problem").contains("letter"));
        user.find<QLineEdit>("printer.bedX")->setText("12x");
        user.find<QLineEdit>("printer.title")->setText("Little one");
        user.find<QPushButton>("printer.save")->click();
        QVERIFY(user.text("printer.problem").contains("not a number"));
        user.find<QLineEdit>("printer.bedX")->setText("5");
        user.find<QPushButton>("printer.save")->click();
        QVERIFY(user.text("printer.problem").contains("bedX_mm"));
        user.find<QLineEdit>("printer.bedX")->setText("120");
        user.find<QPushButton>("printer.save")->click();
        QVERIFY(user.waitForSolid());
        QCOMPARE(user.find<QComboBox>("print.printer")->currentText(), QString("Little one (your own)"));
        QVERIFY(user.text("print.check.bed").contains("too large for Little one"));
        QVERIFY(std::filesystem::exists(printers() / "little-one.json"));

        QVERIFY(QTest::qWaitFor([&] { return user.find<QDialog>("dialog.printer") == nullptr; }, kPatience));
        edit("printer.edit", "Little one", "350");
        QVERIFY(user.waitForSolid());
        QVERIFY(user.text("print.check.bed").contains("fits Little one"));
        user.action("printer.remove")->trigger();
        user.find<QPushButton>("printer.removeQuestion.remove")->click();
        QVERIFY(!std::filesystem::exists(printers() / "little-one.json"));
        QVERIFY(user.waitForSolid());
        QVERIFY(user.find<QComboBox>("print.printer")->findText("Little one (your own)") < 0);
    }

    void longTrackIsCutIntoPiecesWithDowels_data() {
        QTest::addColumn<QString>("study");
        QTest::newRow("linear") << "learned.trap";
        QTest::newRow("bowl") << "bowl.trap";
    }

    void longTrackIsCutIntoPiecesWithDowels() {
        QFETCH(QString, study);
        track::Printer small;
        small.name = "small";
        small.title = "Small";
        small.space = {0.15, 0.12, 0.1};
        QVERIFY(track::savePrinter(printers(), small).ok());
        QSettings().setValue("print/printer", "small");
        User user(studies_, study.toStdString());
        QVERIFY(user.waitForSolid());
        QVERIFY(user.text("print.check.bed").contains("too large for Small"));
        const geometry::MeshReport whole = geometry::checkMesh(*user.scene().solid);

        user.choose("print.split", "As few");
        QVERIFY(user.waitForSolid());
        QVERIFY2(user.text("print.check.bed").contains("pieces fits Small"),
                 qPrintable(user.text("print.splitProblem")));
        QVERIFY(user.text("print.pieces").contains("cut at section"));
        // Cuts on the surface, and holes that are seen through it.
        const auto& marks = user.scene().highlights;
        QVERIFY(std::any_of(marks.begin(), marks.end(), [](const auto& mark) { return mark.through; }));
        const base::Vec3 together = geometry::calcBoundingBox(*user.scene().solid).size();
        user.find<QCheckBox>("print.apart")->click();
        const base::Vec3 apart = geometry::calcBoundingBox(*user.scene().solid).size();
        QVERIFY((apart - together).norm() > 15 * kMm);

        QVERIFY(user.exportTo("stl", folder_.filePath("cut.stl")));
        QVERIFY(QTest::qWaitFor([&] { return user.state().contains("Read back"); }, kPatience));
        double volume = 0.0;
        std::size_t pieces = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path().toStdString())) {
            const std::string name = entry.path().filename().string();
            if (!name.starts_with("cut-") || entry.path().extension() != ".stl") continue;
            const geometry::MeshReport piece = geometry::checkMesh(geometry::readStl(entry.path()).value());
            QVERIFY(piece.isSolid());
            QCOMPARE(piece.nonManifoldEdges, 0);
            volume += piece.volume;
            ++pieces;
            std::filesystem::remove(entry.path());
        }
        QVERIFY(pieces >= 2);
        // Four holes of 3.2 x 8.2 mm in each cut.
        const double holes =
            4.0 * static_cast<double>(pieces - 1) * 8.2 * base::kPi * 1.6 * 1.6 * kMm * kMm * kMm;
        QVERIFY(std::abs((whole.volume - volume) / holes - 1.0) < 0.02);

        QVERIFY(user.exportTo("3mf", folder_.filePath("cut.3mf")));
        QVERIFY(QTest::qWaitFor([&] { return user.state().contains("cut.3mf: "); }, kPatience));
        QCOMPARE(geometry::read3mfObjects(folder_.filePath("cut.3mf").toStdString()).value().size(), pieces);
    }

    void cutsAreChosenByHand() {
        User user(studies_, "learned.trap");
        QVERIFY(user.waitForSolid());
        user.choose("print.split", "Cut at");
        QVERIFY(user.waitForSolid());
        auto* cuts = user.find<QListWidget>("print.cuts");
        QVERIFY(cuts->isVisibleTo(&user.window));
        cuts->item(1)->setCheckState(Qt::Checked);
        QVERIFY(user.waitForSolid());
        QVERIFY(user.text("print.pieces").startsWith("2 pieces, cut at section 2"));
        // Dowels that have no room are told of where they are set, and nothing is exported.
        user.type("dowelDiameter", "29");
        QVERIFY(QTest::qWaitFor([&] { return user.reason("dowelDiameter").contains("no room"); }, kPatience));
        QVERIFY(!user.action("export.stl")->isEnabled());
        user.type("dowelDiameter", "0");
        QVERIFY(user.waitForSolid());
        QVERIFY(user.reason("dowelDiameter").isEmpty());
        QVERIFY(!user.find<QLineEdit>("field.print.dowelDepth")->isVisibleTo(&user.window));
    }

    void whatCannotBePrintedIsMended() {
        auto study = studies_.create("mend.trap", session::smallSettings());
        QVERIFY(study && session::learnToTheEnd(*study));
        std::vector<study::GenerationRecord> generations;
        for (const study::GenerationSummary& summary : study->runs().summaries())
            generations.push_back(study->runs().loadGeneration(summary.index).value());
        const auto [track, limits] =
            fake::findFlawedTrack(study->design().settings().track, generations).value();
        study->runs().choose(track);
        study.reset();

        User user(studies_, "mend.trap");
        QVERIFY(user.waitForSolid());
        user.type("thinnestWall", QString::number(limits.thinnestWall / kMm));
        user.type("rim", "0");  // which could mend it as well
        QVERIFY(user.waitForSolid());
        auto* mend = user.find<QPushButton>("print.mend");
        QVERIFY(mend->isVisibleTo(&user.window) && mend->isEnabled());
        QVERIFY2(user.text("print.mend.cost").contains("mm²"), qPrintable(user.text("print.mend.cost")));
        mend->click();
        QCOMPARE(user.session()->runs().state(), session::RunState::mending);
        QVERIFY(!mend->isVisibleTo(&user.window));
        QVERIFY(user.find<QPushButton>("print.mend.stop")->isVisibleTo(&user.window));
        QVERIFY(QTest::qWaitFor([&] { return user.session()->runs().state() == session::RunState::idle; },
                                kPatience));
        QVERIFY(user.waitForSolid());
        QVERIFY2(user.text("print.mend.result").contains("Mended; "),
                 qPrintable(user.text("print.mend.result")));
        const QString shown = user.find<QComboBox>("export.track")->currentText();
        QVERIFY2(shown.startsWith("Selected") && shown.endsWith("mended"), qPrintable(shown));
        QVERIFY(!mend->isVisibleTo(&user.window));  // nothing is left to mend
    }

    // Of the cuboid's example two crests at its borders are too thin: a rim makes them good, and where the
    // user takes it away no point of the track is moved for what the rim would do.
    void whatPrintsWithARimIsNotMended() {
        const auto example = workflow::findExampleFile(workflow::findExampleStudy("cuboid").value());
        std::filesystem::copy_file(example, studies_.path("cuboid.trap"));
        User user(studies_, "cuboid.trap");
        QVERIFY(user.waitForSolid());
        auto* mend = user.find<QPushButton>("print.mend");
        QVERIFY(!mend->isVisibleTo(&user.window));
        user.type("rim", "0");
        QVERIFY(user.waitForSolid());
        QVERIFY(user.find<QWidget>("print.flaws")->isVisibleTo(&user.window));
        QVERIFY(!mend->isVisibleTo(&user.window));
    }

    void fileMenuExportsFromAnyPage() {
        User user(studies_, "learned.trap");
        user.window.showPage("track");
        user.action("file.export.step")->trigger();
        QVERIFY(QTest::qWaitFor([&] { return user.find<QFileDialog>("dialog.file") != nullptr; }, kPatience));
        QVERIFY(user.find<QFileDialog>("dialog.file")->windowTitle().contains("STEP"));
        user.find<QFileDialog>("dialog.file")->close();
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
    /// Where the user's own ones are kept.
    static std::filesystem::path printers() { return base::findOwnFolder("printers"); }

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
