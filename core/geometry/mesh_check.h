#pragma once

#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Open edges that hang together: the rim of a hole.
struct MeshHole {
    base::Vec3 centre;       // of the rim [m]
    double perimeter = 0.0;  // [m]
    int edges = 0;
};

/// What is wrong with a mesh as the boundary of a solid. Counts are after welding vertices nearer than
/// kWeldTolerance.
struct MeshReport {
    int nonFiniteVertices = 0;    // triangles at them are left out of everything below
    int duplicateVertices = 0;    // that welding removes
    int degenerateTriangles = 0;  // without area; left out of everything below
    int duplicateTriangles = 0;   // with the same corners as one before; left out of everything below
    int inconsistentEdges = 0;    // of several triangles that do not run along it both ways equally often
    base::Vec3 inconsistentPlace = base::Vec3::Zero();  // the middle of one of them [m]
    int nonManifoldEdges = 0;                           // with more than two triangles
    int openEdges = 0;                                  // with one triangle
    std::vector<MeshHole> holes;                        // largest perimeter first
    int shells = 0;
    int insideOutShells = 0;       // of those that touch no other; only without open and inconsistent edges
    int overlappingTriangles = 0;  // that cross or touch a triangle that is no neighbour; only on request
    double volume = 0.0;           // [m^3]

    /// Whether the mesh bounds a solid as it is: finite, closed, consistently oriented outward, with volume.
    [[nodiscard]] bool isSolid() const;
};

/// Vertices nearer than this times the diagonal of the box are taken for one.
inline constexpr double kWeldTolerance = 1e-6;

/// The tolerance above in metres for this mesh.
double calcWeldTolerance(const TriangleMesh& mesh);

/// Counts what is wrong with a mesh, e.g. one that was just imported or is about to be exported. Looking for
/// overlaps takes much longer than the rest on meshes of more than some ten thousand triangles.
MeshReport checkMesh(const TriangleMesh& mesh, bool findOverlaps = false);

/// "(x, y, z) mm", for messages.
std::string formatPlace(const base::Vec3& point);

}  // namespace trapwright::geometry
