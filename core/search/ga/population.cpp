#include "core/search/ga/population.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "core/search/ga/operators.h"

namespace trapwright::search::ga {

namespace {

Bits drawBits(const std::vector<int>& bitsOfValues, base::Random& random) {
    Bits bits(static_cast<std::size_t>(std::accumulate(bitsOfValues.begin(), bitsOfValues.end(), 0)));
    for (std::uint8_t& bit : bits)
        bit = random.boolean() ? 1 : 0;
    return bits;
}

}  // namespace

Chromosome createRandomChromosome(const ChromosomeLayout& layout, base::Random& random) {
    Chromosome chromosome;
    chromosome.points = drawBits(layout.pointBits, random);
    chromosome.singles = drawBits(layout.singleBits, random);
    chromosome.strategy =
        drawBits(std::vector<int>(countStrategyValues(layout.scope), kStrategyBits), random);
    return chromosome;
}

std::vector<Chromosome> createPopulation(const ChromosomeLayout& layout, int size, std::uint64_t seed) {
    std::vector<Chromosome> population;
    for (int i = 0; i < size; ++i) {
        base::Random random({seed, 0, static_cast<std::uint32_t>(i), 0, base::Purpose::initialPopulation});
        population.push_back(createRandomChromosome(layout, random));
    }
    return population;
}

void gradePopulation(std::vector<Chromosome>& population, const DesignSpace& space, std::uint64_t seed) {
    for (std::uint32_t i = 0; i < population.size(); ++i) {
        base::Random random({seed, 0, i, 1, base::Purpose::initialPopulation});
        const double relief = std::exp(random.uniform(std::log(kLeastRelief), 0.0));
        Design design = decodeDesign(population[i], space);
        for (std::size_t k = 0; k < design.size(); ++k) {
            if (space.dimensions[k].isRelief) design[k] = 0.5 + relief * (design[k] - 0.5);
        }
        encodeDesign(design, space, population[i]);

        std::vector<double> values = decodeGray(population[i].strategy, kStrategyBits);
        for (const std::size_t mutation : {1, 4, 6}) {  // of genes 1, 2 and 3
            if (mutation < values.size())
                values[mutation] = std::exp(random.uniform(std::log(kLeastFirstMutation), 0.0));
        }
        population[i].strategy = encodeGray(values, kStrategyBits);
    }
}

std::vector<Chromosome> nextGeneration(std::span<const Chromosome> parents, std::span<const double> fitnesses,
                                       const ChromosomeLayout& layout, const GenerationParameters& parameters,
                                       const Smooth& smooth, std::uint64_t seed, std::uint32_t generation) {
    assert(!parents.empty() && parents.size() == fitnesses.size());
    std::vector<Chromosome> children;
    children.reserve(parents.size());
    for (std::uint32_t i = 0; i < parents.size(); ++i) {
        base::Random selection({seed, generation, i, 0, base::Purpose::selection});
        const std::size_t first = selectByTournament(fitnesses, parameters.tournamentSize, selection);
        const std::size_t second = selectByTournament(fitnesses, parameters.tournamentSize, selection);
        base::Random random({seed, generation, i, 0, base::Purpose::transition});
        children.push_back(
            transition(parents[first], parents[second], layout, parameters.transition, smooth, random));
    }
    return children;
}

}  // namespace trapwright::search::ga
