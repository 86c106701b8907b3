#include "core/study/track_design.h"

#include "core/evolution/gray.h"
#include "core/track/encoding.h"
#include "core/track/smoothing.h"
#include "core/track/track_builder.h"

namespace trapwright::study {

namespace {

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

evolution::ChromosomeLayout chromosomeLayout(const TrackSettings& settings) {
    return {settings.crossSections * settings.pointsPerSection, settings.crossSections};
}

evolution::GenerationParameters generationParameters(const EvolutionSettings& settings) {
    evolution::GenerationParameters parameters;
    parameters.tournamentSize = settings.tournamentSize;
    parameters.transition = {settings.staticMutation, settings.smoothingLimit, settings.mutationFloor};
    return parameters;
}

evolution::SmoothPoints makeSmoothing(const TrackSettings& settings) {
    return [sections = settings.crossSections, points = settings.pointsPerSection](
               const evolution::Bits& gene, double probability, base::Random& random) {
        const std::vector<double> values = evolution::decodeGray(gene, evolution::kPointBits);
        return evolution::encodeGray(track::smoothSurface(values, sections, points, probability, random),
                                     evolution::kPointBits);
    };
}

base::Status checkGenes(const TrackSettings& settings, const evolution::Chromosome& chromosome) {
    const evolution::ChromosomeLayout layout = chromosomeLayout(settings);
    const auto pointBits = static_cast<std::size_t>(layout.points) * 2 * evolution::kPointBits;
    const auto lengthBits = static_cast<std::size_t>(layout.lengths) * evolution::kLengthBits;
    constexpr auto kStrategyLength = std::size_t{3} * evolution::kStrategyBits;
    if (chromosome.points.size() == pointBits && chromosome.lengths.size() == lengthBits &&
        chromosome.strategy.size() == kStrategyLength) {
        return base::success();
    }
    const auto listed = [](std::size_t points, std::size_t lengths, std::size_t strategy) {
        return std::to_string(points) + ", " + std::to_string(lengths) + " and " + std::to_string(strategy) +
               " bits";
    };
    return base::Error{
        "The genes of an individual have " +
        listed(chromosome.points.size(), chromosome.lengths.size(), chromosome.strategy.size()) +
        ", where these settings need " + listed(pointBits, lengthBits, kStrategyLength) +
        ". Use the settings that it was made with."};
}

base::Result<track::Track> decodeTrack(const TrackSettings& settings,
                                       const evolution::Chromosome& chromosome) {
    const track::Encoding encoding = encodingOf(settings);
    if (const auto checked = track::checkEncoding(encoding); !checked) return checked.error();
    if (const auto checked = checkGenes(settings, chromosome); !checked) return checked.error();
    const std::vector<double> points = evolution::decodeGray(chromosome.points, evolution::kPointBits);
    const std::vector<double> lengths = evolution::decodeGray(chromosome.lengths, evolution::kLengthBits);
    return track::buildTrack(parametersOf(settings), track::decodeTrap(encoding, points, lengths));
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
