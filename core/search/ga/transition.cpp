#include "core/search/ga/transition.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/search/ga/operators.h"

namespace trapwright::search::ga {

double combineGeometricMean(std::span<const double> values) {
    assert(!values.empty());
    // By logarithms, because the product of a whole population's rates would underflow.
    double sum = 0.0;
    for (const double value : values) {
        if (value == 0.0) return 0.0;
        sum += std::log(value);
    }
    return std::exp(sum / static_cast<double>(values.size()));
}

StrategyValues decodeStrategy(const Bits& gene) {
    const auto values = decodeGray(gene, kStrategyBits);
    assert(values.size() == 3);
    return {values[0], values[1], values[2]};
}

StrategyValues limitStrategy(StrategyValues values, const TransitionParameters& parameters) {
    values.mutation = std::max(values.mutation, parameters.mutationFloor);
    values.smoothing *= parameters.smoothingLimit;
    return values;
}

StrategyValues calcGeometricMean(std::span<const StrategyValues> values) {
    const auto combine = [&](double StrategyValues::*member) {
        std::vector<double> components;
        for (const StrategyValues& value : values)
            components.push_back(value.*member);
        return combineGeometricMean(components);
    };
    return {combine(&StrategyValues::crossover), combine(&StrategyValues::mutation),
            combine(&StrategyValues::smoothing)};
}

Chromosome transition(const Chromosome& parent1, const Chromosome& parent2, const ChromosomeLayout& layout,
                      const TransitionParameters& parameters, const Smooth& smooth, base::Random& random) {
    const StrategyValues values1 = limitStrategy(decodeStrategy(parent1.strategy), parameters);
    const StrategyValues values2 = limitStrategy(decodeStrategy(parent2.strategy), parameters);
    const double crossover = combineGeometricMean(std::array{values1.crossover, values2.crossover});
    const double mutation = combineGeometricMean(std::array{values1.mutation, values2.mutation});

    Chromosome child;
    child.strategy = crossStateBased(parent1.strategy, parent2.strategy, crossover, random);
    child.strategy =
        mutateBinaryUniform(std::move(child.strategy), mutation + parameters.staticMutation, random);
    const StrategyValues values = limitStrategy(decodeStrategy(child.strategy), parameters);
    const double rate = values.mutation + parameters.staticMutation;

    child.singles = crossStateBased(parent1.singles, parent2.singles, values.crossover, random);
    child.singles = mutateBinaryUniform(std::move(child.singles), rate, random);

    child.points = crossStateBased(parent1.points, parent2.points, values.crossover, random);
    child.points = mutatePoints(std::move(child.points), layout.pointBits, rate, random);
    return smooth(std::move(child), values.smoothing, random);
}

}  // namespace trapwright::search::ga
