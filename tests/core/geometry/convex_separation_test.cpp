#include "core/geometry/convex_separation.h"

#include <QtTest>
#include <cmath>

#include "core/base/random.h"
#include "core/geometry/convex_hull.h"

using namespace trapwright;
using base::Pose;
using base::Quaternion;
using base::Vec3;
using geometry::ConvexPolytope;

namespace {

ConvexPolytope makeBox(const Vec3& half) {
    std::vector<Vec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i)
        corners.emplace_back(
            Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1).cwiseProduct(half));
    return geometry::computeConvexHull(corners).value();
}

Quaternion turn(double degrees, const Vec3& axis) {
    return Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

/// Distance of two convex bodies, by Frank and Wolfe's method on their Minkowski difference; from above.
double calcDistance(const ConvexPolytope& a, const Pose& poseA, const ConvexPolytope& b, const Pose& poseB) {
    const auto farthest = [](const ConvexPolytope& body, const Pose& pose, const Vec3& along) {
        Vec3 best = pose.apply(body.vertices.front());
        for (const Vec3& vertex : body.vertices)
            if (along.dot(pose.apply(vertex)) > along.dot(best)) best = pose.apply(vertex);
        return best;
    };
    Vec3 nearest = poseA.position - poseB.position;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 corner = farthest(a, poseA, -nearest) - farthest(b, poseB, nearest);
        const Vec3 way = corner - nearest;
        const double share = std::clamp(-nearest.dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
        if (share * way.norm() < 1e-12) break;
        nearest += share * way;
    }
    return nearest.norm();
}

}  // namespace

class ConvexSeparationTest : public QObject {
    Q_OBJECT

 private slots:
    void knownGaps_data() {
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("turnA");  // about y [deg]
        QTest::addColumn<double>("turnB");  // about z
        QTest::addColumn<double>("gap");
        const double diagonal = std::sqrt(2.0);
        QTest::newRow("face to face") << 2.5 << 0.0 << 0.0 << 0.5;
        QTest::newRow("inside by 0.5") << 1.5 << 0.0 << 0.0 << -0.5;
        QTest::newRow("edge to face") << 3.0 << 45.0 << 0.0 << 2.0 - diagonal;
        QTest::newRow("edge across edge") << 3.0 << 45.0 << 45.0 << 3.0 - 2.0 * diagonal;
    }
    void knownGaps() {
        QFETCH(double, x);
        QFETCH(double, turnA);
        QFETCH(double, turnB);
        QFETCH(double, gap);
        const ConvexPolytope cube = makeBox(Vec3(1, 1, 1));
        const Pose a{turn(turnA, Vec3::UnitY()), Vec3::Zero()};
        const Pose b{turn(turnB, Vec3::UnitZ()), Vec3(x, 0, 0)};
        QVERIFY(std::abs(geometry::calcSeparation(cube, a, cube, b) - gap) < 1e-12);
        QVERIFY(std::abs(geometry::calcSeparation(cube, b, cube, a) - gap) < 1e-12);
    }

    // Positive exactly if they are apart, and never more than the distance.
    void itTellsWhetherTheyAreApart() {
        base::Random random({.seed = 3});
        const ConvexPolytope a = makeBox(Vec3(2, 4, 6) * 1e-3);
        const ConvexPolytope b = makeBox(Vec3(1, 5, 3) * 1e-3);
        int apart = 0;
        for (int i = 0; i < 300; ++i) {
            const Pose poseA{random.rotation(), Vec3::Zero()};
            const Pose poseB{random.rotation(), Vec3(random.uniform(-8e-3, 8e-3), random.uniform(-8e-3, 8e-3),
                                                     random.uniform(-4e-3, 4e-3))};
            const double separation = geometry::calcSeparation(a, poseA, b, poseB);
            const double distance = calcDistance(a, poseA, b, poseB);
            QVERIFY2(separation <= distance + 1e-9, qPrintable(QString::number(i)));
            if (std::abs(separation) < 2e-5) continue;  // nearer than Frank and Wolfe come
            QVERIFY2((separation > 0.0) == (distance > 1e-5),
                     qPrintable(QString("%1: %2 against %3").arg(i).arg(separation).arg(distance)));
            apart += separation > 0.0 ? 1 : 0;
        }
        QVERIFY(apart > 50 && apart < 250);
    }

    void everyPieceCounts() {
        const std::vector<ConvexPolytope> one = {makeBox(Vec3(1, 1, 1))};
        std::vector<ConvexPolytope> two = one;
        for (Vec3& vertex : two.emplace_back(one.front()).vertices)
            vertex.x() += 4.0;
        for (geometry::PolytopeFace& face : two.back().faces)
            face.offset += 4.0 * face.normal.x();
        const Pose here;
        const auto at = [](double x) { return Pose{Quaternion::Identity(), Vec3(x, 0, 0)}; };
        QVERIFY(!geometry::areApart(two, here, one, at(0.5), 0.0));
        QVERIFY(!geometry::areApart(two, here, one, at(4.5), 0.0));
        QVERIFY(!geometry::areApart(one, at(4.5), two, here, 0.0));
        QVERIFY(geometry::areApart(two, here, one, at(6.5), 0.4));
        QVERIFY(!geometry::areApart(two, here, one, at(6.5), 0.6));
        QVERIFY(!geometry::areApart(two, here, one, at(2.0), 0.1));
    }
};

QTEST_APPLESS_MAIN(ConvexSeparationTest)
#include "convex_separation_test.moc"
