#include "core/geometry/print_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "core/geometry/mesh_check.h"
#include "core/geometry/wall_thickness.h"

namespace trapwright::geometry {

namespace {

constexpr double kOnBed = 1e-6;           // of the size; the coordinates of an STL file are good to 1e-7
constexpr double kAngleTolerance = 1e-6;  // [rad]

/// What was found at a triangle.
struct Finding {
    double value = 0.0;  // as PrintFlaw::worst
    double share = 0.0;  // of the triangle that is concerned; 0: nothing was found
};

/// Patches of the triangles with findings that hang together through edges, largest area first. `isWorse`
/// orders the values.
std::vector<PrintFlaw> collectFlaws(const TriangleMesh& mesh, const std::vector<Finding>& findings,
                                    const std::function<bool(double, double)>& isWorse) {
    std::vector<int> root(mesh.triangles.size());
    std::iota(root.begin(), root.end(), 0);
    const auto findRoot = [&](int i) {
        while (root[i] != i)
            i = root[i] = root[root[i]];
        return i;
    };
    std::map<std::pair<int, int>, int> seen;  // an edge's first marked triangle
    for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
        if (findings[i].share == 0.0) continue;
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
            const auto [place, isNew] = seen.try_emplace({low, high}, i);
            if (!isNew) root[findRoot(i)] = findRoot(place->second);
        }
    }

    std::map<int, PrintFlaw> patches;
    for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
        if (findings[i].share == 0.0) continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const double area =
            0.5 * findings[i].share *
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
        PrintFlaw& patch = patches[findRoot(i)];
        if (patch.triangles.empty() || isWorse(findings[i].value, patch.worst))
            patch.worst = findings[i].value;
        patch.triangles.push_back(i);
        patch.area += area;
        patch.centre += area / 3.0 * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]);
    }
    std::vector<PrintFlaw> flaws;
    for (auto& [number, patch] : patches) {
        patch.centre /= patch.area;
        flaws.push_back(std::move(patch));
    }
    std::stable_sort(flaws.begin(), flaws.end(),
                     [](const PrintFlaw& a, const PrintFlaw& b) { return a.area > b.area; });
    return flaws;
}

std::vector<PrintFlaw> findThinWalls(const TriangleMesh& mesh, double thinnest) {
    std::vector<Finding> findings;
    for (const Wall& wall : measureWalls(mesh, thinnest))
        findings.push_back({wall.thickness, wall.share});
    return collectFlaws(mesh, findings, std::less<>());
}

std::vector<PrintFlaw> findOverhangs(const TriangleMesh& mesh, const PrintLimits& limits) {
    double bed = mesh.vertices.front().dot(limits.direction);
    for (const Triangle& t : mesh.triangles) {
        for (const int vertex : t)
            bed = std::min(bed, mesh.vertices[vertex].dot(limits.direction));
    }
    bed += kOnBed * calcBoundingBox(mesh).size().norm();
    std::vector<Finding> findings(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (std::all_of(t.begin(), t.end(),
                        [&](int vertex) { return mesh.vertices[vertex].dot(limits.direction) <= bed; }))
            continue;
        const double angle = std::asin(std::clamp(-triangleNormal(mesh, i).dot(limits.direction), -1.0, 1.0));
        if (angle > limits.steepestOverhang + kAngleTolerance) findings[i] = {angle, 1.0};
    }
    return collectFlaws(mesh, findings, std::greater<>());
}

}  // namespace

PrintReport checkForPrinting(const TriangleMesh& mesh, const PrintLimits& limits) {
    PrintReport report;
    const MeshReport found = checkMesh(mesh, true);
    report.volume = found.volume;
    report.closed = found.isSolid() && found.nonManifoldEdges == 0;
    report.overlappingTriangles = found.overlappingTriangles;
    if (mesh.triangles.empty()) return report;
    report.size = calcBoundingBox(mesh).size();
    if (!report.closed) return report;
    report.thinWalls = findThinWalls(mesh, limits.thinnestWall);
    report.overhangs = findOverhangs(mesh, limits);
    return report;
}

}  // namespace trapwright::geometry
