#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/exact_solid.h"
#include "core/geometry/shell_nesting.h"
#include "core/geometry/shell_roles.h"

namespace trapwright::geometry {

/// One shell as a solid, turned outward if it is inside out.
ExactSolid makeOutwardSolid(const TriangleMesh& mesh, const Shell& shell);

/// "shells overlap, at (x, y, z) mm: ..." with what the user can do.
base::Error describeOverlap(const base::Vec3& place, const std::string& why);

struct UnitedShells {
    TriangleMesh mesh;
    std::vector<std::string> notes;  // one for each thing that was done
};

/// Makes one solid of bodies that overlap or share a face, and takes cavities that touch a wall or each other
/// out of their bodies. Bodies that touch in edges and corners only stay apart, as does what nothing touches,
/// with its triangles as they are. `mesh` oriented by the roles. Error, with the place: the union's surface
/// would touch itself in an edge, or a shell crosses itself where it crosses another one.
base::Result<UnitedShells> uniteShells(const TriangleMesh& mesh, const std::vector<Shell>& shells,
                                       const ShellNesting& nesting, const std::vector<ShellRole>& roles);

}  // namespace trapwright::geometry
