#include "core/study/presets.h"

#include <algorithm>
#include <array>

#include "core/base/resources.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/traps/groove.h"

namespace trapwright::study {

namespace {

constexpr std::array<std::string_view, 2> kPresetNames = {"cuboid", "cone"};

// The paper determined friction and restitution by experiment and does not print them (section 6).
constexpr std::string_view kCuboidPair = "abs-on-printed-plastic";
constexpr std::string_view kConePair = "brass-on-printed-plastic";

constexpr std::string_view kUsualSurface = "printed plastic";

/// In whole half millimetres, one at least, as a quotient, which files write without a tail of decimals. [m]
double roundLength(double length) {
    constexpr double kHalfMillimetres = 2000.0;  // in a metre
    return std::max(1.0, std::round(length * kHalfMillimetres)) / kHalfMillimetres;
}

/// What was right for a part of this bounding radius [m].
double scaleLength(double length, double radius, const part::Part& part) {
    return roundLength(length * part.boundingRadius / radius);
}

/// Over the operating box brackets of a chain of gaps and ledges that were given up after 0.6 s without
/// progress were 13 of 100, after 1.5 s, as in a selection, 5; that takes a plan 4 % longer.
void waitAsLongAsSimulated(Settings& settings) {
    settings.evolution.learningStuckTime =
        std::max(settings.evolution.learningStuckTime, settings.simulation.termination.stuckTime);
}

/// Each generation one trap or two exchanged in the best chain, in a race that the two best run to its end.
void exchangeTraps(EvolutionSettings& evolution) {
    evolution.search = search::Method::exchange;
    evolution.populationSize = 32;
    evolution.tournamentSize = 6;
    evolution.generations = 20;
    evolution.racingShare = 2.0 / 32.0;
    evolution.commonRandomNumbers = true;
}

/// A plan, whose best chain then has ledges exchanged.
void planLedges(EvolutionSettings& evolution) {
    evolution.firstGeneration = search::ga::FirstGeneration::planned;
    exchangeTraps(evolution);
    // Most parts are thrown out, so that the few that are right count by how much fewer they become; and of
    // those that arrive not one in a hundred may be wrong.
    evolution.objectives = "F_C, purity, yield";
    evolution.trialsPerEvaluation = 1920;
    evolution.racingTrials = 60;
}

constexpr double kInclinationOfLedges = 10.0 * base::kDegree;

/// How high the wall of ledges is behind a groove so wide that it suits the part. [m]
double wallOf(double width) {
    return roundLength(width / 6.0);
}

/// Whether parts lie in a groove at its end, as behind a chain of gaps (core/traps/groove.h).
bool endsInGroove(const track::Track& track) {
    constexpr double kRounding = 1e-6;  // [m]
    const auto& points = track.sections[static_cast<std::size_t>(track.lastTrapSection)].points;
    const auto lowest =
        std::ranges::min_element(points, {}, [](const base::Vec2& point) { return point.y(); });
    if (lowest == points.begin() || lowest + 1 == points.end()) return false;
    const double wall = std::tan(traps::kRestingWall);
    return std::ranges::all_of(points, [&](const base::Vec2& point) {
        const double height = wall * std::abs(point.x() - lowest->x());
        return std::abs(point.y() - lowest->y() - height) < kRounding;
    });
}

/// Whether parts lie beside a wall at the track's end, as behind a chain of ledges (core/traps/ledge.h); the
/// wall's height then, else 0. [m]
double wallAtEnd(const track::Track& track) {
    constexpr double kRounding = 1e-6;  // [m]
    constexpr std::size_t kFewest = 4;  // two on the ledge, two on the wall
    const auto& points = track.sections[static_cast<std::size_t>(track.lastTrapSection)].points;
    if (points.size() < kFewest) return 0.0;
    const auto foot = points.end() - 3;
    const double wall = (foot + 1)->y() - foot->y();
    const bool isUpright =
        (foot + 1)->x() - foot->x() < wall && std::abs((foot + 2)->y() - (foot + 1)->y()) < kRounding;
    const bool leans = std::all_of(points.begin(), foot, [&](const base::Vec2& point) {
        const double height = std::tan(kInclinationOfLedges) * (foot->x() - point.x());
        return std::abs(point.y() - foot->y() - height) < kRounding;
    });
    return isUpright && leans ? std::round(1e9 * wall) / 1e9 : 0.0;  // without a difference's rounding
}

}  // namespace

std::span<const std::string_view> presetNames() {
    return kPresetNames;
}

base::Result<Settings> presetSettings(const std::string& name) {
    if (name != "cuboid" && name != "cone") {
        return base::Error{"There is no preset named \"" + name + "\". Choose \"cuboid\" or \"cone\"."};
    }
    // Table 1; what the columns share.
    Settings settings;
    settings.part.file = name;
    settings.part.units = "mm";
    settings.track.crossSections = 5;
    settings.track.pointsPerSection = 8;
    settings.track.maxSegmentLength = 36e-3;
    settings.track.segmentWidth = 60e-3;
    settings.track.segmentHeight = 30e-3;
    settings.track.shape.bowlRadius = 175e-3;
    settings.evolution.trialsPerEvaluation = 100;
    settings.evolution.populationSize = 100;
    settings.evolution.tournamentSize = 6;

    // Section 6: 50 Hz at 12 degrees. The half-stroke is not printed (decisions.md#drive).
    settings.simulation.drive.frequency = 50.0;
    settings.simulation.drive.angle = 12.0 * base::kDegree;
    settings.simulation.drive.halfStroke = 0.8e-3;

    // Table 1; where the columns differ.
    const bool cuboid = name == "cuboid";
    settings.track.minSegmentLength = cuboid ? 15e-3 : 22e-3;
    settings.evolution.staticMutation = cuboid ? 0.002 : 0.001;
    const auto pair = part::requirePair(part::readMaterials(), cuboid ? kCuboidPair : kConePair);
    if (!pair) return pair.error();
    usePair(settings, *pair);
    settings.box = {};  // what shipped tracks are held to is wider than the pair's spreads
    return settings;
}

Settings paperMode(Settings settings) {
    settings.track.traps = "free-form";
    settings.track.given.clear();
    settings.track.returns = trial::Returns::nowhere;
    settings.track.encoding = PointEncoding::free;
    settings.track.shape.type = track::FeederType::bowl;
    settings.track.shape.bowlRadius = 175e-3;
    settings.evolution.search = search::Method::genetic;
    settings.evolution.objectives = objectives::kPaperObjectives;
    settings.evolution.tradeOff.clear();
    settings.evolution.orientationDistance = trial::OrientationDistance::plain;
    settings.evolution.smoothingLimit = 1.0;
    settings.evolution.mutationFloor = 0.0;
    settings.evolution.strategyScope = search::ga::StrategyScope::individual;
    settings.evolution.firstGeneration = search::ga::FirstGeneration::random;
    settings.evolution.simulateOverlapping = true;
    settings.evolution.racingTrials = 0;
    settings.evolution.commonRandomNumbers = false;
    settings.evolution.learningStuckTime = settings.simulation.termination.stuckTime;
    settings.evolution.learningStep = 0.2e-3;  // engines' own
    settings.evolution.conditions = TrialConditions::nominal;
    settings.validation.conditions = TrialConditions::nominal;
    settings.simulation.engine = "simbody";  // a setting like the others: the one that judges every trial
    return settings;
}

Settings turningMode(Settings settings, const part::Part& part) {
    const auto inProportion = [&](double ofCuboid) { return scaleLength(ofCuboid, 7.5e-3, part); };
    settings.track.traps = "free-form";
    settings.track.given.clear();
    settings.track.crossSections = 5;
    settings.track.pointsPerSection = 8;
    settings.track.minSegmentLength = inProportion(15e-3);
    settings.track.maxSegmentLength = inProportion(36e-3);
    settings.track.segmentWidth = inProportion(60e-3);
    settings.track.segmentHeight = inProportion(30e-3);
    settings.evolution.search = search::Method::genetic;
    settings.evolution.objectives = objectives::kPaperObjectives;
    settings.evolution.tradeOff.clear();
    settings.evolution.firstGeneration = search::ga::FirstGeneration::graded;
    settings.evolution.racingTrials = 0;
    settings.evolution.learningStuckTime = EvolutionSettings().learningStuckTime;
    return settings;
}

Settings sortingMode(Settings settings, const part::Part& part) {
    const auto inProportion = [&](double ofWedge) { return scaleLength(ofWedge, 8.9e-3, part); };
    settings.track.traps = "groove, groove, 8 x gap";
    settings.track.given.clear();
    if (settings.track.returns == trial::Returns::nowhere) settings.track.returns = trial::Returns::anywhere;
    settings.track.pointsPerSection = 9;
    settings.track.minSegmentLength = inProportion(5e-3);
    settings.track.maxSegmentLength = inProportion(30e-3);
    settings.track.segmentWidth = inProportion(60e-3);
    settings.track.segmentHeight = inProportion(200e-3);
    settings.track.startFromLeadInEnd = std::max(settings.track.startFromLeadInEnd, inProportion(10e-3));
    settings.track.leadInLength =
        std::max(settings.track.leadInLength, settings.track.startFromLeadInEnd + inProportion(60e-3));
    // Along a chain of traps, of half a metre and more, what is slow is not stuck, nor what waits at one of
    // them while the drive is weak. [s]
    constexpr double kLongest = 30.0;
    settings.simulation.termination.timeLimit = std::max(settings.simulation.termination.timeLimit, kLongest);
    waitAsLongAsSimulated(settings);
    settings.evolution.search = search::Method::genetic;
    settings.evolution.objectives = objectives::kSorting;
    settings.evolution.tradeOff.clear();
    settings.evolution.firstGeneration = search::ga::FirstGeneration::planned;
    settings.evolution.plannedTraps = 3000;
    // Hardly any generation gets further than the plan: what follows are a few chains like its best ones.
    settings.evolution.populationSize = 24;
    settings.evolution.trialsPerEvaluation = 100;
    settings.evolution.racingTrials = 20;
    settings.evolution.tournamentSize = 6;
    settings.evolution.generations = 2;
    return settings;
}

Settings slotMode(Settings settings, const part::Part& part) {
    settings = sortingMode(std::move(settings), part);
    settings.track.traps = "groove, groove, 3 x slot";
    // Nothing is to be thrown out. Without walls one screw in twenty rolls off the lead-in, and beside walls
    // that are far apart it is stuck where the groove begins, as that rises there. So the track is narrow.
    settings.track.segmentWidth = scaleLength(30e-3, 8.9e-3, part);
    const double wall = scaleLength(6e-3, 8.9e-3, part);
    settings.track.walls = {std::max(settings.track.walls.inner, wall),
                            std::max(settings.track.walls.outer, wall)};
    settings.evolution.plannedTraps = 600;
    return settings;
}

Settings railsMode(Settings settings, const part::Part& part) {
    settings = slotMode(std::move(settings), part);
    settings.track.traps = kRailsTraps;
    settings.track.segmentHeight = scaleLength(120e-3, 8.9e-3, part);  // three traps do not fall far
    // The longer rails are narrow, the fewer leave them wrong of parts that follow each other.
    settings.track.leadOutSegments = 3;
    if (const TargetSettings hanging = findHangingTarget(part);
        hanging.isSet() && !wantsHanging(settings, part))
        settings.target = hanging;
    settings.evolution.firstGeneration = search::ga::FirstGeneration::graded;
    settings.evolution.populationSize = 60;
    settings.evolution.generations = 6;
    return settings;
}

Settings ledgeMode(Settings settings, const part::Part& part) {
    const auto inProportion = [&](double ofBracket) { return scaleLength(ofBracket, 9.4e-3, part); };
    settings = sortingMode(std::move(settings), part);
    TrackSettings& track = settings.track;
    track.traps += ", 6 x ledge";
    track.spiral = {0.0, wallOf(track.segmentWidth), kInclinationOfLedges};  // of the ledges; no lead-in
    track.segmentHeight = inProportion(280e-3);
    planLedges(settings.evolution);
    settings.evolution.plannedTraps = 3000;
    return settings;
}

base::Result<Settings> rejectingMode(Settings settings, const track::Track& track) {
    // Along a wall what lies one way passes; along the spiral's, that of ledges that are there, or one that
    // begins where a groove ends.
    const bool isSpiral = track::spiralOf(track).width > 0.0;
    const double wall = isSpiral ? 0.0 : wallAtEnd(track);
    const bool isLedge = wall > 0.0;
    const bool isGroove = !isSpiral && !isLedge && endsInGroove(track);
    settings.track.traps = isSpiral || isLedge ? "4 x ledge" : isGroove ? "6 x ledge" : "notched";
    auto behind = placeBehind(track, settings.track);
    if (!behind) return behind.error();
    settings.track = *std::move(behind);
    if (settings.track.returns == trial::Returns::nowhere) settings.track.returns = trial::Returns::anywhere;
    EvolutionSettings& evolution = settings.evolution;
    evolution.search = search::Method::genetic;
    evolution.objectives = "F_C, purity, success";
    evolution.tradeOff.clear();
    evolution.cornerShare = 0.0;
    evolution.cornersFrom = 0;
    if (isSpiral || isLedge || isGroove) {
        planLedges(evolution);
        waitAsLongAsSimulated(settings);
        evolution.plannedTraps = isGroove ? 1500 : isLedge ? 1000 : 300;
        if (isSpiral) return settings;
        evolution.objectives = "F_C, purity, success";  // most parts come the right way
        settings.track.spiral = {0.0, isLedge ? wall : wallOf(track.width), kInclinationOfLedges};
        return settings;
    }
    evolution.firstGeneration = search::ga::FirstGeneration::graded;
    // Few numbers are looked for, of a hundred bits at most, and one wrong part in a hundred is to be seen.
    evolution.staticMutation = 0.02;
    evolution.populationSize = 100;
    evolution.trialsPerEvaluation = 300;
    evolution.racingTrials = 30;
    evolution.racingShare = EvolutionSettings{}.racingShare;  // not that of exchanges
    evolution.tournamentSize = std::min(evolution.tournamentSize, evolution.populationSize);
    evolution.generations = 30;
    return settings;
}

trial::ContactParameters contactOf(const part::MaterialPair& pair) {
    return {pair.staticFriction.value, pair.kineticFriction.value, pair.restitution.value};
}

void useContact(Settings& settings, const part::MaterialPair& pair) {
    settings.simulation.contact = contactOf(pair);
    settings.simulation.surface = pair.surface;
    // Both coefficients vary together: by the more uncertain one.
    settings.box.friction = std::max(pair.staticFriction.spread, pair.kineticFriction.spread);
    settings.box.restitution = pair.restitution.spread;
}

void usePair(Settings& settings, const part::MaterialPair& pair) {
    useContact(settings, pair);
    settings.part.density = pair.density.value;
    settings.part.material = pair.material;
}

const part::Material* findUsedMaterial(const part::MaterialLibrary& library, const PartSettings& part) {
    if (!part.material.empty()) {
        const part::Material* named = part::findMaterial(library, part.material);
        return named != nullptr && named->density.value == part.density ? named : nullptr;
    }
    const auto found =
        std::find_if(library.materials.begin(), library.materials.end(),
                     [&](const part::Material& one) { return one.density.value == part.density; });
    return found == library.materials.end() ? nullptr : &*found;
}

const part::MaterialPair* findUsedPair(const part::MaterialLibrary& library, const Settings& settings) {
    const part::Material* material = findUsedMaterial(library, settings.part);
    if (material == nullptr) return nullptr;
    const auto fits = [&](const part::MaterialPair& pair) {
        const trial::ContactParameters& contact = settings.simulation.contact;
        return pair.material == material->name && pair.staticFriction.value == contact.staticFriction &&
               pair.kineticFriction.value == contact.kineticFriction &&
               pair.restitution.value == contact.restitution;
    };
    // A study that does not tell its surface was made with the usual one.
    const std::string_view surface =
        settings.simulation.surface.empty() ? kUsualSurface : settings.simulation.surface;
    if (const auto* pair = part::findPair(library, material->name, surface); pair != nullptr && fits(*pair))
        return pair;
    const auto found = std::find_if(library.pairs.begin(), library.pairs.end(), fits);
    return found == library.pairs.end() ? nullptr : &*found;
}

const part::MaterialPair* suggestPair(const part::MaterialLibrary& library, std::string_view material,
                                      const part::MaterialPair* used) {
    if (used != nullptr) {
        if (const auto* pair = part::findPair(library, material, used->surface)) return pair;
    }
    if (const auto* pair = part::findPair(library, material, kUsualSurface)) return pair;
    const auto found =
        std::find_if(library.pairs.begin(), library.pairs.end(),
                     [&](const part::MaterialPair& pair) { return pair.material == material; });
    return found == library.pairs.end() ? nullptr : &*found;
}

std::filesystem::path findResourceTrack(std::string_view file) {
    return base::findResource(std::filesystem::path("tracks") / file);
}

}  // namespace trapwright::study
