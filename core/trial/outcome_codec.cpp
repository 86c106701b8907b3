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

// The bytes: kVersion, the Layout as one byte, with kCounted the number of parts of all trials together in
// four, with kStreamed that of all stops, then compressed (core/base/compression.h) the unit of time, with
// kCounted how many parts each trial has, the planes, and with kStreamed when each part came, or that it
// never did, and the planes of the stops: trial, part, from, to. A plane has one byte of every part, so that
// what is alike lies together: first all signs and exponents of a number, last the ends of its mantissas,
// which nothing makes smaller.

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
constexpr int kCounted = 4;   // not every trial has one part
constexpr int kStreamed = 8;  // there are stops, or parts that came later than at 0 s or never

constexpr std::size_t kBytesOfEntry = 9;
constexpr std::size_t kBytesOfStop = 24;

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

Layout findLayout(std::span<const PartOutcome> outcomes) {
    Layout layout;
    for (const PartOutcome& outcome : outcomes) {
        layout.tickedTimes = layout.tickedTimes && ticksOf(outcome.time);
        layout.unitRotations = layout.unitRotations && UnitRotation(outcome.farthest.rotation).steps;
    }
    return layout;
}

void addEndings(std::span<const PartOutcome> outcomes, const Layout& layout,
                std::vector<std::string>& planes) {
    Planes endings(planes, 1);
    for (const PartOutcome& outcome : outcomes) {
        auto code = static_cast<unsigned>(outcome.ending);
        if (layout.unitRotations) {
            const UnitRotation rotation(outcome.farthest.rotation);
            code |= static_cast<unsigned>(rotation.greatest) << 2 | (rotation.negative ? 16U : 0U);
        }
        endings.add(code);
    }
}

void addTimes(std::span<const PartOutcome> outcomes, const Layout& layout, std::uint32_t unit,
              std::vector<std::string>& planes) {
    if (!layout.tickedTimes) {
        Planes times(planes, 8);
        for (const PartOutcome& outcome : outcomes)
            times.add(bitsOf(outcome.time));
        return;
    }
    Planes units(planes, 4);
    Planes steps(planes, 1);
    for (const PartOutcome& outcome : outcomes) {
        const std::uint32_t ticks = *ticksOf(outcome.time);
        units.add(ticks / unit);
        steps.add(*stepsFrom(ticks / kTicks, outcome.time));
    }
}

void addRotations(std::span<const PartOutcome> outcomes, const Layout& layout,
                  std::vector<std::string>& planes) {
    const int components = layout.unitRotations ? 3 : 4;
    for (int i = 0; i < components; ++i) {
        Planes numbers(planes, 8);
        for (const PartOutcome& outcome : outcomes) {
            const base::Quaternion& q = outcome.farthest.rotation;
            numbers.add(bitsOf(layout.unitRotations ? UnitRotation(q).lesser[static_cast<std::size_t>(i)]
                                                    : q.coeffs()[i]));
        }
    }
    if (!layout.unitRotations) return;
    Planes steps(planes, 1);
    for (const PartOutcome& outcome : outcomes)
        steps.add(*UnitRotation(outcome.farthest.rotation).steps);
}

/// What all times are multiples of.
std::uint32_t findUnit(std::span<const PartOutcome> outcomes, const Layout& layout) {
    std::uint32_t unit = 0;
    if (layout.tickedTimes)
        for (const PartOutcome& outcome : outcomes)
            unit = std::gcd(unit, *ticksOf(outcome.time));
    return std::max(unit, std::uint32_t{1});
}

void takeTimes(PlaneReader& planes, const Layout& layout, double unit, std::vector<PartOutcome>& outcomes) {
    const std::vector<std::uint64_t> numbers = planes.take(layout.tickedTimes ? 4 : 8);
    const std::vector<std::uint64_t> steps = planes.take(layout.tickedTimes ? 1 : 0);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        outcomes[i].time = layout.tickedTimes
                               ? stepOn(static_cast<double>(numbers[i]) * unit / kTicks, steps[i])
                               : std::bit_cast<double>(numbers[i]);
    }
}

