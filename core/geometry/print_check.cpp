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

/// Patches of the marked triangles that hang together through edges, largest area first. `isWorse` orders the
/// triangles' values.
std::vector<PrintFlaw> collectFlaws(const TriangleMesh& mesh, const std::vector<char>& marked,
                                    const std::vector<double>& values,
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
        if (marked[i] == 0) continue;
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
            const auto [place, isNew] = seen.try_emplace({low, high}, i);
            if (!isNew) root[findRoot(i)] = findRoot(place->second);
        }
    }

    std::map<int, PrintFlaw> patches;
    for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
        if (marked[i] == 0) continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const double area =
            0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
        PrintFlaw& patch = patches[findRoot(i)];
        if (patch.triangles.empty() || isWorse(values[i], patch.worst)) patch.worst = values[i];
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
    const std::vector<double> thickness = measureWalls(mesh, thinnest);
    std::vector<char> thin(thickness.size(), 0);
    std::transform(thickness.begin(), thickness.end(), thin.begin(),
                   [&](double value) { return static_cast<char>(value < thinnest); });
    return collectFlaws(mesh, thin, thickness, std::less<>());
}

std::vector<PrintFlaw> findOverhangs(const TriangleMesh& mesh, const PrintLimits& limits) {
    double bed = mesh.vertices.front().dot(limits.direction);
    for (const Triangle& t : mesh.triangles) {
        for (const int vertex : t)
            bed = std::min(bed, mesh.vertices[vertex].dot(limits.direction));
    }
    bed += kOnBed * calcBoundingBox(mesh).size().norm();
    std::vector<double> angles(mesh.triangles.size(), 0.0);
    std::vector<char> hangs(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (std::all_of(t.begin(), t.end(),
                        [&](int vertex) { return mesh.vertices[vertex].dot(limits.direction) <= bed; }))
            continue;
        angles[i] = std::asin(std::clamp(-triangleNormal(mesh, i).dot(limits.direction), -1.0, 1.0));
        hangs[i] = static_cast<char>(angles[i] > limits.steepestOverhang + kAngleTolerance);
    }
    return collectFlaws(mesh, hangs, angles, std::greater<>());
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
