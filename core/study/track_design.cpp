#include "core/study/track_design.h"

#include "core/track/track_builder.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

/// What the settings say of the traps.
struct Traps {
    traps::TrapChain chain;
    traps::TrapParameters parameters;
};

base::Result<Traps> trapsOf(const TrackSettings& settings) {
    auto chain = traps::readTraps(settings.traps);
    if (!chain) return chain.error();
    Traps made{std::move(*chain), {}};
    made.parameters.sections = settings.crossSections;
    made.parameters.points = settings.pointsPerSection;
    made.parameters.minLength = settings.minSegmentLength;
    made.parameters.maxLength = settings.maxSegmentLength;
    made.parameters.width = settings.segmentWidth;
    made.parameters.height = settings.segmentHeight;
    made.parameters.pointEncoding = settings.encoding;
    if (const auto checked = traps::checkParameters(made.parameters); !checked) return checked.error();
    return made;
}

track::TrackParameters parametersOf(const TrackSettings& settings) {
    track::TrackParameters parameters;
    parameters.shape = settings.shape;
    parameters.width = settings.segmentWidth;
    parameters.height = settings.segmentHeight;
    parameters.leadInLength = settings.leadInLength;
    parameters.startFromLeadInEnd = settings.startFromLeadInEnd;
    parameters.leadOutSegments = settings.leadOutSegments;
    parameters.leadOutSegmentLength = settings.maxSegmentLength;
    parameters.baseThickness = settings.baseThickness;
    return parameters;
}

}  // namespace

search::DesignSpace designSpace(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    return traps ? traps::designSpace(traps->chain, traps->parameters) : search::DesignSpace();
}

double calcLongestTrack(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    const double trap = traps ? traps::calcLongest(traps->chain, traps->parameters) : 0.0;
    return settings.leadInLength + trap + settings.leadOutSegments * settings.maxSegmentLength;
}

search::SearchParameters searchParameters(const EvolutionSettings& settings) {
    search::SearchParameters parameters;
    parameters.seed = settings.seed;
    parameters.populationSize = settings.populationSize;
    parameters.genetic.tournamentSize = settings.tournamentSize;
    parameters.genetic.transition = {settings.staticMutation, settings.smoothingLimit,
                                     settings.mutationFloor};
    return parameters;
}

std::unique_ptr<search::Search> makeSearch(const Settings& settings) {
    return search::makeSearch(settings.evolution.search, designSpace(settings.track),
                              searchParameters(settings.evolution));
}

base::Result<track::Track> decodeTrack(const TrackSettings& settings, const search::Design& design) {
    const auto traps = trapsOf(settings);
    if (!traps) return traps.error();
    if (const auto checked = traps::designSpace(traps->chain, traps->parameters).check(design); !checked)
        return checked.error();
    return track::buildTrack(parametersOf(settings), traps::build(traps->chain, traps->parameters, design));
}

base::Result<track::Track> buildLayout(const TrackSettings& settings) {
    const auto traps = trapsOf(settings);
    if (!traps) return traps.error();
    std::vector<track::CrossSection> flat;
    for (const double x : traps::layOut(traps->chain, traps->parameters)) {
        track::CrossSection section{x, {}};
        for (int point = 0; point < settings.pointsPerSection; ++point)
            section.points.emplace_back(
                settings.segmentWidth * (point / (settings.pointsPerSection - 1.0) - 0.5),
                0.5 * settings.segmentHeight);
        flat.push_back(std::move(section));
    }
    return track::buildTrack(parametersOf(settings), flat);
}

}  // namespace trapwright::study
