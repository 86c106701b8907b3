#include "core/study/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/study/chain_planner.h"
#include "core/study/track_design.h"
#include "core/study/trap_trials.h"
#include "core/traps/groove.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

// Of a chain whose ledges follow other traps.
constexpr double kTrapsBefore = 0.5;    // of those that are tried
constexpr double kRoomForLedges = 1.0;  // below what is before them: longest segments

/// Of a chain whose ledges follow other traps what is before them and what they are; else all is before.
std::pair<traps::TrapChain, traps::TrapChain> splitAtLedges(const traps::TrapChain& chain) {
    const auto first =
        chain.front()->isLedge ? chain.end() : std::ranges::find_if(chain, &traps::TrapKind::isLedge);
    return {{chain.begin(), first}, {first, chain.end()}};
}

std::string keysOf(const traps::TrapChain& chain) {
    std::vector<std::string_view> keys;
    std::ranges::transform(chain, std::back_inserter(keys), &traps::TrapKind::key);
    return fmt::format("{}", fmt::join(keys, ", "));
}

/// What is before the ledges is to bring as many parts as it can to one way; what is wrong then they throw
/// out.
EvolutionSettings evolutionBeforeLedges(EvolutionSettings evolution) {
    evolution.objectives = "F_C, success";
    evolution.tradeOff.clear();
    evolution.plannedTraps = static_cast<int>(kTrapsBefore * evolution.plannedTraps);
    return evolution;
}

/// Most parts come the right way, so that their share tells what their logarithm does: one plan.
EvolutionSettings evolutionOfLedges(EvolutionSettings evolution) {
    evolution.plannedTraps -= evolutionBeforeLedges(evolution).plannedTraps;
    if (seeksPurity(evolution)) {
        evolution.objectives = "F_C, purity, success";
        evolution.tradeOff.clear();
    }
    return evolution;
}

StudyInputs inputsBeforeLedges(const StudyInputs& inputs, const traps::TrapChain& before) {
    StudyInputs changed = inputs;
    changed.settings.track.traps = keysOf(before);
    changed.settings.evolution = evolutionBeforeLedges(inputs.settings.evolution);
    return changed;
}

/// Ledges behind this design of what is before them, which is given then.
base::Result<StudyInputs> inputsOfLedges(const StudyInputs& inputs, const StudyInputs& before,
                                         const traps::TrapChain& ledges, const search::Design& design) {
    const auto track = decodeTrack(before.settings.track, design);
    if (!track) return track.error();
    StudyInputs changed = inputs;
    changed.settings.track.traps = keysOf(ledges);
    const double begin = track->sections[static_cast<std::size_t>(track->firstTrapSection)].x;
    std::vector<track::CrossSection> given(track->sections.begin() + track->firstTrapSection + 1,
                                           track->sections.begin() + track->lastTrapSection + 1);
    for (track::CrossSection& section : given)
        section.x -= begin;
    changed.settings.track.given = describeSections(given);
    changed.settings.evolution = evolutionOfLedges(inputs.settings.evolution);
    return changed;
}

/// Two ways to lie in a groove may be one on a ledge, and one of them two.
ChainAim aimBeforeLedges(const TrackSettings& settings, const traps::TrapChain& ledges) {
    return {kRoomForLedges * settings.maxSegmentLength, true, {ledges.front()}};
}

/// First what is before the ledges, then ledges behind the best of it.
base::Result<std::vector<search::Design>> planLedgesBehind(
    const StudyInputs& inputs, const traps::TrapChain& before, const traps::TrapChain& ledges,
    std::size_t most, const std::function<void(const GenerationPlan&)>& planned,
    const LearningControl& control) {
    const std::int64_t begin = control.run.done();
    const StudyInputs first = inputsBeforeLedges(inputs, before);
    const int left = inputs.settings.evolution.plannedTraps - first.settings.evolution.plannedTraps;
    const auto tellFirst = [&](GenerationPlan plan) {
        // What the ledges take is not known before they are reached: as much for each as for what is before.
        plan.trials += plan.trials * left / std::max(1, first.settings.evolution.plannedTraps);
        if (planned) planned(plan);
    };
    auto turning = planChain(first, before, aimBeforeLedges(inputs.settings.track, ledges), kJudgedChains,
                             tellFirst, control);
    if (!turning) return turning;
    const auto second = inputsOfLedges(inputs, first, ledges, turning->front());
    if (!second) return second.error();
    const auto tellSecond = [&](GenerationPlan plan) {
        plan.trials += plan.doneBefore - begin;
        plan.doneBefore = begin;
        if (planned) planned(plan);
    };
    auto designs = planChain(*second, ledges, {}, most, tellSecond, control);
    if (!designs) return designs;
    for (search::Design& design : *designs)
        design.insert(design.begin(), turning->front().begin(), turning->front().end());
    return designs;
}

}  // namespace

