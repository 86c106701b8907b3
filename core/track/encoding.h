#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/track/track.h"

namespace trapwright::track {

/// How a point's y value becomes a place across the track (decisions.md#surface-points).
enum class PointEncoding {
    strip,  // point j keeps within its own strip of width / points, so a section never crosses itself
    free    // the paper's: any place in the box, so a surface may overhang or cross itself
};

/// How values in [0, 1] describe the functional cross-sections (paper, section 4.2.1; decisions.md#genes).
struct Encoding {
    int sections = 5;          // functional ones
    int points = 8;            // per section
    double minLength = 15e-3;  // of a segment [m]
    double maxLength = 36e-3;  // of a segment [m]
    double width = 60e-3;      // of a segment [m]
    double height = 30e-3;     // of a segment [m]
    PointEncoding pointEncoding = PointEncoding::strip;

    [[nodiscard]] std::size_t pointValues() const {
        return 2 * static_cast<std::size_t>(sections) * static_cast<std::size_t>(points);
    }
    [[nodiscard]] std::size_t lengthValues() const { return static_cast<std::size_t>(sections); }
};

/// From low to low + size. [m]
struct Interval {
    double low = 0.0;
    double size = 0.0;
};

/// Where point j of a section may lie across the track, from the inner edge (y = -width / 2) on.
Interval spanAcross(const Encoding& encoding, int point);

/// An error that names the first parameter that is out of its range.
base::Status checkEncoding(const Encoding& encoding);

/// The functional cross-sections; x is measured from the lead-in's end, y in [-width / 2, width / 2], z in
/// [0, height]. The values must be as many as the encoding says, in [0, 1].
std::vector<CrossSection> decodeTrap(const Encoding& encoding, std::span<const double> points,
                                     std::span<const double> lengths);

}  // namespace trapwright::track
