#include "core/geometry/polygon_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
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

/// Follows a region's border from one of its directed edges until it is back there: around each corner
/// through the region's triangles, so that a corner at which the region touches itself does no harm.
Loop followBorder(const TriangleMesh& mesh, const std::map<Edge, int>& left, const std::vector<int>& region,
                  const Edge& start, std::set<Edge>& done) {
    Loop loop;
    Edge edge = start;
    do {
        done.insert(edge);
        loop.push_back(edge.first);
        int triangle = left.at(edge);
        const int corner = edge.second;
        while (true) {
            const Triangle& t = mesh.triangles[triangle];
            const auto at = static_cast<std::size_t>(std::find(t.begin(), t.end(), corner) - t.begin());
            edge = {corner, t[(at + 1) % 3]};
            const int behind = left.at({edge.second, edge.first});
            if (region[behind] != region[triangle]) break;
            triangle = behind;
        }
    } while (edge != start);
    return loop;
}

/// Twice the area of the loop as seen against the normal; negative for a hole.
double calcDoubleArea(const TriangleMesh& mesh, const Loop& loop, const base::Vec3& normal) {
    base::Vec3 sum = base::Vec3::Zero();
    const base::Vec3& anchor = mesh.vertices[loop.front()];
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (mesh.vertices[loop[i]] - anchor).cross(mesh.vertices[loop[(i + 1) % loop.size()]] - anchor);
    return sum.dot(normal);
}

/// Leaves out corners at which nothing but one straight edge between two faces goes on.
void straightenEdges(const TriangleMesh& mesh, double tolerance, std::vector<FlatFace>& faces) {
    std::map<int, std::set<int>> neighbours;
    for (const FlatFace& face : faces) {
        for (const Loop& loop : face.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                neighbours[loop[i]].insert(loop[(i + 1) % loop.size()]);
                neighbours[loop[(i + 1) % loop.size()]].insert(loop[i]);
            }
        }
    }
    const auto isNeedless = [&](int corner) {
        const std::set<int>& ends = neighbours.at(corner);
        if (ends.size() != 2) return false;
        const base::Vec3& here = mesh.vertices[corner];
        const base::Vec3 back = mesh.vertices[*ends.begin()] - here;
        const base::Vec3 ahead = mesh.vertices[*ends.rbegin()] - here;
        return back.dot(ahead) < 0.0 && back.cross(ahead).norm() <= tolerance * (ahead - back).norm();
    };
    // A loop keeps three corners; then all faces keep them.
    std::set<int> kept;
    for (const FlatFace& face : faces) {
        for (const Loop& loop : face.loops) {
            if (std::count_if(loop.begin(), loop.end(), [&](int v) { return !isNeedless(v); }) < 3)
                kept.insert(loop.begin(), loop.end());
        }
    }
    for (FlatFace& face : faces) {
        for (Loop& loop : face.loops)
            std::erase_if(loop, [&](int v) { return !kept.contains(v) && isNeedless(v); });
    }
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

std::optional<std::vector<FlatFace>> mergeFlatFaces(const TriangleMesh& mesh, double tolerance) {
    const auto left = findLeftTriangles(mesh);
    if (!left) return std::nullopt;
    for (const auto& [edge, triangle] : *left) {
        if (!left->contains({edge.second, edge.first})) return std::nullopt;
    }
    const auto [region, count] = findRegions(mesh, *left, tolerance);
    std::vector<FlatFace> faces(static_cast<std::size_t>(count));
    std::vector<double> largest(faces.size(), -1.0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto number = static_cast<std::size_t>(region[i]);
        const double area = calcDoubleArea(mesh, mesh.triangles[i]);
        if (area <= largest[number]) continue;
        largest[number] = area;
        faces[number].normal = triangleNormal(mesh, i);
    }
    std::set<Edge> done;
    for (const auto& [edge, triangle] : *left) {
        if (region[triangle] == region[left->at({edge.second, edge.first})] || done.contains(edge)) continue;
        FlatFace& face = faces[static_cast<std::size_t>(region[triangle])];
        face.loops.push_back(followBorder(mesh, *left, region, edge, done));
    }
    for (FlatFace& face : faces) {
        std::stable_sort(face.loops.begin(), face.loops.end(), [&](const Loop& a, const Loop& b) {
            return calcDoubleArea(mesh, a, face.normal) > calcDoubleArea(mesh, b, face.normal);
        });
    }
    straightenEdges(mesh, tolerance, faces);
    return faces;
}

}  // namespace trapwright::geometry
