#include "tests/peers/box_shape.h"

#include <algorithm>

namespace trapwright::peers {

std::optional<base::Vec3> findBox(const part::Part& part) {
    constexpr double kTolerance = 1e-9;  // [m]
    if (part.pieces.size() != 1) return std::nullopt;
    const std::vector<base::Vec3>& corners = part.pieces.front().vertices;
    if (corners.size() != 8) return std::nullopt;
    const base::Vec3 half = corners.front().cwiseAbs();
    const bool box = std::all_of(corners.begin(), corners.end(), [&](const base::Vec3& corner) {
        return (corner.cwiseAbs() - half).norm() < kTolerance;
    });
    return box ? std::optional(half) : std::nullopt;
}

}  // namespace trapwright::peers
