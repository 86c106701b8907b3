#pragma once

#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A closed solid whose corners have exact coordinates, so that what one operation gives can go into the next
/// one without rounding.
class ExactSolid {
 public:
    struct Surface;  // CGAL's

    /// `mesh` closed, without edges of more than two triangles by index, oriented outward, walls of cavities
    /// inward.
    explicit ExactSolid(const TriangleMesh& mesh);
    explicit ExactSolid(std::shared_ptr<const Surface> surface) : surface_(std::move(surface)) {}

    [[nodiscard]] const Surface& surface() const { return *surface_; }
    /// With corners rounded to the nearest numbers.
    [[nodiscard]] TriangleMesh toMesh() const;
    [[nodiscard]] double calcVolume() const;  // [m^3]

 private:
    std::shared_ptr<const Surface> surface_;
};

/// What two solids make together. One is missing if its surface would touch itself in an edge.
struct SolidCombination {
    std::optional<ExactSolid> whole;   // what is in either
    std::optional<ExactSolid> common;  // what is in both; may be empty
    std::optional<ExactSolid> rest;    // what is in the first only; may be empty
};

/// By CGAL's corefinement with exact coordinates; faces of both may lie on each other. Error: a surface
/// crosses itself where it meets the other one.
base::Result<SolidCombination> combineSolids(const ExactSolid& first, const ExactSolid& second);

/// Where the second of two solids should lie.
enum class Touching { fromOutside, fromInside };

/// Of two solids that have corners in common and faces that should lie on each other, but part from there by
/// rounding: exactly taken, what they make would touch itself in the edge between those corners. So the
/// second one grows by next to nothing first. With what is in either, or in the first only; none if the
/// second lies otherwise by more than `tolerance` [m], or touches the first in edges and corners only.
std::optional<SolidCombination> combineTouching(const ExactSolid& first, const ExactSolid& second,
                                                Touching touching, double tolerance);

}  // namespace trapwright::geometry
