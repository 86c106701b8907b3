#pragma once

#include <optional>
#include <span>

#include "core/study/records.h"

namespace trapwright::study {

/// The generation since which learning has gained nothing that is more than noise; none while it gains, or
/// there are too few generations to tell (fewer than 16). Compared are means over eight generations of what
/// learning maximises, the top 30 %'s mean fitness: the last eight with all eight before them. A gain is more
/// than two and a half of its standard errors, and more than 1 % of all that was gained since the start.
std::optional<int> findStandstill(std::span<const GenerationSummary> summaries);

}  // namespace trapwright::study
