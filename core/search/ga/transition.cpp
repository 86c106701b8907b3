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
    if (values.size() == countStrategyValues(StrategyScope::individual))
        return sameForGenes(values[0], values[1], values[2]);
    assert(values.size() == countStrategyValues(StrategyScope::gene));
    return {{values[0], values[1]}, {values[3], values[4]}, {values[5], values[6]}, values[2]};
}

StrategyValues limitStrategy(StrategyValues values, const TransitionParameters& parameters) {
    for (GeneRates* rates : {&values.points, &values.singles, &values.strategy})
        rates->mutation = std::max(rates->mutation, parameters.mutationFloor);
    values.smoothing *= parameters.smoothingLimit;
    return values;
}

StrategyValues calcGeometricMean(std::span<const StrategyValues> values) {
    const auto combine = [&](auto component) {
        std::vector<double> components;
        components.reserve(values.size());
        for (const StrategyValues& value : values)
            components.push_back(component(value));
        return combineGeometricMean(components);
    };
    const auto combineRates = [&](GeneRates StrategyValues::*gene) {
        return GeneRates{combine([&](const StrategyValues& value) { return (value.*gene).crossover; }),
                         combine([&](const StrategyValues& value) { return (value.*gene).mutation; })};
    };
    return {combineRates(&StrategyValues::points), combineRates(&StrategyValues::singles),
            combineRates(&StrategyValues::strategy),
            combine([](const StrategyValues& value) { return value.smoothing; })};
}

Chromosome transition(const Chromosome& parent1, const Chromosome& parent2, const ChromosomeLayout& layout,
                      const TransitionParameters& parameters, const Smooth& smooth, base::Random& random) {
    const GeneRates rates1 = limitStrategy(decodeStrategy(parent1.strategy), parameters).strategy;
    const GeneRates rates2 = limitStrategy(decodeStrategy(parent2.strategy), parameters).strategy;
    const double crossover = combineGeometricMean(std::array{rates1.crossover, rates2.crossover});
    const double mutation = combineGeometricMean(std::array{rates1.mutation, rates2.mutation});

    Chromosome child;
    child.strategy = crossStateBased(parent1.strategy, parent2.strategy, crossover, random);
    child.strategy =
        mutateBinaryUniform(std::move(child.strategy), mutation + parameters.staticMutation, random);
    const StrategyValues values = limitStrategy(decodeStrategy(child.strategy), parameters);

    child.singles = crossStateBased(parent1.singles, parent2.singles, values.singles.crossover, random);
    child.singles = mutateBinaryUniform(std::move(child.singles),
                                        values.singles.mutation + parameters.staticMutation, random);

    child.points = crossStateBased(parent1.points, parent2.points, values.points.crossover, random);
    child.points = mutatePoints(std::move(child.points), layout.pointBits,
                                values.points.mutation + parameters.staticMutation, random);
    return smooth(std::move(child), values.smoothing, random);
}

}  // namespace trapwright::search::ga
