#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace trapwright::evolution {

/// A string of bits, one per byte (0 or 1).
using Bits = std::vector<std::uint8_t>;

/// Bits per value (paper, section 4.2.1).
inline constexpr int kPointBits = 10;
inline constexpr int kLengthBits = 10;
inline constexpr int kStrategyBits = 20;

/// How many things the genes describe.
struct ChromosomeLayout {
    int points = 0;   // 2D points in gene 1: sections x points per section
    int lengths = 0;  // values in gene 2

    friend bool operator==(const ChromosomeLayout&, const ChromosomeLayout&) = default;
};

/// The three genes of an individual (paper, section 4.2, Figure 4): points, lengths, strategy values.
struct Chromosome {
    Bits points;    // gene 1: sections x points x (y, z), 10 bits each
    Bits lengths;   // gene 2: one per functional cross-section, 10 bits each
    Bits strategy;  // gene 3: p_x, p_dm, p_s, 20 bits each

    friend bool operator==(const Chromosome&, const Chromosome&) = default;
};

/// The values that a population tunes while it learns (paper, section 5). All in [0, 1].
struct StrategyValues {
    double crossover = 0.0;  // p_x
    double mutation = 0.0;   // p_dm, dynamic
    double smoothing = 0.0;  // p_s

    friend bool operator==(const StrategyValues&, const StrategyValues&) = default;
};

}  // namespace trapwright::evolution