void takeRotations(PlaneReader& planes, const Layout& layout, const std::vector<std::uint64_t>& codes,
                   std::vector<PartOutcome>& outcomes) {
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

void addEntries(std::span<const PartOutcome> outcomes, std::vector<std::string>& planes) {
    Planes came(planes, 1);
    for (const PartOutcome& outcome : outcomes)
        came.add(outcome.entered ? 1 : 0);
    Planes times(planes, 8);
    for (const PartOutcome& outcome : outcomes)
        times.add(bitsOf(outcome.entered.value_or(0.0)));
}

void addStops(std::span<const Outcome> outcomes, std::vector<std::string>& planes) {
    Planes trials(planes, 4);
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        for (std::size_t k = 0; k < outcomes[i].stops.size(); ++k)
            trials.add(i);
    Planes parts(planes, 4);
    for (const Outcome& outcome : outcomes)
        for (const Stop& stop : outcome.stops)
            parts.add(stop.part);
    for (double Stop::*time : {&Stop::from, &Stop::to}) {
        Planes times(planes, 8);
        for (const Outcome& outcome : outcomes)
            for (const Stop& stop : outcome.stops)
                times.add(bitsOf(stop.*time));
    }
}

void takeEntries(PlaneReader& planes, std::vector<PartOutcome>& outcomes) {
    const std::vector<std::uint64_t> came = planes.take(1);
    const std::vector<std::uint64_t> times = planes.take(8);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        outcomes[i].entered.reset();
        if (came[i] != 0) outcomes[i].entered = std::bit_cast<double>(times[i]);
    }
}

/// False if they are of no trial or no part.
bool takeStops(PlaneReader planes, std::size_t count, std::vector<Outcome>& outcomes) {
    const std::vector<std::uint64_t> trials = planes.take(4);
    const std::vector<std::uint64_t> parts = planes.take(4);
    const std::vector<std::uint64_t> from = planes.take(8);
    const std::vector<std::uint64_t> to = planes.take(8);
    for (std::size_t i = 0; i < count; ++i) {
        if (trials[i] >= outcomes.size() || parts[i] >= outcomes[trials[i]].parts.size()) return false;
        outcomes[trials[i]].stops.push_back(
            {parts[i], std::bit_cast<double>(from[i]), std::bit_cast<double>(to[i])});
    }
    return true;
}

/// A number in four bytes, the least one first.
void appendWord(std::string& bytes, std::uint32_t word) {
    for (int i = 0; i < 4; ++i)
        bytes.push_back(static_cast<char>(word >> (8 * i)));
}

std::uint32_t readWord(std::string_view bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;)
        word = word << 8 | static_cast<unsigned char>(bytes[i]);
    return word;
}

/// Parts by trial.
std::vector<Outcome> group(std::vector<PartOutcome> parts, std::span<const std::uint32_t> counts) {
    std::vector<Outcome> outcomes(counts.size());
    auto from = parts.begin();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto to = from + counts[i];
        outcomes[i].parts.assign(from, to);
        from = to;
    }
    return outcomes;
}

}  // namespace

std::size_t countPackable(std::span<const Outcome> outcomes) {
    std::size_t parts = 0;
    std::size_t stops = 0;
    std::size_t trials = 0;
    while (trials < outcomes.size() && trials < kMostPacked) {
        parts += outcomes[trials].parts.size();
        stops += outcomes[trials].stops.size();
        if (parts > kMostPacked || stops > kMostPacked) break;
        ++trials;
    }
    return trials;
}

