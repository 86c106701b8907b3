#include "core/study/robustness.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/objectives/conveying_speed.h"
#include "core/stats/binomial.h"
#include "core/study/target.h"
#include "core/study/trial_batches.h"

namespace trapwright::study {

namespace {

using trial::BoxPlace;
using trial::Condition;

constexpr std::size_t kWorstCorners = 4;

double& coordinate(BoxPlace& place, Condition condition) {
    return place[static_cast<std::size_t>(condition)];
}

std::vector<Condition> listVarying(const SimulationSettings& simulation, const trial::OperatingBox& box) {
    std::vector<Condition> varying;
    for (const trial::ConditionText& text : trial::conditionTexts()) {
        // Of the part its size: a centre of mass that is off has no ends to go from and to.
        const bool room = text.condition == Condition::part ? box.sizeBelow + box.sizeAbove > 0.0
                                                            : varies(simulation, box, text.condition);
        if (room) varying.push_back(text.condition);
    }
    return varying;
}

std::vector<Condition> listVarying(const Settings& settings) {
    return listVarying(settings.simulation, settings.box);
}

/// Where conditions are as set. Ranges that are cut off have it off their middle.
BoxPlace placeAsSet(const Settings& settings) {
    BoxPlace place = trial::kMiddle;
    // Of the part and whatever comes after it nothing.
    const std::array<double, trial::kConditions> asSet = {
        settings.simulation.contact.kineticFriction, settings.simulation.contact.restitution,
        settings.simulation.drive.halfStroke, settings.simulation.drive.frequency,
        settings.simulation.drive.angle};
    for (std::size_t c = 0; c < trial::kConditions; ++c) {
        const auto at = [&](double share) {
            return conditionAt(settings.simulation, settings.box, static_cast<Condition>(c), share);
        };
        const double low = at(0.0);
        const double high = at(1.0);
        if (high > low) place[c] = (asSet[c] - low) / (high - low);
    }
    return place;
}

std::vector<BoxPlace> listCorners(const BoxPlace& asSet, std::span<const Condition> varying) {
    std::vector<BoxPlace> corners;
    for (std::size_t bits = 0; bits < (std::size_t{1} << varying.size()); ++bits) {
        BoxPlace& corner = corners.emplace_back(asSet);
        for (std::size_t v = 0; v < varying.size(); ++v)
            coordinate(corner, varying[v]) = (bits >> v & 1U) != 0 ? 1.0 : 0.0;
    }
    return corners;
}

int trialsOfCorner(const RobustnessPlan& plan) {
    return std::max(plan.trials / 3, 10);
}

/// Runs batches and tells what they came to.
class Measurement {
 public:
    Measurement(const StudyInputs& inputs, std::shared_ptr<const track::Track> track,
                base::RunControl control)
        : inputs_(&inputs), track_(std::move(track)), control_(std::move(control)) {}

    std::optional<trial::Goal> goal;

    base::Result<std::vector<PlaceResult>> measure(std::span<const PlaceTrials> wanted) const {
        std::vector<trial::TrialBatch> batches;
        batches.reserve(wanted.size());
        for (const PlaceTrials& trials : wanted)
            batches.push_back(makePlaceBatch(inputs_->settings, inputs_->part, track_, trials));
        const auto outcomes = runTrials(*inputs_->engine, batches, control_);
        if (!outcomes) return outcomes.error();
        std::vector<PlaceResult> results;
        results.reserve(wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i)
            results.push_back(resultOf(wanted[i], (*outcomes)[i]));
        return results;
    }

    base::Result<std::vector<PlaceResult>> measure(std::span<const BoxPlace> places, int first,
                                                   int count) const {
        std::vector<PlaceTrials> wanted;
        wanted.reserve(places.size());
        for (const BoxPlace& place : places)
            wanted.push_back({place, first, count});
        return measure(wanted);
    }

    /// As set; finds what counts if it is not told.
    base::Result<PlaceResult> measureAsSet(const BoxPlace& asSet, int count) {
        const PlaceTrials wanted{asSet, 0, count};
        const trial::TrialBatch batch = makePlaceBatch(inputs_->settings, inputs_->part, track_, wanted);
        const auto outcomes = runTrials(*inputs_->engine, {&batch, 1}, control_);
        if (!outcomes) return outcomes.error();
        const std::vector<trial::Outcome>& own = outcomes->front();
        goal = trial::findGoal(goal, own, inputs_->part->symmetry, inputs_->settings.validation.tolerance);
        return resultOf(wanted, own);
    }

