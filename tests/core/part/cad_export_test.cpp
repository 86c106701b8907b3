#include "core/part/cad_export.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/file.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/solid_cut.h"
#include "tests/core/geometry/shapes.h"

using namespace trapwright;
using geometry::TriangleMesh;

namespace {

constexpr double kMm = base::kMillimetre;

TriangleMesh makeBlock() {
    return geometry::shapes::makeBox({0, 0, 0}, {30 * kMm, 20 * kMm, 10 * kMm});
}

/// With a hole of 16 sides through it.
TriangleMesh makeDrilled() {
    return geometry::subtractSolid(
               makeBlock(), geometry::makeCylinder({12 * kMm, 10 * kMm}, 4 * kMm, -1 * kMm, 11 * kMm, 16))
        .value();
}

/// A block whose upper side is one twisted quad: two triangles that are not in one plane.
TriangleMesh makeTwisted() {
    TriangleMesh mesh = makeBlock();
    mesh.vertices[7].z() += 3 * kMm;
    return mesh;
}

}  // namespace

Q_DECLARE_METATYPE(TriangleMesh)

class CadExportTest : public QObject {
    Q_OBJECT

 private slots:
    void solidsHavePlaneFaces_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<int>("faces");
        QTest::newRow("block") << makeBlock() << 6;
        QTest::newRow("L") << geometry::shapes::makeL() << 8;
        QTest::newRow("round") << geometry::shapes::makePrism(geometry::shapes::makeCircle(60, 9 * kMm),
                                                              5 * kMm)
                               << 62;
        QTest::newRow("hole") << makeDrilled() << 6 + 16;
        // The upper side in two, and the two sides at the lifted corner stay plane.
        QTest::newRow("twisted") << makeTwisted() << 7;
    }

    void solidsHavePlaneFaces() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(int, faces);
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("solid.step").toStdString();
        const auto written = part::writeStepSolid(path, mesh);
        QVERIFY2(written.ok(), written.ok() ? "" : written.error().message.c_str());
        const auto read = part::inspectStep(path);
        QVERIFY(read.ok());
        QCOMPARE(read->solids, 1);
        QCOMPARE(read->faces, faces);
        QVERIFY(read->valid);
        const double volume = geometry::checkMesh(mesh).volume;
        QVERIFY(std::abs(read->volume / volume - 1.0) < 1e-9);
        QVERIFY((read->size - geometry::calcBoundingBox(mesh).size()).norm() < 1e-9);
    }

    void openMeshIsRefusedAndNothingIsLeft() {
        TriangleMesh mesh = makeBlock();
        mesh.triangles.pop_back();
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("open.step").toStdString();
        QVERIFY(!part::writeStepSolid(path, mesh).ok());
        QVERIFY(std::filesystem::is_empty(folder.path().toStdString()));
    }

    void nobodysFileBesideIsTouched() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.filePath("solid.step").toStdString();
        const std::filesystem::path beside = path.string() + ".new";
        QVERIFY(base::writeFile(beside, "mine").ok());
        QVERIFY(part::writeStepSolid(path, makeBlock()).ok());
        QCOMPARE(base::readFile(beside).value(), std::string("mine"));
    }

    void folderThatIsMissingIsToldOf() {
        const auto written = part::writeStepSolid("/no-such-folder/solid.step", makeBlock());
        QVERIFY(!written.ok());
        QVERIFY(written.error().message.find("/no-such-folder/solid.step") != std::string::npos);
    }

    void textIsNoStepFile() {
        const QTemporaryDir folder;
        QFile file(folder.filePath("text.step"));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write("solid") > 0);
        file.close();
        QVERIFY(!part::inspectStep(file.fileName().toStdString()).ok());
    }
};

QTEST_APPLESS_MAIN(CadExportTest)
#include "cad_export_test.moc"
