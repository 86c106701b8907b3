#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// Minus how much of a track cannot be printed (track::findPrintFlaws) with the limits that a printer has
/// unless it is told otherwise: in mm^2, so that what is wrong weighs about as much as segments do in F_D
/// (decisions.md#printability).
Objective printability();

}  // namespace trapwright::objectives
