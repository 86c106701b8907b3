#include <QtTest>
#include <cmath>

#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;
using trial::Ending;

namespace {

trial::PartOutcome simulate(const trial::TrialBatch& batch) {
    const auto outcomes = testing::makeEngine({1, 0.0})->run(std::vector{batch}, {});
    return outcomes.ok() ? (*outcomes)[0][0].parts.at(0) : trial::PartOutcome{};
}

/// The lying cuboid on a level track that does not vibrate.
trial::TrialBatch makeStill(double duration) {
    trial::TrialBatch batch = testing::makeLyingOn({}, 0.0, duration);
    batch.drive.halfStroke = 0.0;
    return batch;
}

}  // namespace

/// Scenes made for each of the ways in which a trial ends, and their times in closed form.
class EndingsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    // Sliding without friction at 1 m/s over the 400 mm to the finish.
    void finishes() {
        trial::TrialBatch batch = makeStill(2.0);
        batch.contact = {0.0, 0.0, 0.0};
        batch.trials[0].parts[0].velocity = Vec3(1.0, 0.0, 0.0);
        const trial::PartOutcome outcome = simulate(batch);
        QCOMPARE(outcome.ending, Ending::finished);
        QVERIFY(std::abs(outcome.time - 0.4) < 2.1e-3);
        QVERIFY(std::abs(outcome.initial.position.x() - 0.1) < 1e-12);
        QVERIFY(outcome.farthest.position.x() >= 0.5 && outcome.farthest.position.x() < 0.503);
    }

    // Sliding off the outer edge and down past the height of the base.
    void fallsOff() {
        trial::TrialBatch batch = makeStill(2.0);
        batch.contact = {0.0, 0.0, 0.0};
        batch.trials[0].parts[0].velocity = Vec3(0.0, 0.5, 0.0);
        const trial::PartOutcome outcome = simulate(batch);
        QCOMPARE(outcome.ending, Ending::fellOff);
        // 28 mm to the edge, then free fall from 17 mm or a moment more for tipping over it.
        const double fall = std::sqrt(2.0 * 0.017 / base::kStandardGravity);
        QVERIFY(outcome.time > 0.028 / 0.5 + 0.5 * fall && outcome.time < 0.036 / 0.5 + 2.0 * fall);
    }

    void getsStuck() {
        trial::TrialBatch batch = makeStill(2.0);
        batch.termination.stuckTime = 0.2;
        const trial::PartOutcome outcome = simulate(batch);
        QCOMPARE(outcome.ending, Ending::stuck);
        QVERIFY(std::abs(outcome.time - 0.2) < 2.1e-3);
        QVERIFY((outcome.farthest.position - outcome.initial.position).norm() < 1e-5);
    }

    void runsOutOfTime() {
        const trial::PartOutcome outcome = simulate(makeStill(0.3));
        QCOMPARE(outcome.ending, Ending::timedOut);
        QVERIFY(std::abs(outcome.time - 0.3) < 2.1e-3);
    }

    // Over before the first step, in a run as in a replay.
    void beginsPastTheFinish() {
        trial::TrialBatch batch = makeStill(2.0);
        batch.trials[0].parts[0].pose.position.x() = 0.51;
        const trial::PartOutcome outcome = simulate(batch);
        QCOMPARE(outcome.ending, Ending::finished);
        QCOMPARE(outcome.time, 0.0);
        const auto trajectory = testing::makeEngine({1, 0.0})->replay(batch, 0, 1e-3, {});
        QVERIFY(trajectory.ok());
        QVERIFY(trajectory->outcome.parts == std::vector{outcome});
    }

    // Far enough in every stuck time by 1 mm: not stuck until it has stopped.
    void slowProgressIsNotStuck() {
        trial::TrialBatch batch = makeStill(0.3);
        batch.contact = {0.0, 0.0, 0.0};
        batch.termination.stuckTime = 0.1;
        batch.trials[0].parts[0].velocity = Vec3(0.012, 0.0, 0.0);
        QCOMPARE(simulate(batch).ending, Ending::timedOut);
        batch.trials[0].parts[0].velocity = Vec3(0.008, 0.0, 0.0);
        QCOMPARE(simulate(batch).ending, Ending::stuck);
    }
};

QTEST_APPLESS_MAIN(EndingsTest)
#include "endings_test.moc"
