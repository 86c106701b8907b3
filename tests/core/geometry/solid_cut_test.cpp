#include "core/geometry/solid_cut.h"

#include <QTest>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

double volumeOf(const TriangleMesh& mesh) {
    return calcMassProperties(mesh, 1.0).volume;
}

}  // namespace

class SolidCutTest : public QObject {
    Q_OBJECT

 private slots:
    void cylinderIsARegularPrism() {
        const TriangleMesh mesh = makeCylinder({1.0, 2.0}, 0.5, -1.0, 2.0, 7);
        QVERIFY(checkMesh(mesh).isSolid());
        QVERIFY(std::abs(volumeOf(mesh) - 3.0 * shapes::calcCircleArea(7, 0.5)) < 1e-12);
    }

    void holeThroughABox() {
        const TriangleMesh box = shapes::makeBox({0, 0, 0}, {4, 3, 1});
        const TriangleMesh drill = makeCylinder({2.0, 1.0}, 0.5, -1.0, 2.0, 24);
        const auto drilled = subtractSolid(box, drill);
        QVERIFY(drilled.ok());
        const MeshReport report = checkMesh(*drilled, true);
        QVERIFY(report.isSolid());
        QCOMPARE(report.nonManifoldEdges, 0);
        QCOMPARE(report.shells, 1);
        QCOMPARE(report.overlappingTriangles, 0);
        QVERIFY(std::abs(report.volume - (12.0 - shapes::calcCircleArea(24, 0.5))) < 1e-12);
        const auto core = intersectSolids(box, drill);
        QVERIFY(core.ok());
        QVERIFY(std::abs(volumeOf(*core) - shapes::calcCircleArea(24, 0.5)) < 1e-12);
    }

    void facesInOnePlaneAreNoObstacle() {
        // Both boxes end in the plane x = 2 and stand on z = 0.
        const auto rest =
            subtractSolid(shapes::makeBox({0, 0, 0}, {2, 2, 2}), shapes::makeBox({1, 0, 0}, {2, 2, 1}));
        QVERIFY(rest.ok());
        QVERIFY(checkMesh(*rest).isSolid());
        QVERIFY(std::abs(volumeOf(*rest) - 6.0) < 1e-12);
    }

    void whatCannotBeCutIsToldOf() {
        TriangleMesh open = shapes::makeBox({0, 0, 0}, {1, 1, 1});
        open.triangles.pop_back();
        QVERIFY(!subtractSolid(open, shapes::makeBox({0.5, 0, 0}, {2, 1, 1})).ok());
        QVERIFY(!intersectSolids(shapes::makeBox({0.5, 0, 0}, {2, 1, 1}), open).ok());
    }
};

QTEST_APPLESS_MAIN(SolidCutTest)
#include "solid_cut_test.moc"
