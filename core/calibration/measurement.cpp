#include "core/calibration/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/math.h"

namespace trapwright::calibration {

namespace {

constexpr std::array<std::pair<Method, const char*>, 5> kNames = {{
    {Method::tiltUntilSliding, "tilt-until-sliding"},
    {Method::tiltWhileSliding, "tilt-while-sliding"},
    {Method::bounceHeight, "bounce-height"},
    {Method::bounceTime, "bounce-time"},
    {Method::conveyingSpeed, "conveying-speed"},
}};

/// The mean of what `value` makes of each reading, and its interval, cut to [0, most].
template <class Reading, class Value>
base::Result<Estimate> estimate(std::span<const Reading> readings, double most, const Value& value) {
    if (readings.size() < 2)
        return base::Error{"One reading tells nothing of how sure it is. Take at least two, better five."};
    std::vector<double> values;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const base::Result<double> one = value(readings[i]);
        if (!one) return base::Error{fmt::format("Reading {}: {}", i + 1, one.error().message)};
        values.push_back(*one);
    }
    const stats::MeanEstimate mean = stats::estimateMean(values);
    return Estimate{mean.mean, std::max(0.0, mean.interval.low), std::min(most, mean.interval.high)};
}

/// The numbers of each kind of reading, in their order.
constexpr auto membersOf(const Tilt* /*kind*/) {
    return std::array{&Tilt::angle};
}
constexpr auto membersOf(const BounceHeights* /*kind*/) {
    return std::array{&BounceHeights::drop, &BounceHeights::rebound};
}
constexpr auto membersOf(const BounceTimes* /*kind*/) {
    return std::array{&BounceTimes::flight, &BounceTimes::next};
}
constexpr auto membersOf(const TimedRun* /*kind*/) {
    return std::array{&TimedRun::setPoint, &TimedRun::distance, &TimedRun::time};
}

}  // namespace

Readings emptyReadings(Method method) {
    switch (method) {
        case Method::tiltUntilSliding:
        case Method::tiltWhileSliding:
            return std::vector<Tilt>();
        case Method::bounceHeight:
            return std::vector<BounceHeights>();
        case Method::bounceTime:
            return std::vector<BounceTimes>();
        case Method::conveyingSpeed:
            return std::vector<TimedRun>();
    }
    return {};
}

std::size_t countReadings(const Readings& readings) {
    return std::visit([](const auto& all) { return all.size(); }, readings);
}

std::vector<std::vector<double>> numbersOf(const Readings& readings) {
    return std::visit(
        [](const auto& all) {
            std::vector<std::vector<double>> rows;
            rows.reserve(all.size());
            for (const auto& reading : all) {
                std::vector<double>& row = rows.emplace_back();
                for (const auto number : membersOf(&reading))
                    row.push_back(reading.*number);
            }
            return rows;
        },
        readings);
}

void addReading(Readings& readings, std::span<const double> numbers) {
    std::visit(
        [&](auto& all) {
            auto& reading = all.emplace_back();
            const auto members = membersOf(&reading);
            assert(numbers.size() >= members.size());
            for (std::size_t i = 0; i < members.size(); ++i)
                reading.*members[i] = numbers[i];
        },
        readings);
}

void removeReading(Readings& readings, std::size_t index) {
    std::visit([&](auto& all) { all.erase(all.begin() + static_cast<std::ptrdiff_t>(index)); }, readings);
}

std::string nameOf(Method method) {
    for (const auto& [known, name] : kNames)
        if (known == method) return name;
    return {};
}

std::optional<Method> methodOf(const std::string& name) {
    for (const auto& [method, known] : kNames)
        if (name == known) return method;
    return std::nullopt;
}

base::Result<Estimate> estimateFriction(std::span<const Tilt> readings) {
    constexpr double kMost = 1e3;
    return estimate(readings, kMost, [](const Tilt& reading) -> base::Result<double> {
        if (!(reading.angle > 0.0 && reading.angle < 0.5 * base::kPi)) {
            return base::Error{fmt::format("an angle of {:g} degrees cannot be; it is between 0 and 90.",
                                           reading.angle / base::kDegree)};
        }
        return std::tan(reading.angle);
    });
}

base::Result<Estimate> estimateRestitutionFromHeights(std::span<const BounceHeights> readings) {
    return estimate(readings, 1.0, [](const BounceHeights& reading) -> base::Result<double> {
        if (!(reading.drop > 0.0 && reading.rebound >= 0.0 && reading.rebound <= reading.drop)) {
            return base::Error{
                fmt::format("a rebound of {:g} mm from {:g} mm cannot be; it is never higher than the drop.",
                            reading.rebound / base::kMillimetre, reading.drop / base::kMillimetre)};
        }
        return std::sqrt(reading.rebound / reading.drop);
    });
}

base::Result<Estimate> estimateRestitutionFromTimes(std::span<const BounceTimes> readings) {
    return estimate(readings, 1.0, [](const BounceTimes& reading) -> base::Result<double> {
        if (!(reading.flight > 0.0 && reading.next >= 0.0 && reading.next <= reading.flight)) {
            return base::Error{
                fmt::format("a flight of {:g} s after one of {:g} s cannot be; the second is never longer "
                            "than the first.",
                            reading.next, reading.flight)};
        }
        return reading.next / reading.flight;
    });
}

}  // namespace trapwright::calibration
