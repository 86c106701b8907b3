#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/part/specimen.h"
#include "core/study/planning.h"
#include "core/study/pose_weights.h"
#include "core/study/settings.h"
#include "core/study/settings_fields.h"
#include "core/study/stream.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

std::string shown(double value, FileUnit unit) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinity";
    return fileText(value, unit);
}

std::string millimetres(double value) {
    return shown(std::round(value * 1e7) / 1e7, FileUnit::millimetre) + " mm";
}

/// Holds every field against its range.
class RangeCheck {
 public:
    std::vector<std::string> problems;

    void text(std::string_view key, const std::string& value) {
        // A study may be set up before a part is chosen; an engine is always needed.
        if (key == "simulation.engine" && value.empty())
            problems.push_back("simulation.engine is empty; name an engine, e.g. " +
                               SimulationSettings().engine + ".");
        if (key == "track.traps") {
            if (const auto chain = traps::readTraps(value); !chain)
                problems.push_back("track.traps is \"" + value + "\". " + chain.error().message);
        }
        if (key == "track.given") {
            if (const auto sections = readSections(value); !sections)
                problems.push_back("track.given cannot be read. " + sections.error().message);
        }
        if (key == "evolution.objectives") {
            if (const auto list = objectives::readObjectives(value); !list)
                problems.push_back("evolution.objectives is \"" + value + "\". " + list.error().message);
        }
        if (key == "part.droppedCounts" && !readCounts(value)) {
            problems.push_back("part.droppedCounts is \"" + value +
                               "\"; write how many drops ended in each stable pose, as in 129, 48, 23.");
        }
    }
    void number(const NumberField& field, double value) {
        // The bounds as SI values go through the same text as the value, so that a bound itself is allowed.
        const double low = *siValue(fileText(field.low, FileUnit::none), field.unit);
        const double high = *siValue(fileText(field.high, FileUnit::none), field.unit);
        if (value >= low && value <= high) return;  // false for NaN
        add(field.key, shown(value, field.unit), shown(field.low, FileUnit::none),
            shown(field.high, FileUnit::none));
    }
    void count(const CountField& field, int value) {
        if (value >= field.low && value <= field.high) return;
        add(field.key, std::to_string(value), std::to_string(field.low), std::to_string(field.high));
    }
    void rotation(std::string_view key, const std::optional<base::Quaternion>& value) {
        constexpr double kUnitLength = 1e-6;
        if (value && !(std::abs(value->norm() - 1.0) <= kUnitLength)) {
            problems.push_back(std::string(key) + " has the length " + shown(value->norm(), FileUnit::none) +
                               "; a rotation [w, x, y, z] must have the length 1.");
        }
    }
    void seed(std::string_view, std::uint64_t) {}
    void flag(std::string_view, bool) {}
    template <class Enum, std::size_t N>
    void choice(std::string_view, Enum, const Choices<Enum, N>&) {}

 private:
    void add(std::string_view key, const std::string& value, const std::string& low,
             const std::string& high) {
        problems.push_back(std::string(key) + " is " + value + "; it must be from " + low + " to " + high +
                           ".");
    }
};

