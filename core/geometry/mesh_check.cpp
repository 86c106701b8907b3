#include "core/geometry/mesh_check.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_edges.h"
#include "core/geometry/self_overlap.h"
#include "core/geometry/shell_nesting.h"

namespace trapwright::geometry {

namespace {

/// Takes out triangles at vertices that are not finite.
TriangleMesh takeFinite(const TriangleMesh& mesh, MeshReport& report) {
    std::set<int> broken;
    TriangleMesh finite{mesh.vertices, {}};
    for (const Triangle& triangle : mesh.triangles) {
        bool keep = true;
        for (const int vertex : triangle)
            if (!mesh.vertices[vertex].allFinite()) {
                broken.insert(vertex);
                keep = false;
            }
        if (keep) finite.triangles.push_back(triangle);
    }
    report.nonFiniteVertices = static_cast<int>(broken.size());
    return finite;
}

int countUsedVertices(const TriangleMesh& mesh) {
    std::vector<char> used(mesh.vertices.size(), 0);
    for (const Triangle& triangle : mesh.triangles)
        for (const int vertex : triangle)
            used[vertex] = 1;
    return static_cast<int>(std::count(used.begin(), used.end(), 1));
}

/// Takes out triangles without area and repeated ones.
void dropUseless(TriangleMesh& mesh, MeshReport& report) {
    report.degenerateTriangles = static_cast<int>(std::erase_if(
        mesh.triangles, [&](const Triangle& triangle) { return isDegenerate(mesh, triangle); }));
    std::vector<Triangle> corners = mesh.triangles;
    for (Triangle& triangle : corners)
        std::sort(triangle.begin(), triangle.end());
    const std::vector<char> repeated = findRepeated(corners, mesh.vertices.size());
    std::vector<Triangle> kept;
    kept.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < repeated.size(); ++i)
        if (repeated[i] == 0) kept.push_back(mesh.triangles[i]);
    report.duplicateTriangles = static_cast<int>(mesh.triangles.size() - kept.size());
    mesh.triangles = std::move(kept);
}

/// Groups open edges by common vertices.
std::vector<MeshHole> findHoles(const TriangleMesh& mesh, const EdgeUses& edges) {
    std::map<int, int> group;  // vertex -> number of its rim
    std::vector<std::vector<int>> rims;
    for (const auto& [edge, use] : edges) {
        if (use.count() != 1) continue;
        for (const int vertex : {edge.first, edge.second})
            if (group.emplace(vertex, static_cast<int>(rims.size())).second) rims.push_back({vertex});
        const int into = group[edge.first];
        const int from = group[edge.second];
        if (into == from) continue;
        for (const int vertex : rims[from])
            group[vertex] = into;
        rims[into].insert(rims[into].end(), rims[from].begin(), rims[from].end());
        rims[from].clear();
    }
    std::map<int, MeshHole> holes;
    for (const auto& [edge, use] : edges) {
        if (use.count() != 1) continue;
        const base::Vec3& a = mesh.vertices[edge.first];
        const base::Vec3& b = mesh.vertices[edge.second];
        MeshHole& hole = holes.try_emplace(group[edge.first], MeshHole{base::Vec3::Zero()}).first->second;
        const double length = (b - a).norm();
        hole.centre += 0.5 * length * (a + b);
        hole.perimeter += length;
        ++hole.edges;
    }
    std::vector<MeshHole> result;
    for (auto& [number, hole] : holes) {
        hole.centre /= hole.perimeter;
        result.push_back(hole);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const MeshHole& a, const MeshHole& b) { return a.perimeter > b.perimeter; });
    return result;
}

int countInsideOut(const TriangleMesh& mesh, const std::vector<Shell>& shells) {
    const ShellNesting nesting = findNesting(mesh, shells, calcWeldTolerance(mesh));
    int count = 0;
    for (std::size_t i = 0; i < shells.size(); ++i)
        if (!nesting.isRightWayOut(shells[i], i) && !nesting.hasContact(i)) ++count;
    return count;
}

}  // namespace

bool MeshReport::isSolid() const {
    return nonFiniteVertices == 0 && openEdges == 0 && inconsistentEdges == 0 && insideOutShells == 0 &&
           volume > 0.0;
}

double calcWeldTolerance(const TriangleMesh& mesh) {
    return mesh.triangles.empty() ? 0.0 : kWeldTolerance * calcBoundingBox(mesh).size().norm();
}

MeshReport checkMesh(const TriangleMesh& mesh, bool findOverlaps) {
    MeshReport report;
    const TriangleMesh finite = takeFinite(mesh, report);
    TriangleMesh welded = weldVertices(finite, calcWeldTolerance(finite));
    report.duplicateVertices = countUsedVertices(finite) - static_cast<int>(welded.vertices.size());
    dropUseless(welded, report);

    const EdgeUses edges = collectEdges(welded);
    for (const auto& [edge, use] : edges) {
        if (use.count() == 1) ++report.openEdges;
        if (use.count() > 1 && use.forward != use.backward) {
            ++report.inconsistentEdges;
            report.inconsistentPlace = 0.5 * (welded.vertices[edge.first] + welded.vertices[edge.second]);
        }
        if (use.count() > 2) ++report.nonManifoldEdges;
    }
    report.holes = findHoles(welded, edges);
    const std::vector<Shell> shells = findShells(welded);
    report.shells = static_cast<int>(shells.size());
    if (report.openEdges == 0 && report.inconsistentEdges == 0)
        report.insideOutShells = countInsideOut(welded, shells);
    report.volume = calcMassProperties(welded, 1.0).volume;
    if (findOverlaps)
        report.overlappingTriangles = countOverlappingTriangles(welded, welded.triangles.size());
    return report;
}

std::string formatPlace(const base::Vec3& point) {
    std::array<char, 128> text{};
    const base::Vec3 mm = point / base::kMillimetre;
    std::snprintf(text.data(), text.size(), "(%.3g, %.3g, %.3g) mm", mm.x(), mm.y(), mm.z());
    return text.data();
}

}  // namespace trapwright::geometry
