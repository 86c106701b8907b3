#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// Where trials vary over an operating box: the success of those in the half of the box where it is least,
/// of all halves that one condition divides it into (friction above its middle, say). A quantile over strata
/// that are large enough to be counted: with 100 trials each has 50, so that a search can go by it, and a
/// track that fails in a corner fails in the halves that share it. Without a box, the success of all.
Objective worstHalf();

/// Where a share of the trials is in corners of the box: the success of those. Without any, nothing: what is
/// not known does not count, so that a study can begin with its corners later.
Objective corners();

}  // namespace trapwright::objectives
