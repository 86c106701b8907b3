#pragma once

#include <functional>
#include <span>

#include "core/base/random.h"
#include "core/evolution/chromosome.h"

namespace trapwright::evolution {

/// What the paper's transition function is given beside the parents, and the bounds of
/// decisions.md#smoothing.
struct TransitionParameters {
    double staticMutation = 0.002;  // p_sm
    double smoothingLimit = 0.3;    // what p_s = 1 stands for, all others in proportion; 1 in the paper
    double mutationFloor = 0.0005;  // p_dm counts as at least this; 0 in the paper
};

/// Surface smoothing of gene 1 with probability p_s; this folder does not know what the bits stand for.
using SmoothPoints = std::function<Bits(const Bits& points, double probability, base::Random& random)>;

/// Geometric mean (Eq. 6); 0 if any value is 0. The values are not negative, at least one.
double combineGeometricMean(std::span<const double> values);

/// What gene 3 says, before any bound.
StrategyValues decodeStrategy(const Bits& gene);

/// What takes effect: p_dm not below its floor, p_s scaled to [0, limit]. Cut off at the limit instead, all
/// genes above it would act alike, selection could not tell them apart, and p_s would stay at the limit.
StrategyValues limitStrategy(StrategyValues values, const TransitionParameters& parameters);

/// The transition function (paper, section 5, Algorithm 2): one child of two parents. Strategy values first,
/// by their parents' geometric means; then lengths and points by the child's own values; last the points are
/// smoothed.
Chromosome transition(const Chromosome& parent1, const Chromosome& parent2,
                      const TransitionParameters& parameters, const SmoothPoints& smooth,
                      base::Random& random);

}  // namespace trapwright::evolution
