#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// The share of all trials that finish in the wanted orientation (decisions.md#selection-and-success), with
/// the binomial's standard error; tables of people show the exact bounds beside it (core/stats/binomial).
Objective successShare();

}  // namespace trapwright::objectives
