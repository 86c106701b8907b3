#include "core/geometry/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/mesh_edges.h"
#include "core/geometry/sheet_separation.h"
#include "core/geometry/shell_nesting.h"
#include "core/geometry/shell_union.h"
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

int countOdd(const TriangleMesh& mesh) {
    const EdgeUses edges = collectEdges(mesh);
    return static_cast<int>(std::count_if(edges.begin(), edges.end(),
                                          [](const auto& edge) { return edge.second.count() % 2 != 0; }));
}

/// The triangles whose key is that of none before.
TriangleMesh takeFirsts(const TriangleMesh& mesh, const std::vector<Triangle>& keys) {
    const std::vector<char> repeated = findRepeated(keys, mesh.vertices.size());
    TriangleMesh firsts{mesh.vertices, {}};
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (repeated[i] == 0) firsts.triangles.push_back(mesh.triangles[i]);
    return firsts;
}

/// Drops triangles with the corners of one before. Where solids touch, their faces lie on each other and face
/// either way: then one of each kind stays, if that leaves the surface better closed.
int dropDuplicates(TriangleMesh& mesh) {
    std::vector<Triangle> ways = mesh.triangles;
    for (Triangle& way : ways)
        std::rotate(way.begin(), std::min_element(way.begin(), way.end()), way.end());
    std::vector<Triangle> corners = mesh.triangles;
    for (Triangle& triangle : corners)
        std::sort(triangle.begin(), triangle.end());
    const TriangleMesh once = takeFirsts(mesh, corners);
    const std::size_t before = mesh.triangles.size();
    const std::size_t count = once.triangles.size();
    if (count == before) return 0;
    const TriangleMesh eitherWay = takeFirsts(mesh, ways);
    // A surface that comes whole from either side is that of a viewer, not of solids that touch.
    const bool isTouching = eitherWay.triangles.size() > count && eitherWay.triangles.size() < 2 * count;
    const TriangleMesh& best = isTouching && countOdd(eitherWay) <= countOdd(once) ? eitherWay : once;
    if (countOdd(best) > countOdd(mesh)) return 0;  // parts of shells that overlap
    mesh = best;
    return static_cast<int>(before - mesh.triangles.size());
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

/// Whether the file has each shell face inward: by area, as single triangles of it may face either way.
std::vector<char> findFacedInward(const TriangleMesh& file, const TriangleMesh& mesh,
                                  const std::vector<Shell>& shells) {
    std::vector<char> facedInward;
    for (const Shell& shell : shells) {
        double agreement = 0.0;
        for (const std::size_t i : shell.triangles)
            if (i < file.triangles.size()) {
                const base::Vec3 normal = calcNormal(mesh, i);
                agreement += std::copysign(normal.norm(), normal.dot(calcNormal(file, i)));
            }
        facedInward.push_back((agreement < 0.0) != (shell.volume < 0.0) ? 1 : 0);
    }
    return facedInward;
}

/// Turns shells so that the solid is on their inner side, cavities excepted.
void orientShells(TriangleMesh& mesh, std::vector<Shell>& shells, const std::vector<ShellRole>& roles) {
    for (std::size_t i = 0; i < shells.size(); ++i) {
        if ((shells[i].volume < 0.0) == roles[i].isCavity) continue;
        for (const std::size_t triangle : shells[i].triangles)
            std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
        shells[i].volume = -shells[i].volume;
    }
}

void noteShells(const std::vector<Shell>& shells, const std::vector<ShellRole>& roles,
                std::vector<std::string>& notes) {
    const auto doubtful =
        std::count_if(roles.begin(), roles.end(), [](const ShellRole& role) { return role.isDoubtful; });
    if (doubtful > 0)
        notes.push_back("took " + formatCount(static_cast<int>(doubtful), "shell", "shells") +
                        " for cavities, being wholly inside another one, although facing outward. If solid, "
                        "unite the bodies in CAD");
    if (shells.size() < 2) return;
    const auto cavities =
        std::count_if(shells.begin(), shells.end(), [](const Shell& shell) { return shell.volume < 0.0; });
    notes.push_back("kept " + formatCount(static_cast<int>(shells.size()), "shell", "shells") + ", " +
                    formatCount(static_cast<int>(cavities), "of them a cavity", "of them cavities"));
}

/// Whether each edge has one triangle on either side, taking vertices at one place for different ones.
bool isClosed(const TriangleMesh& mesh) {
    const EdgeUses edges = collectEdges(mesh);
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) {
        return edge.second.forward == 1 && edge.second.backward == 1;
    });
}

