#include "tests/peers/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <span>
#include <utility>

#include "core/base/file.h"
#include "core/stats/binomial.h"
#include "core/study/evaluator.h"
#include "core/study/orientation_shares.h"
#include "core/study/robustness.h"
#include "core/study/target.h"
#include "core/trial/orientations.h"

namespace trapwright::peers {

namespace {

constexpr const char* kColumns =
    "{:<12} {:>7} {:<13} {:>11} {:>17} {:>11} {:>7} {:>6} {:>6} {:>9} {:>7} {:>10}\n";

double percent(int count, int of) {
    return 100.0 * count / of;
}

TransferRow runScene(const trial::Engine& engine, const TransferScene& scene, base::RunControl control) {
    TransferRow row;
    row.engine = engine.name();
    row.step = engine.step();
    auto outcomes = study::runTrials(engine, {&scene.batch, 1}, std::move(control));
    if (outcomes)
        row.outcomes = std::move(outcomes->front());
    else
        row.problem = outcomes.error().message;
    return row;
}

void judgeRow(const Transfer& transfer, TransferRow& row) {
    const double tolerance = transfer.settings.validation.tolerance;
    for (const trial::Outcome& outcome : row.outcomes)
        row.verdicts.push_back(
            trial::judge(outcome.parts.front(), transfer.goal, transfer.part->symmetry, tolerance));
    row.tally = trial::tally(row.outcomes, transfer.goal, transfer.part->symmetry, tolerance);
}

constexpr const char* kStretchColumns = "{:<12} {:>7} {:<13} {:>10} {:>17} {:>7} {:>10} {:>10}\n";

/// Of the scene's trials in this engine: those that begin at the stretch as it has its parts there. Adds to
/// `longest` how long it takes them to its end, at most.
base::Result<std::vector<trial::TrialSpec>> findStarts(const trial::Engine& engine,
                                                       const trial::TrialBatch& batch, const Stretch& stretch,
                                                       double& longest, const base::RunControl& control) {
    constexpr double kInterval = 1e-3;  // [s]
    std::vector<trial::TrialSpec> starts;
    for (std::size_t i = 0; i < batch.trials.size(); ++i) {
        const auto way = engine.replay(batch, i, kInterval, control);
        if (!way) return way.error();
        const auto reaches = [&](double x) {
            return std::ranges::find_if(way->samples, [&](const trial::TrajectorySample& sample) {
                return !sample.parts.empty() && sample.parts.front().track.position.x() >= x;
            });
        };
        const auto begin = reaches(stretch.from);
        if (begin == way->samples.end()) continue;
        const trial::PartState& part = begin->parts.front();
        trial::TrialSpec& spec = starts.emplace_back(batch.trials[i]);
        spec.phase =
            std::fmod(spec.phase + 2.0 * std::numbers::pi * batch.driveOf(spec).frequency * begin->time,
                      2.0 * std::numbers::pi);
        spec.parts.front().pose = part.track;
        spec.parts.front().velocity = part.velocity;
        spec.parts.front().angularVelocity = part.angularVelocity;
        if (const auto end = reaches(stretch.to); end != way->samples.end())
            longest = std::max(longest, end->time - begin->time);
    }
    return starts;
}

bool finishes(const trial::Outcome& outcome) {
    return outcome.parts.front().ending == trial::Ending::finished;
}

std::string describeStretch(const TransferRow& row, const TransferRow& reference, const std::string& step,
                            const std::string& conditions) {
    const int trials = static_cast<int>(row.outcomes.size());
    const int passed = static_cast<int>(std::ranges::count_if(row.outcomes, finishes));
    const int passedBefore = static_cast<int>(std::ranges::count_if(reference.outcomes, finishes));
    int bothPass = 0;
    for (std::size_t i = 0; i < row.outcomes.size(); ++i)
        bothPass += finishes(row.outcomes[i]) && finishes(reference.outcomes[i]) ? 1 : 0;
    const int stayedBefore = trials - passedBefore;
    const int bothStay = stayedBefore - (passed - bothPass);
    const stats::Interval bounds = stats::calcClopperPearson(passed, trials);
    return fmt::format(
        kStretchColumns, row.engine, step, conditions, fmt::format("{:.1f}", percent(passed, trials)),
        fmt::format("{:.1f} ... {:.1f}", 100.0 * bounds.low, 100.0 * bounds.high), trials,
        fmt::format("{} of {}", bothPass, passedBefore), fmt::format("{} of {}", bothStay, stayedBefore));
}

/// For each trial the first of the ways in which its part comes to the end, or the one behind them all for
/// those that come in another, or one further for those that do not come.
std::vector<std::size_t> findWays(const Transfer& transfer, const TransferRow& row,
                                  std::span<const study::EndMode> modes) {
    std::vector<std::size_t> ways;
    for (const trial::Outcome& outcome : row.outcomes) {
        const auto mode = std::ranges::find_if(modes, [&](const study::EndMode& known) {
            return trial::calcOrientationAngle(
                       outcome.parts.front().farthest.rotation, known.orientation, transfer.part->symmetry,
                       trial::OrientationDistance::symmetric) <= transfer.settings.validation.tolerance;
        });
        ways.push_back(finishes(outcome) ? static_cast<std::size_t>(mode - modes.begin()) : modes.size() + 1);
    }
    return ways;
}

/// Trials whose part comes to the end as in the first engine, or in neither.
int countAlike(const Transfer& transfer, const TransferRow& row, const TransferRow& reference) {
    int count = 0;
    for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
        const trial::Outcome& one = row.outcomes[i];
        const trial::Outcome& other = reference.outcomes[i];
        const double angle = trial::calcOrientationAngle(
            one.parts.front().farthest.rotation, other.parts.front().farthest.rotation,
            transfer.part->symmetry, trial::OrientationDistance::symmetric);
        const bool areAlike = !finishes(one) || angle <= transfer.settings.validation.tolerance;
        count += finishes(one) == finishes(other) && areAlike ? 1 : 0;
    }
    return count;
}

std::vector<int> countWays(std::span<const std::size_t> ways, std::size_t kinds) {
    std::vector<int> counts(kinds);
    for (const std::size_t way : ways)
        ++counts[way];
    return counts;
}

/// Half the sum of the differences of the shares of two engines with as many trials, the first half of `ways`
/// being of the one.
double calcDistance(std::span<const std::size_t> ways, std::size_t kinds) {
    const std::size_t trials = ways.size() / 2;
    const std::vector<int> one = countWays(ways.first(trials), kinds);
    const std::vector<int> other = countWays(ways.last(trials), kinds);
    int sum = 0;
    for (std::size_t way = 0; way < kinds; ++way)
        sum += std::abs(one[way] - other[way]);
    return 0.5 * sum / static_cast<double>(trials);
}

/// What the distance stays below 95 times in 100 if both engines do the same.
double calcChance(std::vector<std::size_t> ways, std::size_t kinds) {
    constexpr std::size_t kDeals = 1000;
    std::mt19937 random;
    std::vector<double> distances;
    for (std::size_t deal = 0; deal < kDeals; ++deal) {
        std::ranges::shuffle(ways, random);
        distances.push_back(calcDistance(ways, kinds));
    }
    std::ranges::sort(distances);
    return distances[kDeals * 95 / 100];
}

/// The ways of one scene, engine by engine.
std::string describeSceneWays(const Transfer& transfer, std::size_t scene) {
    constexpr std::size_t kMostWays = 12;
    const TransferRow& reference = transfer.rows[scene];
    const auto isOfScene = [&](const TransferRow& row) { return row.scene == scene && row.problem.empty(); };
    std::vector<trial::Outcome> outcomes;
    for (const TransferRow& row : transfer.rows)
        if (isOfScene(row)) outcomes.insert(outcomes.end(), row.outcomes.begin(), row.outcomes.end());
    const std::vector<study::EndMode> modes =
        study::findEndModes(*transfer.part, outcomes, transfer.settings.validation.tolerance, kMostWays);
    const std::size_t kinds = modes.size() + 2;
    const std::vector<std::size_t> before = findWays(transfer, reference, modes);
    std::string text = fmt::format("{}: trials that come to the end in these ways\n{:<12} {:>7}",
                                   transfer.scenes[scene].conditions, "Engine", "Step ms");
    for (const study::EndMode& mode : modes)
        text += fmt::format(" {:>7}", fmt::format("{}{:+.0f}", mode.pose + 1, mode.heading / base::kDegree));
    text += fmt::format(" {:>7} {:>7} {:>9} {:>11} {:>10}\n", "other", "none", "Alike [%]", "Differs [%]",
                        "Chance [%]");
    for (const TransferRow& row : transfer.rows) {
        if (!isOfScene(row)) continue;
        std::vector<std::size_t> ways = findWays(transfer, row, modes);
        text += fmt::format("{:<12} {:>7}", row.engine, fmt::format("{:g}", 1e3 * row.step));
        for (const int count : countWays(ways, kinds))
            text += fmt::format(" {:>7}", count);
        const double alike = percent(countAlike(transfer, row, reference), static_cast<int>(ways.size()));
        ways.insert(ways.begin(), before.begin(), before.end());
        text += fmt::format(" {:>9.1f} {:>11.1f} {:>10.1f}\n", alike, 100.0 * calcDistance(ways, kinds),
                            100.0 * calcChance(ways, kinds));
    }
    return text;
}

int countOtherVerdicts(const TransferRow& row, const TransferRow& reference) {
    int count = 0;
    for (std::size_t i = 0; i < row.verdicts.size(); ++i)
        count += row.verdicts[i] != reference.verdicts[i] ? 1 : 0;
    return count;
}

}  // namespace

