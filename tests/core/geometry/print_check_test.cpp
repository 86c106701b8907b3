#include "core/geometry/print_check.h"

#include <QTest>
#include <set>

#include "core/geometry/wall_thickness.h"
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
        const TriangleMesh plate = shapes::makeBox({0, 0, 0}, {30 * kMm, 0.8 * kMm, 20 * kMm});
        const std::vector<Wall> walls = measureWalls(plate, 50 * kMm);
        for (std::size_t i = 0; i < plate.triangles.size(); ++i) {
            const base::Vec3 normal = triangleNormal(plate, i);
            const double expected = normal.cwiseAbs().dot(base::Vec3(30, 0.8, 20)) * kMm;
            QVERIFY(std::abs(walls[i].thickness - expected) < 1e-12);
            QCOMPARE(walls[i].share, 1.0);
        }
        // Its two large sides, each 600 mm^2, and nothing else.
        const PrintReport report = checkForPrinting(plate, {1.0 * kMm});
        QCOMPARE(report.thinWalls.size(), 2U);
        std::set<int> triangles;
        for (const PrintFlaw& flaw : report.thinWalls) {
            QVERIFY(std::abs(flaw.worst - 0.8 * kMm) < 1e-12);
            QVERIFY(std::abs(flaw.area - 600 * kMm * kMm) < 1e-12);
            triangles.insert(flaw.triangles.begin(), flaw.triangles.end());
        }
        QCOMPARE(triangles.size(), 4U);
        for (const int t : triangles)
            QVERIFY(std::abs(triangleNormal(plate, t).y()) > 0.99);
        QVERIFY(checkForPrinting(plate, {0.79 * kMm}).thinWalls.empty());
    }

    void wallOfACup() {
        // Wall and bottom 1 mm, of 60 flat sides: 1 mm times cos(3 degrees) between the sides.
        const TriangleMesh cup = shapes::makeCup(60, 20 * kMm, 15 * kMm, 1.0 * kMm);
        QCOMPARE(checkForPrinting(cup, {1.01 * kMm}).thinWalls.size(), 2U);  // outside and inside
        QVERIFY(checkForPrinting(cup, {0.99 * kMm}).thinWalls.empty());
    }

    void bluntEdgesAreNoWalls() {
        // Toward its edge a wedge gets as thin as one likes; one of 40 degrees is a blade, one of 50 is not.
        const auto wedge = [](double angle) {
            const double half = 20 * kMm * std::tan(0.5 * angle);
            return shapes::makePrism({{0, 0}, {20 * kMm, -half}, {20 * kMm, half}}, 10 * kMm);
        };
        QVERIFY(checkForPrinting(wedge(50 * base::kDegree), {1.0 * kMm}).thinWalls.empty());
        // Where the way through is below 1 mm: the first 1.19 of 21.3 mm of its two sides.
        const std::vector<PrintFlaw> blade =
            checkForPrinting(wedge(40 * base::kDegree), {1.0 * kMm}).thinWalls;
        QCOMPARE(blade.size(), 1U);
        const double side = 20 * kMm / std::cos(20 * base::kDegree) * 10 * kMm;
        QVERIFY(blade.front().area > 0.0 && blade.front().area < 0.2 * 2.0 * side);
    }

    void overhang() {
        const TriangleMesh ramp = makeLeaning(45 * base::kDegree);
        PrintLimits limits{0.1 * kMm, 44 * base::kDegree};
        const PrintReport report = checkForPrinting(ramp, limits);
        QCOMPARE(report.overhangs.size(), 1U);
        const PrintFlaw& flaw = report.overhangs.front();
        QCOMPARE(flaw.triangles.size(), 2U);
        QVERIFY(std::abs(flaw.worst - 45 * base::kDegree) < 1e-9);
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
