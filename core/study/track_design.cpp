#include "core/study/track_design.h"

#include "core/track/encoding.h"
#include "core/track/smoothing.h"
#include "core/track/track_builder.h"

namespace trapwright::study {

namespace {

constexpr int kBits = 10;  // of each number (paper, section 4.2.1)
constexpr double kMillimetres = 1e3;

track::Encoding encodingOf(const TrackSettings& settings) {
    track::Encoding encoding;
    encoding.sections = settings.crossSections;
    encoding.points = settings.pointsPerSection;
    encoding.minLength = settings.minSegmentLength;
    encoding.maxLength = settings.maxSegmentLength;
    encoding.width = settings.segmentWidth;
    encoding.height = settings.segmentHeight;
    encoding.pointEncoding = settings.encoding;
    return encoding;
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
    const track::Encoding encoding = encodingOf(settings);
    search::DesignSpace space;
    space.dimensions.reserve(encoding.pointValues() + encoding.lengthValues());
    for (int section = 0; section < encoding.sections; ++section) {
        for (int point = 0; point < encoding.points; ++point) {
            const std::string place =
                "section " + std::to_string(section + 1) + ", point " + std::to_string(point + 1);
            const track::Interval across = track::spanAcross(encoding, point);
            space.dimensions.push_back({place + ", y", "mm", kMillimetres * across.low,
                                        kMillimetres * (across.low + across.size), kBits, true});
            space.dimensions.push_back(
                {place + ", z", "mm", 0.0, kMillimetres * encoding.height, kBits, true});
        }
    }
    for (int section = 0; section < encoding.sections; ++section) {
        space.dimensions.push_back({"length of segment " + std::to_string(section + 1), "mm",
                                    kMillimetres * encoding.minLength, kMillimetres * encoding.maxLength,
                                    kBits});
    }
    space.smooth = [encoding](search::Design design, double probability, base::Random& random) {
        const std::vector<double> points =
            track::smoothSurface(std::span(design).first(encoding.pointValues()), encoding.sections,
                                 encoding.points, probability, random);
        std::copy(points.begin(), points.end(), design.begin());
        return design;
    };
    return space;
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
    const track::Encoding encoding = encodingOf(settings);
    if (const auto checked = track::checkEncoding(encoding); !checked) return checked.error();
    if (const auto checked = designSpace(settings).check(design); !checked) return checked.error();
    const std::span<const double> numbers(design);
    return track::buildTrack(parametersOf(settings),
                             track::decodeTrap(encoding, numbers.first(encoding.pointValues()),
                                               numbers.subspan(encoding.pointValues())));
}

base::Result<track::Track> buildLayout(const TrackSettings& settings) {
    const track::Encoding encoding = encodingOf(settings);
    if (const auto checked = track::checkEncoding(encoding); !checked) return checked.error();
    const double length = 0.5 * (encoding.minLength + encoding.maxLength);
    std::vector<track::CrossSection> trap;
    for (int section = 1; section <= encoding.sections; ++section) {
        track::CrossSection flat{section * length, {}};
        for (int point = 0; point < encoding.points; ++point)
            flat.points.emplace_back(encoding.width * (point / (encoding.points - 1.0) - 0.5),
                                     0.5 * encoding.height);
        trap.push_back(std::move(flat));
    }
    return track::buildTrack(parametersOf(settings), trap);
}

}  // namespace trapwright::study
