#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/search/ga/genes.h"
#include "core/search/ga/transition.h"

namespace trapwright::search::ga {

/// How a generation follows from the one before.
struct GenerationParameters {
    int tournamentSize = 6;  // s
    TransitionParameters transition;
};

/// Every bit drawn at random.
Chromosome createRandomChromosome(const ChromosomeLayout& layout, base::Random& random);

/// Generation 0 (paper, section 3, step 1): `size` random individuals, each from its own random stream.
std::vector<Chromosome> createPopulation(const ChromosomeLayout& layout, int size, std::uint64_t seed);

/// The children that make up `generation`, as many as there are parents, without elitism (4.3.1). Child i has
/// its own random streams (seed, generation, i) for selection and for transition, so it depends on no other
/// child.
std::vector<Chromosome> nextGeneration(std::span<const Chromosome> parents, std::span<const double> fitnesses,
                                       const ChromosomeLayout& layout, const GenerationParameters& parameters,
                                       const Smooth& smooth, std::uint64_t seed, std::uint32_t generation);

}  // namespace trapwright::search::ga
