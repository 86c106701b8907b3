#include "sim/contact/law.h"

#include <QtTest>
#include <cmath>

#include "core/base/math.h"
#include "core/base/random.h"
#include "sim/contact/formulas/scalar.h"

using namespace trapwright;
using base::Vec2;

namespace {

constexpr int kSubsteps = 10000;

struct Friction {
    Vec2 change;
    bool sliding;
};

Friction calcFriction(const Vec2& slip, const Vec2& slipBefore, double bound) {
    const contact::scalar::Pair end = {slip.x(), slip.y()};
    const contact::scalar::FrictionShape shape =
        contact::scalar::calcFrictionShape(end, {slipBefore.x(), slipBefore.y()}, bound);
    const contact::scalar::Friction friction = contact::scalar::calcFriction(shape, end, bound);
    return {{friction.change.x, friction.change.y}, friction.sliding};
}

base::Random makeRandom(std::uint32_t trial) {
    return base::Random({1, 0, 0, trial, base::Purpose::test});
}

/// Slip at the end of one unit of time under a constant acceleration and dry friction of strength `bound`, in
/// many small implicit steps: what calcFriction must say in one.
double integrateSlip(double before, double acceleration, double bound) {
    const double h = 1.0 / kSubsteps;
    double slip = before;
    for (int i = 0; i < kSubsteps; ++i) {
        const double free = slip + h * acceleration;
        slip = std::abs(free) <= h * bound ? 0.0 : free - std::copysign(h * bound, free);
    }
    return slip;
}

/// The same by the law, along a direction of the plane.
double calcSlip(double before, double acceleration, double bound, const Vec2& along) {
    const Friction friction = calcFriction((before + acceleration) * along, before * along, bound);
    return (before + acceleration) + friction.change.dot(along);
}

/// The same in the plane.
Vec2 integratePlaneSlip(const Vec2& before, const Vec2& acceleration, double bound) {
    const double h = 1.0 / kSubsteps;
    Vec2 slip = before;
    for (int i = 0; i < kSubsteps; ++i) {
        slip += h * acceleration;
        const double size = slip.norm();
        slip *= size <= h * bound ? 0.0 : 1.0 - h * bound / size;
    }
    return slip;
}

/// Mean velocity (along conveying, down the slope) of a point on a plane that vibrates at 50 Hz and 12 deg
/// and falls off to the side by `slope`.
Vec2 convey(double friction, double halfStroke, double slope, double step) {
    const double w = 2.0 * base::kPi * 50.0;
    const double along = halfStroke * std::cos(12.0 * base::kDegree);
    const double up = halfStroke * std::sin(12.0 * base::kDegree);
    const auto perPeriod = static_cast<int>(std::lround(0.02 / step));
    const auto sine = [&](int i) { return std::sin(w * step * i); };
    const auto planeSpeed = [&](int i) { return Vec2(along * (sine(i + 1) - sine(i)) / step, 0.0); };
    Vec2 velocity = Vec2::Zero();
    Vec2 way = Vec2::Zero();
    for (int i = 0; i < 30 * perPeriod; ++i) {
        const double lift = up * (sine(i + 1) - 2.0 * sine(i) + sine(i - 1)) / step;
        const double bound = friction * (base::kStandardGravity * std::cos(slope) * step + lift);
        const Vec2 before = velocity - planeSpeed(i - 1);
        velocity.y() += base::kStandardGravity * std::sin(slope) * step;
        velocity += calcFriction(velocity - planeSpeed(i), before, bound).change;
        if (i >= 20 * perPeriod) way += step * velocity;
    }
    return way / 0.2;
}

/// Rebound ratio of a mass on the continuous form's contact, by classical Runge-Kutta steps.
double integrateRebound(double restitution, double approach) {
    const double mass = 1e-4;
    const double damping = contact::calcContactDamping(restitution);
    const auto acceleration = [&](double depth, double rate) {
        return depth > 0.0 ? -contact::calcNormalForce(depth, rate, approach, damping) / mass : 0.0;
    };
    const double h = 1e-4 * std::sqrt(mass / contact::kStiffness);
    double x = 0.0;
    double v = approach;
    do {
        const double a1 = acceleration(x, v);
        const double a2 = acceleration(x + 0.5 * h * v, v + 0.5 * h * a1);
        const double a3 = acceleration(x + 0.5 * h * v + 0.25 * h * h * a1, v + 0.5 * h * a2);
        const double a4 = acceleration(x + h * v + 0.5 * h * h * a2, v + h * a3);
        x += h * v + h * h / 6.0 * (a1 + a2 + a3);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    } while (x > 0.0);
    return -v / approach;
}

}  // namespace

