#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace trapwright::geometry {

/// Points and polygons as a mesh file lists them, in the unit of the file. Corners are numbers of points that
/// are there; coordinates need not be finite.
struct PolygonSoup {
    std::vector<base::Vec3> points;
    std::vector<int> corners;       // of all polygons, one polygon after the other
    std::vector<std::size_t> ends;  // behind each polygon's last corner

    [[nodiscard]] std::span<const int> polygon(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, ends[i] - begin};
    }
};

}  // namespace trapwright::geometry