base::Status refuseOpen(const TriangleMesh& mesh, double largestHole) {
    if (isClosed(mesh)) return base::success();
    const MeshReport report = checkMesh(mesh);
    if (report.holes.empty() && report.inconsistentEdges == 0) return base::success();
    if (!report.holes.empty())
        return base::Error{
            "the surface is open: " +
            formatCount(static_cast<int>(report.holes.size()), "hole remains", "holes remain") +
            ", the largest of " + describe(report.holes.front()) + ". Only holes of up to " +
            formatMillimetres(largestHole) + " are filled. Close it in CAD and export the part as a solid"};
    return base::Error{"the surface has no inside: surfaces meet in " +
                       formatCount(report.inconsistentEdges, "edge", "edges") + " near " +
                       formatPlace(report.inconsistentPlace) +
                       " without closing a volume. Remove inner walls in CAD and export the part as a solid"};
}

/// Orients shells and unites those that overlap. `file` has the first triangles as they came.
base::Status settleShells(const TriangleMesh& file, RepairedMesh& repaired) {
    std::vector<Shell> shells = findShells(repaired.mesh);
    const ShellNesting nesting = findNesting(repaired.mesh, shells, calcWeldTolerance(repaired.mesh));
    const auto roles =
        findShellRoles(repaired.mesh, shells, nesting, findFacedInward(file, repaired.mesh, shells));
    if (!roles) return roles.error();
    orientShells(repaired.mesh, shells, *roles);
    if (const int turned = countTurned(file, repaired.mesh); turned > 0)
        repaired.notes.push_back("turned " + formatCount(turned, "triangle", "triangles") +
                                 " to face outward");
    const bool isAnyEmbedded = std::any_of(roles->begin(), roles->end(),
                                           [](const ShellRole& role) { return role.embeddedIn.has_value(); });
    if (!nesting.contacts.empty() || isAnyEmbedded) {
        auto united = uniteShells(repaired.mesh, shells, nesting, *roles);
        if (!united) return united.error();
        repaired.mesh = std::move(united->mesh);
        repaired.notes.insert(repaired.notes.end(), united->notes.begin(), united->notes.end());
        shells = findShells(repaired.mesh);
    }
    noteShells(shells, *roles, repaired.notes);
    return base::success();
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
    if (!doSpanVolume(clean.vertices))
        return base::Error{"the mesh has no volume: all of it lies in one plane or line through " +
                           formatPlace(mesh.vertices[mesh.triangles[0][0]]) + ". Export the part as a solid"};
    const MeshReport report = checkMesh(clean);
    if (report.nonManifoldEdges > 0)
        notes.push_back("took surfaces apart at " + formatCount(report.nonManifoldEdges, "edge", "edges") +
                        " where more than two triangles meet");

    const bool isTouching = report.nonManifoldEdges + report.duplicateTriangles > 0;
    base::Result<ClosedSurface> closed =
        closeSurface(isTouching ? separateSheets(clean) : clean, largestHole * size);
    if (!closed) return closed.error();
    for (const MeshHole& hole : closed->filled)
        notes.push_back("filled a hole: " + describe(hole));
    repaired.mesh = std::move(closed->mesh);
    if (const base::Status status = refuseOpen(repaired.mesh, largestHole * size); !status)
        return status.error();
    if (const base::Status status = settleShells(clean, repaired); !status) return status.error();

    const double volume = calcMassProperties(repaired.mesh, 1.0).volume;
    if (!(volume > kSmallestVolume * size * size * size))
        return base::Error{"the mesh has no volume: it is a surface without thickness around " +
                           formatPlace(0.5 * (calcBoundingBox(mesh).low + calcBoundingBox(mesh).high)) +
                           ". Export the part as a solid"};
    return repaired;
}

}  // namespace trapwright::geometry
