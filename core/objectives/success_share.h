#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// The share of all trials that finish in the wanted orientation (decisions.md#selection-and-success), with
/// the binomial's standard error; tables of people show the exact bounds beside it (core/stats/binomial).
Objective successShare();

/// The same of those that finish alone: what comes out of a track that throws back what lies wrong.
Objective correctShare();

}  // namespace trapwright::objectives
