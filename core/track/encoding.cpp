#include "core/track/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace trapwright::track {

namespace {

// A section that was written with a few digits may stick out of its range by this much of it.
constexpr double kSlack = 1e-6;

// The interval of y that the value of point j spans. [m]
struct Interval {
    double low;
    double size;
};

Interval findInterval(const Encoding& encoding, int point) {
    if (encoding.pointEncoding == PointEncoding::free) return {-0.5 * encoding.width, encoding.width};
    const double strip = encoding.width / encoding.points;
    return {-0.5 * encoding.width + strip * point, strip};
}

// Where x lies in [low, low + size], as a value in [0, 1]; nothing if it lies outside.
std::optional<double> findValue(double x, const Interval& interval) {
    if (interval.size <= 0.0) {
        return std::abs(x - interval.low) <= kSlack * std::abs(interval.low) ? std::optional(0.0)
                                                                             : std::nullopt;
    }
    const double value = (x - interval.low) / interval.size;
    if (!(value >= -kSlack && value <= 1.0 + kSlack)) return std::nullopt;
    return std::clamp(value, 0.0, 1.0);
}

double inMillimetres(double length) {
    return length / base::kMillimetre;
}

}  // namespace

base::Status checkEncoding(const Encoding& encoding) {
    if (encoding.sections < 1) {
        return base::Error{
            fmt::format("The number of cross-sections is {}; a trap needs at least 1.", encoding.sections)};
    }
    if (encoding.points < 2) {
        return base::Error{fmt::format(
            "The number of points per cross-section is {}; a surface needs at least 2.", encoding.points)};
    }
    const struct {
        const char* name;
        double value;
    } lengths[] = {{"minimal segment length", encoding.minLength},
                   {"maximal segment length", encoding.maxLength},
                   {"segment width", encoding.width},
                   {"segment height", encoding.height}};
    for (const auto& [name, value] : lengths) {
        if (!(value > 0.0 && std::isfinite(value))) {
            return base::Error{
                fmt::format("The {} is {:g} mm; it must be greater than 0.", name, inMillimetres(value))};
        }
    }
    if (encoding.minLength > encoding.maxLength) {
        return base::Error{fmt::format(
            "The minimal segment length ({:g} mm) is greater than the maximal segment length ({:g} mm).",
            inMillimetres(encoding.minLength), inMillimetres(encoding.maxLength))};
    }
    return base::success();
}

std::vector<CrossSection> decodeTrap(const Encoding& encoding, std::span<const double> points,
                                     std::span<const double> lengths) {
    assert(points.size() == encoding.pointValues() && lengths.size() == encoding.lengthValues());
    std::vector<CrossSection> sections(lengths.size());
    double x = 0.0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        x += encoding.minLength + (encoding.maxLength - encoding.minLength) * lengths[i];
        sections[i].x = x;
        sections[i].points.reserve(static_cast<std::size_t>(encoding.points));
        for (int j = 0; j < encoding.points; ++j, next += 2) {
            const Interval interval = findInterval(encoding, j);
            sections[i].points.emplace_back(interval.low + interval.size * points[next],
                                            encoding.height * points[next + 1]);
        }
    }
    return sections;
}

base::Result<EncodedTrap> encodeTrap(const Encoding& encoding, std::span<const CrossSection> sections) {
    if (sections.size() != encoding.lengthValues()) {
        return base::Error{fmt::format("The trap has {} cross-sections; the encoding has {}.",
                                       sections.size(), encoding.sections)};
    }
    EncodedTrap encoded;
    double previous = 0.0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const CrossSection& section = sections[i];
        if (section.points.size() != static_cast<std::size_t>(encoding.points)) {
            return base::Error{fmt::format("Cross-section {} has {} points; the encoding has {}.", i + 1,
                                           section.points.size(), encoding.points)};
        }
        const auto length =
            findValue(section.x - previous, {encoding.minLength, encoding.maxLength - encoding.minLength});
        if (!length) {
            return base::Error{fmt::format(
                "Cross-section {} is {:g} mm from the one before; segments may be {:g} to {:g} mm long.",
                i + 1, inMillimetres(section.x - previous), inMillimetres(encoding.minLength),
                inMillimetres(encoding.maxLength))};
        }
        encoded.lengths.push_back(*length);
        previous = section.x;
        for (int j = 0; j < encoding.points; ++j) {
            const base::Vec2& point = section.points[static_cast<std::size_t>(j)];
            const Interval interval = findInterval(encoding, j);
            const auto y = findValue(point.x(), interval);
            const auto z = findValue(point.y(), {0.0, encoding.height});
            if (!y || !z) {
                return base::Error{
                    fmt::format("Point {} of cross-section {} is at (y, z) = ({:g}, {:g}) mm; y may be {:g} "
                                "to {:g} mm and z 0 "
                                "to {:g} mm.",
                                j + 1, i + 1, inMillimetres(point.x()), inMillimetres(point.y()),
                                inMillimetres(interval.low), inMillimetres(interval.low + interval.size),
                                inMillimetres(encoding.height))};
            }
            encoded.points.push_back(*y);
            encoded.points.push_back(*z);
        }
    }
    return encoded;
}

}  // namespace trapwright::track
