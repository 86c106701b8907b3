#include "core/study/robustness.h"

#include <QtTest>
#include <algorithm>

#include "core/study/track_design.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;
using trial::Condition;

namespace {

/// Parts turn wrong where friction is low and the stroke is high at once, and half of them where a part is
/// too large. Restitution does not matter.
trial::PartOutcome cornerLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    trial::PartOutcome outcome;
    outcome.ending = trial::Ending::finished;
    outcome.time = 1.0;
    outcome.initial.position.x() = batch.track->start;
    outcome.farthest.position.x() = batch.track->finish;
    const double friction = batch.contactOf(spec).kineticFriction;
    const double halfStroke = batch.driveOf(spec).halfStroke;
    const bool large = batch.partOf(spec).boundingRadius > 1.0001 * std::sqrt(56.0) * 1e-3;
    const bool wrong = (friction < 0.38 && halfStroke > 0.85e-3) || (large && spec.stream.trial % 2 == 0);
    outcome.farthest.rotation = Eigen::AngleAxisd(wrong ? 1.5 : 0.0, base::Vec3::UnitX());
    return outcome;
}

study::StudyInputs cornerInputs() {
    study::StudyInputs inputs = fake::waveInputs(2);
    inputs.engine = std::make_shared<fake::FakeEngine>(cornerLaw, 2);
    inputs.settings.simulation.contact = {0.5, 0.5, 0.2};
    inputs.settings.box.sizeBelow = inputs.settings.box.sizeAbove = 0.0;
    return inputs;
}

std::shared_ptr<const track::Track> makeTrack(const study::StudyInputs& inputs) {
    const search::Design design(study::designSpace(inputs.settings.track).dimensions.size(), 0.5);
    return std::make_shared<const track::Track>(study::decodeTrack(inputs.settings.track, design).value());
}

double shareOf(const study::PlaceResult& result) {
    return static_cast<double>(result.tally.success) / result.tally.trials();
}

}  // namespace

class RobustnessTest : public QObject {
    Q_OBJECT

 private slots:
    // One condition alone does no harm; the corner of two is found, and so is their map.
    void theWorstCornerIsFound() {
        const study::StudyInputs inputs = cornerInputs();
        const base::RunControl control;
        const study::RobustnessPlan plan{60, 512, 5, 5};
        const auto robustness =
            study::measureRobustness(inputs, makeTrack(inputs), std::nullopt, plan, control);
        VERIFY_OK(robustness);
        QCOMPARE(control.done(), study::countRobustnessTrials(inputs.settings, plan));
        QCOMPARE(shareOf(robustness->nominal), 1.0);
        QCOMPARE(robustness->sweeps.size(), std::size_t{3});
        for (const study::ConditionSweep& sweep : robustness->sweeps) {
            QCOMPARE(sweep.points.size(), std::size_t{5});
            for (const study::PlaceResult& point : sweep.points)
                QCOMPARE(shareOf(point), 1.0);
        }
        const auto at = [](const study::PlaceResult& result, Condition condition) {
            return (*result.trials.place)[static_cast<std::size_t>(condition)];
        };
        const study::PlaceResult& worst = robustness->corners.front();
        QCOMPARE(shareOf(worst), 0.0);
        QCOMPARE(at(worst, Condition::friction), 0.0);
        QCOMPARE(at(worst, Condition::halfStroke), 1.0);
        QVERIFY(robustness->worstPair.has_value());
        QVERIFY(robustness->worstPair->across == Condition::friction);
        QVERIFY(robustness->worstPair->up == Condition::halfStroke);
        // Over the box: 0.08 of 0.4 in friction times 0.046 of 0.192 mm in stroke.
        const double expected = 1.0 - 0.08 / 0.4 * 0.046 / 0.192;
        QVERIFY(std::abs(shareOf(robustness->overBox) - expected) < 0.01);
        const std::string text = study::formatRobustness(inputs, *robustness);
        QVERIFY2(
            text.find("Friction 0.30") != std::string::npos && text.find("0.896 mm") != std::string::npos,
            text.c_str());
    }

    // Each trial counts once in each condition that varies, in the quarter that it lies in.
    void trialsAreSlicedByCondition() {
        const study::Settings settings = cornerInputs().settings;
        std::vector<trial::BoxPlace> places(8, trial::kMiddle);
        std::vector<trial::Verdict> verdicts(8, trial::Verdict::success);
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i][static_cast<std::size_t>(Condition::friction)] =
                i < 7 ? 0.125 * static_cast<double>(i) : 1.0;
        verdicts[6] = trial::Verdict::stuck;
        const auto conditions = study::sliceByCondition(settings.simulation, settings.box, places, verdicts);
        QCOMPARE(conditions.size(), std::size_t{3});
        QVERIFY(conditions[0].condition == Condition::friction);
        const auto& slices = conditions[0].slices;
        QCOMPARE(slices.size(), std::size_t{4});
        for (const study::ConditionSlice& slice : slices)
            QCOMPARE(slice.tally.trials(), 2);
        QCOMPARE(slices[3].tally.stuck, 1);
        QVERIFY(std::abs(slices[3].low - 0.6) < 1e-12 && std::abs(slices[3].high - 0.7) < 1e-12);
        QCOMPARE(conditions[1].slices[2].tally.trials(), 8);
        QCOMPARE(study::describeRange(Condition::halfStroke, conditions[2].slices[0]),
                 std::string("0.704 ... 0.752 mm"));
        const std::string text = study::formatSlices(conditions);
        QVERIFY2(text.find("0.60 ... 0.70") != std::string::npos, text.c_str());
        QVERIFY(study::formatSlices({}).empty());
    }

    void sizesAreTried() {
        study::StudyInputs inputs = cornerInputs();
        inputs.settings.box = {trial::BoxDistribution::uniform, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1e-3, 0.1e-3, 0.0};
        const auto robustness =
            study::measureRobustness(inputs, makeTrack(inputs), std::nullopt, {60, 64, 3, 5}, {});
        VERIFY_OK(robustness);
        QCOMPARE(robustness->sweeps.size(), std::size_t{1});
        const auto& points = robustness->sweeps.front().points;
        QCOMPARE(shareOf(points[0]), 1.0);
        QCOMPARE(shareOf(points[1]), 1.0);
        QCOMPARE(shareOf(points[2]), 0.5);
        QVERIFY(!robustness->worstPair);
        QCOMPARE(robustness->corners.size(), std::size_t{2});
    }

    void refusalsTellWhy() {
        study::StudyInputs inputs = cornerInputs();
        const auto track = makeTrack(inputs);
        const auto few = study::measureRobustness(inputs, track, std::nullopt, {5, 64, 3, 5}, {});
        QVERIFY(fake::messageOf(few).contains("from 10 to"));
        inputs.settings.box = {trial::BoxDistribution::uniform, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        const auto none = study::measureRobustness(inputs, track, std::nullopt, {}, {});
        QVERIFY(fake::messageOf(none).contains("box.friction"));
        base::RunControl cancelled;
        cancelled.cancel();
        QVERIFY(!study::measureRobustness(cornerInputs(), track, std::nullopt, {}, cancelled).ok());
    }
};

QTEST_APPLESS_MAIN(RobustnessTest)
#include "robustness_test.moc"
