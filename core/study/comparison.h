#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/stats/binomial.h"
#include "core/stats/samples.h"
#include "core/study/records.h"

/// Several studies side by side, as of one task with many seeds or settings.
namespace trapwright::study {

/// What is compared of a study.
struct ComparedStudy {
    std::string name;
    std::string part;
    std::uint64_t seed = 0;
    bool fallsAreForgiven = false;  // forgivesFalls
    std::vector<GenerationSummary> generations;
    std::optional<Individual> best{};          // winner (findBestWinner); none: nothing is learned
    std::optional<SelectionEntry> selected{};  // the first of the last selection
};

/// What counts of one while learning: success, or where falls are forgiven the share of those that finish.
/// None: not counted, or of nothing.
std::optional<stats::Count> bestRate(const ComparedStudy& study);
/// The same of its fresh trials.
std::optional<stats::Count> selectedRate(const ComparedStudy& study);

/// One of the two of all studies that have it; none: none has.
using RateOf = std::optional<stats::Count> (*)(const ComparedStudy& study);
std::optional<stats::Quartiles> spreadOf(std::span<const ComparedStudy> studies, RateOf rate);

/// A generation of all studies that have it.
struct GenerationSpread {
    int generation = 0;
    int studies = 0;
    stats::Quartiles fitness;                      // of their winners
    std::optional<stats::Quartiles> success{};     // of those winners of which it was counted
    std::optional<stats::Quartiles> topSuccess{};  // GenerationStatistics::topSuccess
};

/// From generation 0 to the last that any study has.
std::vector<GenerationSpread> spreadByGeneration(std::span<const ComparedStudy> studies);

}  // namespace trapwright::study
