#include "core/track/encoding.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace trapwright::track {

namespace {

double inMillimetres(double length) {
    return length / base::kMillimetre;
}

}  // namespace

Interval spanAcross(const Encoding& encoding, int point) {
    if (encoding.pointEncoding == PointEncoding::free) return {-0.5 * encoding.width, encoding.width};
    const double strip = encoding.width / encoding.points;
    return {-0.5 * encoding.width + strip * point, strip};
}

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
            const Interval interval = spanAcross(encoding, j);
            sections[i].points.emplace_back(interval.low + interval.size * points[next],
                                            encoding.height * points[next + 1]);
        }
    }
    return sections;
}

}  // namespace trapwright::track
