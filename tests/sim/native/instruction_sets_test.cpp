#include <QtTest>
#include <cmath>
#include <string>
#include <vector>

#include "sim/native/kernel.h"
#include "sim/native/native_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;

namespace {

using Outcomes = std::vector<trial::Outcome>;

Outcomes simulate(const trial::TrialBatch& batch, unsigned threads) {
    const auto outcomes = native::NativeEngine({threads, 0.0}).run(std::vector{batch}, {});
    return outcomes.ok() ? (*outcomes)[0] : Outcomes{};
}

/// Ways along the track: their mean and its standard error. [m]
struct Ways {
    double mean = 0.0;
    double error = 0.0;
};

Ways measureWays(const Outcomes& outcomes) {
    const auto count = static_cast<double>(outcomes.size());
    double sum = 0.0;
    double squares = 0.0;
    for (const trial::Outcome& outcome : outcomes) {
        const trial::PartOutcome& part = outcome.parts.front();
        const double way = part.farthest.position.x() - part.initial.position.x();
        sum += way;
        squares += way * way;
    }
    const double mean = sum / count;
    return {mean, std::sqrt((squares / count - mean * mean) / count)};
}

}  // namespace

/// The kernel of every instruction set that this machine has.
class InstructionSetsTest : public QObject {
    Q_OBJECT

    // More trials than one thread has lanes; vectors of every width are left partly filled.
    trial::TrialBatch batch_ = testing::makeRoughBatch(verify::makePaperCuboid(), 1, 301, 0.2);
    Ways best_;  // by the best set

 private slots:
    void initTestCase_data() {
        QTest::addColumn<QString>("name");
        for (const std::string& name : native::instructionSets())
            QTest::newRow(name.c_str()) << QString::fromStdString(name);
    }
    void initTestCase() { best_ = measureWays(simulate(batch_, 2)); }

    void init() {
        QFETCH_GLOBAL(QString, name);
        QVERIFY(native::useInstructionSet(name.toStdString()));
        QCOMPARE(QString::fromStdString(native::instructionSet()), name);
    }
    void cleanup() { QVERIFY(native::useInstructionSet("")); }

    // How many lanes a vector has must not show: threads share out the trials in their own way.
    void threadsDoNotMatter() {
        const Outcomes outcomes = simulate(batch_, 1);
        QCOMPARE(outcomes.size(), batch_.trials.size());
        for (const unsigned threads : {2U, 7U})
            QVERIFY(simulate(batch_, threads) == outcomes);
    }

    void replayIsTheTrialBitForBit() {
        const Outcomes outcomes = simulate(batch_, 1);
        for (const std::size_t index :
             {std::size_t{0}, std::size_t{255}, std::size_t{256}, std::size_t{300}}) {
            const auto replay = native::NativeEngine({}).replay(batch_, index, 0.1, {});
            QVERIFY(replay.ok());
            QVERIFY(replay->outcome == outcomes[index]);
        }
    }

    // Sets round differently (some have no fused multiply-add), so trials part company; not what comes of
    // many.
    void manyTrialsGoEquallyFar() {
        const Ways ways = measureWays(simulate(batch_, 2));
        QVERIFY(ways.mean > 2e-3);
        QVERIFY(std::abs(ways.mean - best_.mean) < 4.0 * std::hypot(ways.error, best_.error));
    }

    // Before chaos sets in, trials are the same in all sets.
    void aShortTrialIsTheSame_data() {
        QTest::addColumn<bool>("bowl");
        QTest::newRow("linear") << false;
        QTest::newRow("bowl") << true;
    }
    void aShortTrialIsTheSame() {
        QFETCH(bool, bowl);
        const track::FeederShape shape{bowl ? track::FeederType::bowl : track::FeederType::linear};
        const trial::TrialBatch lying = testing::makeLyingOn(shape, 0.3, 0.1);
        const trial::Trajectory here = verify::replayScene(native::NativeEngine({}), lying, 1e-3, {});
        QVERIFY(native::useInstructionSet(""));
        const trial::Trajectory best = verify::replayScene(native::NativeEngine({}), lying, 1e-3, {});
        QCOMPARE(here.samples.size(), best.samples.size());
        for (std::size_t i = 0; i < here.samples.size(); ++i) {
            const base::Pose& a = here.samples[i].parts[0].room;
            const base::Pose& b = best.samples[i].parts[0].room;
            QVERIFY((a.position - b.position).norm() < 1e-6);
            QVERIFY(a.rotation.angularDistance(b.rotation) < 1e-4);
        }
    }

    void whatTheMachineLacksIsRefused() {
        const std::string before = native::instructionSet();
        QVERIFY(!native::useInstructionSet("ABACUS"));
        QCOMPARE(native::instructionSet(), native::instructionSets().front());
        QVERIFY(native::useInstructionSet(before));
    }
};

QTEST_APPLESS_MAIN(InstructionSetsTest)
#include "instruction_sets_test.moc"
