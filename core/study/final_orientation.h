#pragma once

#include <span>
#include <vector>

#include "core/part/part.h"
#include "core/trial/outcome.h"

namespace trapwright::study {

/// The orientations in which parts passed the finish line, in the trials' order.
std::vector<base::Quaternion> finalOrientations(std::span<const trial::Outcome> outcomes);

/// Success (decisions.md#selection-and-success): finished within `tolerance` [rad] of the expected
/// orientation, modulo the part's symmetry.
bool isOriented(const trial::Outcome& outcome, const base::Quaternion& expected,
                const part::SymmetryGroup& symmetry, double tolerance);

/// How many of these succeeded.
int countOriented(std::span<const trial::Outcome> outcomes, const base::Quaternion& expected,
                  const part::SymmetryGroup& symmetry, double tolerance);

}  // namespace trapwright::study
