#pragma once

#include <QString>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/study/records.h"

namespace trapwright::charts {

/// What the charts show of one study, or of several as one: then each value is the median of those that have
/// it, between their quartiles.
struct StudyCurves {
    QString name;                                     // of the study, for the legend of a comparison
    std::vector<study::GenerationSummary> summaries;  // in their order
    std::vector<study::CheckRecord> checks;           // in any order; none if one engine does everything
    std::vector<double> trialsPerSecond;              // slot i for summaries[i]; NaN or missing: not known
    std::vector<objectives::Score> attainable{};      // objectives::listAttainable of the part
    std::vector<std::string> summed{};                // keys of the objectives in F; none: not known
    std::optional<int> cornersFrom{};                 // the generation whose trials are harder from there on
    std::vector<std::vector<study::GenerationSummary>> members{};  // of several: instead of all but the name

    /// One more generation.
    void append(const study::GenerationSummary& summary, double rate) {
        trialsPerSecond.resize(summaries.size(), std::numeric_limits<double>::quiet_NaN());
        trialsPerSecond.push_back(rate);
        summaries.push_back(summary);
    }
};

}  // namespace trapwright::charts
