#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// How many bits tell in which way a part ends: minus the binary logarithm of how likely two trials end
/// alike, both finished (the collision entropy of ends, Renyi 1961). Each halving of the ways takes one bit,
/// from chaos to one way, where F_O gains almost all with the last one. Two ends are alike as exp(-(angle /
/// tolerance of success)^2).
Objective disorder();

}  // namespace trapwright::objectives
