#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/byte_archive.h"
#include "core/search/design_space.h"

/// The paper's genetic algorithm: its strings of bits are known to nobody else.
namespace trapwright::search::ga {

/// A string of bits, one per byte (0 or 1).
using Bits = std::vector<std::uint8_t>;

/// Bits of a dimension that may be any number.
inline constexpr int kRealBits = 20;
/// Bits of a strategy value (paper, section 4.2.1).
inline constexpr int kStrategyBits = 20;

/// What has a crossover rate and a mutation rate of its own: an individual (paper, section 5) or each of its
/// genes, which the paper leaves to be tried (section 9).
enum class StrategyScope { individual, gene };

/// The scopes by the names that they have in files and on the command line.
inline constexpr std::array<std::pair<std::string_view, StrategyScope>, 2> kStrategyScopes = {
    {{"individual", StrategyScope::individual}, {"gene", StrategyScope::gene}}};

/// Which bits stand for what.
struct ChromosomeLayout {
    std::vector<int> pointBits;   // of each number of gene 1: two numbers a 2D point, with equally many bits
    std::vector<int> singleBits;  // of each number of gene 2
    StrategyScope scope = StrategyScope::individual;

    friend bool operator==(const ChromosomeLayout&, const ChromosomeLayout&) = default;
};

/// The three genes of an individual (paper, section 4.2, Figure 4): points, single numbers (the paper's
/// segment lengths), strategy values.
struct Chromosome {
    Bits points;    // gene 1: (y, z) of each point
    Bits singles;   // gene 2
    Bits strategy;  // gene 3: p_x, p_dm, p_s, 20 bits each; by gene then also p_x, p_dm of genes 2 and 3

    friend bool operator==(const Chromosome&, const Chromosome&) = default;
};

/// How a gene is bred. In [0, 1].
struct GeneRates {
    double crossover = 0.0;  // p_x
    double mutation = 0.0;   // p_dm, dynamic

    friend bool operator==(const GeneRates&, const GeneRates&) = default;
};

/// The values that a population tunes while it learns (paper, section 5). Of an individual's scope the rates
/// of its three genes are the same.
struct StrategyValues {
    GeneRates points;        // gene 1
    GeneRates singles;       // gene 2
    GeneRates strategy;      // gene 3
    double smoothing = 0.0;  // p_s, of gene 1, in [0, 1]

    friend bool operator==(const StrategyValues&, const StrategyValues&) = default;
};

/// The same rates for all genes.
constexpr StrategyValues sameForGenes(double crossover, double mutation, double smoothing) {
    return {{crossover, mutation}, {crossover, mutation}, {crossover, mutation}, smoothing};
}

/// How many values gene 3 holds.
constexpr std::size_t countStrategyValues(StrategyScope scope) {
    return scope == StrategyScope::gene ? 7 : 3;
}

/// Each value in [0, 1] as `bitsPerValue` bits of reflected binary code (Gray code; paper, section 4.2), most
/// significant first: the whole number nearest to value x (2^bits - 1). At most 31 bits.
Bits encodeGray(std::span<const double> values, int bitsPerValue);

/// The inverse: whole number / (2^bits - 1). encodeGray(decodeGray(bits)) = bits.
std::vector<double> decodeGray(std::span<const std::uint8_t> bits, int bitsPerValue);

/// Points are the dimensions that are of points; all others are single numbers.
ChromosomeLayout layOut(const DesignSpace& space, StrategyScope scope);

/// Whether the genes are as long as the layout says.
bool fits(const Chromosome& chromosome, const ChromosomeLayout& layout);

/// The design that genes 1 and 2 stand for. They must fit the space's layout.
Design decodeDesign(const Chromosome& chromosome, const DesignSpace& space);

/// Puts a design into genes 1 and 2: decodeDesign gives it back, where its numbers are those of their bits.
void encodeDesign(const Design& design, const DesignSpace& space, Chromosome& chromosome);

/// A bit count (32 bits), then eight bits a byte, the first in the lowest place.
std::string packBits(const Bits& bits);
/// The bits that come next; none if that is not what packBits writes.
std::optional<Bits> getBits(base::ByteReader& reader);
/// None if the bytes are not just what packBits writes.
std::optional<Bits> unpackBits(std::string_view bytes);

}  // namespace trapwright::search::ga
