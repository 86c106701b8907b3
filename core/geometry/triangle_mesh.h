#pragma once

#include <array>
#include <vector>

#include "core/base/math.h"

namespace trapwright::geometry {

using Triangle = std::array<int, 3>;

/// A triangle mesh, counter-clockwise seen from outside. Vertices in metres.
struct TriangleMesh {
    std::vector<base::Vec3> vertices;
    std::vector<Triangle> triangles;
};

/// Unit normal of triangle `index`; zero for a degenerate one.
base::Vec3 triangleNormal(const TriangleMesh& mesh, std::size_t index);

struct Box {
    base::Vec3 low = base::Vec3::Constant(1e300);
    base::Vec3 high = base::Vec3::Constant(-1e300);

    void include(const base::Vec3& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    [[nodiscard]] base::Vec3 size() const { return high - low; }
};

/// The axis-aligned box around all vertices that a triangle uses. [m]
Box calcBoundingBox(const TriangleMesh& mesh);

/// How many times the mesh winds around the point: 1 inside a closed, outward oriented mesh, 0 outside;
/// between them for an open one. The sum of the triangles' solid angles over 4 pi (Jacobson et al. 2013, with
/// the solid angle of Van Oosterom and Strackee 1983).
double calcWindingNumber(const TriangleMesh& mesh, const base::Vec3& point);

}  // namespace trapwright::geometry
