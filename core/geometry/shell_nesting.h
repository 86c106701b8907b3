#pragma once

#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// A set of triangles that hang together through common edges.
struct Shell {
    std::vector<std::size_t> triangles;
    double volume = 0.0;  // [m^3], negative if inside out
};

/// The shells in the order of their first triangles. Volumes mean something for closed, consistently oriented
/// shells.
std::vector<Shell> findShells(const TriangleMesh& mesh);

/// The triangles of one shell, with vertices of their own.
TriangleMesh extractShell(const TriangleMesh& mesh, const Shell& shell);

/// Two shells whose surfaces cross, touch or come very near to each other.
struct ShellContact {
    std::size_t first = 0;
    std::size_t second = 0;
    base::Vec3 place = base::Vec3::Zero();  // a point of one of them there [m]
};

/// How closed shells lie to each other.
struct ShellNesting {
    std::vector<std::vector<std::size_t>> around;  // of each shell: those it lies in wholly, without contact
    std::vector<ShellContact> contacts;            // first < second, in ascending order

    [[nodiscard]] bool hasContact(std::size_t shell) const;
    /// Whether its orientation fits: solid inside, or cavity inside if an odd number of shells is around it.
    [[nodiscard]] bool isRightWayOut(const Shell& shell, std::size_t index) const {
        return (around[index].size() % 2 == 0) == (shell.volume >= 0.0);
    }
};

/// Shells that come nearer than `tolerance` [m] to each other are in contact. All of a shell without contact
/// lies on one side of every other shell. By CGAL's trees of boxes and exact predicates.
ShellNesting findNesting(const TriangleMesh& mesh, const std::vector<Shell>& shells, double tolerance);

}  // namespace trapwright::geometry
