#include "core/study/track_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/spelling.h"
#include "core/study/number_text.h"

namespace trapwright::study {

namespace {

base::Result<traps::TrapChain> trapsOf(const TrackSettings& settings) {
    if (const auto checked = traps::checkParameters(settings); !checked) return checked.error();
    return traps::readTraps(settings.traps);
}

/// What comes before the traps of a search, and how long it is.
struct Given {
    std::vector<track::CrossSection> sections;

    /// x of its end. [m]
    [[nodiscard]] double length() const { return sections.empty() ? 0.0 : sections.back().x; }
    /// The last section of what is before the traps.
    [[nodiscard]] track::CrossSection last(const TrackSettings& settings) const {
        return sections.empty()
                   ? track::makeLeadIn(settings, 0.0, static_cast<std::size_t>(settings.pointsPerSection))
                   : sections.back();
    }
    /// With these behind it.
    [[nodiscard]] std::vector<track::CrossSection> followedBy(std::vector<track::CrossSection> behind) const {
        std::vector<track::CrossSection> all = sections;
        for (track::CrossSection& section : behind) {
            section.x += length();
            all.push_back(std::move(section));
        }
        return all;
    }
};

Given givenOf(const TrackSettings& settings) {
    auto sections = readSections(settings.given);
    return sections ? Given{std::move(sections).value()} : Given();
}

/// All numbers in the middle of their ranges.
std::vector<track::CrossSection> buildTypical(const traps::TrapChain& traps,
                                              const traps::TrapParameters& parameters,
                                              const track::CrossSection& before) {
    const search::Design typical(traps::designSpace(traps, parameters).dimensions.size(), 0.5);
    return traps::build(traps, parameters, typical, before);
}

base::Error noSection(std::size_t number, const std::string& what) {
    return {
        fmt::format("Cross-section {} {}; write each as \"x: y z, y z\" with semicolons between them, in mm.",
                    number + 1, what)};
}

/// Two numbers with a blank between them. [m]
std::optional<base::Vec2> readPoint(std::string_view text) {
    const std::size_t blank = text.find(' ');
    if (blank == std::string_view::npos) return std::nullopt;
    const auto y = siValue(text.substr(0, blank), FileUnit::millimetre);
    const auto z = siValue(text.substr(blank + 1), FileUnit::millimetre);
    if (!y || !z) return std::nullopt;
    return base::Vec2(*y, *z);
}

std::string_view withoutBlanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

search::DesignSpace designSpace(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    return traps ? traps::designSpace(*traps, settings) : search::DesignSpace();
}

std::string describeSections(std::span<const track::CrossSection> sections) {
    std::string text;
    for (const track::CrossSection& section : sections) {
        text += (text.empty() ? "" : "; ") + fileText(section.x, FileUnit::millimetre) + ":";
        for (std::size_t i = 0; i < section.points.size(); ++i) {
            text += i == 0 ? " " : ", ";
            text += fileText(section.points[i].x(), FileUnit::millimetre) + " " +
                    fileText(section.points[i].y(), FileUnit::millimetre);
        }
    }
    return text;
}

base::Result<std::vector<track::CrossSection>> readSections(const std::string& text) {
    std::vector<track::CrossSection> sections;
    if (withoutBlanks(text).empty()) return sections;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, ';');) {
        const std::size_t number = sections.size();
        const std::size_t colon = word.find(':');
        if (colon == std::string::npos) return noSection(number, "has no colon behind its x");
        const auto x = siValue(withoutBlanks(std::string_view(word).substr(0, colon)), FileUnit::millimetre);
        if (!x) return noSection(number, "has no number as its x");
        if (*x <= (sections.empty() ? 0.0 : sections.back().x))
            return noSection(number, "is not behind what comes before it");
        track::CrossSection& section = sections.emplace_back(track::CrossSection{*x, {}});
        for (const std::string_view name : base::splitNames(std::string_view(word).substr(colon + 1))) {
            const auto point = readPoint(name);
            if (!point) return noSection(number, fmt::format("has \"{}\" where a point should be", name));
            section.points.push_back(*point);
        }
        if (section.points.size() != sections.front().points.size())
            return noSection(number, "has not as many points as the first");
    }
    return sections;
}

