#include "core/geometry/print_check.h"

#include <QTest>

#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

constexpr double kMm = base::kMillimetre;

/// A block with a roof that leans over its foot: from the foot's edge the underside rises at `angle` from
/// upright.
TriangleMesh makeLeaning(double angle) {
    const double out = 10 * kMm * std::tan(angle);
    // The outline lies in x and z; turned so that the prism's height is y.
    TriangleMesh mesh =
        shapes::makePrism({{0, 0}, {10 * kMm, 0}, {10 * kMm + out, 10 * kMm}, {0, 10 * kMm}}, 5 * kMm);
    for (base::Vec3& v : mesh.vertices)
        v = {v.x(), -v.z(), v.y()};
    return mesh;
}

}  // namespace

class PrintCheckTest : public QObject {
    Q_OBJECT

 private slots:
    void box() {
        const PrintReport report =
            checkForPrinting(shapes::makeBox({0, 0, 0}, {30 * kMm, 20 * kMm, 10 * kMm}), PrintLimits{});
        QVERIFY(report.closed);
        QVERIFY(std::abs(report.volume - 6000 * kMm * kMm * kMm) < 1e-15);
        QVERIFY((report.size - base::Vec3(30, 20, 10) * kMm).norm() < 1e-12);
        QVERIFY(report.thinWalls.empty());
        QVERIFY(report.overhangs.empty());
    }

    void openMeshIsNoSolid() {
        TriangleMesh mesh = shapes::makeBox({0, 0, 0}, {1, 1, 1});
        mesh.triangles.pop_back();
        QVERIFY(!checkForPrinting(mesh, {}).closed);
        QVERIFY(!checkForPrinting({}, {}).closed);
    }

    void thinPlate() {
        // Its two large sides, each 600 mm^2, are one wall, and nothing else is thin.
        const TriangleMesh plate = shapes::makeBox({0, 0, 0}, {30 * kMm, 0.8 * kMm, 20 * kMm});
        const PrintReport report = checkForPrinting(plate, {1.0 * kMm});
        QCOMPARE(report.thinWalls.size(), 1U);
        const ThinWall& wall = report.thinWalls.front();
        QVERIFY(std::abs(wall.thickness - 0.8 * kMm) < 1e-12);
        QVERIFY(std::abs(wall.area - 600 * kMm * kMm) < 1e-12);
        QVERIFY((wall.centre - base::Vec3(15, 0.4, 10) * kMm).norm() < 1e-4);
        for (std::size_t i = 0; i < wall.patch.triangles.size(); ++i)
            QVERIFY(std::abs(triangleNormal(wall.patch, i).y()) > 0.99);
        QVERIFY(report.ridges.empty());
        QVERIFY(checkForPrinting(plate, {0.79 * kMm}).thinWalls.empty());
    }

    void thickPlateIsOneWallToo() {
        // Thinner than what the printer can do, but farther through than cells are wide.
        const PrintReport report =
            checkForPrinting(shapes::makeBox({0, 0, 0}, {40 * kMm, 30 * kMm, 5 * kMm}), {6.0 * kMm});
        QCOMPARE(report.thinWalls.size(), 1U);
        QVERIFY(std::abs(report.thinWalls.front().area - 1200 * kMm * kMm) < 1e-12);
    }

    void thinWebOnABlock() {
        // 0.8 mm thick, 10 mm high, 30 mm long, on a foot of 10 x 5 mm.
        const TriangleMesh web = shapes::makePrism({{0, 0},
                                                    {5 * kMm, 0},
                                                    {5 * kMm, 5 * kMm},
                                                    {0.4 * kMm, 5 * kMm},
                                                    {0.4 * kMm, 15 * kMm},
                                                    {-0.4 * kMm, 15 * kMm},
                                                    {-0.4 * kMm, 5 * kMm},
                                                    {-5 * kMm, 5 * kMm},
                                                    {-5 * kMm, 0}},
                                                   30 * kMm);
        const PrintReport report = checkForPrinting(web, {1.2 * kMm});
        QVERIFY(report.closed);
        QCOMPARE(report.thinWalls.size(), 1U);
        const ThinWall& wall = report.thinWalls.front();
        QVERIFY(std::abs(wall.thickness - 0.8 * kMm) < 1e-9);
        QVERIFY(std::abs(wall.area - 300 * kMm * kMm) < 1e-9);
        QVERIFY((wall.centre - base::Vec3(0, 10, 15) * kMm).norm() < 0.1 * kMm);
        QVERIFY(report.ridges.empty());
    }

    void wallOfACup() {
        // Wall and bottom 1 mm, of 60 flat sides: 1 mm times cos(3 degrees) between the sides.
        const TriangleMesh cup = shapes::makeCup(60, 20 * kMm, 15 * kMm, 1.0 * kMm);
        QCOMPARE(checkForPrinting(cup, {1.01 * kMm}).thinWalls.size(), 1U);
        QVERIFY(checkForPrinting(cup, {0.99 * kMm}).thinWalls.empty());
    }

    void wedgesAreRidgesAndNoWalls_data() {
        QTest::addColumn<double>("angle");  // [deg]
        QTest::newRow("razor") << 5.0;
        QTest::newRow("blade") << 20.0;
        QTest::newRow("ridge") << 40.0;
        QTest::newRow("blunt") << 50.0;
    }

