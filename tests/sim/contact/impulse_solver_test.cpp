#include "sim/contact/impulse_solver.h"

#include <QtTest>
#include <array>
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

/// One step of one part.
contact::StepResult solve(contact::ImpulseSolver& solver, const BodyInertia& inertia,
                          const BodyMotion& before, const BodyMotion& free,
                          const std::vector<MovingContact>& contacts, const trial::ContactParameters& law) {
    const contact::MovingBody body{inertia, before, free};
    return solver.solve({&body, 1}, contacts, {law, {}}, kStep).front();
}

MovingContact makeContact(const Vec3& arm, const Vec3& normal, double gap, std::uint64_t feature) {
    return {arm, normal, gap, Vec3::Zero(), Vec3::Zero(), feature};
}

Vec3 drawVector(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A contact of part 0 with part 1 that touches already.
MovingContact betweenParts(const Vec3& armA, const Vec3& armB, const Vec3& normal) {
    return {armB, normal, 0.0, Vec3::Zero(), Vec3::Zero(), 1, 0, 1, armA};
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
    void oneCornerAfterTheOther_data() {
        QTest::addColumn<double>("restitution");
        QTest::addColumn<double>("second");
        for (const double e : {0.0, 0.3, 0.7})
            for (const double second : {0.25, 0.4, 0.9})
                QTest::addRow("e = %g, gap of %g", e, second) << e << second;
    }
    // A part that falls a little aslant and without friction: with one corner after a fifth of the step, with
    // the other when it comes there as it turns then. Impact by impact in closed form.
    void oneCornerAfterTheOther() {
        QFETCH(double, restitution);
        QFETCH(double, second);
        constexpr double kSpeed = 0.5;
        constexpr double kArm =
            2e-3;  // less than the radius of gyration: a push at one corner lifts the other, too
        const Body body;
        const double inertia = body.inertia(1, 1);
        const double gaps[2] = {0.2 * kSpeed * kStep, second * kSpeed * kStep};
        const auto speedAt = [&](const Vec2& motion, double x) { return motion.x() - motion.y() * x; };
        Vec2 motion(-kSpeed, 0.0);  // upwards, about y
        double now[2] = {gaps[0], gaps[1]};
        double left = kStep;
        while (true) {
            int next = -1;
            double soonest = left;
            for (int i = 0; i < 2; ++i) {
                const double speed = speedAt(motion, i == 0 ? kArm : -kArm);
                if (speed < -contact::scalar::kRestSpeed && -now[i] / speed < soonest) {
                    soonest = -now[i] / speed;
                    next = i;
                }
            }
            for (int i = 0; i < 2; ++i)
                now[i] += soonest * speedAt(motion, i == 0 ? kArm : -kArm);
            if (next < 0) break;
            left -= soonest;
            const double x = next == 0 ? kArm : -kArm;
            const double approach = -speedAt(motion, x);
            const double impulse = approach *
                                   (1.0 + contact::scalar::calcRestitution(approach, restitution)) /
                                   (1.0 / body.mass + x * x / inertia);
            motion += Vec2(impulse / body.mass, -impulse * x / inertia);
        }

        const BodyMotion before{Vec3(0.0, 0.0, -kSpeed), Vec3::Zero()};
        contact::ImpulseSolver solver;
        const auto result = solve(solver, body.inverse(), before, before,
                                  {makeContact(Vec3(kArm, 0.0, -2e-3), Vec3::UnitZ(), gaps[0], 1),
                                   makeContact(Vec3(-kArm, 0.0, -2e-3), Vec3::UnitZ(), gaps[1], 2)},
                                  {0.0, 0.0, restitution});
        QVERIFY(std::abs(result.motion.velocity.z() - motion.x()) < 1e-4);
        QVERIFY(std::abs(result.motion.angularVelocity.y() - motion.y()) * kArm < 1e-4);
        // So does the pose: where the corners are at the step's end.
        for (int i = 0; i < 2; ++i) {
            const Vec3 arm(i == 0 ? kArm : -kArm, 0.0, -2e-3);
            const double gap = gaps[i] + kStep * result.advance.at(arm).z();
            QVERIFY2(std::abs(gap - now[i]) < 1e-7, qPrintable(QString::number(gap - now[i])));
        }
    }

    // Contacts from all sides with much friction, pushed this way and that by some mm/s in a step: where
    // normal impulses and friction called forth each other, one set in a hundred was thrown, at up to 3e9
    // m/s.
    void wedgedPartsAreNotThrown() {
        const Body body;
        for (unsigned set = 0; set < 4000; ++set) {
            base::Random random({77, 0, 0, set, base::Purpose::test});
            std::vector<MovingContact> contacts;
            const std::uint32_t count = 2 + random.below(5);
            for (std::uint32_t i = 0; i < count; ++i) {
                const Vec3 arm = drawVector(random, 1.0).cwiseProduct(Vec3(2e-3, 4e-3, 6e-3));
                const Vec3 normal = (drawVector(random, 1.0) - arm.normalized()).normalized();
                contacts.push_back(makeContact(arm, normal, 0.0, i));
            }
            const double friction = random.uniform(0.3, 1.5);
            contact::ImpulseSolver solver;
            BodyMotion motion;
            for (int step = 0; step < 30; ++step) {
                BodyMotion free = motion;
                free.velocity += Vec3(0.0, 0.0, -9.81 * kStep) + drawVector(random, 1e-3);
                free.angularVelocity += drawVector(random, 1.0);
                motion =
                    solve(solver, body.inverse(), motion, free, contacts, {1.2 * friction, friction, 0.3})
                        .motion;
                QVERIFY2(motion.velocity.norm() < 0.2, qPrintable(QString::number(set)));
            }
        }
    }

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
            const BodyMotion after = solve(solver, body.inverse(), before, before,
                                           {makeContact(arm, normal, 0.0, 1)}, {0.4, 0.3, restitution})
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
                solve(solver, body.inverse(), before, before, {touch}, {friction, friction, 0.3}).motion;
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
            const BodyMotion after = solve(solver, body.inverse(), before, before,
                                           makeFace(Vec3::Zero(), Vec3::Zero()), {0.5, 0.3, 0.2})
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
                const BodyMotion after = solve(*solver, body.inverse(), before, before, contacts, law).motion;
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
                solve(solver, body.inverse(), motion, free, makeFace(velocity(step), velocity(step - 1)),
                      {0.5, 0.5, 0.3});
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
                solve(solver, body.inverse(), {}, {}, contacts, {0.5, 0.5, 0.3});
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
        const auto far = solve(solver, body.inverse(), before, before,
                               {makeContact({0.0, 0.0, -2e-3}, Vec3::UnitZ(), 11e-6, 1)}, {0.5, 0.5, 0.3});
        QCOMPARE(far.motion.velocity, before.velocity);
        QCOMPARE(far.carrying, 0);
        const auto near = solve(solver, body.inverse(), before, before,
                                {makeContact({0.0, 0.0, -2e-3}, Vec3::UnitZ(), 9e-6, 1)}, {0.5, 0.5, 0.3});
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
        const auto first = solve(solver, body.inverse(), before, free, contacts, law);
        QVERIFY(!solver.released());
        solver.release();
        QVERIFY(solver.released());
        const auto again = solve(solver, body.inverse(), before, free, contacts, law);
        QCOMPARE(again.motion.velocity, first.motion.velocity);
        QCOMPARE(again.motion.angularVelocity, first.motion.angularVelocity);
        QCOMPARE(again.advance.velocity, first.advance.velocity);
    }

    void headOnCollision_data() {
        QTest::addColumn<double>("ratio");
        QTest::addColumn<double>("restitution");
        for (const double ratio : {1.0, 0.1, 20.0})
            for (const double e : {0.0, 0.4, 0.95})
                QTest::addRow("A / B = %g, e = %g", ratio, e) << ratio << e;
    }
    // Two parts meet in the line of their centres, as in the closed form: momentum stays, and they part as
    // fast as restitution wants.
    void headOnCollision() {
        QFETCH(double, ratio);
        QFETCH(double, restitution);
        const Body body;
        const contact::MovingBody b{body.inverse(), {{-0.1, 0.02, 0.0}, Vec3::Zero()}, {}};
        contact::MovingBody a = b;
        a.inertia = {b.inertia.inverseMass / ratio, b.inertia.inverseInertia / ratio};
        a.before.velocity = {0.3, 0.02, 0.0};
        std::array bodies{a, b};
        for (contact::MovingBody& one : bodies)
            one.free = one.before;
        contact::ImpulseSolver solver;
        const std::vector contacts{betweenParts({2e-3, 0.0, 0.0}, {-2e-3, 0.0, 0.0}, Vec3::UnitX())};
        const auto after = solver.solve(bodies, contacts, {{}, {0.4, 0.4, restitution}}, kStep);
        const double common = (ratio * 0.3 - 0.1) / (ratio + 1.0);
        const double tolerance = 1e-5;
        QVERIFY(std::abs(after[0].motion.velocity.x() - (common - 0.4 * restitution / (ratio + 1.0))) <
                tolerance);
        QVERIFY(std::abs(after[1].motion.velocity.x() -
                         (common + 0.4 * restitution * ratio / (ratio + 1.0))) < tolerance);
        QVERIFY(std::abs(after[0].motion.velocity.y() - 0.02) < tolerance);
        QCOMPARE(after[0].carrying, 1);
        QCOMPARE(after[1].carrying, 1);
        // What A loses B gets.
        const Vec3 impulse = solver.impulses().at(0).impulse;
        QVERIFY((body.mass * (after[1].motion.velocity - b.before.velocity) - impulse).norm() < 1e-9);
    }

    // Two parts and the track, in any places: momentum and angular momentum of the two change by what the
    // track gives, and energy never grows.
    void partsShareMomentumAndLoseEnergy() {
        base::Random random({5, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 2000; ++i) {
            const std::array shapes{Body(random.rotation()), Body(random.rotation())};
            const Vec3 between = 8e-3 * (random.rotation() * Vec3::UnitZ());  // A's centre -> B's
            std::array<contact::MovingBody, 2> bodies;
            for (std::size_t k = 0; k < 2; ++k) {
                bodies[k].inertia = shapes[k].inverse();
                bodies[k].before = {drawVector(random, 0.3), drawVector(random, 30.0)};
                bodies[k].free = bodies[k].before;
            }
            std::vector<MovingContact> contacts;
            const std::uint32_t count = 1 + random.below(4);
            for (std::uint32_t k = 0; k < count; ++k) {
                const Vec3 arm = 0.5 * between + drawVector(random, 3e-3);
                contacts.push_back(betweenParts(arm, arm - between, between.normalized()));
                contacts.back().feature = k;
            }
            if (i % 3 != 0) contacts.push_back(makeContact(drawVector(random, 4e-3), Vec3::UnitZ(), 0.0, 1));
            const double friction = random.uniform(0.0, 1.0);
            const trial::ContactParameters law{friction, friction, random.uniform(0.0, 0.9)};
            contact::ImpulseSolver solver;
            const auto after = solver.solve(bodies, contacts, {law, law}, kStep);
            Vec3 momentum = Vec3::Zero();
            Vec3 angular = Vec3::Zero();  // about A's centre
            double energy = 0.0;
            double energyBefore = 0.0;
            for (std::size_t k = 0; k < 2; ++k) {
                const BodyMotion& to = after[k].motion;
                const BodyMotion& from = bodies[k].before;
                const Vec3 gained = shapes[k].mass * (to.velocity - from.velocity);
                momentum += gained;
                angular += shapes[k].inertia * (to.angularVelocity - from.angularVelocity);
                if (k == 1) angular += between.cross(gained);
                energy += shapes[k].calcEnergy(to);
                energyBefore += shapes[k].calcEnergy(from);
            }
            for (const contact::ContactImpulse& given : solver.impulses()) {
                const MovingContact& contact = contacts[static_cast<std::size_t>(given.contact)];
                if (contact.bodyA != trial::kTrack) continue;
                momentum -= given.impulse;
                angular -= contact.arm.cross(given.impulse);
            }
            QVERIFY(momentum.norm() < 1e-12);
            QVERIFY(angular.norm() < 1e-14);
            QVERIFY2(energy < energyBefore * (1.0 + 1e-3),
                     qPrintable(QString("pair %1: from %2 to %3").arg(i).arg(energyBefore).arg(energy)));
        }
    }

    // Beside others that it does not touch a part moves as if it were alone, to the last bit.
    void whoTouchesNobodyIsAlone() {
        base::Random random({6, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 200; ++i) {
            const Body body(random.rotation());
            const trial::ContactParameters law{0.5, 0.4, 0.3};
            contact::MovingBody own{body.inverse(), {drawVector(random, 0.2), drawVector(random, 10.0)}, {}};
            own.free = own.before;
            const std::vector<MovingContact> contacts = drawContacts(random, 5e-6);
            contact::ImpulseSolver alone;
            const contact::StepResult expected = alone.solve({&own, 1}, contacts, {law, {}}, kStep).front();

            std::array bodies{own, own, own};
            bodies[0].before.velocity = bodies[0].free.velocity = {0.1, 0.0, 0.0};
            std::vector<MovingContact> all{betweenParts({3e-3, 0.0, 0.0}, {-3e-3, 0.0, 0.0}, Vec3::UnitX())};
            for (MovingContact contact : contacts) {
                contact.bodyB = 2;
                all.push_back(contact);
            }
            contact::ImpulseSolver solver;
            const auto after = solver.solve(bodies, all, {law, law}, kStep);
            QCOMPARE(after[2].motion.velocity, expected.motion.velocity);
            QCOMPARE(after[2].motion.angularVelocity, expected.motion.angularVelocity);
            QCOMPARE(after[2].advance.velocity, expected.advance.velocity);
            QCOMPARE(after[2].carrying, expected.carrying);
        }
    }

    // A block on a block on the track, which shakes within what friction holds: both follow it, and the lower
    // one carries the weight of both.
    void aStackFollowsTheTrack() {
        const Body body;
        contact::ImpulseSolver solver;
        const auto velocity = [](long step) {
            const double time = kStep * static_cast<double>(step);
            return Vec3(0.02 * std::cos(60.0 * time), 0.0, 0.01 * std::cos(95.0 * time));
        };
        std::array<contact::MovingBody, 2> bodies;
        for (contact::MovingBody& one : bodies)
            one = {body.inverse(), {velocity(0), Vec3::Zero()}, {}};
        double weight = 0.0;
        for (long step = 1; step < 2000; ++step) {
            std::vector<MovingContact> contacts = makeFace(velocity(step), velocity(step - 1));
            for (const MovingContact& below : makeFace(Vec3::Zero(), Vec3::Zero())) {
                const Vec3 armA(below.arm.x(), below.arm.y(), -below.arm.z());
                contacts.push_back(betweenParts(armA, below.arm, Vec3::UnitZ()));
                contacts.back().feature = below.feature;
            }
            for (contact::MovingBody& one : bodies) {
                one.free = one.before;
                one.free.velocity.z() -= base::kStandardGravity * kStep;
            }
            const trial::ContactParameters law{0.5, 0.5, 0.3};
            const auto after = solver.solve(bodies, contacts, {law, law}, kStep);
            for (std::size_t k = 0; k < 2; ++k) {
                QVERIFY((after[k].motion.velocity - velocity(step)).norm() < 3e-5);
                QVERIFY(after[k].motion.angularVelocity.norm() < 1e-2);
                bodies[k].before = after[k].motion;
            }
            for (const contact::ContactImpulse& given : solver.impulses())
                if (contacts[static_cast<std::size_t>(given.contact)].bodyA == trial::kTrack)
                    weight += given.impulse.z() / 1999.0 / kStep;
        }
        // The track's mean acceleration is next to nothing.
        QVERIFY(std::abs(weight / (2.0 * body.mass * base::kStandardGravity) - 1.0) < 0.01);
    }
};

QTEST_APPLESS_MAIN(ImpulseSolverTest)
#include "impulse_solver_test.moc"
