#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/search/ranking.h"
#include "core/study/number_text.h"
#include "core/study/settings.h"

namespace trapwright::study {

/// A number's key in files ("track.segmentWidth_mm"), its unit there and its allowed range in that unit.
struct NumberField {
    std::string_view key;
    FileUnit unit = FileUnit::none;
    double low = 0.0;
    double high = 0.0;
};

/// A whole number's key and allowed range.
struct CountField {
    std::string_view key;
    int low = 0;
    int high = 0;
};

template <class Enum, std::size_t N>
using Choices = std::array<std::pair<std::string_view, Enum>, N>;

inline constexpr Choices<TrialConditions, 2> kConditionChoices = {
    {{"nominal", TrialConditions::nominal}, {"varied", TrialConditions::varied}}};

/// The one list of all settings: visits every field in the order of the file. The JSON writer, the JSON
/// reader and the range check are visitors, so that a key, its unit and its range cannot fall apart.
/// SettingsType is Settings or const Settings.
template <class Visitor, class SettingsType>
void visitFields(Visitor& v, SettingsType& s) {
    constexpr auto mm = FileUnit::millimetre;
    constexpr auto degree = FileUnit::degree;
    constexpr auto none = FileUnit::none;

    v.text("part.file", s.part.file);
    v.text("part.units", s.part.units);
    v.number({"part.density_kg_m3", none, 1.0, 30000.0}, s.part.density);
    v.text("part.material", s.part.material);
    v.number({"part.symmetryTolerance", none, 1e-6, 0.2}, s.part.symmetryTolerance);
    v.choice("part.symmetry", s.part.symmetry,
             Choices<part::SymmetryUse, 2>{
                 {{"found", part::SymmetryUse::found}, {"none", part::SymmetryUse::none}}});
    v.choice("part.poseWeights", s.part.poseWeights,
             Choices<PoseWeights, 2>{
                 {{"quasi-static", PoseWeights::quasiStatic}, {"dropped", PoseWeights::dropped}}});
    v.text("part.droppedCounts", s.part.droppedCounts);

    v.choice("track.feeder", s.track.shape.type,
             Choices<track::FeederType, 2>{
                 {{"linear", track::FeederType::linear}, {"bowl", track::FeederType::bowl}}});
    v.number({"track.bowlRadius_mm", mm, 10.0, 5000.0}, s.track.shape.bowlRadius);
    v.choice("track.conveying", s.track.shape.conveying,
             Choices<track::Conveying, 2>{{{"clockwise", track::Conveying::clockwise},
                                           {"anticlockwise", track::Conveying::anticlockwise}}});
    // The last bits that radians lose of whole degrees are more than a float carries.
    constexpr double kSteepest = static_cast<float>(track::kSteepestSlope / base::kDegree);
    v.number({"track.slope_deg", degree, -kSteepest, kSteepest}, s.track.shape.slope);
    v.text("track.traps", s.track.traps);
    v.text("track.given", s.track.given);
    v.choice("track.returns", s.track.returns,
             Choices<trial::Returns, 4>{{{"nowhere", trial::Returns::nowhere},
                                         {"inner", trial::Returns::innerSide},
                                         {"outer", trial::Returns::outerSide},
                                         {"anywhere", trial::Returns::anywhere}}});
    v.count({"track.crossSections", 1, 200}, s.track.crossSections);
    v.count({"track.pointsPerSection", 2, 200}, s.track.pointsPerSection);
    v.number({"track.minSegmentLength_mm", mm, 0.1, 1000.0}, s.track.minSegmentLength);
    v.number({"track.maxSegmentLength_mm", mm, 0.1, 1000.0}, s.track.maxSegmentLength);
    v.number({"track.segmentWidth_mm", mm, 1.0, 1000.0}, s.track.segmentWidth);
    v.number({"track.segmentHeight_mm", mm, 0.1, 1000.0}, s.track.segmentHeight);
    v.number({"track.leadInLength_mm", mm, 1.0, 2000.0}, s.track.leadInLength);
    v.number({"track.startFromLeadInEnd_mm", mm, 0.1, 2000.0}, s.track.startFromLeadInEnd);
    v.count({"track.leadOutSegments", 1, 50}, s.track.leadOutSegments);
    v.number({"track.baseThickness_mm", mm, 0.1, 100.0}, s.track.baseThickness);
    v.number({"track.innerWall_mm", mm, 0.0, 1000.0}, s.track.walls.inner);
    v.number({"track.outerWall_mm", mm, 0.0, 1000.0}, s.track.walls.outer);
    v.number({"track.spiralWidth_mm", mm, 0.0, 1000.0}, s.track.spiral.width);
    v.number({"track.spiralWall_mm", mm, 0.1, 1000.0}, s.track.spiral.wall);
    v.number({"track.spiralInclination_deg", degree, 0.0, 45.0}, s.track.spiral.inclination);
    v.number({"track.chuteLength_mm", mm, 0.0, 1000.0}, s.track.chute.length);
    v.number({"track.chuteAngle_deg", degree, 1.0, 60.0}, s.track.chute.angle);
    v.choice("track.encoding", s.track.encoding,
             Choices<PointEncoding, 2>{{{"strip", PointEncoding::strip}, {"free", PointEncoding::free}}});

    v.choice("evolution.search", s.evolution.search, search::kMethods);
    v.count({"evolution.populationSize", 2, 100000}, s.evolution.populationSize);
    v.count({"evolution.trialsPerEvaluation", 1, 1000000}, s.evolution.trialsPerEvaluation);
    v.count({"evolution.tournamentSize", 1, 100000}, s.evolution.tournamentSize);
    v.number({"evolution.staticMutation", none, 0.0, 1.0}, s.evolution.staticMutation);
    v.number({"evolution.smoothingLimit", none, 0.0, 1.0}, s.evolution.smoothingLimit);
    v.number({"evolution.mutationFloor", none, 0.0, 1.0}, s.evolution.mutationFloor);
    v.choice("evolution.strategyScope", s.evolution.strategyScope, search::ga::kStrategyScopes);
    v.choice("evolution.firstGeneration", s.evolution.firstGeneration,
             Choices<search::ga::FirstGeneration, 4>{{{"graded", search::ga::FirstGeneration::graded},
                                                      {"random", search::ga::FirstGeneration::random},
                                                      {"planned", search::ga::FirstGeneration::planned},
                                                      {"known", search::ga::FirstGeneration::known}}});
    v.count({"evolution.plannedTraps", 32, 1000000}, s.evolution.plannedTraps);
    v.text("evolution.objectives", s.evolution.objectives);
    v.text("evolution.tradeOff", s.evolution.tradeOff);
    v.choice("evolution.conditions", s.evolution.conditions, kConditionChoices);
    v.number({"evolution.cornerShare", none, 0.0, 1.0}, s.evolution.cornerShare);
    v.count({"evolution.cornersFrom", 0, 1000000}, s.evolution.cornersFrom);
    v.choice("evolution.orientationDistance", s.evolution.orientationDistance,
             Choices<trial::OrientationDistance, 2>{{{"symmetric", trial::OrientationDistance::symmetric},
                                                     {"plain", trial::OrientationDistance::plain}}});
    v.flag("evolution.simulateOverlapping", s.evolution.simulateOverlapping);
    v.count({"evolution.racingTrials", 0, 1000000}, s.evolution.racingTrials);
    v.number({"evolution.racingShare", none, 0.02, 1.0}, s.evolution.racingShare);
    v.flag("evolution.commonRandomNumbers", s.evolution.commonRandomNumbers);
    v.number({"evolution.streamShare", none, 0.0, 1.0}, s.evolution.streamShare);
    v.count({"evolution.streamsEach", 1, 1000}, s.evolution.streamsEach);
    v.number({"evolution.learningStuckTime_s", none, 0.05, 600.0}, s.evolution.learningStuckTime);
    v.number({"evolution.learningStep_ms", FileUnit::millisecond, 0.0, 1.0}, s.evolution.learningStep);
    v.count({"evolution.generations", 1, 1000000}, s.evolution.generations);
    v.seed("evolution.seed", s.evolution.seed);

    auto& drive = s.simulation.drive;
    v.number({"simulation.drive.frequency_Hz", none, 1.0, 1000.0}, drive.frequency);
    v.number({"simulation.drive.halfStroke_mm", mm, 0.001, 10.0}, drive.halfStroke);
    v.number({"simulation.drive.angle_deg", degree, 0.1, 89.0}, drive.angle);
    auto& contact = s.simulation.contact;
    v.number({"simulation.contact.staticFriction", none, 0.0, 2.0}, contact.staticFriction);
    v.number({"simulation.contact.kineticFriction", none, 0.0, 2.0}, contact.kineticFriction);
    v.number({"simulation.contact.restitution", none, 0.0, 1.0}, contact.restitution);
    v.text("simulation.contact.surface", s.simulation.surface);
    auto& termination = s.simulation.termination;
    v.number({"simulation.termination.timeLimit_s", none, 0.0, 600.0}, termination.timeLimit);
    v.number({"simulation.termination.stuckTime_s", none, 0.05, 600.0}, termination.stuckTime);
    v.number({"simulation.termination.stuckProgress_mm", mm, 0.001, 100.0}, termination.stuckProgress);
    auto& start = s.simulation.start;
    v.rotation("simulation.start.nearPose", start.nearPose);
    v.number({"simulation.start.tilt_deg", degree, 0.0, 90.0}, start.tilt);
    v.number({"simulation.start.lateral_mm", mm, 0.0, 500.0}, start.lateral);
    v.number({"simulation.gravity_m_s2", none, 0.1, 100.0}, s.simulation.gravity);
    v.text("simulation.engine", s.simulation.engine);

    constexpr auto percent = FileUnit::percent;
    auto& box = s.box;
    v.number({"box.friction", none, 0.0, 2.0}, box.friction);
    v.number({"box.restitution", none, 0.0, 1.0}, box.restitution);
    v.number({"box.halfStroke_percent", percent, 0.0, 50.0}, box.halfStroke);
    v.number({"box.frequency_percent", percent, 0.0, 20.0}, box.frequency);
    v.number({"box.angle_deg", degree, 0.0, 30.0}, box.angle);
    v.number({"box.sizeBelow_mm", mm, 0.0, 10.0}, box.sizeBelow);
    v.number({"box.sizeAbove_mm", mm, 0.0, 10.0}, box.sizeAbove);
    v.number({"box.centre_mm", mm, 0.0, 10.0}, box.centre);
    v.number({"box.startOffset_mm", mm, 0.0, 100.0}, box.startOffset);
    v.number({"box.startSpeed_mm_s", mm, 0.0, 1000.0}, box.startSpeed);
    v.number({"box.roughness_deg", degree, 0.0, 30.0}, box.roughness);
    v.choice("box.distribution", box.distribution,
             Choices<trial::BoxDistribution, 2>{
                 {{"uniform", trial::BoxDistribution::uniform}, {"normal", trial::BoxDistribution::normal}}});

    v.text("target.poses", s.target.poses);
    v.rotation("target.orientation", s.target.orientation);
    v.flag("target.orientationTurns", s.target.orientationTurns);
    v.text("target.heading_deg", s.target.heading);

    v.count({"validation.selectionWinners", 1, 10000}, s.validation.selectionWinners);
    v.count({"validation.selectionTrials", 1, 1000000}, s.validation.selectionTrials);
    v.count({"validation.selectionCornerTrials", 0, 1000000}, s.validation.selectionCornerTrials);
    v.count({"validation.trialsPerPose", 1, 1000000}, s.validation.trialsPerPose);
    v.number({"validation.tolerance_deg", degree, 0.1, 180.0}, s.validation.tolerance);
    v.choice("validation.conditions", s.validation.conditions, kConditionChoices);

    auto& stream = s.stream;
    v.number({"stream.partsPerMinute", none, 0.1, 10000.0}, stream.partsPerMinute);
    v.choice("stream.arrivals", stream.arrivals,
             Choices<Arrivals, 2>{{{"random", Arrivals::random}, {"regular", Arrivals::regular}}});
    v.choice("stream.delivery", stream.delivery,
             Choices<Delivery, 2>{{{"resting", Delivery::resting}, {"anyhow", Delivery::anyhow}}});
    v.number({"stream.warmUp_s", none, 0.0, 3600.0}, stream.warmUp);
    v.number({"stream.duration_s", none, 1.0, 36000.0}, stream.duration);
    v.count({"stream.streams", 2, 10000}, stream.streams);
    v.number({"stream.contact.staticFriction", none, 0.0, 2.0}, stream.contact.staticFriction);
    v.number({"stream.contact.kineticFriction", none, 0.0, 2.0}, stream.contact.kineticFriction);
    v.number({"stream.contact.restitution", none, 0.0, 1.0}, stream.contact.restitution);

    v.number({"feeder.highestSetPoint", none, 0.01, 1.0}, s.feeder.highestSetPoint);
    v.number({"feeder.rampPerSecond", none, 0.05, 10.0}, s.feeder.rampPerSecond);
}

}  // namespace trapwright::study