std::vector<std::string> findSpiralProblems(const TrackSettings& track, double beside) {
    const track::Spiral& spiral = track.spiral;
    std::vector<std::string> problems;
    if (!(spiral.width > 0.0)) return problems;
    const std::string width = "track.spiralWidth_mm is " + shown(spiral.width, FileUnit::millimetre) + "; ";
    const double most = track.segmentWidth - 2.0 * track::kSpiralWallWidth;
    if (spiral.width > most) {
        problems.push_back(width +
                           "with its wall it must find room in track.segmentWidth_mm, so it must be " +
                           millimetres(most) + " at most.");
    }
    if (beside > 0.5 * spiral.width) {
        problems.push_back(width + "parts start up to " + millimetres(beside) +
                           " beside the middle, so it must be at least " + millimetres(2.0 * beside) +
                           ", or simulation.start.lateral_mm or box.startOffset_mm less.");
    }
    const auto least = static_cast<int>(track::kLeastSpiralPoints);
    if (track.pointsPerSection < least) {
        problems.push_back(
            fmt::format("track.pointsPerSection is {}; a spiral's ledge and wall (track.spiralWidth_mm) need "
                        "at least {}.",
                        track.pointsPerSection, least));
    }
    const double fall = 0.5 * spiral.width * std::tan(spiral.inclination);
    const double room = 0.5 * track.segmentHeight;
    if (spiral.wall - fall > room || fall > room) {
        problems.push_back(
            "track.spiralWall_mm is " + shown(spiral.wall, FileUnit::millimetre) +
            "; ledge and wall keep to track.segmentHeight_mm, in the middle of which the ledge "
            "lies, so it must be " +
            millimetres(std::max(0.0, room + fall)) + " at most, or that higher.");
    }
    return problems;
}

std::vector<std::string> findTrackProblems(const TrackSettings& track) {
    std::vector<std::string> problems;
    if (track.minSegmentLength > track.maxSegmentLength) {
        problems.push_back("track.minSegmentLength_mm is " +
                           shown(track.minSegmentLength, FileUnit::millimetre) +
                           "; it must not be more than track.maxSegmentLength_mm, which is " +
                           shown(track.maxSegmentLength, FileUnit::millimetre) + ".");
    }
    if (const auto chain = traps::readTraps(track.traps)) {
        // Of ledges beside a spiral it is told once, by the spiral.
        const auto needed = [&](const traps::TrapKind* kind) {
            return kind->isLedge && track.spiral.width > 0.0 ? 0 : kind->leastPoints;
        };
        const traps::TrapKind* most = std::ranges::max(*chain, {}, needed);
        if (track.pointsPerSection < needed(most))
            problems.push_back(fmt::format("track.pointsPerSection is {}; the trap {} needs at least {}.",
                                           track.pointsPerSection, most->key, most->leastPoints));
    }
    if (const auto given = readSections(track.given); given && !given->empty()) {
        const auto points = static_cast<int>(given->front().points.size());
        if (points != track.pointsPerSection)
            problems.push_back(fmt::format(
                "track.pointsPerSection is {}; the cross-sections of track.given have {} points, and all of "
                "a track must have as many.",
                track.pointsPerSection, points));
        const double half = 0.5 * track.segmentWidth;
        const auto isInside = [&](const base::Vec2& point) {
            constexpr double kRounding = 1e-9;
            return std::abs(point.x()) <= half + kRounding && point.y() >= -kRounding &&
                   point.y() <= track.segmentHeight + kRounding;
        };
        if (!std::ranges::all_of(*given, [&](const track::CrossSection& section) {
                return std::ranges::all_of(section.points, isInside);
            }))
            problems.push_back(
                fmt::format("track.given has points outside the box of the track's segments, {} wide "
                            "(track.segmentWidth_mm) and {} high (track.segmentHeight_mm).",
                            millimetres(track.segmentWidth), millimetres(track.segmentHeight)));
    }
    if (track.startFromLeadInEnd >= track.leadInLength) {
        problems.push_back(
            "track.startFromLeadInEnd_mm is " + shown(track.startFromLeadInEnd, FileUnit::millimetre) +
            "; the start must lie on the lead-in, so it must be less than track.leadInLength_mm, which is " +
            shown(track.leadInLength, FileUnit::millimetre) + ".");
    }
    if (track.shape.type == track::FeederType::bowl) {
        const double radius = track.shape.bowlRadius;
        if (track::widthWithWalls(track.segmentWidth, track.walls) / 2 >= radius) {
            problems.push_back("track.segmentWidth_mm is " + shown(track.segmentWidth, FileUnit::millimetre) +
                               "; on a bowl it must be less than twice track.bowlRadius_mm, which is " +
                               shown(radius, FileUnit::millimetre) +
                               (track.walls.any() ? ", and leave room for the walls." : "."));
        }
        const double longest = calcLongestTrack(track);
        const double turn = 2.0 * base::kPi * radius;
        if (longest >= turn) {
            problems.push_back("track.bowlRadius_mm is " + shown(radius, FileUnit::millimetre) +
                               ": one turn of that bowl is " + millimetres(turn) +
                               " and the longest track of these settings is " + millimetres(longest) +
                               ". Enlarge the radius or shorten the segments, the lead-in or the lead-out.");
        }
    }
    return problems;
}

}  // namespace

