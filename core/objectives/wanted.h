#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// F_W: the share of all trials that end as it is wanted, with the binomial's standard error. Of success it
/// is the part that there is only where something is wanted: a search that sums it up is led to one way of
/// ending, where F_O is content with any (decisions.md#wanted-orientation).
Objective wanted();

}  // namespace trapwright::objectives
