#include "sim/contact/impulse_solver.h"

#include <QtTest>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/verify/scenes.h"

using namespace trapwright;
using base::Vec2;
using base::Vec3;
using contact::BodyInertia;
using contact::BodyMotion;
using contact::MovingContact;

namespace {

constexpr double kStep = 2e-4;

/// The paper's cuboid, in an orientation.
struct Body {
    double mass;
    base::Mat3 inertia;  // room axes

    explicit Body(const base::Quaternion& rotation = base::Quaternion::Identity()) {
        const auto cuboid = verify::makePaperCuboid();
        mass = cuboid->massProperties.mass;
        inertia = rotation * cuboid->massProperties.inertia * rotation.conjugate();
    }
    [[nodiscard]] BodyInertia inverse() const { return {1.0 / mass, inertia.inverse()}; }
    [[nodiscard]] double calcEnergy(const BodyMotion& motion) const {
        return 0.5 * mass * motion.velocity.squaredNorm() +
               0.5 * motion.angularVelocity.dot(inertia * motion.angularVelocity);
    }
};

MovingContact makeContact(const Vec3& arm, const Vec3& normal, double gap, std::uint64_t feature) {
    return {arm, normal, gap, Vec3::Zero(), Vec3::Zero(), feature};
}

Vec3 drawVector(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// One to six contacts around the part's lower half, leaning up to some 50 degrees.
std::vector<MovingContact> drawContacts(base::Random& random, double gap) {
    std::vector<MovingContact> contacts;
    const std::uint32_t count = 1 + random.below(6);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 normal = (Vec3::UnitZ() + drawVector(random, 0.7)).normalized();
        const Vec3 arm = Vec3(0.0, 0.0, -3e-3) + drawVector(random, 3e-3);
        contacts.push_back(makeContact(arm, normal, random.uniform(0.0, gap), i));
    }
    return contacts;
}

/// The four corners of a face that is 3 mm below the centre.
std::vector<MovingContact> makeFace(const Vec3& trackVelocity, const Vec3& trackVelocityBefore) {
    std::vector<MovingContact> contacts;
    for (int i = 0; i < 4; ++i) {
        const Vec3 arm((i & 1) != 0 ? 6e-3 : -6e-3, (i & 2) != 0 ? 4e-3 : -4e-3, -2e-3);
        contacts.push_back(
            {arm, Vec3::UnitZ(), 0.0, trackVelocity, trackVelocityBefore, static_cast<std::uint64_t>(i)});
    }
    return contacts;
}

}  // namespace

class ImpulseSolverTest : public QObject {
    Q_OBJECT