base::Result<TrackSettings> placeBehind(const track::Track& track, TrackSettings settings) {
    std::vector<track::CrossSection> given(track.sections.begin() + track.firstTrapSection + 1,
                                           track.sections.begin() + track.lastTrapSection + 1);
    if (given.empty()) return base::Error{"The track has no trap that others could follow."};
    const double begin = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
    // What people read, without the rounding of a difference.
    const auto inNanometres = [](double length) { return std::round(1e9 * length) / 1e9; };
    const auto inNanodegrees = [](double angle) {
        return std::round(1e9 * (angle / base::kDegree)) / 1e9 * base::kDegree;
    };
    // In whole millimetres. Ledges fall by steps, and their gaps have no floor.
    const auto traps = trapsOf(settings);
    const bool hasLedge = traps && std::ranges::any_of(*traps, &traps::TrapKind::isLedge);
    const double fall = calcTypicalFall(settings) + (hasLedge ? settings.maxSegmentLength : 0.0);
    const double raised = std::ceil(1e3 * fall - 1e-6) * 1e-3;
    for (track::CrossSection& section : given) {
        section.x = inNanometres(section.x - begin);
        for (base::Vec2& point : section.points)
            point.y() += raised;
        if (section.points.size() != given.front().points.size())
            return base::Error{"The cross-sections of the track do not have equally many points."};
    }
    settings.given = describeSections(given);
    settings.shape = track.shape;
    settings.pointsPerSection = static_cast<int>(given.front().points.size());
    settings.segmentWidth = track.width;
    settings.segmentHeight = track.height + 2.0 * raised;
    settings.baseThickness = track.baseThickness;
    settings.walls = track.walls;
    settings.leadInLength = inNanometres(begin - track.begin());
    settings.startFromLeadInEnd = inNanometres(begin - track.start);
    const track::Spiral spiral = track::spiralOf(track);
    settings.spiral = {inNanometres(spiral.width), inNanometres(spiral.wall),
                       inNanodegrees(spiral.inclination)};
    const track::Chute chute = track::chuteOf(track);
    settings.chute = {inNanometres(chute.length), inNanodegrees(chute.angle)};
    return settings;
}

double calcLongestTrack(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    const double trap = traps ? traps::calcLongest(*traps, settings) : 0.0;
    return settings.leadInLength + givenOf(settings).length() + trap +
           settings.leadOutSegments * settings.maxSegmentLength + settings.chute.length;
}

double calcTypicalFall(const TrackSettings& settings) {
    constexpr double kHighEnough = 100.0;  // [m]
    const auto traps = trapsOf(settings);
    if (!traps) return 0.0;
    traps::TrapParameters high = settings;
    high.segmentHeight = kHighEnough;
    const std::vector<track::CrossSection> sections =
        buildTypical(*traps, high, traps::levelSection(high, 0.5 * kHighEnough));
    return std::max(0.0, 0.5 * kHighEnough - traps::findLowest(sections.back()));
}

search::SearchParameters searchParameters(const EvolutionSettings& settings) {
    search::SearchParameters parameters;
    parameters.seed = settings.seed;
    parameters.populationSize = settings.populationSize;
    parameters.genetic.tournamentSize = settings.tournamentSize;
    parameters.genetic.transition = {settings.staticMutation, settings.smoothingLimit,
                                     settings.mutationFloor};
    parameters.genetic.first = settings.firstGeneration;
    parameters.genetic.scope = settings.strategyScope;
    return parameters;
}

const search::MethodInfo& describeSearch(const EvolutionSettings& settings) {
    return search::describeMethod(settings.search, settings.strategyScope);
}

std::unique_ptr<search::Search> makeSearch(const Settings& settings) {
    return search::makeSearch(settings.evolution.search, designSpace(settings.track),
                              searchParameters(settings.evolution));
}

base::Result<track::Track> decodeTrack(const TrackSettings& settings, const search::Design& design) {
    const auto traps = trapsOf(settings);
    if (!traps) return traps.error();
    if (const auto checked = traps::designSpace(*traps, settings).check(design); !checked)
        return checked.error();
    return decodeChain(settings, *traps, design, settings);
}

base::Result<track::Track> decodeChain(const TrackSettings& settings, const traps::TrapChain& traps,
                                       const search::Design& design, const TrackSettings& around) {
    const track::CrossSection before = givenOf(settings).last(around);
    return track::buildTrack(around,
                             givenOf(around).followedBy(traps::build(traps, settings, design, before)));
}

base::Result<track::Track> buildLayout(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    if (!traps) return traps.error();
    const Given given = givenOf(settings);
    // Ledges have their form before anything is learned.
    const bool hasLedge = std::ranges::any_of(*traps, &traps::TrapKind::isLedge);
    if (hasLedge || calcTypicalFall(settings) > 0.0)
        return track::buildTrack(settings,
                                 given.followedBy(buildTypical(*traps, settings, given.last(settings))));
    std::vector<track::CrossSection> flat;
    for (const double x : traps::layOut(*traps, settings)) {
        flat.push_back(traps::levelSection(settings, 0.5 * settings.segmentHeight));
        flat.back().x = x;
    }
    return track::buildTrack(settings, given.followedBy(std::move(flat)));
}

}  // namespace trapwright::study
