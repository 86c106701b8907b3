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

const std::vector<double> kEndOfSlot = {30.0, 17.0};  // its rails fall as much as it is deep [mm]
const std::vector<double> kEndOfNarrowRails = {15.0, 3.0, 40.0, 20.0};  // [mm], [deg]

/// A groove in which parts lie down, and behind it a slot or rails of this width [mm]: 17 mm deep, deeper
/// than the bolt is long. `end`: the last numbers of the kind, which rails have not.
std::shared_ptr<const track::Track> makeSlotted(const traps::TrapKind& kind, double width,
                                                const std::vector<double>& end = {}) {
    traps::TrapParameters parameters;
    parameters.pointsPerSection = 9;
    parameters.minSegmentLength = 5.5e-3;
    parameters.maxSegmentLength = 32e-3;
    parameters.segmentWidth = 64e-3;
    parameters.segmentHeight = 200e-3;
    std::vector<double> sizes{16.0, 15.0, 26.0, width, 17.0, 25.0, 49.0};
    sizes.insert(sizes.end(), end.begin(), end.end());
    search::Design design = traps::restingGroove(parameters);
    const std::vector<search::Dimension> dimensions = kind.dimensions(parameters);
    for (std::size_t i = 0; i < dimensions.size(); ++i)
        design.push_back((sizes[i] - dimensions[i].low) / (dimensions[i].high - dimensions[i].low));
    const auto chain = traps::readTraps("groove, " + std::string(kind.key));
    const auto sections = traps::build(chain.value(), parameters, design);
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

/// Of those that began head first and of the others, how many end with their head towards there.
struct Ends {
    int ofHeads = 0;
    int ofTips = 0;
    int arrived = 0;
};

Ends run(const trial::TrialBatch& batch, const base::Vec3& there) {
    const auto outcomes = testing::makeEngine()->run({&batch, 1}, {});
    Ends count;
    for (std::size_t i = 0; i < batch.trials.size(); ++i) {
        const trial::PartOutcome& part = outcomes.value()[0][i].parts[0];
        count.arrived += part.ending == trial::Ending::finished ? 1 : 0;
        const base::Vec3 axis = part.farthest.rotation * base::Vec3::UnitZ();
        const bool isThere = part.ending == trial::Ending::finished && axis.dot(there) < -0.9;
        (i % 2 == 0 ? count.ofTips : count.ofHeads) += isThere ? 1 : 0;
    }
    return count;
}

QString describe(const Ends& ends) {
    return QString("%1 of heads, %2 of tips, %3 arrived")
        .arg(ends.ofHeads)
        .arg(ends.ofTips)
        .arg(ends.arrived);
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
        const base::Vec3 ahead = base::Vec3::UnitX();
        const Ends slotted = run(makeBolts(makeSlotted(traps::slot(), 6.0, kEndOfSlot), kCount), ahead);
        QVERIFY2(slotted.ofHeads >= 11 && slotted.ofTips >= 10, qPrintable(describe(slotted)));
        // Narrower than the shank it lets them pass as they come.
        const Ends passed = run(makeBolts(makeSlotted(traps::slot(), 1.0, kEndOfSlot), kCount), ahead);
        QVERIFY2(passed.ofHeads >= 8 && passed.ofTips <= 3, qPrintable(describe(passed)));
    }

    // decisions.md#rails: they leave as they hang.
    void boltsLeaveRailsHeadUp() {
        constexpr int kCount = 24;
        const base::Vec3 up = base::Vec3::UnitZ();
        const Ends hanging = run(makeBolts(makeSlotted(traps::rails(), 6.0), kCount), up);
        QVERIFY2(hanging.ofHeads >= 11 && hanging.ofTips >= 11, qPrintable(describe(hanging)));
        const Ends lying = run(makeBolts(makeSlotted(traps::rails(), 1.0), kCount), up);
        QVERIFY2(lying.ofHeads + lying.ofTips <= 2, qPrintable(describe(lying)));
    }

    // They pass as well where the rails are narrow; what does not hang falls off there.
    void whatDoesNotHangFallsOffNarrowRails() {
        constexpr int kCount = 24;
        const base::Vec3 up = base::Vec3::UnitZ();
        const Ends hanging =
            run(makeBolts(makeSlotted(traps::narrowRails(), 6.0, kEndOfNarrowRails), kCount), up);
        QVERIFY2(hanging.ofHeads >= 11 && hanging.ofTips >= 11, qPrintable(describe(hanging)));
        const Ends lying =
            run(makeBolts(makeSlotted(traps::narrowRails(), 0.0, kEndOfNarrowRails), kCount), up);
        QVERIFY2(lying.arrived <= 2, qPrintable(describe(lying)));
    }
};

QTEST_APPLESS_MAIN(SlotTest)
#include "slot_test.moc"
