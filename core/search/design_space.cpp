#include "core/search/design_space.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/byte_archive.h"

namespace trapwright::search {

namespace {

constexpr int kMostPackedBits = 24;
constexpr std::size_t kBitsPerByte = 8;
constexpr std::size_t kMostNumbers = std::size_t{1} << 24U;

double largestOf(int bits) {
    return static_cast<double>((std::uint32_t{1} << static_cast<unsigned>(bits)) - 1);
}

/// The fewest bits that tell all numbers; 0 if none do.
int findBits(const Design& design) {
    for (int bits = 1; bits <= kMostPackedBits; ++bits) {
        const bool all = std::all_of(design.begin(), design.end(), [&](double value) {
            return value >= 0.0 && value <= 1.0 && roundToBits(value, bits) == value && !std::signbit(value);
        });
        if (all) return bits;
    }
    return 0;
}

std::size_t bytesFor(std::size_t count, int bits) {
    return (count * static_cast<std::size_t>(bits) + kBitsPerByte - 1) / kBitsPerByte;
}

}  // namespace

base::Status DesignSpace::check(const Design& design) const {
    if (design.size() != dimensions.size()) {
        return base::Error{"The design has " + std::to_string(design.size()) +
                           " numbers, where these settings need " + std::to_string(dimensions.size()) +
                           ". Use the settings that it was made with."};
    }
    for (std::size_t i = 0; i < design.size(); ++i) {
        if (design[i] >= 0.0 && design[i] <= 1.0) continue;  // false for NaN
        return base::Error{"The design's number of " + dimensions[i].key + " is " +
                           std::to_string(design[i]) + "; it must be from 0 to 1."};
    }
    return base::success();
}

double roundToBits(double value, int bits) {
    if (bits == 0) return value;
    const double largest = largestOf(bits);
    return std::round(value * largest) / largest;
}

double drawNumber(const Dimension& dimension, base::Random& random) {
    constexpr double kLevel = 0.25;
    const bool isLevel = dimension.isRelief && random.uniform() < kLevel;
    return roundToBits(isLevel ? 0.5 : random.uniform(), dimension.bits);
}

void mutateNumbers(std::span<double> numbers, std::span<const Dimension> dimensions, base::Random& random) {
    constexpr double kSmallest = 0.01;
    constexpr double kLargest = 0.25;
    constexpr double kRedrawn = 0.15;
    const std::uint32_t changes = 1 + random.below(3);
    const double step = std::exp(random.uniform(std::log(kSmallest), std::log(kLargest)));
    for (std::uint32_t change = 0; change < changes; ++change) {
        const std::size_t i = random.below(static_cast<std::uint32_t>(numbers.size()));
        numbers[i] =
            random.uniform() < kRedrawn
                ? drawNumber(dimensions[i], random)
                : roundToBits(std::clamp(numbers[i] + step * random.normal(), 0.0, 1.0), dimensions[i].bits);
    }
}

std::string packDesign(const Design& design) {
    base::ByteWriter writer;
    const int bits = findBits(design);
    writer(static_cast<std::uint32_t>(design.size()), static_cast<std::uint8_t>(bits));
    if (bits == 0) {
        for (const double value : design)
            writer(value);
        return writer.bytes();
    }
    std::string packed(bytesFor(design.size(), bits), '\0');
    std::size_t at = 0;
    for (const double value : design) {
        const auto number = static_cast<std::uint32_t>(std::round(value * largestOf(bits)));
        for (int k = 0; k < bits; ++k, ++at) {
            if (((number >> static_cast<unsigned>(k)) & 1U) != 0)
                packed[at / kBitsPerByte] |= static_cast<char>(1U << (at % kBitsPerByte));
        }
    }
    writer.appendBytes(packed);
    return writer.bytes();
}

std::optional<Design> unpackDesign(std::string_view bytes) {
    base::ByteReader reader(bytes);
    std::uint32_t count = 0;
    std::uint8_t bits = 0;
    reader(count, bits);
    if (reader.failed() || bits > kMostPackedBits || count > kMostNumbers) return std::nullopt;
    if (reader.left() != (bits == 0 ? std::size_t{count} * sizeof(double) : bytesFor(count, bits)))
        return std::nullopt;
    Design design(count);
    if (bits == 0) {
        for (double& value : design)
            reader(value);
        return design;
    }
    const std::string_view packed = reader.takeBytes(reader.left());
    std::size_t at = 0;
    for (double& value : design) {
        std::uint32_t number = 0;
        for (int k = 0; k < bits; ++k, ++at) {
            const auto byte = static_cast<unsigned char>(packed[at / kBitsPerByte]);
            number |= static_cast<std::uint32_t>((byte >> (at % kBitsPerByte)) & 1U)
                      << static_cast<unsigned>(k);
        }
        value = number / largestOf(bits);
    }
    return design;
}

}  // namespace trapwright::search
