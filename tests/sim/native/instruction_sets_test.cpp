#include <QtTest>
#include <algorithm>
#include <string>
#include <vector>

#include "sim/native/kernel.h"
#include "sim/native/native_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using trial::Ending;

namespace {

using Outcomes = std::vector<trial::Outcome>;

Outcomes simulate(const trial::TrialBatch& batch, unsigned threads) {
    const auto outcomes = native::NativeEngine({threads, 0.0}).run(std::vector{batch}, {});
    return outcomes.ok() ? (*outcomes)[0] : Outcomes{};
}

/// Mean way along the track, and the share of trials that fell off it.
struct Summary {
    double way = 0.0;  // [m]
    double fallen = 0.0;
};

Summary summarize(const Outcomes& outcomes) {
    Summary summary;
    for (const trial::Outcome& outcome : outcomes) {
        summary.way += outcome.farthest.position.x() - outcome.initial.position.x();
        summary.fallen += outcome.ending == Ending::fellOff ? 1.0 : 0.0;
    }
    summary.way /= static_cast<double>(outcomes.size());
    summary.fallen /= static_cast<double>(outcomes.size());
    return summary;
}

}  // namespace

/// The kernel of every instruction set that this machine has.
class InstructionSetsTest : public QObject {
    Q_OBJECT

    trial::TrialBatch many_ = testing::makeRoughBatch(verify::makePaperCuboid(), 1, 600, 0.5);

 private slots:
    void initTestCase_data() {
        QTest::addColumn<std::string>("name");
        for (const std::string& name : native::instructionSets())
            QTest::newRow(name.c_str()) << name;
    }

    void init() {
        QFETCH_GLOBAL(std::string, name);
        QVERIFY(native::useInstructionSet(name));
        QCOMPARE(native::instructionSet(), name);
    }
    void cleanup() { QVERIFY(native::useInstructionSet("")); }

    void explore() {
        const Summary s = summarize(simulate(many_, 1));
        qInfo("%g %g", s.way, s.fallen);
    }

};

QTEST_APPLESS_MAIN(InstructionSetsTest)
#include "instruction_sets_test.moc"
