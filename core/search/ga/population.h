#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/search/ga/genes.h"
#include "core/search/ga/transition.h"

namespace trapwright::search::ga {

/// How generation 0 is drawn.
enum class FirstGeneration {
    random,   // every bit at random (the paper's)
    graded,   // from nearly level to rough, from rarely mutating to often (gradePopulation)
    planned,  // the same, and designs that were put together before (Search::begin)
    known     // the same, and designs of another study
};

/// How the first generation is drawn, and how each follows from the one before.
struct GenerationParameters {
    int tournamentSize = 6;  // s
    TransitionParameters transition;
    FirstGeneration first = FirstGeneration::random;
    StrategyScope scope = StrategyScope::individual;
};

/// Every bit drawn at random.
Chromosome createRandomChromosome(const ChromosomeLayout& layout, base::Random& random);

/// Generation 0 (paper, section 3, step 1): `size` random individuals, each from its own random stream.
std::vector<Chromosome> createPopulation(const ChromosomeLayout& layout, int size, std::uint64_t seed);

/// Of individual i's dimensions of relief all come nearer to 0.5 by a factor of its own, from kLeastRelief to
/// 1, and each p_dm becomes one from kLeastFirstMutation to 1; the logarithms of all are uniform, from the
/// stream (seed, 0, i, 1, initialPopulation). Most designs at random are so rough that no part comes through,
/// and half of all p_dm at random make a child that has nothing of its parents: a search learns only that for
/// its first ten generations.
void gradePopulation(std::vector<Chromosome>& population, const DesignSpace& space, std::uint64_t seed);
inline constexpr double kLeastRelief = 0.03;
inline constexpr double kLeastFirstMutation = 0.0005;

/// The children that make up `generation`, as many as there are parents, without elitism (4.3.1). Child i has
/// its own random streams (seed, generation, i) for selection and for transition, so it depends on no other
/// child.
std::vector<Chromosome> nextGeneration(std::span<const Chromosome> parents, std::span<const double> fitnesses,
                                       const ChromosomeLayout& layout, const GenerationParameters& parameters,
                                       const Smooth& smooth, std::uint64_t seed, std::uint32_t generation);

}  // namespace trapwright::search::ga
