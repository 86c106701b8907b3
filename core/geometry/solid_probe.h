#pragma once

#include <memory>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Where points are as seen from a solid, through CGAL's tree of boxes. Copies what it needs.
class SolidProbe {
 public:
    /// The mesh must be closed and have triangles.
    explicit SolidProbe(const TriangleMesh& mesh);
    ~SolidProbe();
    SolidProbe(SolidProbe&&) noexcept;
    SolidProbe& operator=(SolidProbe&&) noexcept;

    /// The point of the surface that is nearest to the given one. [m]
    [[nodiscard]] base::Vec3 findNearest(const base::Vec3& point) const;
    /// Whether the point is inside; on the surface either answer may come.
    [[nodiscard]] bool isInside(const base::Vec3& point) const;

 private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace trapwright::geometry
