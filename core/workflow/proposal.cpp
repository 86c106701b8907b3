#include "core/workflow/proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/part/stable_poses.h"
#include "core/study/planning.h"
#include "core/study/presets.h"
#include "core/workflow/estimate.h"

namespace trapwright::workflow {

namespace {

constexpr double kTimingBudget = 3.0;  // [s]
/// Of a part's length: what is sorted by its ends has its centre of mass farther from the middle than this
/// (learning.md).
constexpr double kBalanced = 0.03;
/// Of the user's time: the rest is for checks and selection, and for what an estimate misses.
constexpr double kLearningShare = 0.85;

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

std::string durationText(double seconds) {
    const auto minutes = static_cast<int>(std::lround(seconds / 60.0));
    if (minutes < 1) return fmt::format("{:.0f} s", seconds);
    if (minutes < 60) return fmt::format("{} min", minutes);
    return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string trackText(const study::TrackSettings& track) {
    return fmt::format("{:g} mm wide, {:g} mm high, segments of {:g} to {:g} mm", 1e3 * track.segmentWidth,
                       1e3 * track.segmentHeight, 1e3 * track.minSegmentLength, 1e3 * track.maxSegmentLength);
}

/// The most that learning is given.
study::EvolutionSettings mostOfSearch(study::EvolutionSettings evolution) {
    constexpr int kMostEach = 400;
    constexpr int kMostTraps = 100000;
    evolution.plannedTraps = kMostTraps;
    if (study::isPlanned(evolution)) return evolution;
    evolution.populationSize = kMostEach;
    evolution.trialsPerEvaluation = kMostEach;
    evolution.generations = 2000;
    return evolution;
}

}  // namespace

base::Result<Proposal> proposeSettings(const study::StudyInputs& inputs, double seconds,
                                       const base::RunControl& control) {
    if (!(seconds >= kShortestTime))
        return base::Error{fmt::format("{:g} s are too short to learn a track in; give {:.0f} s or more.",
                                       seconds, kShortestTime)};
    const part::Part& part = *inputs.part;
    const bool isSorted = hasTwoEnds(part.symmetry);
    study::StudyInputs proposed = inputs;
    study::Settings& settings = proposed.settings;
    settings = isSorted ? study::sortingMode(settings, part) : study::turningMode(settings, part);
    const auto cost = timeTrials(proposed, kTimingBudget, control);
    if (!cost) return cost.error();
    const auto fitted = fitEvolution(mostOfSearch(settings.evolution), kLearningShare * seconds, *cost);
    if (!fitted)
        return base::Error{
            fmt::format("In {} no track for {} can be learned on this machine: a trial takes {:.2g} ms. Take "
                        "more time, or a "
                        "part of fewer pieces.",
                        durationText(seconds), part.name, 1e3 * cost->learning)};
    settings.evolution = *fitted;

    Proposal proposal;
    proposal.seconds = learningTime(*fitted, fitted->generations, *cost);
    if (isSorted) {
        proposal.reasons.push_back(
            fmt::format("{} (symmetry {}) looks another way with its other end in front, and hardly any "
                        "track turns such a "
                        "part round: what lies wrong is thrown out, by eight gaps planned from {} traps "
                        "tried one by one.",
                        part.name, part.symmetry.name, fitted->plannedTraps));
        const part::LengthInPose uneven = part::findUnevenLength(part);
        if (uneven.offset < kBalanced * uneven.length) {
            proposal.reasons.push_back(fmt::format(
                "Its centre of mass is {:.2g} mm from the middle of its length of {:.3g} mm: of "
                "parts that balance so gaps do not tell which end comes first, and about half "
                "will come the other way round. Ledges behind gaps throw these out of some parts: --ledges, "
                "or Let only one way pass among the presets of a track.",
                uneven.offset / base::kMillimetre, uneven.length / base::kMillimetre));
        }
    } else {
        proposal.reasons.push_back(fmt::format(
            "{} (symmetry {}) looks alike with either end in front: a free-form trap turns it over, and "
            "all that is fed is to arrive.",
            part.name, part.symmetry.name));
    }
    proposal.reasons.push_back("In proportion to the part: " + trackText(settings.track) + ".");
    proposal.reasons.push_back(
        fmt::format("{} generations of {} individuals x {} trials: about {} here, of {}.",
                    fitted->generations, fitted->populationSize, fitted->trialsPerEvaluation,
                    durationText(proposal.seconds), durationText(seconds)));
    proposal.settings = std::move(settings);
    return proposal;
}

}  // namespace trapwright::workflow