class LawTest : public QObject {
    Q_OBJECT

 private slots:
    void restitutionRamp_data() {
        QTest::addColumn<double>("speed");
        QTest::addColumn<double>("share");
        QTest::newRow("resting") << 0.0 << 0.0;
        QTest::newRow("at 3 mm/s") << 3e-3 << 0.0;
        QTest::newRow("half-way") << 7.5e-3 << 0.5;
        QTest::newRow("at 12 mm/s") << 12e-3 << 1.0;
        QTest::newRow("impact of a feeder") << 0.1 << 1.0;
        QTest::newRow("fast") << 2.0 << 1.0;
    }
    void restitutionRamp() {
        QFETCH(double, speed);
        QFETCH(double, share);
        for (const double e : {0.0, 0.3, 0.9})
            QVERIFY(std::abs(contact::scalar::calcRestitution(speed, e) - share * e) < 1e-12);
    }

    // Of 3000 random steps at least 300 turn round inside the step, 300 stick and 300 slide on.
    void frictionAgreesWithFineIntegration() {
        base::Random random = makeRandom(1);
        int turned = 0;
        int stuck = 0;
        int slid = 0;
        for (int i = 0; i < 3000; ++i) {
            const double bound = random.uniform(0.1, 1.0);
            const double before = bound * random.uniform(0.0, 3.0);
            const double acceleration = bound * random.uniform(-3.0, 2.0);
            const double heading = random.uniform(0.0, 2.0 * base::kPi);
            const Vec2 along(std::cos(heading), std::sin(heading));
            const double expected = integrateSlip(before, acceleration, bound);
            const double got = calcSlip(before, acceleration, bound, along);
            // A slip of less than a hundredth of the bound counts as none.
            const double tolerance = 5.0 * bound / kSubsteps + (before <= 0.01 * bound ? before : 0.0);
            QVERIFY2(std::abs(got - expected) < tolerance,
                     qPrintable(QString("before %1, acceleration %2, bound %3: %4 instead of %5")
                                    .arg(before)
                                    .arg(acceleration)
                                    .arg(bound)
                                    .arg(got)
                                    .arg(expected)));
            turned += expected < 0.0 ? 1 : 0;
            stuck += expected == 0.0 ? 1 : 0;
            slid += expected > 0.0 ? 1 : 0;
        }
        QVERIFY(turned > 300 && stuck > 300 && slid > 300);
    }

    // Where the slip changes its direction by whatever angle within a step: the result is off by a small
    // share of what friction does, at most a third of it where slip nearly vanishes.
    void frictionTurnsWithTheSlip() {
        base::Random random = makeRandom(4);
        constexpr int kCases = 1000;
        double sum = 0.0;
        double worst = 0.0;
        for (int i = 0; i < kCases; ++i) {
            const double bound = random.uniform(0.1, 1.0);
            const Vec2 before = 6.0 * bound * Vec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const Vec2 carried = 6.0 * bound * Vec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const Vec2 expected = integratePlaneSlip(before, carried, bound);
            const Vec2 slip = before + carried;
            const Vec2 got = slip + calcFriction(slip, before, bound).change;
            const double error = (got - expected).norm() / bound;
            sum += error;
            worst = std::max(worst, error);
        }
        QVERIFY2(sum / kCases < 0.05, qPrintable(QString::number(sum / kCases)));
        QVERIFY2(worst < 0.33, qPrintable(QString::number(worst)));
    }

    void conveyingOnASidewaysSlope_data() {
        QTest::addColumn<double>("friction");
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("degrees");
        for (const double friction : {0.3, 0.5})
            for (const double halfStroke : {0.25e-3, 0.45e-3})
                for (const double degrees : {0.0, 2.0, 8.0, 14.0})
                    QTest::addRow("friction %g, %g mm, %g deg", friction, halfStroke * 1e3, degrees)
                        << friction << halfStroke << degrees;
    }
    // A point on a vibrating plane that falls off to the side: it slides across while it is conveyed. At the
    // engines' step it moves as at a step fifty times finer, where the direction of friction is no question.
    void conveyingOnASidewaysSlope() {
        QFETCH(double, friction);
        QFETCH(double, halfStroke);
        QFETCH(double, degrees);
        const Vec2 expected = convey(friction, halfStroke, degrees * base::kDegree, 4e-6);
        const Vec2 got = convey(friction, halfStroke, degrees * base::kDegree, 2e-4);
        const QString both = QString("%1, %2 instead of %3, %4 mm/s")
                                 .arg(got.x() * 1e3)
                                 .arg(got.y() * 1e3)
                                 .arg(expected.x() * 1e3)
                                 .arg(expected.y() * 1e3);
        QVERIFY2(std::abs(got.x() - expected.x()) < 0.02 * expected.x(), qPrintable(both));
        QVERIFY2(std::abs(got.y() - expected.y()) < 0.02 * expected.norm(), qPrintable(both));
    }

