#include "core/study/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/study/operating_box.h"

namespace trapwright::study {

namespace {

// decisions.md#steps-while-learning
constexpr double kLearningStepsPerPeriod = 66.0;
constexpr double kLargestStep = 0.3e-3;  // [s]

bool isSame(const std::optional<base::Quaternion>& a, const std::optional<base::Quaternion>& b) {
    return a.has_value() == b.has_value() && (!a || a->coeffs() == b->coeffs());
}

/// The generation; none: the largest number.
int firstWithCorners(const EvolutionSettings& settings) {
    const bool hasCorners = settings.conditions == TrialConditions::varied && settings.cornerShare > 0.0;
    return hasCorners ? settings.cornersFrom : std::numeric_limits<int>::max();
}

/// What counts in the sum besides; empty too where a name is wrong.
objectives::ObjectiveList listWithoutCorners(const EvolutionSettings& settings) {
    auto list = objectives::readObjectives(settings.objectives);
    if (!list) return {};
    std::erase(*list, objectives::findObjective(objectives::kCorners));
    return *std::move(list);
}

}  // namespace

bool operator==(const TrackSettings& a, const TrackSettings& b) {
    const auto fields = [](const TrackSettings& s) {
        return std::tie(s.shape.type, s.shape.bowlRadius, s.shape.conveying, s.shape.slope, s.traps,
                        s.crossSections, s.pointsPerSection, s.minSegmentLength, s.maxSegmentLength,
                        s.segmentWidth, s.segmentHeight, s.leadInLength, s.startFromLeadInEnd,
                        s.leadOutSegments, s.baseThickness, s.walls.inner, s.walls.outer, s.encoding, s.given,
                        s.returns, s.spiral.width, s.spiral.wall, s.spiral.inclination, s.chute.length,
                        s.chute.angle);
    };
    return fields(a) == fields(b);
}

bool operator==(const TargetSettings& a, const TargetSettings& b) {
    return a.poses == b.poses && a.heading == b.heading && isSame(a.orientation, b.orientation) &&
           a.orientationTurns == b.orientationTurns;
}

bool operator==(const SimulationSettings& a, const SimulationSettings& b) {
    const auto fields = [](const SimulationSettings& s) {
        return std::tie(s.drive.frequency, s.drive.halfStroke, s.drive.angle, s.contact.staticFriction,
                        s.contact.kineticFriction, s.contact.restitution, s.surface, s.termination.timeLimit,
                        s.termination.stuckTime, s.termination.stuckProgress, s.start.tilt, s.start.lateral,
                        s.gravity, s.engine);
    };
    return isSame(a.start.nearPose, b.start.nearPose) && fields(a) == fields(b);
}

bool operator==(const StreamSettings& a, const StreamSettings& b) {
    const auto fields = [](const StreamSettings& s) {
        return std::tie(s.partsPerMinute, s.arrivals, s.delivery, s.warmUp, s.duration, s.streams,
                        s.contact.staticFriction, s.contact.kineticFriction, s.contact.restitution);
    };
    return fields(a) == fields(b);
}

std::optional<trial::OperatingBox> boxOfJudging(const Settings& settings) {
    if (settings.validation.conditions == TrialConditions::nominal) return std::nullopt;
    return settings.box;
}

double chooseLearningStep(const Settings& settings) {
    if (settings.evolution.learningStep > 0.0) return settings.evolution.learningStep;
    return std::min(kLargestStep, trial::calcLongestStep(settings.simulation.drive, kLearningStepsPerPeriod));
}

void takePoseWeights(PartSettings& part, const PartSettings& other) {
    part.poseWeights = other.poseWeights;
    part.droppedCounts = other.droppedCounts;
}

bool keepsScores(const Settings& before, const Settings& after, int generations) {
    Settings same = after;
    same.evolution.generations = before.evolution.generations;
    if (firstWithCorners(before.evolution) >= generations &&
        firstWithCorners(after.evolution) >= generations &&
        listWithoutCorners(before.evolution) == listWithoutCorners(after.evolution)) {
        same.evolution.objectives = before.evolution.objectives;
        same.evolution.cornerShare = before.evolution.cornerShare;
        same.evolution.cornersFrom = before.evolution.cornersFrom;
    }
    takePoseWeights(same.part, before.part);
    same.validation = before.validation;
    // Where success counts in F, what success is counts as well.
    const auto summed = objectives::readObjectives(before.evolution.objectives);
    if (summed && std::ranges::any_of(*summed, &objectives::Objective::usesTolerance))
        same.validation.tolerance = after.validation.tolerance;
    if (!summed || !objectives::contains(*summed, objectives::kThroughput)) same.stream = before.stream;
    same.feeder = before.feeder;
    if (before.evolution.conditions == TrialConditions::nominal) same.box = before.box;
    return same == before;
}

double cornerShareIn(const EvolutionSettings& settings, int generation) {
    return generation >= firstWithCorners(settings) ? settings.cornerShare : 0.0;
}

Settings learnInCorners(const Settings& settings, int generation) {
    constexpr double kShare = 0.6;
    constexpr int kGenerations = 20;
    Settings next = settings;
    EvolutionSettings& evolution = next.evolution;
    evolution.cornerShare = kShare;
    evolution.cornersFrom = generation;
    if (listWithoutCorners(evolution) == objectives::readObjectives(evolution.objectives).value())
        evolution.objectives += fmt::format(", {}", objectives::kCorners);
    evolution.generations = std::max(evolution.generations, generation + kGenerations);
    return next;
}

bool canLearnInCorners(const Settings& settings, int generation) {
    return settings.evolution.conditions == TrialConditions::varied &&
           hasRoom(settings.simulation, settings.box) && firstWithCorners(settings.evolution) > generation;
}

}  // namespace trapwright::study