 private slots:
    void reboundOfOneContact_data() {
        QTest::addColumn<double>("speed");
        QTest::addColumn<double>("restitution");
        QTest::addColumn<double>("expected");
        for (const double e : {0.0, 0.3, 0.9})
            for (const double speed : {0.02, 0.1, 1.0})
                QTest::addRow("%g m/s, e = %g", speed, e) << speed << e << e;
        QTest::newRow("too slow to rebound") << 2.5e-3 << 0.9 << 0.0;
    }
    // Newton's law holds at the contact point, for any lever arm and any direction of the normal.
    void reboundOfOneContact() {
        QFETCH(double, speed);
        QFETCH(double, restitution);
        QFETCH(double, expected);
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 100; ++i) {
            const Body body(random.rotation());
            const Vec3 normal = random.rotation() * Vec3::UnitZ();
            const Vec3 arm = i == 0 ? Vec3(-3e-3 * normal) : drawVector(random, 4e-3);
            const BodyMotion before{-speed * normal, Vec3::Zero()};
            contact::ImpulseSolver solver;
            const BodyMotion after =
                solver
                    .solve(body.inverse(), before, before, {makeContact(arm, normal, 0.0, 1)},
                           {0.4, 0.3, restitution}, kStep)
                    .motion;
            const double tolerance =
                std::hypot(contact::scalar::kVelocityTolerance, contact::scalar::kRelativeTolerance * speed);
            QVERIFY(std::abs(normal.dot(after.at(arm)) - expected * speed) < tolerance);
        }
    }

    // One contact gives one impulse at one point: along its normal at least zero, across it within Coulomb's
    // cone, and the spin is its moment.
    void impulseOfOneContactIsInTheCone() {
        base::Random random({2, 0, 0, 0, base::Purpose::test});
        int sliding = 0;
        int sticking = 0;
        for (int i = 0; i < 2000; ++i) {
            const Body body(random.rotation());
            const double friction = random.uniform(0.0, 1.0);
            const Vec3 normal = random.rotation() * Vec3::UnitZ();
            const bool central = i % 2 == 0;
            const Vec3 arm = central ? Vec3(-3e-3 * normal) : drawVector(random, 4e-3);
            BodyMotion before{drawVector(random, 0.3), drawVector(random, 30.0)};
            before.velocity -= 0.2 * normal;
            MovingContact touch = makeContact(arm, normal, random.uniform(0.0, 5e-6), 1);
            touch.trackVelocity = touch.trackVelocityBefore = drawVector(random, 0.1);
            contact::ImpulseSolver solver;
            const BodyMotion after =
                solver.solve(body.inverse(), before, before, {touch}, {friction, friction, 0.3}, kStep)
                    .motion;
            const Vec3 impulse = body.mass * (after.velocity - before.velocity);
            const double normalImpulse = normal.dot(impulse);
            const double across = (impulse - normalImpulse * normal).norm();
            QVERIFY(normalImpulse > -1e-15);
            QVERIFY(across <= friction * normalImpulse + 1e-12);
            const Vec3 moment = body.inertia * (after.angularVelocity - before.angularVelocity);
            QVERIFY((moment - arm.cross(impulse)).norm() < 1e-12 * (impulse.norm() + 1e-6));
            if (normalImpulse <= 1e-9) continue;
            const Vec3 relative = after.at(arm) - touch.trackVelocity;
            const Vec3 slip = relative - normal.dot(relative) * normal;
            // Where the normal impulse does not turn the slip: it sticks, or friction is fully used.
            if (slip.norm() < 1e-5) ++sticking;
            if (slip.norm() < 1e-5 || !central) continue;
            QVERIFY(across > (1.0 - 1e-3) * friction * normalImpulse);
            ++sliding;
        }
        QVERIFY(sliding > 200 && sticking > 200);
    }

    // The contacts of one plane pull across it no more than their cone allows all of them together.
    void impulsesOfAFaceAreInTheCone() {
        base::Random random({3, 0, 0, 0, base::Purpose::test});
        const Body body;
        for (int i = 0; i < 500; ++i) {
            const BodyMotion before{drawVector(random, 0.2) - Vec3(0.0, 0.0, 0.2), drawVector(random, 10.0)};
            contact::ImpulseSolver solver;
            const BodyMotion after = solver
                                         .solve(body.inverse(), before, before,
                                                makeFace(Vec3::Zero(), Vec3::Zero()), {0.5, 0.3, 0.2}, kStep)
                                         .motion;
            const Vec3 impulse = body.mass * (after.velocity - before.velocity);
            QVERIFY(impulse.head<2>().norm() <= 0.5 * impulse.z() + 1e-12);
        }
    }

    void energyNeverGrows_data() {
        QTest::addColumn<double>("restitution");
        for (const double e : {0.0, 0.3, 0.6, 0.9})
            QTest::addRow("e = %g", e) << e;
    }
    // Relative to a track that rests or moves evenly, whatever the contacts: in a fresh solver and in one
    // that remembers the impulses of other motions.
    void energyNeverGrows() {
        QFETCH(double, restitution);
        base::Random random({4, 0, 0, 0, base::Purpose::test});
        contact::ImpulseSolver old;
        for (int i = 0; i < 3000; ++i) {
            const Body body(random.rotation());
            const double friction = random.uniform(0.0, 1.0);
            const Vec3 wind = i % 2 == 0 ? Vec3::Zero().eval() : drawVector(random, 0.3);
            auto contacts = drawContacts(random, 20e-6);
            for (MovingContact& contact : contacts)
                contact.trackVelocity = contact.trackVelocityBefore = wind;
            const double pace = std::pow(10.0, random.uniform(-3.0, 0.0));
            BodyMotion before{wind + pace * drawVector(random, 1.0), pace * drawVector(random, 100.0)};
            contact::ImpulseSolver fresh;
            const auto relative = [&](BodyMotion motion) {
                motion.velocity -= wind;
                return motion;
            };
            const double energy = body.calcEnergy(relative(before));
            const trial::ContactParameters law{friction, friction, restitution};
            for (contact::ImpulseSolver* solver : {&fresh, &old}) {
                const BodyMotion after =
                    solver->solve(body.inverse(), before, before, contacts, law, kStep).motion;
                const double gain = body.calcEnergy(relative(after)) / energy - 1.0;
                QVERIFY2(gain < 1e-3, qPrintable(QString("step %1: energy grows by %2").arg(i).arg(gain)));
            }
        }
    }

    // Four corners, gravity, and a track that shakes within what friction holds: the part has the track's
    // velocity, step after step, and does not turn.
    void aRestingBlockFollowsTheTrack() {
        const Body body;
        contact::ImpulseSolver solver;
        BodyMotion motion;
        const auto track = [](long step) {
            const double time = kStep * static_cast<double>(step);
            return Vec3(0.4e-3 * std::sin(60.0 * time) + 0.02 * time, 0.3e-3 * std::sin(95.0 * time + 1.0),
                        0.2e-3 * std::sin(120.0 * time));
        };
        const auto velocity = [&](long step) { return Vec3((track(step + 1) - track(step)) / kStep); };
        motion.velocity = velocity(0);
        Vec3 position = track(1);
        for (long step = 1; step < 2000; ++step) {
            BodyMotion free = motion;
            free.velocity.z() -= base::kStandardGravity * kStep;
            const contact::StepResult result =
                solver.solve(body.inverse(), motion, free, makeFace(velocity(step), velocity(step - 1)),
                             {0.5, 0.5, 0.3}, kStep);
            motion = result.motion;
            position += kStep * result.advance.velocity;
            QVERIFY((motion.velocity - velocity(step)).norm() < 3e-6);
            QVERIFY(motion.angularVelocity.norm() < 1e-3);
            QCOMPARE(result.carrying, 4);
        }
        QVERIFY((position - track(2000)).norm() < 1e-7);
    }

    void overlapIsTakenBackWithoutSpeed() {
        const Body body;
        auto contacts = makeFace(Vec3::Zero(), Vec3::Zero());
        contact::ImpulseSolver solver;
        double overlap = 40e-6;
        double last = overlap;
        for (int step = 0; step < 60; ++step) {
            for (MovingContact& contact : contacts)
                contact.gap = -overlap;
            const contact::StepResult result =
                solver.solve(body.inverse(), {}, {}, contacts, {0.5, 0.5, 0.3}, kStep);
            QVERIFY(result.motion.velocity.norm() < 1e-12 && result.motion.angularVelocity.norm() < 1e-9);
            QVERIFY(kStep * result.advance.angularVelocity.norm() < 1e-5);  // 60 nm at the corners
            overlap -= kStep * result.advance.velocity.z();
            QVERIFY(overlap <= last);
            last = overlap;
        }
        QVERIFY(overlap > -1e-9 && overlap < 1e-8);
    }

    void aGapIsFlownThrough() {
        const Body body;
        const BodyMotion before{{0.1, 0.0, -0.05}, Vec3::Zero()};
        contact::ImpulseSolver solver;
        // In a step it falls by 10 micrometres.
        const auto far =
            solver.solve(body.inverse(), before, before,
                         {makeContact({0.0, 0.0, -2e-3}, Vec3::UnitZ(), 11e-6, 1)}, {0.5, 0.5, 0.3}, kStep);
        QCOMPARE(far.motion.velocity, before.velocity);
        QCOMPARE(far.carrying, 0);
        const auto near =
            solver.solve(body.inverse(), before, before,
                         {makeContact({0.0, 0.0, -2e-3}, Vec3::UnitZ(), 9e-6, 1)}, {0.5, 0.5, 0.3}, kStep);
        QCOMPARE(near.carrying, 1);
        // At the step's end it has touched and rebounded.
        QVERIFY(near.motion.velocity.z() > 0.0);
        QVERIFY(9e-6 + kStep * near.advance.velocity.z() > -1e-9);
    }

    void releaseForgets() {
        const Body body;
        const BodyMotion before{{0.05, 0.0, 0.0}, Vec3::Zero()};
        BodyMotion free = before;
        free.velocity.z() -= 1e-3;
        const auto contacts = makeFace(Vec3::Zero(), Vec3::Zero());
        const trial::ContactParameters law{0.5, 0.4, 0.3};
        contact::ImpulseSolver solver;
        QVERIFY(solver.released());
        const auto first = solver.solve(body.inverse(), before, free, contacts, law, kStep);
        QVERIFY(!solver.released());
        solver.release();
        QVERIFY(solver.released());
        const auto again = solver.solve(body.inverse(), before, free, contacts, law, kStep);
        QCOMPARE(again.motion.velocity, first.motion.velocity);
        QCOMPARE(again.motion.angularVelocity, first.motion.angularVelocity);
        QCOMPARE(again.advance.velocity, first.advance.velocity);
    }
};

QTEST_APPLESS_MAIN(ImpulseSolverTest)
#include "impulse_solver_test.moc"