std::string packOutcomes(std::span<const Outcome> outcomes) {
    assert(countPackable(outcomes) == outcomes.size());
    std::vector<PartOutcome> parts;
    std::string counts;
    bool single = true;
    std::size_t stops = 0;
    for (const Outcome& outcome : outcomes) {
        stops += outcome.stops.size();
        parts.insert(parts.end(), outcome.parts.begin(), outcome.parts.end());
        appendWord(counts, static_cast<std::uint32_t>(outcome.parts.size()));
        single = single && outcome.parts.size() == 1;
    }
    const bool streamed = stops > 0 || std::ranges::any_of(parts, [](const PartOutcome& part) {
                              return !part.entered || bitsOf(*part.entered) != 0;
                          });
    const Layout layout = findLayout(parts);
    const std::uint32_t unit = findUnit(parts, layout);

    std::vector<std::string> planes(1);
    appendWord(planes.front(), unit);
    if (!single) planes.push_back(counts);
    addEndings(parts, layout, planes);
    addTimes(parts, layout, unit, planes);
    for (int axis = 0; axis < 3; ++axis) {
        Planes positions(planes, 8);
        for (const PartOutcome& outcome : parts)
            positions.add(bitsOf(outcome.farthest.position[axis]));
    }
    addRotations(parts, layout, planes);
    if (streamed) {
        addEntries(parts, planes);
        addStops(outcomes, planes);
    }

    std::string bytes(1, static_cast<char>(kVersion));
    bytes.push_back(static_cast<char>((layout.tickedTimes ? kTicked : 0) |
                                      (layout.unitRotations ? kUnit : 0) | (single ? 0 : kCounted) |
                                      (streamed ? kStreamed : 0)));
    if (!single) appendWord(bytes, static_cast<std::uint32_t>(parts.size()));
    if (streamed) appendWord(bytes, static_cast<std::uint32_t>(stops));
    return bytes + base::compress(planes);
}

base::Result<std::vector<Outcome>> unpackOutcomes(std::string_view bytes, std::size_t count) {
    const base::Error damaged{"These bytes are not " + std::to_string(count) + " outcomes of trials.",
                              base::ErrorKind::damaged};
    if (count > kMostPacked || bytes.size() < 2 || bytes.front() != kVersion ||
        (bytes[1] & ~(kTicked | kUnit | kCounted | kStreamed)) != 0)
        return damaged;
    const Layout layout{(bytes[1] & kTicked) != 0, (bytes[1] & kUnit) != 0};
    const bool counted = (bytes[1] & kCounted) != 0;
    const bool streamed = (bytes[1] & kStreamed) != 0;
    bytes.remove_prefix(2);
    std::size_t partCount = count;
    std::size_t stopCount = 0;
    for (std::size_t* number : {counted ? &partCount : nullptr, streamed ? &stopCount : nullptr}) {
        if (number == nullptr) continue;
        if (bytes.size() < 4) return damaged;
        *number = readWord(bytes);
        bytes.remove_prefix(4);
        if (*number > kMostPacked) return damaged;
    }
    const std::size_t before = 4 + (counted ? 4 * count : 0);
    const std::size_t ofParts = partCount * (bytesEach(layout) + (streamed ? kBytesOfEntry : 0));
    const auto unpacked = base::decompress(bytes, before + ofParts + stopCount * kBytesOfStop);
    if (!unpacked) return damaged;
    const std::string_view plain = *unpacked;
    std::vector<std::uint32_t> counts(count, 1);
    if (counted) {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            counts[i] = readWord(plain.substr(4 + 4 * i));
            sum += counts[i];
        }
        if (sum != partCount) return damaged;
    }

    const double unit = readWord(plain);
    PlaneReader planes(plain.substr(before), partCount);
    std::vector<PartOutcome> parts(partCount);
    const std::vector<std::uint64_t> codes = planes.take(1);
    for (std::size_t i = 0; i < partCount; ++i)
        parts[i].ending = static_cast<Ending>(codes[i] & 3);
    takeTimes(planes, layout, unit, parts);
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<std::uint64_t> numbers = planes.take(8);
        for (std::size_t i = 0; i < partCount; ++i)
            parts[i].farthest.position[axis] = std::bit_cast<double>(numbers[i]);
    }
    takeRotations(planes, layout, codes, parts);
    if (streamed) takeEntries(planes, parts);
    std::vector<Outcome> outcomes = group(std::move(parts), counts);
    if (!takeStops(PlaneReader(plain.substr(before + ofParts), stopCount), stopCount, outcomes))
        return damaged;
    return outcomes;
}

}  // namespace trapwright::trial