std::vector<std::string> findProblems(const Settings& settings) {
    RangeCheck ranges;
    visitFields(ranges, settings);
    std::vector<std::string> problems = std::move(ranges.problems);

    const std::vector<std::string> track = findTrackProblems(settings.track);
    problems.insert(problems.end(), track.begin(), track.end());
    const std::vector<std::string> spiral =
        findSpiralProblems(settings.track, settings.simulation.start.lateral + settings.box.startOffset);
    problems.insert(problems.end(), spiral.begin(), spiral.end());
    const std::vector<std::string> target = findTargetProblems(settings);
    problems.insert(problems.end(), target.begin(), target.end());
    const EvolutionSettings& evolution = settings.evolution;
    if (evolution.populationSize > 0 && evolution.tournamentSize > evolution.populationSize) {
        problems.push_back("evolution.tournamentSize is " + std::to_string(evolution.tournamentSize) +
                           "; it must not be more than evolution.populationSize, which is " +
                           std::to_string(evolution.populationSize) + ".");
    }
    constexpr double kLeastStep = 0.01e-3;
    if (evolution.learningStep > 0.0 && evolution.learningStep < kLeastStep) {
        problems.push_back("evolution.learningStep_ms is " +
                           shown(evolution.learningStep, FileUnit::millisecond) +
                           "; it must be 0 (chosen by the program) or from 0.01 to 1.");
    }
    constexpr double kLeastLimit = 0.1;
    const double limit = settings.simulation.termination.timeLimit;
    if (limit > 0.0 && limit < kLeastLimit) {
        problems.push_back("simulation.termination.timeLimit_s is " + shown(limit, FileUnit::none) +
                           "; it must be 0 (as long as the track needs) or from 0.1 to 600.");
    }
    if (evolution.racingTrials == 1) {
        problems.emplace_back(
            "evolution.racingTrials is 1; F_O compares two parts at least, so it must be 0 (no race) or at "
            "least 2.");
    }
    if (evolution.search != search::Method::exchange && evolution.racingShare < search::kTopShare) {
        problems.push_back("evolution.racingShare is " + shown(evolution.racingShare, FileUnit::none) +
                           "; it must be from 0.3 to 1, as what breeds and what is shown is the best 30 %, "
                           "unless evolution.search is exchange.");
    }
    if (isPlanned(evolution)) {
        if (const std::string problem = findPlanningProblem(settings.track); !problem.empty())
            problems.push_back("evolution.firstGeneration is planned. " + problem);
    }
    if (std::string problem = findTradeOffProblem(evolution); !problem.empty())
        problems.push_back(std::move(problem));
    // Learning sends streams at this inflow where throughput counts.
    if (evolution.populationSize > 0 && objectives::readObjectives(evolution.objectives) &&
        countStreamed(evolution) > 0) {
        const std::vector<std::string> stream = findStreamProblems(settings, settings.stream.partsPerMinute);
        problems.insert(problems.end(), stream.begin(), stream.end());
    }
    const trial::ContactParameters& contact = settings.simulation.contact;
    if (contact.kineticFriction > contact.staticFriction) {
        problems.push_back("simulation.contact.kineticFriction is " +
                           shown(contact.kineticFriction, FileUnit::none) +
                           "; it must not be more than simulation.contact.staticFriction, which is " +
                           shown(contact.staticFriction, FileUnit::none) + ".");
    }
    if (settings.track.segmentWidth > 0 &&
        settings.simulation.start.lateral > settings.track.segmentWidth / 2) {
        problems.push_back("simulation.start.lateral_mm is " +
                           shown(settings.simulation.start.lateral, FileUnit::millimetre) +
                           "; parts would start beside the track, so it must not be more than half of "
                           "track.segmentWidth_mm, which is " +
                           shown(settings.track.segmentWidth, FileUnit::millimetre) + ".");
    }
    return problems;
}

