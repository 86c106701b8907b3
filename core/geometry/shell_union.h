#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/exact_solid.h"
#include "core/geometry/shell_nesting.h"

namespace trapwright::geometry {

/// What a shell stands for: the outer wall of a body, or the wall of a cavity in one.
struct ShellRole {
    bool isCavity = false;
    std::size_t body = 0;                   // the shell that is the body's outer wall: itself unless a cavity
    bool isDoubtful = false;                // a cavity by its place although the file has it face outward
    std::optional<std::size_t> embeddedIn;  // the body whose material this one lies in wholly
};

/// The bodies that a file's shells mean, from where they lie and how the file has them face.
///
/// A shell inside no other bounds a solid, whichever way it faces; so does one inside a cavity. One inside
/// a solid, without touching anything, is a cavity if it faces inward. If it faces outward, it is a body
/// embedded in the solid where the file has other shells face inward, so that its orientation means
/// something; where all face the same way, it is a cavity, which is doubtful. One that touches or crosses
/// others is a cavity only if it faces inward and nothing of it is outside one other shell.
///
/// `shells` closed; `facedInward` how the file has them, by volume. If most of the volume of shells inside no
/// other faces inward, the file is inside out as a whole. Error: a shell crosses itself where it crosses
/// another one.
base::Result<std::vector<ShellRole>> findShellRoles(const TriangleMesh& mesh,
                                                    const std::vector<Shell>& shells,
                                                    const ShellNesting& nesting,
                                                    std::vector<char> facedInward);

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
