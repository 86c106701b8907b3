#include "sim/contact/contact_track.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trapwright::contact {

using base::Vec3;

namespace {

/// The two triangles at an edge, with the edge's corner index (0-2: edge from corner c to c + 1) in each.
struct EdgeUse {
    int triangle[2] = {-1, -1};
    int corner[2] = {-1, -1};
};

using EdgeMap = std::map<std::pair<int, int>, EdgeUse>;

EdgeMap findEdges(const geometry::TriangleMesh& mesh, const std::vector<int>& usable) {
    EdgeMap edges;
    for (const int t : usable) {
        for (int c = 0; c < 3; ++c) {
            const int a = mesh.triangles[t][c];
            const int b = mesh.triangles[t][(c + 1) % 3];
            EdgeUse& use = edges[std::minmax(a, b)];
            const int side = use.triangle[0] < 0 ? 0 : 1;
            use.triangle[side] = t;
            use.corner[side] = c;
        }
    }
    return edges;
}

Vec3 edgeNormalOf(const geometry::TriangleMesh& mesh, int triangle, int corner, const Vec3& normal) {
    const Vec3& a = mesh.vertices[mesh.triangles[triangle][corner]];
    const Vec3& b = mesh.vertices[mesh.triangles[triangle][(corner + 1) % 3]];
    return (b - a).cross(normal).normalized();
}

/// Positive where two faces meet in a ridge, negative in a valley. [rad]
double calcConvexity(const Vec3& normal0, const Vec3& normal1, const Vec3& out0) {
    const double angle = std::atan2(normal0.cross(normal1).norm(), normal0.dot(normal1));
    // At a ridge the neighbour's normal leans the way that leads out of this triangle.
    return normal1.dot(out0) >= 0.0 ? angle : -angle;
}

/// Whether the line of an edge goes on in the solid beyond its end: another edge there (`others`, unit, away
/// from that end) leads on above the line. `away`: of the edge beyond its end, unit.
bool goesOnInside(const std::vector<Vec3>& others, const Vec3& away, const Vec3& outward) {
    constexpr double kBend = 0.02;  // less is straight, and needs nothing
    return std::ranges::any_of(others, [&](const Vec3& other) {
        return other.dot(away) > 0.0 && (other - away).dot(outward) > kBend;
    });
}

}  // namespace

ContactTrack prepareTrack(const geometry::TriangleMesh& mesh) {
    ContactTrack track;
    std::vector<int> usable;
    std::vector<int> placeOf(mesh.triangles.size(), -1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 normal = geometry::triangleNormal(mesh, t);
        if (normal.isZero()) continue;
        placeOf[t] = static_cast<int>(track.triangles.size());
        usable.push_back(static_cast<int>(t));
        TrackTriangle triangle;
        triangle.normal = normal;
        triangle.corner = mesh.vertices[mesh.triangles[t][0]];
        triangle.centre = Vec3::Zero();
        for (const int v : mesh.triangles[t])
            triangle.centre += mesh.vertices[v] / 3.0;
        triangle.radius = 0.0;
        for (int c = 0; c < 3; ++c) {
            const Vec3& vertex = mesh.vertices[mesh.triangles[t][c]];
            triangle.radius = std::max(triangle.radius, (vertex - triangle.centre).norm());
            triangle.edgeNormal[c] = edgeNormalOf(mesh, static_cast<int>(t), c, normal);
            triangle.edgeOffset[c] = triangle.edgeNormal[c].dot(vertex) + kEdgeSlack;
        }
        track.triangles.push_back(triangle);
    }

    // Keep the strictly convex edges, and take the slack of their triangles away again.
    std::map<int, std::vector<Vec3>> edgesAtVertex;
    std::map<int, bool> vertexActs;
    const EdgeMap edges = findEdges(mesh, usable);
    const auto directionOf = [&](const std::pair<int, int>& key) -> Vec3 {
        return (mesh.vertices[key.second] - mesh.vertices[key.first]).normalized();
    };
    for (const auto& [key, use] : edges) {
        edgesAtVertex[key.first].push_back(directionOf(key));
        edgesAtVertex[key.second].push_back(-directionOf(key));
    }
    for (const auto& [key, use] : edges) {
        if (use.triangle[1] < 0) continue;
        TrackTriangle& t0 = track.triangles[placeOf[use.triangle[0]]];
        TrackTriangle& t1 = track.triangles[placeOf[use.triangle[1]]];
        const Vec3& out0 = t0.edgeNormal[use.corner[0]];
        const Vec3& out1 = t1.edgeNormal[use.corner[1]];
        if (calcConvexity(t0.normal, t1.normal, out0) < kConvexAngle) continue;
        t0.edgeOffset[use.corner[0]] -= kEdgeSlack;
        t1.edgeOffset[use.corner[1]] -= kEdgeSlack;
        TrackEdge edge;
        edge.direction = directionOf(key);
        edge.into[0] = -out0;
        edge.into[1] = -out1;
        const Vec3 sum = t0.normal + t1.normal;
        // A blade folded flat onto itself has no mean normal: it points away from both faces' insides.
        edge.outward = sum.norm() > 1e-9 ? Vec3(sum.normalized()) : Vec3((out0 + out1).normalized());
        edge.from = mesh.vertices[key.first];
        edge.to = mesh.vertices[key.second];
        if (goesOnInside(edgesAtVertex[key.first], -edge.direction, edge.outward))
            edge.from -= kEdgeSlack * edge.direction;
        if (goesOnInside(edgesAtVertex[key.second], edge.direction, edge.outward))
            edge.to += kEdgeSlack * edge.direction;
        edge.centre = 0.5 * (edge.from + edge.to);
        edge.radius = 0.5 * (edge.to - edge.from).norm();
        track.edges.push_back(edge);
        vertexActs[key.first] = true;
        vertexActs[key.second] = true;
    }
    for (const auto& [vertex, acts] : vertexActs) {
        const std::vector<Vec3>& directions = edgesAtVertex[vertex];
        track.vertices.push_back({mesh.vertices[vertex], static_cast<int>(track.vertexEdges.size()),
                                  static_cast<int>(directions.size())});
        track.vertexEdges.insert(track.vertexEdges.end(), directions.begin(), directions.end());
    }
    return track;
}

}  // namespace trapwright::contact