std::vector<std::string> findPartProblems(const Settings& settings, const part::Part& part) {
    std::vector<std::string> problems = findTargetPartProblems(settings.target, part);
    const TrackSettings& track = settings.track;
    const double radius = part.boundingRadius;
    const std::string size =
        "The part " + part.name + " reaches " + millimetres(radius) + " from its centre of mass";
    const double behind = track.leadInLength - track.startFromLeadInEnd;
    const double beside = settings.simulation.start.lateral + settings.box.startOffset;
    if (radius + beside > track.segmentWidth / 2) {
        const std::string units = ", or check the units of the part's file.";
        const std::string less = ", or box.startOffset_mm to less.";
        problems.push_back(size + " and starts up to " + millimetres(beside) +
                           " beside the middle: it is too large for a track " +
                           millimetres(track.segmentWidth) + " wide. Set track.segmentWidth_mm to at least " +
                           millimetres(2 * (radius + beside)) +
                           (settings.box.startOffset > 0.0 ? less : units));
    }
    const double thinnest = part::calcExtents(part).minCoeff();
    if (settings.box.sizeBelow > 0.5 * thinnest) {
        problems.push_back("box.sizeBelow_mm is " + shown(settings.box.sizeBelow, FileUnit::millimetre) +
                           ", and the part " + part.name + " is only " + millimetres(thinnest) +
                           " thick. Set it to half of that at most.");
    }
    if (radius > track.startFromLeadInEnd) {
        problems.push_back(size + ", which is more than track.startFromLeadInEnd_mm (" +
                           shown(track.startFromLeadInEnd, FileUnit::millimetre) +
                           "): it could start inside the trap. Set that to at least " + millimetres(radius) +
                           ".");
    }
    if (radius > behind) {
        problems.push_back(
            size + ", and only " + millimetres(behind) +
            " of lead-in lie behind the start point. Lengthen track.leadInLength_mm to at least " +
            millimetres(radius + track.startFromLeadInEnd) + ".");
    }
    return problems;
}

