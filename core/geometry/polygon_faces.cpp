#include "core/geometry/polygon_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace trapwright::geometry {

namespace {

using Edge = std::pair<int, int>;
using Loop = std::vector<int>;

/// The triangle on the left of every directed edge. None if an edge occurs twice.
std::optional<std::map<Edge, int>> findLeftTriangles(const TriangleMesh& mesh) {
    std::map<Edge, int> left;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        for (int k = 0; k < 3; ++k)
            if (!left.emplace(Edge{t[k], t[(k + 1) % 3]}, static_cast<int>(i)).second) return std::nullopt;
    }
    return left;
}

double calcDoubleArea(const TriangleMesh& mesh, const Triangle& t) {
    const base::Vec3& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
}

/// Grows regions of coplanar triangles, each from its largest triangle, whose plane is the best known.
/// Returns the region of every triangle and the number of regions.
std::pair<std::vector<int>, int> findRegions(const TriangleMesh& mesh, const std::map<Edge, int>& left,
                                             double tolerance) {
    std::vector<double> areas(mesh.triangles.size());
    for (std::size_t i = 0; i < areas.size(); ++i)
        areas[i] = calcDoubleArea(mesh, mesh.triangles[i]);
    std::vector<int> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });

    std::vector<int> region(mesh.triangles.size(), -1);
    int count = 0;
    for (const int seed : order) {
        if (region[seed] >= 0) continue;
        const base::Vec3 normal = triangleNormal(mesh, seed);
        const base::Vec3& anchor = mesh.vertices[mesh.triangles[seed][0]];
        std::vector<int> open = {seed};
        region[seed] = count;
        while (!open.empty()) {
            const Triangle t = mesh.triangles[open.back()];
            open.pop_back();
            for (int k = 0; k < 3; ++k) {
                const auto neighbour = left.find({t[(k + 1) % 3], t[k]});
                if (neighbour == left.end() || region[neighbour->second] >= 0) continue;
                const Triangle& other = mesh.triangles[neighbour->second];
                const bool coplanar = std::all_of(other.begin(), other.end(), [&](int v) {
                    return std::abs(normal.dot(mesh.vertices[v] - anchor)) <= tolerance;
                });
                if (!coplanar) continue;
                region[neighbour->second] = count;
                open.push_back(neighbour->second);
            }
        }
        ++count;
    }
    return {region, count};
}

/// Chains a region's boundary edges into its one loop. None if it has several loops or touches itself.
std::optional<Loop> chainLoop(const std::map<int, int>& next) {
    if (next.size() < 3) return std::nullopt;
    Loop loop = {next.begin()->first};
    while (true) {
        const auto step = next.find(loop.back());
        if (step == next.end()) return std::nullopt;
        if (step->second == loop.front()) break;
        loop.push_back(step->second);
        if (loop.size() > next.size()) return std::nullopt;
    }
    if (loop.size() != next.size()) return std::nullopt;
    return loop;
}

std::optional<std::vector<Loop>> findLoops(const TriangleMesh& mesh, const std::map<Edge, int>& left,
                                           const std::vector<int>& region, int regions) {
    std::vector<std::map<int, int>> next(regions);
    for (const auto& [edge, triangle] : left) {
        const auto opposite = left.find({edge.second, edge.first});
        if (opposite == left.end()) return std::nullopt;
        if (region[opposite->second] == region[triangle]) continue;
        if (!next[region[triangle]].emplace(edge.first, edge.second).second) return std::nullopt;
    }
    std::vector<Loop> loops;
    std::vector<int> facesAt(mesh.vertices.size(), 0);
    for (const std::map<int, int>& boundary : next) {
        std::optional<Loop> loop = chainLoop(boundary);
        if (!loop) return std::nullopt;
        for (const int vertex : *loop)
            ++facesAt[vertex];
        loops.push_back(std::move(*loop));
    }
    // A vertex between two faces only lies on the line in which their planes meet.
    for (Loop& loop : loops) {
        std::erase_if(loop, [&](int vertex) { return facesAt[vertex] < 3; });
        if (loop.size() < 3) return std::nullopt;
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

/// Renumbers the loops so that only vertices in use remain, in their order.
std::vector<base::Vec3> compactVertices(const TriangleMesh& mesh, std::vector<Loop>& loops) {
    std::vector<int> number(mesh.vertices.size(), -1);
    for (const Loop& loop : loops)
        for (const int vertex : loop)
            number[vertex] = 0;
    std::vector<base::Vec3> vertices;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < 0) continue;
        number[i] = static_cast<int>(vertices.size());
        vertices.push_back(mesh.vertices[i]);
    }
    for (Loop& loop : loops)
        for (int& vertex : loop)
            vertex = number[vertex];
    return vertices;
}

std::optional<PolytopeFace> makeFace(const std::vector<base::Vec3>& vertices, Loop loop) {
    // Newell's normal: the mean plane, little disturbed by the noise of single vertices.
    base::Vec3 normal = base::Vec3::Zero();
    const base::Vec3& anchor = vertices[loop.front()];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        normal += (vertices[loop[i]] - anchor).cross(vertices[loop[i + 1]] - anchor);
    if (normal.squaredNorm() == 0.0) return std::nullopt;
    normal.normalize();
    double offset = normal.dot(anchor);
    for (const int vertex : loop)
        offset = std::max(offset, normal.dot(vertices[vertex]));
    return PolytopeFace{normal, offset, std::move(loop)};
}

bool fillEdges(ConvexPolytope& polytope) {
    std::map<Edge, int> left;
    for (std::size_t i = 0; i < polytope.faces.size(); ++i) {
        const Loop& loop = polytope.faces[i].loop;
        for (std::size_t k = 0; k < loop.size(); ++k)
            if (!left.emplace(Edge{loop[k], loop[(k + 1) % loop.size()]}, static_cast<int>(i)).second)
                return false;
    }
    for (const auto& [edge, face] : left) {
        const auto opposite = left.find({edge.second, edge.first});
        if (opposite == left.end()) return false;
        if (edge.first < edge.second)
            polytope.edges.push_back({edge.first, edge.second, face, opposite->second});
    }
    return true;
}

}  // namespace

std::optional<ConvexPolytope> mergeCoplanarTriangles(const TriangleMesh& mesh, double tolerance) {
    const auto left = findLeftTriangles(mesh);
    if (!left) return std::nullopt;
    const auto [region, regions] = findRegions(mesh, *left, tolerance);
    auto loops = findLoops(mesh, *left, region, regions);
    if (!loops) return std::nullopt;

    ConvexPolytope polytope;
    polytope.vertices = compactVertices(mesh, *loops);
    for (Loop& loop : *loops) {
        std::optional<PolytopeFace> face = makeFace(polytope.vertices, std::move(loop));
        if (!face) return std::nullopt;
        polytope.faces.push_back(std::move(*face));
    }
    if (!fillEdges(polytope)) return std::nullopt;
    return polytope;
}

}  // namespace trapwright::geometry
