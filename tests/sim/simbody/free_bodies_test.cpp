#include "sim/simbody/free_bodies.h"

#include <QtTest>
#include <cmath>

#include "core/base/random.h"
#include "core/verify/scenes.h"

using namespace trapwright;
using base::Quaternion;
using base::Vec3;
using contact::BodyMotion;
using simbody::FreeBodies;

namespace {

constexpr double kStep = 2e-4;

FreeBodies makeBodies(int count, double gravity = base::kStandardGravity) {
    const auto cuboid = verify::makePaperCuboid();
    return {cuboid->massProperties.mass, cuboid->massProperties.inertia, {0.0, 0.0, -gravity}, count};
}

/// One step in which nothing touches.
void fly(FreeBodies& bodies) {
    bodies.beginStep(kStep);
    for (int i = 0; i < bodies.count(); ++i)
        bodies.resolve(i, {bodies.free(i), bodies.free(i), 0});
    bodies.endStep(kStep);
}

void stepAll(FreeBodies& bodies, int steps) {
    for (int i = 0; i < steps; ++i)
        fly(bodies);
    bodies.beginStep(kStep);  // so that pose() is of this moment
}

Vec3 drawVector(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Puts a body that `seed` alone determines into a slot.
void placeDrawn(FreeBodies& bodies, int slot, std::uint32_t seed) {
    base::Random random({1, 0, 0, seed, base::Purpose::test});
    const base::Pose pose{random.rotation(), drawVector(random, 0.2)};
    bodies.place(slot, pose, {drawVector(random, 0.5), drawVector(random, 30.0)}, kStep);
}

bool isSame(const FreeBodies& a, int slotA, const FreeBodies& b, int slotB) {
    return a.pose(slotA) == b.pose(slotB) && a.before(slotA).velocity == b.before(slotB).velocity &&
           a.before(slotA).angularVelocity == b.before(slotB).angularVelocity &&
           a.free(slotA).velocity == b.free(slotB).velocity &&
           a.free(slotA).angularVelocity == b.free(slotB).angularVelocity;
}

}  // namespace

class FreeBodiesTest : public QObject {
    Q_OBJECT

 private slots:
    void freeFlightIsAnExactParabola() {
        FreeBodies bodies = makeBodies(1);
        const Vec3 from(0.1, -0.2, 0.3);
        const Vec3 velocity(0.3, 0.2, 1.0);
        bodies.place(0, {Quaternion::Identity(), from}, {velocity, Vec3(20.0, -5.0, 8.0)}, kStep);
        for (int step = 0; step < 2000; ++step) {
            bodies.beginStep(kStep);
            const double t = kStep * step;
            const Vec3 gravity(0.0, 0.0, -base::kStandardGravity);
            const Vec3 expected = from + t * velocity + 0.5 * t * t * gravity;
            QVERIFY((bodies.pose(0).position - expected).norm() < 1e-12);
            QVERIFY((bodies.now(0, kStep).velocity - velocity - t * gravity).norm() < 1e-12);
            bodies.resolve(0, {bodies.free(0), bodies.free(0), 0});
            bodies.endStep(kStep);
        }
    }

    // About a principal axis a body turns evenly.
    void spinAboutAPrincipalAxisIsEven() {
        for (int axis = 0; axis < 3; ++axis) {
            FreeBodies bodies = makeBodies(1);
            const double rate = 40.0;
            const Quaternion start = Quaternion(0.9, 0.3, -0.2, 0.1).normalized();
            const Vec3 about = start * Vec3::Unit(axis);
            bodies.place(0, {start, Vec3::Zero()}, {Vec3::Zero(), rate * about}, kStep);
            stepAll(bodies, 2500);
            const Quaternion expected = Quaternion(Eigen::AngleAxisd(2500.0 * kStep * rate, about)) * start;
            QVERIFY(bodies.pose(0).rotation.angularDistance(expected) < 1e-6);
            QVERIFY(std::abs(bodies.pose(0).rotation.norm() - 1.0) < 1e-14);
            QVERIFY((bodies.now(0, kStep).angularVelocity - rate * about).norm() < 1e-9);
        }
    }