std::vector<std::string> findRecommendations(const Settings& settings) {
    // Parts drift back at first; with less room behind them some are lost at the track's beginning.
    constexpr double kRoomBehindStart = 60e-3;
    constexpr double kRounding = 1e-9;
    std::vector<std::string> recommendations;
    const double behind = settings.track.leadInLength - settings.track.startFromLeadInEnd;
    if (behind < kRoomBehindStart - kRounding) {
        recommendations.push_back(
            "Only " + millimetres(behind) +
            " of lead-in lie behind the start point (track.leadInLength_mm minus "
            "track.startFromLeadInEnd_mm); at least 60 mm are recommended, because parts drift back at "
            "first.");
    }
    const auto summed = objectives::readObjectives(settings.evolution.objectives);
    if (settings.target.isSet() && summed &&
        std::ranges::none_of(*summed, &objectives::Objective::usesTolerance)) {
        recommendations.push_back(
            "How parts shall end is told (target), but nothing in evolution.objectives looks at it, so that "
            "learning is content with any way; " +
            std::string(objectives::kWantedObjectives) + " is recommended.");
    }
    const EvolutionSettings& evolution = settings.evolution;
    const bool isVaried = evolution.conditions == TrialConditions::varied;
    const auto counts = [&summed](std::string_view key) {
        return summed && objectives::contains(*summed, key);
    };
    const bool countsCorners = counts(objectives::kCorners);
    if (evolution.cornerShare > 0.0 && !isVaried)
        recommendations.push_back(
            "evolution.cornerShare does nothing while evolution.conditions is nominal, because no trial "
            "varies over the operating box; varied is recommended, or a share of 0.");
    if (countsCorners && (evolution.cornerShare == 0.0 || !isVaried))
        recommendations.push_back(
            "evolution.objectives counts corners of the operating box, but no trial is in one, so that it is "
            "0; an evolution.cornerShare above 0 with varied evolution.conditions, or another objective, is "
            "recommended.");
    if (evolution.cornerShare > 0.0 && evolution.cornersFrom > 0 && isVaried) {
        if (evolution.cornersFrom >= evolution.generations)
            recommendations.push_back(fmt::format(
                "Trials are in corners of the operating box from generation {} on (evolution.cornersFrom), "
                "but learning ends with generation {}; more evolution.generations are recommended.",
                evolution.cornersFrom, evolution.generations - 1));
        if (summed && !countsCorners)
            recommendations.push_back(fmt::format(
                "From generation {} on (evolution.cornersFrom) trials are harder than before, but nothing in "
                "evolution.objectives counts that they are, so that tracks from before would be taken for "
                "the best; to add corners is recommended.",
                evolution.cornersFrom));
    }
    if (evolution.firstGeneration == search::ga::FirstGeneration::known &&
        evolution.search == search::Method::random)
        recommendations.push_back(
            "evolution.firstGeneration is known, but designs that are drawn at random begin with nothing; "
            "genetic or exchange is recommended as evolution.search.");
    if (!evolution.tradeOff.empty() && evolution.search != search::Method::genetic)
        recommendations.push_back(
            "evolution.tradeOff asks for many tracks, but only the genetic search keeps more than one; "
            "genetic is recommended as evolution.search.");
    if (evolution.search == search::Method::exchange && !evolution.commonRandomNumbers)
        recommendations.push_back(
            "evolution.search is exchange, whose designs differ by little; that they meet the same starts is "
            "recommended (evolution.commonRandomNumbers), or luck decides between them.");
    if ((counts(objectives::kSorting) || counts(objectives::kPurity)) &&
        settings.track.returns == trial::Returns::nowhere)
        recommendations.push_back(
            "evolution.objectives forgives parts that fall off where they come again, but track.returns is "
            "nowhere, so that all of them count as wrong; anywhere, or the side at which they fall back into "
            "the bowl, is recommended.");
    if (counts(objectives::kThroughput) && evolution.streamShare == 0.0)
        recommendations.push_back(
            "evolution.objectives counts throughput, but evolution.streamShare is 0, so that no streams of "
            "parts are sent; 0.1 is recommended.");
    const track::FeederShape& shape = settings.track.shape;
    if (shape.slope > 0.0 && findProblems(settings).empty() &&
        predictOnFeeder(settings.simulation, shape).speed <= 0.0)
        recommendations.push_back(
            fmt::format("A part that lies flat does not come up a slope of {:g} deg (track.slope_deg) with "
                        "this drive and "
                        "friction; a gentler slope, or a greater simulation.drive.halfStroke_mm or "
                        "simulation.drive.angle_deg, is recommended.",
                        shape.slope / base::kDegree));
    const double fall = calcTypicalFall(settings.track);
    if (fall > 0.5 * settings.track.segmentHeight && settings.track.given.empty()) {
        recommendations.push_back(
            "Traps that fall (track.traps) fall by " + millimetres(std::ceil(1e3 * fall) * 1e-3) +
            " on a typical track, but only half of track.segmentHeight_mm lies below the lead-in, and what "
            "would fall deeper is cut off; at least " +
            millimetres(std::ceil(2e3 * fall) * 1e-3) + " are recommended.");
    }
    return recommendations;
}

}  // namespace trapwright::study
