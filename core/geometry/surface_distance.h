#pragma once

#include <memory>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Distances from points to the surface of a mesh, through a tree of boxes (Eigen's KdBVH). Copies what it
/// needs.
class SurfaceDistance {
 public:
    /// The mesh must have triangles.
    explicit SurfaceDistance(const TriangleMesh& mesh);
    ~SurfaceDistance();
    SurfaceDistance(SurfaceDistance&&) noexcept;
    SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

    /// Distance from the point to the nearest point of a triangle. [m]
    [[nodiscard]] double calcDistance(const base::Vec3& point) const;

 private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace trapwright::geometry
