#include "core/search/ga/genes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace trapwright::search::ga {

namespace {

constexpr std::size_t kBitsPerByte = 8;

double largestOf(int bits) {
    return static_cast<double>((std::uint32_t{1} << static_cast<unsigned>(bits)) - 1);
}

void appendGray(double value, int count, Bits& bits) {
    assert(count >= 1 && count <= 31);
    const auto number =
        static_cast<std::uint32_t>(std::round(std::clamp(value, 0.0, 1.0) * largestOf(count)));
    const std::uint32_t gray = number ^ (number >> 1U);
    for (int k = count - 1; k >= 0; --k)
        bits.push_back(static_cast<std::uint8_t>((gray >> static_cast<unsigned>(k)) & 1U));
}

double readGray(std::span<const std::uint8_t> bits) {
    // Every binary digit is the parity of the Gray digits down to it.
    std::uint32_t number = 0;
    std::uint32_t digit = 0;
    for (const std::uint8_t bit : bits) {
        digit ^= bit;
        number = (number << 1U) | digit;
    }
    return number / largestOf(static_cast<int>(bits.size()));
}

int bitsOf(const Dimension& dimension) {
    return dimension.bits == 0 ? kRealBits : dimension.bits;
}

std::size_t sumOf(const std::vector<int>& bits) {
    return static_cast<std::size_t>(std::accumulate(bits.begin(), bits.end(), 0));
}

}  // namespace

Bits encodeGray(std::span<const double> values, int bitsPerValue) {
    Bits bits;
    bits.reserve(values.size() * static_cast<std::size_t>(bitsPerValue));
    for (const double value : values)
        appendGray(value, bitsPerValue, bits);
    return bits;
}

std::vector<double> decodeGray(std::span<const std::uint8_t> bits, int bitsPerValue) {
    assert(bitsPerValue >= 1 && bitsPerValue <= 31);
    const auto step = static_cast<std::size_t>(bitsPerValue);
    assert(bits.size() % step == 0);
    std::vector<double> values;
    values.reserve(bits.size() / step);
    for (std::size_t first = 0; first < bits.size(); first += step)
        values.push_back(readGray(bits.subspan(first, step)));
    return values;
}

ChromosomeLayout layOut(const DesignSpace& space, StrategyScope scope) {
    ChromosomeLayout layout;
    layout.scope = scope;
    for (const Dimension& dimension : space.dimensions)
        (dimension.ofPoint ? layout.pointBits : layout.singleBits).push_back(bitsOf(dimension));
    return layout;
}

bool fits(const Chromosome& chromosome, const ChromosomeLayout& layout) {
    return chromosome.points.size() == sumOf(layout.pointBits) &&
           chromosome.singles.size() == sumOf(layout.singleBits) &&
           chromosome.strategy.size() == countStrategyValues(layout.scope) * kStrategyBits;
}

Design decodeDesign(const Chromosome& chromosome, const DesignSpace& space) {
    Design design;
    design.reserve(space.dimensions.size());
    std::span<const std::uint8_t> points(chromosome.points);
    std::span<const std::uint8_t> singles(chromosome.singles);
    for (const Dimension& dimension : space.dimensions) {
        std::span<const std::uint8_t>& gene = dimension.ofPoint ? points : singles;
        const auto count = static_cast<std::size_t>(bitsOf(dimension));
        design.push_back(readGray(gene.first(count)));
        gene = gene.subspan(count);
    }
    return design;
}

void encodeDesign(const Design& design, const DesignSpace& space, Chromosome& chromosome) {
    chromosome.points.clear();
    chromosome.singles.clear();
    for (std::size_t i = 0; i < space.dimensions.size(); ++i) {
        const Dimension& dimension = space.dimensions[i];
        appendGray(design[i], bitsOf(dimension), dimension.ofPoint ? chromosome.points : chromosome.singles);
    }
}

std::string packBits(const Bits& bits) {
    base::ByteWriter writer;
    writer(static_cast<std::uint32_t>(bits.size()));
    std::string packed((bits.size() + kBitsPerByte - 1) / kBitsPerByte, '\0');
    for (std::size_t i = 0; i < bits.size(); ++i) {
        if (bits[i] != 0) packed[i / kBitsPerByte] |= static_cast<char>(1U << (i % kBitsPerByte));
    }
    writer.appendBytes(packed);
    return writer.bytes();
}

std::optional<Bits> getBits(base::ByteReader& reader) {
    std::uint32_t count = 0;
    reader(count);
    const std::string_view packed = reader.takeBytes((std::size_t{count} + kBitsPerByte - 1) / kBitsPerByte);
    if (reader.failed()) return std::nullopt;
    Bits bits(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto byte = static_cast<unsigned char>(packed[i / kBitsPerByte]);
        bits[i] = (byte >> (i % kBitsPerByte)) & 1U;
    }
    return bits;
}

std::optional<Bits> unpackBits(std::string_view bytes) {
    base::ByteReader reader(bytes);
    auto bits = getBits(reader);
    if (!reader.finished()) return std::nullopt;
    return bits;
}

}  // namespace trapwright::search::ga
