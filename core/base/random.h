#pragma once

#include <array>
#include <cstdint>

#include "core/base/math.h"

namespace trapwright::base {

/// What a random stream is used for, so that no two uses share numbers.
enum class Purpose : std::uint8_t {
    initialPopulation = 1,
    selection = 2,
    transition = 3,
    trialStart = 4,
    finalSelection = 5,
    validation = 6,
    stablePoseDrop = 7,
    virtualFeeder = 8,
    physicalOrder = 9,
    randomDesign = 10,
    planning = 11,
    conditions = 12,
    specimen = 13,
    robustness = 14,
    surface = 15,
    corners = 16,
    mending = 17,
    stream = 18,
    learningStream = 19,
    test = 255
};

/// Names one random stream: (study seed, generation, individual, trial, purpose). individual < 2^24.
struct StreamKey {
    std::uint64_t seed = 0;
    std::uint32_t generation = 0;
    std::uint32_t individual = 0;
    std::uint32_t trial = 0;
    Purpose purpose = Purpose::test;

    friend bool operator==(const StreamKey&, const StreamKey&) = default;
};

/// A counter-based random stream (Philox4x32-10, Salmon et al. 2011, through Random123). The numbers depend
/// on the key alone: equal on every machine and for any number of threads. All conversions are our own,
/// because the standard library's distributions differ between implementations.
class Random {
 public:
    explicit Random(const StreamKey& key);

    std::uint32_t bits32();
    /// Uniform in [0, 1) with 53 bits.
    double uniform();
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    bool boolean() { return (bits32() & 1U) != 0; }
    /// Uniform in 0 ... count - 1, without bias; count > 0.
    std::uint32_t below(std::uint32_t count);
    /// Standard normal (Box-Muller).
    double normal();
    /// Uniform on the rotation group SO(3) (Shoemake 1992).
    Quaternion rotation();

 private:
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> block_{};
    unsigned used_ = 4;
};

}  // namespace trapwright::base
