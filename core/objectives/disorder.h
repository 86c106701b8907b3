#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// How many bits tell in which way a part ends: minus the binary logarithm of how likely two trials end
/// alike, both finished (the collision entropy of ends, Renyi 1961). Each halving of the ways takes one bit,
/// from chaos to one way, where F_O gains almost all with the last one. Two ends are alike as exp(-(angle /
/// tolerance of success)^2).
Objective disorder();

/// For tracks that throw out what lies wrong, so that it comes again: the disorder of those parts that do not
/// fall off, and kBitsOfHalving for each halving of their number. Chaos in four ways has 2 bits, and one of
/// the four alone two thirds: order is worth more than what it costs. What gets stuck counts as in
/// disorder().
Objective sorting();
/// With 1, throwing out half of the ways would gain nothing; with 0, throwing out almost all parts would cost
/// nothing.
inline constexpr double kBitsOfHalving = 1.0 / 3.0;

}  // namespace trapwright::objectives
