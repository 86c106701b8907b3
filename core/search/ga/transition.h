#pragma once

#include <functional>
#include <span>

#include "core/base/random.h"
#include "core/search/ga/genes.h"

namespace trapwright::search::ga {

/// What the paper's transition function is given beside the parents, and the bounds of
/// decisions.md#smoothing.
struct TransitionParameters {
    double staticMutation = 0.002;  // p_sm
    double smoothingLimit = 0.3;    // what p_s = 1 stands for, all others in proportion; 1 in the paper
    double mutationFloor = 0.0005;  // p_dm counts as at least this; 0 in the paper
};

/// Smoothing of what genes 1 and 2 stand for, with probability p_s.
using Smooth = std::function<Chromosome(Chromosome child, double probability, base::Random& random)>;

/// Geometric mean (Eq. 6); 0 if any value is 0. The values are not negative, at least one.
double combineGeometricMean(std::span<const double> values);

/// What gene 3 says, before any bound; how many values it holds tells their scope.
StrategyValues decodeStrategy(const Bits& gene);

/// Component by component (Eq. 6).
StrategyValues calcGeometricMean(std::span<const StrategyValues> values);

/// What takes effect: each p_dm not below its floor, p_s scaled to [0, limit]. Cut off at the limit instead,
/// all genes above it would act alike, selection could not tell them apart, and p_s would stay at the limit.
StrategyValues limitStrategy(StrategyValues values, const TransitionParameters& parameters);

/// The transition function (paper, section 5, Algorithm 2): one child of two parents. Strategy values first,
/// by their parents' geometric means; then single numbers and points by the child's own values, those of
/// their gene; last comes smoothing.
Chromosome transition(const Chromosome& parent1, const Chromosome& parent2, const ChromosomeLayout& layout,
                      const TransitionParameters& parameters, const Smooth& smooth, base::Random& random);

}  // namespace trapwright::search::ga
