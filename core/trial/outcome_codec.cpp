#include "core/trial/outcome_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "core/base/compression.h"

// The bytes: kVersion, the Layout as one byte, then compressed (core/base/compression.h) the unit of time and
// the planes. A plane has one byte of every trial, so that what is alike lies together: first all signs and
// exponents of a number, last the ends of its mantissas, which nothing makes smaller.

namespace trapwright::trial {

namespace {

constexpr std::uint8_t kVersion = 1;
/// Times are told in these, which simulated steps are multiples of, and how many make 1 s.
constexpr double kTicks = 1e6;
constexpr double kMostTicks = 4294967295.0;

/// What does not fit is written as it is, all 8 bytes of every number.
struct Layout {
    bool tickedTimes = true;    // a number of units, and how far the time is from it
    bool unitRotations = true;  // three numbers, and how far the fourth is from what they make it
};

constexpr int kTicked = 1;
constexpr int kUnit = 2;

std::size_t bytesEach(const Layout& layout) {
    return std::size_t{1} + (layout.tickedTimes ? 5 : 8) + 24 + (layout.unitRotations ? 25 : 32);
}

/// The bytes of one row of numbers, one plane for each place in them.
class Planes {
 public:
    Planes(std::vector<std::string>& planes, int width)
        : planes_(&planes), first_(planes.size()), width_(width) {
        planes.resize(first_ + static_cast<std::size_t>(width));
    }
    void add(std::uint64_t word) {
        for (int i = 0; i < width_; ++i)
            (*planes_)[first_ + static_cast<std::size_t>(i)].push_back(
                static_cast<char>(word >> (8 * (width_ - 1 - i))));
    }

 private:
    std::vector<std::string>* planes_;
    std::size_t first_;
    int width_;
};

/// Takes planes off the bytes again.
class PlaneReader {
 public:
    PlaneReader(std::string_view bytes, std::size_t count) : bytes_(bytes), count_(count) {}

    std::vector<std::uint64_t> take(int width) {
        std::vector<std::uint64_t> words(count_, 0);
        for (int i = 0; i < width; ++i) {
            for (std::size_t k = 0; k < count_; ++k)
                words[k] = words[k] << 8 | static_cast<unsigned char>(bytes_[k]);
            bytes_.remove_prefix(count_);
        }
        return words;
    }

 private:
    std::string_view bytes_;
    std::size_t count_;
};

std::uint64_t bitsOf(double number) {
    return std::bit_cast<std::uint64_t>(number);
}

/// How far apart two numbers of one sign are, in steps from one double to the next; none if that is no byte.
std::optional<std::uint8_t> stepsFrom(double expected, double number) {
    const std::uint64_t steps = bitsOf(number) - bitsOf(expected) + 128;
    if (steps > 255) return std::nullopt;
    return static_cast<std::uint8_t>(steps);
}

double stepOn(double expected, std::uint64_t steps) {
    return std::bit_cast<double>(bitsOf(expected) + steps - 128);
}

std::optional<std::uint32_t> ticksOf(double time) {
    const double ticks = time * kTicks;
    if (!(ticks >= 0.0 && ticks <= kMostTicks)) return std::nullopt;
    const auto whole = static_cast<std::uint32_t>(std::llround(ticks));
    if (!stepsFrom(static_cast<double>(whole) / kTicks, time)) return std::nullopt;
    return whole;
}

/// A unit quaternion by its three lesser components, in their order, and by what the greatest one is.
struct UnitRotation {
    explicit UnitRotation(const base::Quaternion& rotation) {
        const Eigen::Vector4d& all = rotation.coeffs();
        for (int i = 1; i < 4; ++i)
            if (std::abs(all[i]) > std::abs(all[greatest])) greatest = i;
        negative = std::signbit(all[greatest]);
        for (int i = 0, k = 0; i < 4; ++i)
            if (i != greatest) lesser[static_cast<std::size_t>(k++)] = all[i];
        steps = stepsFrom(calcGreatest(lesser), std::abs(all[greatest]));
    }

    /// What the greatest component is but for a few last bits. Correctly rounded operations only, which give
    /// the same everywhere.
    static double calcGreatest(const std::array<double, 3>& lesser) {
        double rest = 1.0;
        for (const double component : lesser)
            rest -= component * component;
        return std::sqrt(std::max(rest, 0.0));
    }