    void whatCanHoldSticksExactly() {
        base::Random random = makeRandom(2);
        for (int i = 0; i < 1000; ++i) {
            const Vec2 slip(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const double bound = slip.norm() * random.uniform(1.0, 3.0) + 1e-12;
            const Friction held = calcFriction(slip, Vec2::Zero(), bound);
            QVERIFY(!held.sliding);
            QCOMPARE(Vec2(slip + held.change), Vec2(Vec2::Zero()));
            const Friction torn = calcFriction(slip, Vec2::Zero(), 0.99 * slip.norm());
            QVERIFY(torn.sliding);
        }
    }

    // The slip at the end is a continuous function of the acceleration that grows by no more than it does:
    // no jump where sliding goes over into turning round or sticking.
    void frictionIsContinuousInTheAcceleration() {
        constexpr double kStep = 1e-4;
        for (const double bound : {0.2, 1.0}) {
            for (const double before : {0.05, 0.5, 1.5}) {
                double last = calcSlip(before, -5.0, bound, Vec2::UnitX());
                for (int i = 1; i < 80000; ++i) {
                    const double slip = calcSlip(before, -5.0 + i * kStep, bound, Vec2::UnitX());
                    QVERIFY(slip - last > -1e-12);
                    QVERIFY(slip - last < 1.001 * kStep);
                    last = slip;
                }
            }
        }
    }

    void frictionStaysInItsConeAndTurnsWithTheScene() {
        base::Random random = makeRandom(3);
        for (int i = 0; i < 5000; ++i) {
            const Vec2 slip(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const Vec2 before(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const double bound = random.uniform(0.0, 1.0);
            const Eigen::Rotation2Dd turn(random.uniform(0.0, 2.0 * base::kPi));
            const Friction plain = calcFriction(slip, before, bound);
            const Friction turned = calcFriction(turn * slip, turn * before, bound);
            QVERIFY(plain.change.norm() <= bound * (1.0 + 1e-12));
            QVERIFY((turn * plain.change - turned.change).norm() < 1e-12);
            QCOMPARE(plain.sliding, turned.sliding);
        }
    }

    void dampingGivesTheSetRebound_data() {
        QTest::addColumn<double>("restitution");
        for (const double e : {0.05, 0.2, 0.3, 0.5, 0.7, 0.9})
            QTest::addRow("e = %g", e) << e;
    }
    void dampingGivesTheSetRebound() {
        QFETCH(double, restitution);
        for (const double approach : {0.02, 0.5})
            QVERIFY(std::abs(integrateRebound(restitution, approach) - restitution) < 1e-3);
    }

    void normalForceOnlyPushes() {
        const double damping = contact::calcContactDamping(0.3);
        QCOMPARE(contact::calcNormalForce(1e-5, -10.0, 0.1, damping), 0.0);
        QCOMPARE(contact::calcNormalForce(1e-5, 0.0, 0.1, damping), contact::kStiffness * 1e-5);
        // Without an approach the damping stays finite.
        QCOMPARE(contact::calcNormalForce(1e-5, 1e-3, 0.0, damping),
                 contact::calcNormalForce(1e-5, 1e-3, contact::kLeastApproach, damping));
    }

    void regularisedFrictionHasCoulombsLimits() {
        const trial::ContactParameters law{0.6, 0.4, 0.3};
        const auto friction = [&](double slip) { return slip * contact::calcFrictionRatio(slip, law); };
        QCOMPARE(friction(0.0), 0.0);
        QCOMPARE(friction(0.5 * contact::kSlipScale), 0.3);
        QCOMPARE(friction(contact::kSlipScale), 0.6);
        QCOMPARE(friction(10.0 * contact::kSlipScale), 0.4);
        QCOMPARE(friction(1.0), 0.4);
        double last = 0.6;
        for (int i = 0; i < 1900; ++i) {
            const double slip = contact::kSlipScale + i * 1e-6;
            QVERIFY(friction(slip) <= last + 1e-12 && friction(slip) >= 0.4 - 1e-12);
            last = friction(slip);
        }
    }
};

QTEST_APPLESS_MAIN(LawTest)
#include "law_test.moc"
