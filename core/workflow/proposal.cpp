#include "core/workflow/proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/part/stable_poses.h"
#include "core/study/chain_planner.h"
#include "core/study/planning.h"
#include "core/study/presets.h"
#include "core/study/target.h"
#include "core/workflow/estimate.h"

namespace trapwright::workflow {

namespace {

constexpr double kTimingBudget = 3.0;  // [s]
/// Of a part's length: what is sorted by its ends has its centre of mass farther from the middle than this
/// (learning.md).
constexpr double kBalanced = 0.03;
/// Of the user's time: the rest is for checks and selection, and for what an estimate misses.
constexpr double kLearningShare = 0.85;
/// With 500 of them 43 % of clips came right, with 3000 94 %
/// (tests/studies/results/2026-11-29-ledges-for-a-time.md).
constexpr int kTrapsForLedges = 1000;
/// Slots that are tried to find out whether a part hangs in them, if they take no more of the time.
constexpr int kSlotsToTry = 64;
constexpr double kShareToTry = 0.1;
/// What the best of them brings to one way then at least, and how much more than comes so: bolts and screws
/// 90 to 96 %, pins 70 to 80, cones and cups 45, a plate 17 (tests/studies/results/2026-11-30-slots.md).
constexpr double kHangs = 0.65;
constexpr double kHangsMore = 1.15;

/// Whether a part looks another way when it comes the other end first: a track has to tell the two apart.
bool hasTwoEnds(const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return false;
    if (symmetry.continuous) return !symmetry.flip;
    // Turns about one axis alone, none of which brings the other end to the front.
    const base::Quaternion& first =
        symmetry.rotations.size() > 1 ? symmetry.rotations[1] : symmetry.rotations[0];
    return std::all_of(symmetry.rotations.begin(), symmetry.rotations.end(),
                       [&](const base::Quaternion& one) {
                           constexpr double kAlong = 1e-3;
                           return one.vec().cross(first.vec()).norm() < kAlong;
                       });
}

constexpr double kMinute = 60.0;

std::string durationText(double seconds) {
    const auto minutes = static_cast<int>(std::lround(seconds / kMinute));
    if (minutes < 1) return fmt::format("{:.0f} s", seconds);
    if (minutes < 60) return fmt::format("{} min", minutes);
    return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

/// As it was given: not 90 s as 2 min.
std::string givenText(double seconds) {
    return std::fmod(seconds, kMinute) == 0.0 ? durationText(seconds) : fmt::format("{:g} s", seconds);
}

/// No less than that.
std::string leastText(double seconds) {
    return durationText(kMinute * std::ceil(seconds / kMinute));
}

std::string trackText(const study::TrackSettings& track) {
    return fmt::format("{:g} mm wide, {:g} mm high, segments of {:g} to {:g} mm", 1e3 * track.segmentWidth,
                       1e3 * track.segmentHeight, 1e3 * track.minSegmentLength, 1e3 * track.maxSegmentLength);
}

/// The most that learning is given.
study::EvolutionSettings mostOfSearch(TrackIdea idea, study::EvolutionSettings evolution) {
    constexpr int kMostEach = 400;
    constexpr int kMostTraps = 100000;
    constexpr int kMostTrapsBeforeExchanges = 6000;  // of more than 3000 nothing is known
    constexpr int kMostSlots = 3000;
    constexpr int kMostGenerations = 2000;
    const bool exchanges = evolution.search == search::Method::exchange;
    evolution.plannedTraps = exchanges                    ? kMostTrapsBeforeExchanges
                             : idea == TrackIdea::hanging ? kMostSlots
                                                          : kMostTraps;
    if (exchanges) evolution.generations = kMostGenerations;
    if (study::isPlanned(evolution)) return evolution;
    evolution.populationSize = kMostEach;
    evolution.trialsPerEvaluation = kMostEach;
    evolution.generations = kMostGenerations;
    return evolution;
}

/// An idea, and how much of it there is time for.
struct FittedIdea {
    TrackIdea idea = TrackIdea::turning;
    study::Settings settings;
    bool fits = false;     // else the time is too short for it
    double seconds = 0.0;  // of learning, estimated
    double least = 0.0;    // of the user's time that it takes [s]
    TrialCost cost;
    std::optional<study::AloneSample> alone;  // of its traps, where it was chosen by them
};

/// An error as of proposeSettings.
base::Result<FittedIdea> fitIdea(TrackIdea idea, const study::StudyInputs& inputs, double seconds,
                                 const base::RunControl& control) {
    study::StudyInputs proposed = inputs;
    proposed.settings = applyIdea(idea, inputs.settings, *inputs.part);
    study::EvolutionSettings& evolution = proposed.settings.evolution;
    const auto cost = timeTrials(proposed, kTimingBudget, control);
    if (!cost) return cost.error();
    const study::EvolutionSettings most = mostOfSearch(idea, evolution);
    FittedIdea fitted;
    fitted.idea = idea;
    fitted.cost = *cost;
    fitted.least = leastTime(most, *cost) / kLearningShare;
    if (const auto search = fitEvolution(most, kLearningShare * seconds, *cost)) {
        evolution = *search;
        fitted.fits = true;
        fitted.seconds = learningTime(*search, search->generations, *cost);
    }
    fitted.settings = std::move(proposed.settings);
    return fitted;
}

/// Slots, if some of them tried by themselves show that the part hangs in them, and there is time for that.
base::Result<std::optional<FittedIdea>> fitSlots(const study::StudyInputs& inputs, double seconds,
                                                 const base::RunControl& control) {
    auto slots = fitIdea(TrackIdea::hanging, inputs, seconds, control);
    if (!slots) return slots.error();
    const double trying =
        static_cast<double>(study::estimateAloneTrials(kSlotsToTry, slots->cost.ways)) * slots->cost.planning;
    if (!slots->fits || trying > kShareToTry * seconds) return std::optional<FittedIdea>();
    study::StudyInputs proposed = inputs;
    proposed.settings = slots->settings;
    const auto alone = study::sampleAlone(proposed, traps::readTraps(proposed.settings.track.traps).value(),
                                          kSlotsToTry, control);
    if (!alone) return alone.error();
    if (alone->best < std::max(kHangs, kHangsMore * alone->unturned)) return std::optional<FittedIdea>();
    slots->alone = *alone;
    return std::optional(std::move(*slots));
}

/// What suits the part, as far as there is time for it.
base::Result<FittedIdea> chooseIdea(const study::StudyInputs& inputs, double seconds,
                                    const base::RunControl& control, std::optional<TrackIdea> asked) {
    if (asked) return fitIdea(*asked, inputs, seconds, control);
    if (study::wantsHanging(inputs.settings, *inputs.part))
        return fitIdea(TrackIdea::rails, inputs, seconds, control);
    if (!hasTwoEnds(inputs.part->symmetry)) return fitIdea(TrackIdea::turning, inputs, seconds, control);
    auto slots = fitSlots(inputs, seconds, control);
    if (!slots) return slots.error();
    if (*slots) return std::move(**slots);
    auto ledges = fitIdea(TrackIdea::ledges, inputs, seconds, control);
    if (!ledges || (ledges->fits && ledges->settings.evolution.plannedTraps >= kTrapsForLedges))
        return ledges;
    return fitIdea(TrackIdea::gaps, inputs, seconds, control);
}

}  // namespace

study::Settings applyIdea(TrackIdea idea, study::Settings settings, const part::Part& part) {
    switch (idea) {
        case TrackIdea::turning:
            break;
        case TrackIdea::gaps:
            return study::sortingMode(std::move(settings), part);
        case TrackIdea::ledges:
            return study::ledgeMode(std::move(settings), part);
        case TrackIdea::hanging:
            return study::slotMode(std::move(settings), part);
        case TrackIdea::rails:
            return study::railsMode(std::move(settings), part);
    }
    return study::turningMode(std::move(settings), part);
}

base::Result<Proposal> proposeSettings(const study::StudyInputs& inputs, double seconds,
                                       const base::RunControl& control, std::optional<TrackIdea> asked) {
    if (!(seconds >= kShortestTime))
        return base::Error{fmt::format("{:g} s are too short to learn a track in; give {:.0f} s or more.",
                                       seconds, kShortestTime)};
    const part::Part& part = *inputs.part;
    auto chosen = chooseIdea(inputs, seconds, control, asked);
    if (!chosen) return chosen.error();
    FittedIdea& fitted = *chosen;
    if (!fitted.fits)
        return base::Error{fmt::format(
            "In {} no track for {} can be learned {}on this machine: as it is now it takes {}. Give it that "
            "time, end what else keeps it busy, or take a part of fewer pieces.",
            givenText(seconds), part.name, asked ? "that way " : "", leastText(fitted.least))};
    const TrackIdea idea = fitted.idea;
    const study::EvolutionSettings& evolution = fitted.settings.evolution;
    const bool isSorted = hasTwoEnds(part.symmetry);
    const std::string looks = fmt::format("{} (symmetry {}) looks another way with its other end in front",
                                          part.name, part.symmetry.name);

    Proposal proposal;
    proposal.seconds = fitted.seconds;
    if (idea == TrackIdea::turning) {
        const std::string why = isSorted
                                    ? std::string("As you asked")
                                    : fmt::format("{} (symmetry {}) looks alike with either end in front",
                                                  part.name, part.symmetry.name);
        proposal.reasons.push_back(why +
                                   ": a free-form trap turns it over, and all that is fed is to arrive.");
    } else if (idea == TrackIdea::rails) {
        const std::string why =
            asked ? std::string("As you asked, parts leave hanging")
                  : fmt::format("{} is wanted as it hangs by its thicker end, in any heading", part.name);
        proposal.reasons.push_back(why +
                                   ": a slot that goes on to the track's end, between whose rails it "
                                   "hangs.");
    } else if (idea == TrackIdea::hanging) {
        constexpr double kPercent = 100.0;
        const std::string why =
            fitted.alone
                ? fmt::format(
                      "{}, and hangs in a slot by its thicker end: of {} slots tried by "
                      "themselves one brings {:.0f} % of the parts to lie one way, where {:.0f} % come in "
                      "the most frequent one",
                      looks, kSlotsToTry, kPercent * fitted.alone->best, kPercent * fitted.alone->unturned)
                : std::string("As you asked, parts hang by their thicker end");
        proposal.reasons.push_back(
            fmt::format("{}. Three slots, planned from {} tried one by one.", why, evolution.plannedTraps));
    } else {
        const std::string why =
            isSorted ? looks + ", and hardly any track turns such a part round: what lies wrong is thrown out"
                     : std::string("As you asked, what lies wrong is thrown out");
        const std::string by =
            idea == TrackIdea::ledges ? "eight gaps and six ledges behind them" : "eight gaps";
        proposal.reasons.push_back(fmt::format("{}, by {} planned from {} traps tried one by one.", why, by,
                                               evolution.plannedTraps));
        const part::LengthInPose uneven = part::findUnevenLength(part);
        if (uneven.offset < kBalanced * uneven.length)
            proposal.reasons.push_back(fmt::format(
                "Its centre of mass is {:.2g} mm from the middle of its length of {:.3g} mm: of "
                "parts that balance so gaps do not tell which end comes first{}",
                uneven.offset / base::kMillimetre, uneven.length / base::kMillimetre,
                idea == TrackIdea::ledges
                    ? ", and ledges behind them of some parts only."
                    : ", and about half will come the other way round. Ledges behind gaps throw these out of "
                      "some parts: --ledges, or Let only one way pass among the presets of a track."));
    }
    proposal.reasons.push_back("In proportion to the part: " + trackText(fitted.settings.track) + ".");
    proposal.reasons.push_back(
        fmt::format("{} generations of {} individuals x {} trials: about {} here, of {}.",
                    evolution.generations, evolution.populationSize, evolution.trialsPerEvaluation,
                    durationText(proposal.seconds), durationText(seconds)));
    proposal.settings = std::move(fitted.settings);
    return proposal;
}

}  // namespace trapwright::workflow
