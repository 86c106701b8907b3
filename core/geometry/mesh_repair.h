#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Holes whose perimeter is at most this times the diagonal of the box are filled.
inline constexpr double kLargestHole = 0.1;

/// A mesh that bounds a solid, and what had to be done to it, one sentence each for the user.
struct RepairedMesh {
    TriangleMesh mesh;               // closed, consistently oriented; outward, walls of cavities inward
    std::vector<std::string> notes;  // empty if nothing was wrong
};

/// Mends a mesh as it comes from a file: welds vertices, drops degenerate and duplicate triangles, turns
/// triangles that disagree with their neighbours, fills small holes, orients shells outward, or inward where
/// they are cavities (findShellRoles says which are), and unites shells that overlap or share a face, each
/// with a note. Error, naming the place in millimetres and what to do: no triangles, coordinates that are not
/// finite, a hole with a perimeter above `largestHole` times the diagonal of the box, shells that overlap and
/// cannot be united, no volume.
base::Result<RepairedMesh> repairMesh(const TriangleMesh& mesh, double largestHole = kLargestHole);

}  // namespace trapwright::geometry
