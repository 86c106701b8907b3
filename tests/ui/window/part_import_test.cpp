// Parts through the window: imported, dropped, asked about, refused.

#include <QComboBox>
#include <QMimeData>
#include <QPushButton>
#include <QToolButton>
#include <fstream>

#include "core/geometry/triangle_mesh.h"
#include "tests/ui/window/user.h"
#include "ui/session/study_design.h"

using namespace trapwright;
using tests::bundled;
using tests::kPatience;
using tests::User;

namespace {

bool writeObj(const geometry::TriangleMesh& mesh, const std::filesystem::path& path) {
    std::ofstream file(path);
    file.precision(17);
    for (const base::Vec3& v : mesh.vertices)
        file << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const geometry::Triangle& t : mesh.triangles)
        file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    return bool(file.flush());
}

}  // namespace

class PartImportTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { tests::useFolder(folder_, "part_import_test"); }
    void init() { QSettings().clear(); }

    void importShowsThePart() {
        User user;
        QVERIFY(user.import("cuboid"));
        QCOMPARE(user.find<QLabel>("part.name")->text(), QString("cuboid"));
        QCOMPARE(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"));
        QVERIFY(user.find<QLabel>("part.symmetry")->text().startsWith("D2"));
        // Three pairs of faces, each face a pose; opposite ones look the same.
        QTRY_COMPARE(user.window.findChildren<QFrame*>("poseCard").size(), 3);
        QCOMPARE(user.window.findChildren<QFrame*>("singlePoseCard").size(), 0);
        auto* opener = user.find<QToolButton>("poseCard.open");
        QCOMPARE(opener->text(), QString("2 alike"));
        opener->click();
        QTRY_COMPARE(user.window.findChildren<QFrame*>("singlePoseCard").size(), 2);
        user.find<QToolButton>("poseCard.open")->click();
        QTRY_COMPARE(user.window.findChildren<QFrame*>("singlePoseCard").size(), 0);
        QVERIFY(user.find<scene::SceneView>("scene")->contents().stablePoses != nullptr);
        QVERIFY(user.action("run.start")->isEnabled());
    }

    // STL has no unit; 4 x 8 x 12 of what would be 0.3 m in feet.
    void anotherUnitChangesTheSizeAndCanBeUndone() {
        User user;
        QVERIFY(user.import("cuboid"));
        auto* unit = user.find<QComboBox>("part.unit");
        QVERIFY(unit->findData("cm") >= 0);
        unit->setCurrentIndex(unit->findData("cm"));
        emit unit->activated(unit->currentIndex());
        QTRY_COMPARE_WITH_TIMEOUT(user.find<QLabel>("part.size")->text(), QString("40 × 80 × 120 mm"),
                                  kPatience);
        // It does not fit the track any more: said here, and learning waits for it.
        QVERIFY(user.find<QLabel>("part.misfit")->isVisible());
        QVERIFY(!user.action("run.start")->isEnabled());
        user.action("edit.undo")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"),
                                  kPatience);
        QVERIFY(user.action("run.start")->isEnabled());
    }

    void materialSetsTheDensity() {
        User user;
        QVERIFY(user.import("cuboid"));
        auto* material = user.find<QComboBox>("part.material");
        material->setCurrentIndex(material->findText("steel"));
        emit material->activated(material->currentIndex());
        // EN 1991-1-1.
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().settings().part.density, 7850.0, kPatience);
        QCOMPARE(user.session()->design().part()->density, 7850.0);
        QCOMPARE(user.find<QLineEdit>("field.part.density_kg_m3")->text(), QString("7850"));
    }

    void symmetryCanBeOverridden() {
        User user;
        QVERIFY(user.import("cuboid"));
        auto* counts = user.find<QComboBox>("field.part.symmetry");
        counts->setCurrentIndex(counts->findData("none"));
        emit counts->activated(counts->currentIndex());
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->symmetry.name, std::string("C1"),
                                  kPatience);
        QVERIFY(user.find<QLabel>("part.symmetry")->text().startsWith("C1"));
        user.action("edit.undo")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(user.session()->design().part()->symmetry.name, std::string("D2"),
                                  kPatience);
    }

    void droppedFilesAreOpened() {
        User user;
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(bundled("pin").string()))});
        QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&user.window, &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&user.window, &drop);
        QVERIFY2(QTest::qWaitFor([&] { return user.session() != nullptr; }, kPatience),
                 qPrintable(user.message()));
        QCOMPARE(user.find<QLabel>("part.name")->text(), QString("pin"));
    }

    void aFileThatIsNoPartIsToldWithoutADialog_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        QTest::newRow("empty") << "empty.stl" << QByteArray();
        QTest::newRow("damaged") << "damaged.stl" << QByteArray("solid x\nfacet normal 0 0");
        QTest::newRow("another kind") << "letter.txt" << QByteArray("hello");
        QTest::newRow("damaged study") << "damaged.trap" << QByteArray("no database");
    }
    void aFileThatIsNoPartIsToldWithoutADialog() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        QFile file(folder_.filePath(name));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(content) == content.size());
        file.close();
        User user;
        user.window.openFile(file.fileName().toStdString());
        QTRY_VERIFY2_WITH_TIMEOUT(user.message().contains(name), qPrintable(user.message()), kPatience);
        QVERIFY(user.session() == nullptr);
        QVERIFY(QApplication::activeModalWidget() == nullptr);
    }

    // The same cuboid in metres: 12 thousandths of a millimetre would be no part.
    void theUnitIsAskedForWhereItCannotBeAssumed() {
        geometry::TriangleMesh metres = part::makeBundledShape("cuboid");
        const std::filesystem::path file = folder_.filePath("metres.obj").toStdString();
        QVERIFY(writeObj(metres, file));
        User user;
        user.window.openFile(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.find<QPushButton>("unit.m") != nullptr, kPatience);
        QVERIFY(user.find<QPushButton>("unit.m")->isVisible());
        QVERIFY(user.find<QPushButton>("unit.m")->text().contains("4 × 8 × 12 mm"));
        QTest::mouseClick(user.find<QPushButton>("unit.m"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        QCOMPARE(user.session()->design().settings().part.units, std::string("m"));
        QCOMPARE(user.find<QLabel>("part.size")->text(), QString("4 × 8 × 12 mm"));
    }

    void aLargeHoleIsClosedOnlyWhenAsked() {
        geometry::TriangleMesh open = part::makeBundledShape("cuboid");
        for (base::Vec3& vertex : open.vertices)
            vertex *= 1e3;
        open.triangles.pop_back();
        const std::filesystem::path file = folder_.filePath("open.obj").toStdString();
        QVERIFY(writeObj(open, file));
        User user;
        user.window.openFile(file);
        QTRY_VERIFY_WITH_TIMEOUT(user.find<QPushButton>("repair") != nullptr, kPatience);
        QVERIFY(user.session() == nullptr);
        QTest::mouseClick(user.find<QPushButton>("repair"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr, kPatience);
        // Closed, it is the cuboid again: 4 x 8 x 12 mm.
        QVERIFY(std::abs(user.session()->design().part()->massProperties.volume - 384e-9) < 1e-12);
        QTRY_VERIFY_WITH_TIMEOUT(!user.find<QLabel>("part.notes")->text().isEmpty(), kPatience);
    }

 private:
    QTemporaryDir folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    PartImportTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "part_import_test.moc"
