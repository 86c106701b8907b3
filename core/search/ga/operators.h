#pragma once

#include <span>

#include "core/base/random.h"
#include "core/search/ga/genes.h"

/// The genetic operators of the paper's section 4.3. Each draws from the random stream that it is given.
namespace trapwright::search::ga {

/// Deterministic tournament (4.3.1): draws `size` individuals with replacement and returns the index of the
/// one with the highest fitness; among equals the one that was drawn first, which favours no place in the
/// population.
std::size_t selectByTournament(std::span<const double> fitnesses, int size, base::Random& random);

/// State-based crossover, SBX (4.3.2, Algorithm 1): copies parent 2 while the state is true, which it is at
/// first, and parent 1 while it is false; before each bit the state is drawn anew with probability `rate`.
/// Rate 0 gives parent 2, rate 1 takes each bit from either at random. The parents are equally long.
Bits crossStateBased(const Bits& parent1, const Bits& parent2, double rate, base::Random& random);

/// Binary uniform mutation, BUM (4.3.3): replaces each bit with probability `rate` by a random one, so that
/// rate / 2 of the bits change.
Bits mutateBinaryUniform(Bits bits, double rate, base::Random& random);

/// 2D-point mutation, 2DPM (4.3.3). The gene is a row of points of two values each; `bitsOfValues` are those
/// of each value, b for both of a point. b times per point, with probability `rate`, a random bit of the
/// first value and a random bit of the second are replaced by random ones.
Bits mutatePoints(Bits bits, std::span<const int> bitsOfValues, double rate, base::Random& random);

}  // namespace trapwright::search::ga