    void wedgesAreRidgesAndNoWalls() {
        QFETCH(double, angle);
        const double half = 20 * kMm * std::tan(0.5 * angle * base::kDegree);
        const TriangleMesh wedge = shapes::makePrism({{0, 0}, {20 * kMm, -half}, {20 * kMm, half}}, 10 * kMm);
        const PrintReport report = checkForPrinting(wedge, {1.0 * kMm});
        QVERIFY(report.closed);
        QVERIFY(report.thinWalls.empty());
        QCOMPARE(report.ridges.size(), angle < 45.0 ? 1U : 0U);
        if (report.ridges.empty()) return;
        const SharpRidge& ridge = report.ridges.front();
        QVERIFY(std::abs(ridge.angle - angle * base::kDegree) < 1e-9);
        QVERIFY(std::abs(ridge.length - 10 * kMm) < 1e-12);
        QVERIFY((ridge.centre - base::Vec3(0, 0, 5) * kMm).norm() < 1e-12);
        // Where the wedge is 1 mm wide.
        QVERIFY(std::abs(ridge.lost - 0.5 * kMm / std::tan(0.5 * angle * base::kDegree)) < 1e-12);
    }

    void bluntedWedgeIsAWallWhereItIsThin() {
        // From 0.4 to 3.2 mm over 20 mm, 8 degrees: thinner than 1.2 mm over the first 5.7 mm.
        const TriangleMesh fin = shapes::makePrism(
            {{0, -0.2 * kMm}, {20 * kMm, -1.6 * kMm}, {20 * kMm, 1.6 * kMm}, {0, 0.2 * kMm}}, 30 * kMm);
        const PrintReport report = checkForPrinting(fin, {1.2 * kMm});
        QVERIFY(report.ridges.empty());
        QCOMPARE(report.thinWalls.size(), 1U);
        const ThinWall& wall = report.thinWalls.front();
        QVERIFY(wall.thickness > 0.4 * kMm && wall.thickness < 0.5 * kMm);
        QVERIFY(std::abs(wall.area / (5.7 * 30 * kMm * kMm) - 1.0) < 0.1);
    }

    void sharpenedWebIsBoth() {
        // A web of 0.8 mm, 10 mm high, that ends in a ridge of 40 degrees.
        const double tip = 0.4 * kMm / std::tan(20 * base::kDegree);
        const TriangleMesh web = shapes::makePrism({{0, 0},
                                                    {0.4 * kMm, tip},
                                                    {0.4 * kMm, tip + 10 * kMm},
                                                    {-0.4 * kMm, tip + 10 * kMm},
                                                    {-0.4 * kMm, tip}},
                                                   30 * kMm);
        const PrintReport report = checkForPrinting(web, {1.2 * kMm});
        QCOMPARE(report.ridges.size(), 1U);
        QVERIFY(std::abs(report.ridges.front().angle - 40 * base::kDegree) < 1e-9);
        QCOMPARE(report.thinWalls.size(), 1U);
        const ThinWall& wall = report.thinWalls.front();
        QVERIFY(std::abs(wall.thickness - 0.8 * kMm) < 1e-9);
        QVERIFY(std::abs(wall.area / (10 * 30 * kMm * kMm) - 1.0) < 0.1);
    }

    void notchesAreNoRidges() {
        // A groove of 30 degrees in a block: sharp from outside.
        const double half = 8 * kMm * std::tan(15 * base::kDegree);
        const TriangleMesh block = shapes::makePrism({{0, 2 * kMm},
                                                      {-half, 10 * kMm},
                                                      {-10 * kMm, 10 * kMm},
                                                      {-10 * kMm, -2 * kMm},
                                                      {10 * kMm, -2 * kMm},
                                                      {10 * kMm, 10 * kMm},
                                                      {half, 10 * kMm}},
                                                     20 * kMm);
        const PrintReport report = checkForPrinting(block, {1.0 * kMm});
        QVERIFY(report.closed);
        QVERIFY(report.ridges.empty());
        QVERIFY(report.thinWalls.empty());
    }

    void overhang() {
        const TriangleMesh ramp = makeLeaning(45 * base::kDegree);
        PrintLimits limits{0.1 * kMm, 44 * base::kDegree};
        const PrintReport report = checkForPrinting(ramp, limits);
        QCOMPARE(report.overhangs.size(), 1U);
        const Overhang& flaw = report.overhangs.front();
        QCOMPARE(flaw.triangles.size(), 2U);
        QVERIFY(std::abs(flaw.angle - 45 * base::kDegree) < 1e-9);
        QVERIFY(std::abs(flaw.area - std::sqrt(2.0) * 50 * kMm * kMm) < 1e-12);
        QVERIFY((flaw.centre - base::Vec3(15, -2.5, 5) * kMm).norm() < 1e-9);
        limits.steepestOverhang = 45 * base::kDegree;
        QVERIFY(checkForPrinting(ramp, limits).overhangs.empty());
        // Printed the other way up it has none; on its side the underside is upright.
        limits.steepestOverhang = 1 * base::kDegree;
        limits.direction = -base::Vec3::UnitZ();
        QVERIFY(checkForPrinting(ramp, limits).overhangs.empty());
        limits.direction = base::Vec3::UnitY();
        QVERIFY(checkForPrinting(ramp, limits).overhangs.empty());
    }
};

QTEST_APPLESS_MAIN(PrintCheckTest)
#include "print_check_test.moc"
