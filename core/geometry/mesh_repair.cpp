#include "core/geometry/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/mesh_edges.h"
#include "core/geometry/surface_closing.h"

namespace trapwright::geometry {

namespace {

constexpr double kSmallestVolume = 1e-9;  // of the cube of the size

std::string formatCount(int count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string formatMillimetres(double length) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.3g mm", length / base::kMillimetre);
    return text.data();
}

std::string describe(const MeshHole& hole) {
    return formatCount(hole.edges, "edge", "edges") + " around " + formatPlace(hole.centre) + ", " +
           formatMillimetres(hole.perimeter) + " long";
}

base::Status refuseBrokenInput(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return base::Error{"the mesh has no triangles. Export the part as a solid"};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const int vertex : mesh.triangles[i]) {
            if (mesh.vertices[vertex].allFinite()) continue;
            for (const int other : mesh.triangles[i])
                if (mesh.vertices[other].allFinite())
                    return base::Error{
                        "triangle " + std::to_string(i) + " at " + formatPlace(mesh.vertices[other]) +
                        " has a coordinate that is not a finite number. Export the part again"};
            return base::Error{"triangle " + std::to_string(i) +
                               " has coordinates that are not finite numbers. Export the part again"};
        }
    return base::success();
}

int countUnbalanced(const TriangleMesh& mesh) {
    const EdgeUses edges = collectEdges(mesh);
    return static_cast<int>(
        std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second.count() != 2; }));
}

/// Drops triangles with two equal corners. Those that are flat but have three different corners may be what
/// joins their neighbours: they go only where that does not open the surface.
int dropDegenerates(TriangleMesh& mesh) {
    const std::size_t before = mesh.triangles.size();
    std::erase_if(mesh.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    TriangleMesh without = mesh;
    std::erase_if(without.triangles, [&](const Triangle& t) { return isDegenerate(mesh, t); });
    if (without.triangles.size() < mesh.triangles.size() && countUnbalanced(without) <= countUnbalanced(mesh))
        mesh.triangles = std::move(without.triangles);
    return static_cast<int>(before - mesh.triangles.size());
}

int dropDuplicates(TriangleMesh& mesh) {
    const std::size_t before = mesh.triangles.size();
    std::set<Triangle> known;
    std::erase_if(mesh.triangles, [&](Triangle key) {
        std::sort(key.begin(), key.end());
        return !known.insert(key).second;
    });
    return static_cast<int>(before - mesh.triangles.size());
}

/// Turns shells so that the solid is on the inner side, cavities excepted.
void orientShells(TriangleMesh& mesh, std::vector<Shell>& shells) {
    for (Shell& shell : shells) {
        if (shell.isRightWayOut()) continue;
        for (const std::size_t i : shell.triangles)
            std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
        shell.volume = -shell.volume;
    }
}

base::Vec3 calcNormal(const TriangleMesh& mesh, std::size_t i) {
    const Triangle& t = mesh.triangles[i];
    return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

int countTurned(const TriangleMesh& before, const TriangleMesh& after) {
    int turned = 0;
    for (std::size_t i = 0; i < before.triangles.size(); ++i)
        if (calcNormal(before, i).dot(calcNormal(after, i)) < 0.0) ++turned;
    return turned;
}

void noteShells(const std::vector<Shell>& shells, std::vector<std::string>& notes) {
    if (shells.size() < 2) return;
    const auto cavities =
        std::count_if(shells.begin(), shells.end(), [](const Shell& shell) { return shell.depth % 2 == 1; });
    notes.push_back("kept " + formatCount(static_cast<int>(shells.size()), "shell", "shells") + ", " +
                    formatCount(static_cast<int>(cavities), "of them a cavity", "of them cavities"));
}

}  // namespace

base::Result<RepairedMesh> repairMesh(const TriangleMesh& mesh, double largestHole) {
    if (const base::Status status = refuseBrokenInput(mesh); !status) return status.error();
    const double size = calcBoundingBox(mesh).size().norm();
    RepairedMesh repaired;
    std::vector<std::string>& notes = repaired.notes;

    TriangleMesh clean = weldVertices(mesh, calcWeldTolerance(mesh));
    if (const int count = dropDegenerates(clean); count > 0)
        notes.push_back("dropped " + formatCount(count, "triangle", "triangles") + " without area");
    if (const int count = dropDuplicates(clean); count > 0)
        notes.push_back("dropped " + formatCount(count, "repeated triangle", "repeated triangles"));
    if (!computeConvexHull(clean))
        return base::Error{"the mesh has no volume: all of it lies in one plane or line through " +
                           formatPlace(mesh.vertices[mesh.triangles[0][0]]) + ". Export the part as a solid"};
    if (const MeshReport report = checkMesh(clean); report.nonManifoldEdges > 0)
        notes.push_back("took surfaces apart at " + formatCount(report.nonManifoldEdges, "edge", "edges") +
                        " where more than two triangles meet");

    base::Result<ClosedSurface> closed = closeSurface(clean, largestHole * size);
    if (!closed) return closed.error();
    for (const MeshHole& hole : closed->filled)
        notes.push_back("filled a hole: " + describe(hole));
    repaired.mesh = std::move(closed->mesh);
    const MeshReport after = checkMesh(repaired.mesh);
    if (!after.holes.empty())
        return base::Error{"the surface is open: " +
                           formatCount(static_cast<int>(after.holes.size()), "hole remains", "holes remain") +
                           ", the largest of " + describe(after.holes.front()) + ". Only holes of up to " +
                           formatMillimetres(largestHole * size) +
                           " are filled. Close it in CAD and export the part as a solid"};

    if (after.inconsistentEdges > 0)
        return base::Error{
            "the surface has no inside: surfaces meet in " +
            formatCount(after.inconsistentEdges, "edge", "edges") + " near " +
            formatPlace(after.inconsistentPlace) +
            " without closing a volume. Remove inner walls in CAD and export the part as a solid"};

    std::vector<Shell> shells = findShells(repaired.mesh);
    orientShells(repaired.mesh, shells);
    if (const int turned = countTurned(clean, repaired.mesh); turned > 0)
        notes.push_back("turned " + formatCount(turned, "triangle", "triangles") + " to face outward");
    noteShells(shells, notes);

    const double volume = calcMassProperties(repaired.mesh, 1.0).volume;
    if (!(volume > kSmallestVolume * size * size * size))
        return base::Error{"the mesh has no volume: it is a surface without thickness around " +
                           formatPlace(0.5 * (calcBoundingBox(mesh).low + calcBoundingBox(mesh).high)) +
                           ". Export the part as a solid"};
    return repaired;
}

}  // namespace trapwright::geometry