    int greatest = 0;
    bool negative = false;
    std::array<double, 3> lesser{};
    std::optional<std::uint8_t> steps;
};

Layout findLayout(std::span<const Outcome> outcomes) {
    Layout layout;
    for (const Outcome& outcome : outcomes) {
        layout.tickedTimes = layout.tickedTimes && ticksOf(outcome.time);
        layout.unitRotations = layout.unitRotations && UnitRotation(outcome.farthest.rotation).steps;
    }
    return layout;
}

void addEndings(std::span<const Outcome> outcomes, const Layout& layout, std::vector<std::string>& planes) {
    Planes endings(planes, 1);
    for (const Outcome& outcome : outcomes) {
        auto code = static_cast<unsigned>(outcome.ending);
        if (layout.unitRotations) {
            const UnitRotation rotation(outcome.farthest.rotation);
            code |= static_cast<unsigned>(rotation.greatest) << 2 | (rotation.negative ? 16U : 0U);
        }
        endings.add(code);
    }
}

void addTimes(std::span<const Outcome> outcomes, const Layout& layout, std::uint32_t unit,
              std::vector<std::string>& planes) {
    if (!layout.tickedTimes) {
        Planes times(planes, 8);
        for (const Outcome& outcome : outcomes)
            times.add(bitsOf(outcome.time));
        return;
    }
    Planes units(planes, 4);
    Planes steps(planes, 1);
    for (const Outcome& outcome : outcomes) {
        const std::uint32_t ticks = *ticksOf(outcome.time);
        units.add(ticks / unit);
        steps.add(*stepsFrom(ticks / kTicks, outcome.time));
    }
}

void addRotations(std::span<const Outcome> outcomes, const Layout& layout, std::vector<std::string>& planes) {
    const int components = layout.unitRotations ? 3 : 4;
    for (int i = 0; i < components; ++i) {
        Planes numbers(planes, 8);
        for (const Outcome& outcome : outcomes) {
            const base::Quaternion& q = outcome.farthest.rotation;
            numbers.add(bitsOf(layout.unitRotations ? UnitRotation(q).lesser[static_cast<std::size_t>(i)]
                                                    : q.coeffs()[i]));
        }
    }
    if (!layout.unitRotations) return;
    Planes steps(planes, 1);
    for (const Outcome& outcome : outcomes)
        steps.add(*UnitRotation(outcome.farthest.rotation).steps);
}

/// What all times are multiples of.
std::uint32_t findUnit(std::span<const Outcome> outcomes, const Layout& layout) {
    std::uint32_t unit = 0;
    if (layout.tickedTimes)
        for (const Outcome& outcome : outcomes)
            unit = std::gcd(unit, *ticksOf(outcome.time));
    return std::max(unit, std::uint32_t{1});
}

void takeTimes(PlaneReader& planes, const Layout& layout, double unit, std::vector<Outcome>& outcomes) {
    const std::vector<std::uint64_t> numbers = planes.take(layout.tickedTimes ? 4 : 8);
    const std::vector<std::uint64_t> steps = planes.take(layout.tickedTimes ? 1 : 0);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        outcomes[i].time = layout.tickedTimes
                               ? stepOn(static_cast<double>(numbers[i]) * unit / kTicks, steps[i])
                               : std::bit_cast<double>(numbers[i]);
    }
}

void takeRotations(PlaneReader& planes, const Layout& layout, const std::vector<std::uint64_t>& codes,
                   std::vector<Outcome>& outcomes) {
    std::array<std::vector<std::uint64_t>, 4> numbers;
    for (int i = 0; i < (layout.unitRotations ? 3 : 4); ++i)
        numbers[static_cast<std::size_t>(i)] = planes.take(8);
    const std::vector<std::uint64_t> steps = planes.take(layout.unitRotations ? 1 : 0);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        Eigen::Vector4d all = Eigen::Vector4d::Zero();
        const auto greatest = layout.unitRotations ? static_cast<int>(codes[k] >> 2 & 3) : 4;
        std::array<double, 3> lesser{};
        for (int i = 0, from = 0; i < 4; ++i) {
            if (i == greatest) continue;
            all[i] = std::bit_cast<double>(numbers[static_cast<std::size_t>(from)][k]);
            if (layout.unitRotations) lesser[static_cast<std::size_t>(from)] = all[i];
            ++from;
        }
        if (layout.unitRotations) {
            const double size = stepOn(UnitRotation::calcGreatest(lesser), steps[k]);
            all[greatest] = (codes[k] & 16) != 0 ? -size : size;
        }
        outcomes[k].farthest.rotation.coeffs() = all;
    }
}

}  // namespace

std::string packOutcomes(std::span<const Outcome> outcomes) {
    assert(outcomes.size() <= kMostPacked);
    const Layout layout = findLayout(outcomes);
    const std::uint32_t unit = findUnit(outcomes, layout);

    std::vector<std::string> planes(1);
    for (int i = 0; i < 4; ++i)
        planes.front().push_back(static_cast<char>(unit >> (8 * i)));
    addEndings(outcomes, layout, planes);
    addTimes(outcomes, layout, unit, planes);
    for (int axis = 0; axis < 3; ++axis) {
        Planes positions(planes, 8);
        for (const Outcome& outcome : outcomes)
            positions.add(bitsOf(outcome.farthest.position[axis]));
    }
    addRotations(outcomes, layout, planes);

    std::string bytes(1, static_cast<char>(kVersion));
    bytes.push_back(
        static_cast<char>((layout.tickedTimes ? kTicked : 0) | (layout.unitRotations ? kUnit : 0)));
    return bytes + base::compress(planes);
}

base::Result<std::vector<Outcome>> unpackOutcomes(std::string_view bytes, std::size_t count) {
    const base::Error damaged{"These bytes are not " + std::to_string(count) + " outcomes of trials.",
                              base::ErrorKind::damaged};
    if (count > kMostPacked || bytes.size() < 2 || bytes.front() != kVersion ||
        (bytes[1] & ~(kTicked | kUnit)) != 0)
        return damaged;
    const Layout layout{(bytes[1] & kTicked) != 0, (bytes[1] & kUnit) != 0};
    const auto unpacked = base::decompress(bytes.substr(2), 4 + count * bytesEach(layout));
    if (!unpacked) return damaged;

    double unit = 0.0;
    for (int i = 3; i >= 0; --i)
        unit = 256.0 * unit + static_cast<unsigned char>((*unpacked)[static_cast<std::size_t>(i)]);
    PlaneReader planes(std::string_view(*unpacked).substr(4), count);
    std::vector<Outcome> outcomes(count);
    const std::vector<std::uint64_t> codes = planes.take(1);
    for (std::size_t i = 0; i < count; ++i)
        outcomes[i].ending = static_cast<Ending>(codes[i] & 3);
    takeTimes(planes, layout, unit, outcomes);
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<std::uint64_t> numbers = planes.take(8);
        for (std::size_t i = 0; i < count; ++i)
            outcomes[i].farthest.position[axis] = std::bit_cast<double>(numbers[i]);
    }
    takeRotations(planes, layout, codes, outcomes);
    return outcomes;
}

}  // namespace trapwright::trial