Transfer makeTransfer(const study::Settings& settings, const std::shared_ptr<const part::Part>& part,
                      const std::shared_ptr<const track::Track>& track, int trials) {
    // Ranges that are not cut off have what is set in their middle.
    const study::PlaceTrials asSet{trial::kMiddle, 0, trials};
    const study::PlaceTrials anywhere{std::nullopt, 0, trials};
    return {settings,
            part,
            {{"as set", study::makePlaceBatch(settings, part, track, asSet)},
             {"over the box", study::makePlaceBatch(settings, part, track, anywhere)}},
            {},
            {},
            {}};
}

base::Status beginAtStretch(Transfer& transfer, const Stretch& stretch, const Contender& contender,
                            const base::RunControl& control) {
    const std::shared_ptr<const trial::Engine> engine = contender.kind.make({1, contender.step});
    if (auto checked = study::checkInputs({transfer.settings, transfer.part, engine}); !checked)
        return checked;
    if (transfer.scenes.front().batch.track->shape.type != track::FeederType::linear)
        return base::Error{"A stretch can be taken of linear tracks only."};
    constexpr double kLeast = 0.5;  // [s]
    double longest = kLeast;
    const auto shortened = std::make_shared<track::Track>(*transfer.scenes.front().batch.track);
    if (stretch.to > shortened->finish)
        return base::Error{fmt::format("The stretch ends at {:g} mm, behind the finish line at {:g} mm.",
                                       stretch.to / base::kMillimetre,
                                       shortened->finish / base::kMillimetre)};
    shortened->finish = stretch.to;
    for (TransferScene& scene : transfer.scenes) {
        scene.batch.track = shortened;
        auto starts = findStarts(*engine, scene.batch, stretch, longest, control);
        if (!starts) return starts.error();
        scene.batch.trials = std::move(*starts);
    }
    std::erase_if(transfer.scenes, [](const TransferScene& scene) { return scene.batch.trials.empty(); });
    if (transfer.scenes.empty())
        return base::Error{
            fmt::format("No part comes to {:g} mm in {}.", stretch.from / base::kMillimetre, engine->name())};
    for (TransferScene& scene : transfer.scenes)
        scene.batch.termination.timeLimit = std::min(scene.batch.termination.timeLimit, 2.0 * longest);
    transfer.stretch = stretch;
    return base::success();
}

