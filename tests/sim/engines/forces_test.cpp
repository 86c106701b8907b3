#include <QtTest>
#include <algorithm>

#include "tests/sim/contact/sunken_scenes.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

constexpr double kStep = 2e-4;

Vec3 sumOf(const trial::TrajectorySample& sample) {
    Vec3 sum = Vec3::Zero();
    for (const trial::ContactForce& contact : sample.forces)
        sum += contact.force;
    return sum;
}

FeederShape shapeOf(bool bowl) {
    if (!bowl) return {};
    return {FeederType::bowl, 0.175, Conveying::clockwise};
}

}  // namespace

/// The contact forces of a replay against Newton: what acts is what moves.
class ForcesTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    void restingPartIsCarried_data() {
        QTest::addColumn<bool>("bowl");
        QTest::newRow("linear") << false;
        QTest::newRow("bowl") << true;
    }
    void restingPartIsCarried() {
        QFETCH(bool, bowl);
        trial::TrialBatch batch = testing::makeLyingOn(shapeOf(bowl), 0.3, 0.3);
        batch.drive.halfStroke = 0.0;
        const auto trajectory = verify::replayScene(*testing::makeEngine(), batch, kStep, {});
        const trial::TrajectorySample& last = trajectory.samples.back();
        const double weight = batch.parts.front()->massProperties.mass * batch.gravity;
        QVERIFY(last.parts[0].contacts >= 3);
        QCOMPARE(static_cast<int>(last.forces.size()), last.parts[0].contacts);
        QVERIFY((sumOf(last) - weight * Vec3::UnitZ()).norm() < 0.01 * weight);
        Vec3 moment = Vec3::Zero();
        for (const trial::ContactForce& contact : last.forces) {
            moment += (contact.point - last.parts[0].room.position).cross(contact.force);
            QVERIFY(qAbs(contact.point.z() - 0.015) < 2e-6);
            QCOMPARE(contact.bodyA, trial::kTrack);
            QCOMPARE(contact.bodyB, 0);
        }
        QVERIFY(moment.norm() < 0.01 * weight * 6e-3);
    }

    // It has a contact there at once, and is not let through.
    void aValleysEndCarriesWhatHasSunkOntoIt() {
        for (const testing::SunkenScene& sunken :
             {testing::makeSunkenBesideRise(), testing::makeSunkenInValley()}) {
            const trial::TrialBatch batch =
                verify::makeStillScene(sunken.track, verify::makePaperCuboid(), sunken.pose, 0.01);
            const auto trajectory = verify::replayScene(*testing::makeEngine(), batch, kStep, {});
            const std::vector<trial::ContactForce>& forces = trajectory.samples.at(1).forces;
            QVERIFY(std::ranges::any_of(forces, [&](const trial::ContactForce& contact) {
                return (contact.point - sunken.vertex).norm() < 2e-6 &&
                       contact.force.dot(sunken.normal) > 0.0;
            }));
        }
    }

    void forcesGiveThePartItsMomentum_data() { restingPartIsCarried_data(); }
    void forcesGiveThePartItsMomentum() {
        QFETCH(bool, bowl);
        const trial::TrialBatch batch = testing::makeLyingOn(shapeOf(bowl), 0.3, 0.5);
        const auto trajectory = verify::replayScene(*testing::makeEngine(), batch, kStep, {});
        const std::vector<trial::TrajectorySample>& samples = trajectory.samples;
        QVERIFY(samples.size() > 1000U);
        const double mass = batch.parts.front()->massProperties.mass;
        // A sample's velocity is of its moment, half a step after that of the impulses before it.
        Vec3 given = -0.5 * kStep * (sumOf(samples[1]) + sumOf(samples[samples.size() - 1]));
        double carried = 0.0;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            given += kStep * sumOf(samples[i]);
            carried += samples[i].forces.empty() ? 0.0 : 1.0;
        }
        QVERIFY(carried < static_cast<double>(samples.size()));  // it hops
        const double time = samples.back().time;
        const double scale = mass * batch.gravity * time;
        const Vec3 gained = mass * (samples.back().parts[0].velocity - samples.front().parts[0].velocity);
        QVERIFY2(qAbs(given.z() - gained.z() - scale) < 0.01 * scale,
                 qPrintable(QString::number(given.z() / scale)));
        // On a bowl the axes of the track turn to and fro by less than half a degree.
        QVERIFY((given - gained - scale * Vec3::UnitZ()).norm() < 0.02 * scale);
    }
};

QTEST_APPLESS_MAIN(ForcesTest)
#include "forces_test.moc"
