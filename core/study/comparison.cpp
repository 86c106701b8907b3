#include "core/study/comparison.h"

#include <algorithm>
#include <cstddef>

namespace trapwright::study {

namespace {

std::optional<stats::Quartiles> quartilesOf(const std::vector<double>& values) {
    if (values.empty()) return std::nullopt;
    return stats::calcQuartiles(values);
}

}  // namespace

std::optional<stats::Count> bestRate(const ComparedStudy& study) {
    if (!study.best) return std::nullopt;
    const std::optional<stats::Count> rate =
        study.fallsAreForgiven ? study.best->record.correct() : study.best->record.success();
    return rate && rate->trials > 0 ? rate : std::nullopt;
}

std::optional<stats::Count> selectedRate(const ComparedStudy& study) {
    if (!study.selected) return std::nullopt;
    const int of = study.fallsAreForgiven ? study.selected->finished : study.selected->trials;
    if (of == 0) return std::nullopt;
    return stats::Count{study.selected->oriented, of};
}

std::optional<stats::Quartiles> spreadOf(std::span<const ComparedStudy> studies, RateOf rate) {
    std::vector<double> shares;
    for (const ComparedStudy& study : studies)
        if (const std::optional<stats::Count> count = rate(study)) shares.push_back(count->share());
    return quartilesOf(shares);
}

std::vector<GenerationSpread> spreadByGeneration(std::span<const ComparedStudy> studies) {
    std::size_t count = 0;
    for (const ComparedStudy& study : studies)
        count = std::max(count, study.generations.size());
    std::vector<GenerationSpread> spreads;
    spreads.reserve(count);
    for (std::size_t g = 0; g < count; ++g) {
        std::vector<double> fitness;
        std::vector<double> success;
        std::vector<double> topSuccess;
        for (const ComparedStudy& study : studies) {
            if (g >= study.generations.size()) continue;
            const GenerationStatistics& statistics = study.generations[g].statistics;
            fitness.push_back(statistics.best.total);
            if (statistics.success && statistics.success->trials > 0)
                success.push_back(statistics.success->share());
            if (statistics.topSuccess) topSuccess.push_back(*statistics.topSuccess);
        }
        spreads.push_back({static_cast<int>(g), static_cast<int>(fitness.size()),
                           stats::calcQuartiles(fitness), quartilesOf(success), quartilesOf(topSuccess)});
    }
    return spreads;
}

}  // namespace trapwright::study