base::Status addEngine(Transfer& transfer, const Contender& contender, const base::RunControl& control) {
    const std::shared_ptr<const trial::Engine> engine = contender.kind.make({1, contender.step});
    if (auto checked = study::checkInputs({transfer.settings, transfer.part, engine}); !checked)
        return checked;
    for (std::size_t scene = 0; scene < transfer.scenes.size(); ++scene) {
        TransferRow row = runScene(*engine, transfer.scenes[scene], control);
        const bool first = transfer.rows.empty();
        if (control.cancelled() || (first && !row.problem.empty())) return base::Error{row.problem};
        row.scene = scene;
        if (first)
            transfer.goal =
                trial::findGoal(study::findWanted(transfer.settings, *transfer.part), row.outcomes,
                                transfer.part->symmetry, transfer.settings.validation.tolerance);
        judgeRow(transfer, row);
        transfer.rows.push_back(std::move(row));
    }
    return base::success();
}

std::string transferHeader(const Transfer& transfer) {
    if (transfer.stretch)
        return fmt::format("From {:g} to {:g} mm, all as the first engine's parts begin there\n",
                           transfer.stretch->from / base::kMillimetre,
                           transfer.stretch->to / base::kMillimetre) +
               fmt::format(kStretchColumns, "Engine", "Step ms", "Conditions", "Passes [%]", "95 % bounds",
                           "Trials", "Passes too", "Stays too");
    return fmt::format("Success: within {:.0f} degrees of {}\n",
                       transfer.settings.validation.tolerance / base::kDegree,
                       study::describeGoal(transfer.goal, *transfer.part)) +
           fmt::format(kColumns, "Engine", "Step ms", "Conditions", "Success [%]", "95 % bounds",
                       "Correct [%]", "Trials", "Wrong", "Stuck", "Fell off", "Points", "Other [%]");
}