    void knowsItsMass() {
        const auto cuboid = verify::makePaperCuboid();
        const FreeBodies bodies = makeBodies(3);
        QCOMPARE(bodies.count(), 3);
        QCOMPARE(bodies.inverseMass() * cuboid->massProperties.mass, 1.0);
        QVERIFY((bodies.inverseInertia() * cuboid->massProperties.inertia - base::Mat3::Identity()).norm() <
                1e-12);
    }

    void slotsAreIndependent_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<int>("slot");
        QTest::newRow("first of two") << 2 << 0;
        QTest::newRow("last of five") << 5 << 4;
        QTest::newRow("in the middle of sixteen") << 16 << 7;
    }
    // To the last bit: how many others there are, where among them, and what becomes of them.
    void slotsAreIndependent() {
        QFETCH(int, count);
        QFETCH(int, slot);
        FreeBodies alone = makeBodies(1);
        FreeBodies many = makeBodies(count);
        placeDrawn(alone, 0, 0);
        for (int i = 0; i < count; ++i)
            placeDrawn(many, i, i == slot ? 0 : static_cast<std::uint32_t>(100 + i));
        for (int step = 0; step < 300; ++step) {
            alone.beginStep(kStep);
            many.beginStep(kStep);
            QVERIFY(isSame(alone, 0, many, slot));
            // The others are hit now and then, and replaced.
            const BodyMotion hit{Vec3(0.1, 0.2, 0.3), Vec3(1.0, 2.0, 3.0)};
            alone.resolve(0, {alone.free(0), alone.free(0), 0});
            for (int i = 0; i < count; ++i) {
                const bool isHit = i != slot && (step + i) % 10 == 0;
                many.resolve(i, isHit ? contact::StepResult{hit, hit, 1}
                                      : contact::StepResult{many.free(i), many.free(i), 0});
            }
            alone.endStep(kStep);
            many.endStep(kStep);
            for (int i = 0; i < count; ++i)
                if (i != slot && (step + i) % 50 == 0) placeDrawn(many, i, static_cast<std::uint32_t>(step));
        }
    }

    void adoptTakesABodyOverBitForBit() {
        FreeBodies old = makeBodies(4);
        for (int i = 0; i < 4; ++i)
            placeDrawn(old, i, static_cast<std::uint32_t>(i));
        for (int step = 0; step < 200; ++step)
            fly(old);
        FreeBodies fresh = makeBodies(2);
        fresh.adopt(0, old, 3);
        fresh.adopt(1, old, 1);
        for (int step = 0; step < 200; ++step) {
            old.beginStep(kStep);
            fresh.beginStep(kStep);
            QVERIFY(isSame(fresh, 0, old, 3));
            QVERIFY(isSame(fresh, 1, old, 1));
            for (FreeBodies* bodies : {&old, &fresh}) {
                for (int i = 0; i < bodies->count(); ++i)
                    bodies->resolve(i, {bodies->free(i), bodies->free(i), 0});
                bodies->endStep(kStep);
            }
        }
    }

    void contactsHaveTheirWay() {
        FreeBodies bodies = makeBodies(1);
        bodies.place(0, {}, {}, kStep);
        bodies.beginStep(kStep);
        const BodyMotion after{Vec3(0.1, 0.0, 0.2), Vec3(0.0, 0.0, 3.0)};
        const BodyMotion advance{Vec3(0.0, 0.3, 0.0), Vec3::Zero()};
        bodies.resolve(0, {after, advance, 1});
        bodies.endStep(kStep);
        bodies.beginStep(kStep);
        // The pose went with `advance`, the motion is `after`.
        QVERIFY((bodies.pose(0).position - kStep * advance.velocity).norm() < 1e-15);
        QCOMPARE(bodies.before(0).velocity, after.velocity);
        QCOMPARE(bodies.before(0).angularVelocity, after.angularVelocity);
        const Vec3 fall(0.0, 0.0, -base::kStandardGravity * kStep);
        QVERIFY((bodies.free(0).velocity - after.velocity - fall).norm() < 1e-14);
    }
};

QTEST_APPLESS_MAIN(FreeBodiesTest)
#include "free_bodies_test.moc"
