#include "core/search/ga/operators.h"

#include <cassert>

namespace trapwright::search::ga {

std::size_t selectByTournament(std::span<const double> fitnesses, int size, base::Random& random) {
    assert(!fitnesses.empty() && size >= 1);
    const auto count = static_cast<std::uint32_t>(fitnesses.size());
    std::size_t winner = random.below(count);
    for (int i = 1; i < size; ++i) {
        const std::size_t candidate = random.below(count);
        if (fitnesses[candidate] > fitnesses[winner]) winner = candidate;
    }
    return winner;
}

Bits crossStateBased(const Bits& parent1, const Bits& parent2, double rate, base::Random& random) {
    assert(parent1.size() == parent2.size());
    Bits child = parent1;
    bool crossoverState = true;
    for (std::size_t i = 0; i < child.size(); ++i) {
        if (random.uniform() < rate) crossoverState = random.boolean();
        if (crossoverState) child[i] = parent2[i];
    }
    return child;
}

Bits mutateBinaryUniform(Bits bits, double rate, base::Random& random) {
    for (std::uint8_t& bit : bits) {
        if (random.uniform() < rate) bit = random.boolean() ? 1 : 0;
    }
    return bits;
}

Bits mutatePoints(Bits bits, std::span<const int> bitsOfValues, double rate, base::Random& random) {
    assert(bitsOfValues.size() % 2 == 0);
    std::size_t point = 0;  // its first bit
    for (std::size_t value = 0; value < bitsOfValues.size(); value += 2) {
        assert(bitsOfValues[value] == bitsOfValues[value + 1]);
        const auto b = static_cast<std::uint32_t>(bitsOfValues[value]);
        for (std::uint32_t attempt = 0; attempt < b; ++attempt) {
            if (random.uniform() >= rate) continue;
            const std::size_t first = point + random.below(b);
            const std::size_t second = point + b + random.below(b);
            bits[first] = random.boolean() ? 1 : 0;
            bits[second] = random.boolean() ? 1 : 0;
        }
        point += 2 * static_cast<std::size_t>(b);
    }
    return bits;
}

}  // namespace trapwright::search::ga