std::string describeTransfer(const Transfer& transfer, const TransferRow& row) {
    const std::string step = fmt::format("{:g}", 1e3 * row.step);
    const std::string& conditions = transfer.scenes[row.scene].conditions;
    if (!row.problem.empty())
        return fmt::format("{:<12} {:>7} {:<13} cannot: {}\n", row.engine, step, conditions, row.problem);
    const TransferRow& reference = transfer.rows[row.scene];
    if (transfer.stretch) return describeStretch(row, reference, step, conditions);
    const trial::Tally& tally = row.tally;
    const int trials = tally.trials();
    const stats::Interval bounds = stats::calcClopperPearson(tally.success, trials);
    const double success = percent(tally.success, trials);
    const int arrived = tally.success + tally.wrongOrientation;
    return fmt::format(
        kColumns, row.engine, step, conditions, fmt::format("{:.1f}", success),
        fmt::format("{:.1f} ... {:.1f}", 100.0 * bounds.low, 100.0 * bounds.high),
        arrived > 0 ? fmt::format("{:.1f}", percent(tally.success, arrived)) : "-", trials,
        tally.wrongOrientation, tally.stuck, tally.fellOff,
        fmt::format("{:+.1f}", success - percent(reference.tally.success, reference.tally.trials())),
        fmt::format("{:.1f}", percent(countOtherVerdicts(row, reference), trials)));
}

std::string describeWays(const Transfer& transfer) {
    std::string text;
    for (std::size_t scene = 0; scene < transfer.scenes.size(); ++scene)
        text += describeSceneWays(transfer, scene);
    return text +
           "Ways: stable pose and heading, in degrees. Alike: each trial as in the first engine. Differs: of "
           "the first engine's shares; chance alone stays below the last column 95 times in 100.\n";
}

base::Status writeTransferTrials(const Transfer& transfer, const std::filesystem::path& file) {
    std::string text =
        "conditions,trial,friction,restitution,half_stroke_mm,bounding_radius_mm,engine,step_ms,verdict,"
        "farthest_x_mm,time_s\n";
    for (const TransferRow& row : transfer.rows) {
        const TransferScene& scene = transfer.scenes[row.scene];
        for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
            const trial::TrialSpec& spec = scene.batch.trials[i];
            const trial::ContactParameters& contact = scene.batch.contactOf(spec);
            const trial::PartOutcome& outcome = row.outcomes[i].parts.front();
            text += fmt::format(
                "{},{},{:.4f},{:.4f},{:.4f},{:.4f},{},{:g},{},{:.2f},{:.3f}\n", scene.conditions, i,
                contact.kineticFriction, contact.restitution, 1e3 * scene.batch.driveOf(spec).halfStroke,
                1e3 * scene.batch.partOf(spec).boundingRadius, row.engine, 1e3 * row.step,
                trial::verdictName(row.verdicts[i]), 1e3 * outcome.farthest.position.x(), outcome.time);
        }
    }
    return base::writeFile(file, text);
}

}  // namespace trapwright::peers
