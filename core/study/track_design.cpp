#include "core/study/track_design.h"

#include <algorithm>

#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

base::Result<traps::TrapChain> trapsOf(const TrackSettings& settings) {
    if (const auto checked = traps::checkParameters(settings); !checked) return checked.error();
    return traps::readTraps(settings.traps);
}

/// All numbers in the middle of their ranges.
std::vector<track::CrossSection> buildTypical(const traps::TrapChain& traps,
                                              const traps::TrapParameters& parameters) {
    const search::Design typical(traps::designSpace(traps, parameters).dimensions.size(), 0.5);
    return traps::build(traps, parameters, typical);
}

}  // namespace

search::DesignSpace designSpace(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    return traps ? traps::designSpace(*traps, settings) : search::DesignSpace();
}

double calcLongestTrack(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    const double trap = traps ? traps::calcLongest(*traps, settings) : 0.0;
    return settings.leadInLength + trap + settings.leadOutSegments * settings.maxSegmentLength;
}

double calcTypicalFall(const TrackSettings& settings) {
    constexpr double kHighEnough = 100.0;  // [m]
    const auto traps = trapsOf(settings);
    if (!traps) return 0.0;
    traps::TrapParameters high = settings;
    high.segmentHeight = kHighEnough;
    const std::vector<track::CrossSection> sections = buildTypical(*traps, high);
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
    return track::buildTrack(settings, traps::build(*traps, settings, design));
}

base::Result<track::Track> buildLayout(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    if (!traps) return traps.error();
    if (calcTypicalFall(settings) > 0.0) return track::buildTrack(settings, buildTypical(*traps, settings));
    std::vector<track::CrossSection> flat;
    for (const double x : traps::layOut(*traps, settings)) {
        track::CrossSection section{x, {}};
        for (int point = 0; point < settings.pointsPerSection; ++point)
            section.points.emplace_back(
                settings.segmentWidth * (point / (settings.pointsPerSection - 1.0) - 0.5),
                0.5 * settings.segmentHeight);
        flat.push_back(std::move(section));
    }
    return track::buildTrack(settings, flat);
}

}  // namespace trapwright::study
