#include "core/base/random.h"

#include <Random123/philox.h>

#include <cmath>

namespace trapwright::base {

Random::Random(const StreamKey& key)
    : counter_{0, key.trial, key.individual | (std::uint32_t{static_cast<std::uint8_t>(key.purpose)} << 24U),
               key.generation},
      key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32U)} {}

std::uint32_t Random::bits32() {
    if (used_ == 4) {
        const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
        const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
        const auto words = r123::Philox4x32{}(counter, key);
        for (unsigned i = 0; i < 4; ++i)
            block_[i] = words[i];
        ++counter_[0];
        used_ = 0;
    }
    return block_[used_++];
}

double Random::uniform() {
    const std::uint64_t high = bits32() >> 5U;  // 27 bits
    const std::uint64_t low = bits32() >> 6U;   // 26 bits
    return static_cast<double>((high << 26U) | low) * 0x1.0p-53;
}

std::uint32_t Random::below(std::uint32_t count) {
    // Reject the tail that would favour small numbers.
    const std::uint32_t limit = 0xFFFFFFFFU - (0xFFFFFFFFU % count + 1U) % count;
    std::uint32_t bits = bits32();
    while (bits > limit)
        bits = bits32();
    return bits % count;
}

double Random::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
}

Quaternion Random::rotation() {
    const double u = uniform();
    const double a = 2.0 * kPi * uniform();
    const double b = 2.0 * kPi * uniform();
    const double r1 = std::sqrt(1.0 - u);
    const double r2 = std::sqrt(u);
    return {r2 * std::cos(b), r1 * std::sin(a), r1 * std::cos(a), r2 * std::sin(b)};
}

}  // namespace trapwright::base