std::string findPlanningProblem(const TrackSettings& settings) {
    const auto chain = traps::readTraps(settings.traps);
    if (!chain) return chain.error().message;
    const auto areLedges = [](const traps::TrapChain& traps) {
        return traps.size() > kLedgesBefore && std::ranges::all_of(traps, &traps::TrapKind::isLedge);
    };
    if (areLedges(*chain)) return {};
    if (!settings.given.empty())
        return "Behind a trap that is given (track.given) only ledges are planned, as in \"4 x ledge\"; "
               "choose them or graded.";
    const std::string_view groove = traps::groove().key;
    const auto [before, ledges] = splitAtLedges(*chain);
    bool isRight = before.size() > kGroovesBefore && (ledges.empty() || areLedges(ledges));
    for (std::size_t i = 0; i < before.size(); ++i) {
        const traps::TrapKind& kind = *before[i];
        isRight = isRight && (i < kGroovesBefore ? kind.key == groove : kind.endsInGroove);
    }
    if (isRight) return {};
    return fmt::format(
        "Traps can be planned that begin with two grooves and go on with drops, cut-outs, gaps and slots, as "
        "in \"groove, groove, 3 x gap\", with ledges behind them or not, or that are all ledges, as in \"4 x "
        "ledge\"; these are \"{}\".",
        settings.traps);
}

bool isPlanned(const EvolutionSettings& settings) {
    return settings.search != search::Method::random &&
           settings.firstGeneration == search::ga::FirstGeneration::planned;
}

base::Result<PlanningSample> samplePlanning(const StudyInputs& inputs, double budget,
                                            const base::RunControl& control) {
    const auto [before, ledges] = splitAtLedges(traps::readTraps(inputs.settings.track.traps).value());
    // Of ledges behind other traps a trial takes about as long.
    const StudyInputs first = ledges.empty() ? inputs : inputsBeforeLedges(inputs, before);
    const ChainAim aim = ledges.empty() ? ChainAim{} : aimBeforeLedges(inputs.settings.track, ledges);
    const auto sample = sampleChain(first, before, aim, budget, control);
    if (!sample) return sample.error();
    return PlanningSample{sample->ways, sample->seconds, !ledges.empty()};
}

std::int64_t estimatePlanningTrials(const EvolutionSettings& settings, int ways, bool ledgesFollow) {
    if (!isPlanned(settings)) return 0;
    constexpr int kWaysToLedges = 4;  // few others are left
    if (ledgesFollow)
        return estimatePlanningTrials(evolutionBeforeLedges(settings), ways) +
               estimatePlanningTrials(evolutionOfLedges(settings), std::min(ways, kWaysToLedges));
    return estimateTrapTrials(settings, ways);
}

std::int64_t estimateJudgingTrials(const EvolutionSettings& settings, bool ledgesFollow) {
    if (!isPlanned(settings)) return 0;
    if (ledgesFollow)
        return estimateJudgingTrials(evolutionBeforeLedges(settings)) +
               estimateJudgingTrials(evolutionOfLedges(settings));
    return estimateJudgingOf(settings, countPlanned(settings));
}

std::size_t countPlanned(const EvolutionSettings& settings) {
    return (static_cast<std::size_t>(settings.populationSize) + 1) / 2;
}

base::Result<std::vector<search::Design>> planDesigns(
    const StudyInputs& inputs, std::size_t most, const std::function<void(const GenerationPlan&)>& planned,
    const LearningControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    if (const std::string problem = findPlanningProblem(inputs.settings.track); !problem.empty())
        return base::Error{problem};
    const auto [before, ledges] = splitAtLedges(traps::readTraps(inputs.settings.track.traps).value());
    if (!ledges.empty()) return planLedgesBehind(inputs, before, ledges, most, planned, control);
    return planChain(inputs, before, {}, most, planned, control);
}

}  // namespace trapwright::study