 private:
    [[nodiscard]] PlaceResult resultOf(const PlaceTrials& trials,
                                       std::span<const trial::Outcome> outcomes) const {
        const objectives::Evaluation evaluation = makeEvaluation(*inputs_, *track_, 0, outcomes);
        return {
            trials,
            trial::tally(outcomes, *goal, inputs_->part->symmetry, inputs_->settings.validation.tolerance),
            objectives::conveyingSpeed().measure(evaluation).value};
    }

    const StudyInputs* inputs_;
    std::shared_ptr<const track::Track> track_;
    base::RunControl control_;
};

/// The two conditions of whose four common quarters of the corners one is worst.
std::pair<Condition, Condition> findWorstPair(std::span<const PlaceResult> corners,
                                              std::span<const Condition> varying) {
    std::pair<Condition, Condition> worst{varying[0], varying[1]};
    double least = 2.0;
    for (std::size_t a = 0; a < varying.size(); ++a) {
        for (std::size_t b = a + 1; b < varying.size(); ++b) {
            for (const double x : {0.0, 1.0}) {
                for (const double y : {0.0, 1.0}) {
                    trial::Tally sum;
                    for (const PlaceResult& corner : corners) {
                        BoxPlace at = *corner.trials.place;
                        if (coordinate(at, varying[a]) == x && coordinate(at, varying[b]) == y)
                            sum += corner.tally;
                    }
                    const double share = static_cast<double>(sum.success) / std::max(sum.trials(), 1);
                    if (share >= least) continue;
                    least = share;
                    worst = {varying[a], varying[b]};
                }
            }
        }
    }
    return worst;
}

bool isWorse(const PlaceResult& a, const PlaceResult& b) {
    return a.tally.success * static_cast<double>(b.tally.trials()) <
           b.tally.success * static_cast<double>(a.tally.trials());
}

const trial::ConditionText& textOf(Condition condition) {
    return trial::conditionTexts()[static_cast<std::size_t>(condition)];
}

/// Without its unit. `value` in SI.
std::string shownNumber(Condition condition, double value) {
    const trial::ConditionText& text = textOf(condition);
    value *= text.shownAs;
    std::string number = fmt::format("{:.{}f}", value + 0.0, text.decimals);
    const bool isDifference = condition == Condition::part || condition == Condition::startOffset;
    if (isDifference && value >= 0.0) number.insert(0, "+");
    return number;
}

std::string shown(const Settings& settings, Condition condition, double share) {
    const std::string number =
        shownNumber(condition, conditionAt(settings.simulation, settings.box, condition, share));
    const std::string_view unit = textOf(condition).unit;
    return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

std::string shareText(const trial::Tally& tally) {
    const stats::Interval bounds = stats::calcClopperPearson(tally.success, tally.trials());
    return fmt::format("{:5.1f}   {:5.1f} ... {:5.1f}   {:6} {:6} {:6} {:8}",
                       100.0 * tally.success / tally.trials(), 100.0 * bounds.low, 100.0 * bounds.high,
                       tally.trials(), tally.wrongOrientation, tally.stuck, tally.fellOff);
}

}  // namespace

base::Status RobustnessPlan::check() const {
    constexpr int kMost = 1000000;
    const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
    if (!within(trials, 10, kMost))
        return base::Error{fmt::format("{} trials at each place; it must be from 10 to {}.", trials, kMost)};
    if (!within(boxTrials, 10, kMost))
        return base::Error{
            fmt::format("{} trials over the box; it must be from 10 to {}.", boxTrials, kMost)};
    if (!within(sweepPoints, 2, 101))
        return base::Error{
            fmt::format("{} points of each condition; it must be from 2 to 101.", sweepPoints)};
    if (!within(mapPoints, 2, 41))
        return base::Error{
            fmt::format("A map of {} x {} points; it must be from 2 x 2 to 41 x 41.", mapPoints, mapPoints)};
    return base::success();
}

trial::TrialBatch makePlaceBatch(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                                 const std::shared_ptr<const track::Track>& track,
                                 const PlaceTrials& trials) {
    if (!trials.place) {
        Settings varied = settings;
        varied.validation.conditions = TrialConditions::varied;
        trial::TrialBatch batch =
            makeSelectionBatch(makeScene(varied, part, track), {0, 0}, trials.first + trials.count);
        batch.trials.erase(batch.trials.begin(), batch.trials.begin() + trials.first);
        return batch;
    }
    trial::TrialBatch batch;
    batch.track = track;
    batch.parts = {
        makeSpecimenAt(settings.box, part, (*trials.place)[static_cast<std::size_t>(Condition::part)])};
    batch.drive = settings.simulation.drive;
    batch.contact = settings.simulation.contact;
    batch.termination = terminationOn(settings.simulation, *track);
    batch.gravity = settings.simulation.gravity;
    base::StreamKey key{settings.evolution.seed, 0, 0, static_cast<std::uint32_t>(trials.first),
                        base::Purpose::robustness};
    for (int i = 0; i < trials.count; ++i, ++key.trial) {
        trial::TrialSpec& spec = batch.trials.emplace_back(
            trial::drawTrial(*track, *batch.parts.front(), settings.simulation.start, key));
        putAt(settings.simulation, settings.box, *trials.place, *track, spec);
    }
    return batch;
}

std::int64_t countRobustnessTrials(const Settings& settings, const RobustnessPlan& plan) {
    const auto varying = static_cast<std::int64_t>(listVarying(settings).size());
    if (varying == 0) return 0;
    const std::int64_t corners = std::int64_t{1} << varying;
    const std::int64_t map = varying > 1 ? std::int64_t{plan.mapPoints} * plan.mapPoints : 0;
    return plan.trials + plan.boxTrials + varying * plan.sweepPoints * plan.trials +
           corners * trialsOfCorner(plan) + std::min<std::int64_t>(corners, kWorstCorners) * plan.trials +
           map * (plan.trials / 2);
}

base::Result<Robustness> measureRobustness(const StudyInputs& inputs,
                                           const std::shared_ptr<const track::Track>& track,
                                           const std::optional<trial::Goal>& given,
                                           const RobustnessPlan& plan, base::RunControl control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    if (const auto checked = plan.check(); !checked) return checked.error();
    const Settings& settings = inputs.settings;
    const std::vector<Condition> varying = listVarying(settings);
    if (varying.empty())
        return base::Error{
            "The operating box has no room: all of box.friction, box.restitution, box.halfStroke_percent, "
            "box.frequency_percent, box.angle_deg, box.sizeBelow_mm, box.sizeAbove_mm, box.startOffset_mm, "
            "box.startSpeed_mm_s and box.roughness_deg are 0. Set what is not known exactly."};
    Measurement measurement(inputs, track, std::move(control));
    measurement.goal = given ? given : findWanted(settings, *inputs.part);
    Robustness robustness;

    const BoxPlace asSet = placeAsSet(settings);
    auto nominal = measurement.measureAsSet(asSet, plan.trials);
    if (!nominal) return nominal.error();
    robustness.nominal = *nominal;
    robustness.goal = *measurement.goal;

    const PlaceTrials anywhere{std::nullopt, 0, plan.boxTrials};
    const auto overBox = measurement.measure({&anywhere, 1});
    if (!overBox) return overBox.error();
    robustness.overBox = overBox->front();

    for (const Condition condition : varying) {
        std::vector<BoxPlace> places(static_cast<std::size_t>(plan.sweepPoints), asSet);
        for (int i = 0; i < plan.sweepPoints; ++i)
            coordinate(places[static_cast<std::size_t>(i)], condition) =
                static_cast<double>(i) / (plan.sweepPoints - 1);
        auto points = measurement.measure(places, 0, plan.trials);
        if (!points) return points.error();
        robustness.sweeps.push_back({condition, std::move(*points)});
    }

    auto corners = measurement.measure(listCorners(asSet, varying), 0, trialsOfCorner(plan));
    if (!corners) return corners.error();
    std::stable_sort(corners->begin(), corners->end(), isWorse);
    std::vector<BoxPlace> worst;
    for (std::size_t i = 0; i < std::min(kWorstCorners, corners->size()); ++i)
        worst.push_back(*(*corners)[i].trials.place);
    auto fresh = measurement.measure(worst, plan.trials, plan.trials);
    if (!fresh) return fresh.error();
    robustness.corners = std::move(*fresh);
    std::stable_sort(robustness.corners.begin(), robustness.corners.end(), isWorse);

    if (varying.size() > 1) {
        const auto [across, up] = findWorstPair(*corners, varying);
        PairMap map{across, up, plan.mapPoints, {}};
        std::vector<BoxPlace> places;
        for (int row = 0; row < plan.mapPoints; ++row) {
            for (int column = 0; column < plan.mapPoints; ++column) {
                BoxPlace& place = places.emplace_back(asSet);
                coordinate(place, map.across) = static_cast<double>(column) / (plan.mapPoints - 1);
                coordinate(place, map.up) = static_cast<double>(row) / (plan.mapPoints - 1);
            }
        }
        auto measured = measurement.measure(places, 0, plan.trials / 2);
        if (!measured) return measured.error();
        map.places = std::move(*measured);
        robustness.worstPair = std::move(map);
    }
    return robustness;
}

std::vector<SlicedCondition> sliceByCondition(const SimulationSettings& simulation,
                                              const trial::OperatingBox& box,
                                              std::span<const BoxPlace> places,
                                              std::span<const trial::Verdict> verdicts) {
    constexpr int kSlices = 4;
    std::vector<SlicedCondition> conditions;
    for (const Condition condition : listVarying(simulation, box)) {
        SlicedCondition& sliced = conditions.emplace_back(SlicedCondition{condition, {}});
        for (int i = 0; i < kSlices; ++i) {
            const BoxSlice slice{condition, static_cast<double>(i) / kSlices,
                                 static_cast<double>(i + 1) / kSlices};
            const auto at = [&](double share) { return conditionAt(simulation, box, condition, share); };
            ConditionSlice& counted =
                sliced.slices.emplace_back(ConditionSlice{slice, at(slice.low), at(slice.high), {}});
            for (std::size_t k = 0; k < places.size(); ++k)
                if (slice.holds(places[k])) counted.tally.add(verdicts[k]);
        }
    }
    return conditions;
}

std::string describeRange(Condition condition, const ConditionSlice& slice) {
    const std::string_view unit = textOf(condition).unit;
    return fmt::format("{} ... {}{}{}", shownNumber(condition, slice.low), shownNumber(condition, slice.high),
                       unit.empty() ? "" : " ", unit);
}

std::string formatSlices(std::span<const SlicedCondition> conditions) {
    if (conditions.empty()) return {};
    std::string text = fmt::format("{:<34} success [%]   95 % bounds      trials  wrong  stuck fell off\n",
                                   "By condition, all others varying");
    for (const SlicedCondition& sliced : conditions) {
        text += fmt::format("{}\n", textOf(sliced.condition).name);
        for (const ConditionSlice& slice : sliced.slices) {
            const trial::Tally& tally = slice.tally;
            if (tally.trials() == 0) continue;
            text += fmt::format("  {:<38} {}\n", describeRange(sliced.condition, slice), shareText(tally));
        }
    }
    return text;
}

std::string describePlace(const Settings& settings, const BoxPlace& place) {
    std::string text;
    for (const Condition condition : listVarying(settings)) {
        std::string name(trial::conditionTexts()[static_cast<std::size_t>(condition)].name);
        if (!text.empty()) name.front() = static_cast<char>(std::tolower(name.front()));
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                            shown(settings, condition, place[static_cast<std::size_t>(condition)]));
    }
    return text;
}

std::string formatRobustness(const StudyInputs& inputs, const Robustness& robustness) {
    const Settings& settings = inputs.settings;
    std::string text =
        fmt::format("{:<34} success [%]   95 % bounds      trials  wrong  stuck fell off   mm/s\n", "");
    const auto row = [&](const std::string& name, const PlaceResult& result) {
        text += fmt::format("{:<40} {}   {:6.1f}\n", name, shareText(result.tally), 1e3 * result.speed);
    };
    row("As set", robustness.nominal);
    row("All over the operating box", robustness.overBox);
    for (const ConditionSweep& sweep : robustness.sweeps) {
        text += fmt::format("{}, all else as set\n",
                            trial::conditionTexts()[static_cast<std::size_t>(sweep.condition)].name);
        for (const PlaceResult& point : sweep.points)
            row("  " + shown(settings, sweep.condition,
                             (*point.trials.place)[static_cast<std::size_t>(sweep.condition)]),
                point);
    }
    text += "Worst corners, on fresh trials\n";
    for (const PlaceResult& corner : robustness.corners) {
        text += "  " + describePlace(settings, *corner.trials.place) + '\n';
        row("", corner);
    }
    if (robustness.worstPair) {
        const PairMap& map = *robustness.worstPair;
        const auto name = [](Condition condition) {
            return trial::conditionTexts()[static_cast<std::size_t>(condition)].name;
        };
        text += fmt::format("Success [%] over the worst two: {} downwards, {} across\n{:>12}", name(map.up),
                            name(map.across), "");
        const auto share = [&](int i) { return static_cast<double>(i) / (map.points - 1); };
        for (int column = 0; column < map.points; ++column)
            text += fmt::format("{:>11}", shown(settings, map.across, share(column)));
        text += '\n';
        for (int line = 0; line < map.points; ++line) {
            text += fmt::format("{:>12}", shown(settings, map.up, share(line)));
            const auto columns = static_cast<std::size_t>(map.points);
            for (std::size_t column = 0; column < columns; ++column) {
                const trial::Tally& tally =
                    map.places[static_cast<std::size_t>(line) * columns + column].tally;
                text += fmt::format("{:>11.1f}", 100.0 * tally.success / tally.trials());
            }
            text += '\n';
        }
    }
    return text;
}

}  // namespace trapwright::study
