#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "core/track/track_builder.h"
#include "core/traps/groove.h"
#include "core/traps/trap_chain.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;

namespace {

/// A groove in which parts lie down, and a slot of this width behind it [mm]: 17 mm deep, deeper than the
/// bolt is long, with an end over which the rails fall as much.
std::shared_ptr<const track::Track> makeSlotted(double width) {
    traps::TrapParameters parameters;
    parameters.pointsPerSection = 9;
    parameters.minSegmentLength = 5.5e-3;
    parameters.maxSegmentLength = 32e-3;
    parameters.segmentWidth = 64e-3;
    parameters.segmentHeight = 200e-3;
    const traps::TrapKind slot = traps::slot();
    const std::vector<double> sizes{16.0, 15.0, 26.0, width, 17.0, 25.0, 49.0, 30.0, 17.0};
    search::Design design = traps::restingGroove(parameters);
    const std::vector<search::Dimension> dimensions = slot.dimensions(parameters);
    for (std::size_t i = 0; i < sizes.size(); ++i)
        design.push_back((sizes[i] - dimensions[i].low) / (dimensions[i].high - dimensions[i].low));
    const auto sections = traps::build(traps::readTraps("groove, slot").value(), parameters, design);
    return std::make_shared<const track::Track>(track::buildTrack(parameters, sections).value());
}

/// Bolts dropped lying along the track, half of them head first, the others tip first.
trial::TrialBatch makeBolts(std::shared_ptr<const track::Track> track, int count) {
    auto built = part::buildPart(part::makeBundledShape("bolt"), {.name = "bolt"});
    const auto bolt = std::make_shared<const part::Part>(std::move(built.value().part));
    trial::TrialBatch batch = verify::makeStillScene(std::move(track), bolt, {}, 20.0);
    batch.drive = {};
    batch.termination = {20.0, 1.5, 1e-3};
    const trial::TrialSpec pattern = batch.trials.front();
    batch.trials.clear();
    for (int i = 0; i < count; ++i) {
        trial::TrialSpec spec = pattern;
        spec.stream = {1, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::test};
        base::Random random(spec.stream);
        // The bolt's axis is z, from its head to its tip.
        const double ahead = i % 2 == 0 ? 1.0 : -1.0;
        const base::Quaternion along =
            base::Quaternion::FromTwoVectors(base::Vec3::UnitZ(), ahead * base::Vec3::UnitX());
        const base::Quaternion turn(Eigen::AngleAxisd(random.uniform(-0.3, 0.3), base::Vec3::UnitZ()));
        const double x = batch.track->start;
        spec.parts[0].pose = {turn * along, {x, 0.0, verify::findSurfaceHeight(*batch.track, x, 0.0) + 5e-3}};
        spec.phase = random.uniform(0.0, 2.0 * base::kPi);
        batch.trials.push_back(spec);
    }
    return batch;
}

/// Of those that began head first and of the others, how many end so.
struct HeadFirst {
    int ofHeads = 0;
    int ofTips = 0;
    int arrived = 0;
};

HeadFirst run(const trial::TrialBatch& batch) {
    const auto outcomes = testing::makeEngine()->run({&batch, 1}, {});
    HeadFirst count;
    for (std::size_t i = 0; i < batch.trials.size(); ++i) {
        const trial::PartOutcome& part = outcomes.value()[0][i].parts[0];
        count.arrived += part.ending == trial::Ending::finished ? 1 : 0;
        const base::Vec3 axis = part.farthest.rotation * base::Vec3::UnitZ();
        const bool isHeadFirst = part.ending == trial::Ending::finished && axis.x() < -0.9;
        (i % 2 == 0 ? count.ofTips : count.ofHeads) += isHeadFirst ? 1 : 0;
    }
    return count;
}

}  // namespace

/// decisions.md#slot in both engines.
class SlotTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    // Whichever end comes first: they hang by their head, and lie down with it ahead.
    void boltsHangByTheirHead() {
        constexpr int kCount = 24;
        const HeadFirst slotted = run(makeBolts(makeSlotted(6.0), kCount));
        QVERIFY2(slotted.ofHeads >= 11 && slotted.ofTips >= 10,
                 qPrintable(QString("%1 of heads, %2 of tips, %3 arrived")
                                .arg(slotted.ofHeads)
                                .arg(slotted.ofTips)
                                .arg(slotted.arrived)));
        // Narrower than the shank it lets them pass as they come.
        const HeadFirst passed = run(makeBolts(makeSlotted(1.0), kCount));
        QVERIFY2(passed.ofHeads >= 8 && passed.ofTips <= 3,
                 qPrintable(QString("%1 of heads, %2 of tips, %3 arrived")
                                .arg(passed.ofHeads)
                                .arg(passed.ofTips)
                                .arg(passed.arrived)));
    }
};

QTEST_APPLESS_MAIN(SlotTest)
#include "slot_test.moc"
