#include "sim/contact/contact_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "sim/contact/formulas/scalar.h"

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

/// How far a flank is to act beyond a valley whose other flank is this triangle, with its corner at the
/// valley's begin (kCornerSlack). [m]
double calcValleySlack(const geometry::TriangleMesh& mesh, int triangle, int corner) {
    const Vec3& a = mesh.vertices[mesh.triangles[triangle][corner]];
    const Vec3& b = mesh.vertices[mesh.triangles[triangle][(corner + 1) % 3]];
    const Vec3& top = mesh.vertices[mesh.triangles[triangle][(corner + 2) % 3]];
    const double height = (b - a).cross(top - a).norm() / (b - a).norm();
    return std::clamp(0.5 * height, kEdgeSlack, kCornerSlack);
}

/// How near to a ridge of that convexity [rad] its triangles do not act (scalar::kBorder). Less at blunt
/// ones: a vertex there would have to sink the deeper until a flank holds it again, the less they differ. [m]
double calcRidgeInset(double convexity) {
    constexpr double kBlunt = 30.0 * base::kDegree;
    return scalar::kBorder * std::min(1.0, std::sin(std::min(convexity, kBlunt)) / std::sin(kBlunt));
}

/// What of the surface meets at a vertex, seen from there: the solid is on the inner side of all of it.
class VertexFan {
 public:
    /// a, b: unit, to the triangle's other corners, its normal on the side of a x b.
    void add(const Vec3& a, const Vec3& b) { sectors_.push_back({a, b, a.cross(b).normalized()}); }

    /// Whether what lies this way from the vertex, near to it, is inside the solid.
    [[nodiscard]] bool isInside(const Vec3& way) const {
        // Along the great circle to the middle of one of the triangles: which side of the surface is met
        // first?
        const Vec3 target = (sectors_.front().a + sectors_.front().b).normalized();
        const Vec3 ahead = (target - target.dot(way) * way).normalized();
        const double whole = std::atan2(ahead.dot(target), way.dot(target));
        double first = whole;
        bool leaves = sectors_.front().normal.dot(way) < 0.0;
        for (const Sector& sector : sectors_) {
            double angle = std::atan2(-sector.normal.dot(way), sector.normal.dot(ahead));
            if (angle < 0.0) angle += base::kPi;
            if (!(angle < first)) continue;
            const Vec3 there = std::cos(angle) * way + std::sin(angle) * ahead;
            if (sector.a.cross(there).dot(sector.normal) < -kSame ||
                there.cross(sector.b).dot(sector.normal) < -kSame)
                continue;
            first = angle;
            leaves = sector.normal.dot(way) < 0.0;
        }
        return leaves;
    }

 private:
    static constexpr double kSame = 1e-12;
    struct Sector {
        Vec3 a, b, normal;
    };
    std::vector<Sector> sectors_;
};

/// A ridge as seen from one of its ends.
struct RidgeEnd {
    Vec3 into;       // along it, unit
    Vec3 outward;    // mean of its flanks' normals, unit
    Vec3 normal[2];  // of its flanks, unit
};

/// What meets at a vertex of a mesh.
struct VertexSurroundings {
    std::vector<Vec3> edges;  // away from it, unit
    double shortest = 1e300;  // of the edges [m]
    std::vector<RidgeEnd> ridges;
    VertexFan fan;
};

/// How far a ridge is to act beyond its end there (kCornerSlack). [m]
double calcCornerSlack(const VertexSurroundings& end, const RidgeEnd& ridge) {
    constexpr double kAlike = 0.02;   // what bends by less is still straight
    constexpr double kAstray = 0.06;  // a border's flank bends by less from piece to piece of a bowl
    const Vec3 away = -ridge.into;
    const bool goesOn = std::ranges::any_of(end.ridges, [&](const RidgeEnd& other) {
        return (other.into - away).norm() < kAlike && (other.outward - ridge.outward).norm() < kAlike;
    });
    if (goesOn) return 0.0;
    const double slack = std::min(kCornerSlack, end.shortest);
    if (end.fan.isInside((away - kAlike * ridge.outward).normalized())) return slack;
    // The border of a valley in a bowl: it goes on along nearly the same upright flank, and higher. The flank
    // bends outward there, so that the straight way on is a little outside of it.
    const bool rises = std::ranges::any_of(ridge.normal, [&](const Vec3& normal) {
        const Vec3 inward = (away - kAstray * normal).normalized();
        return std::abs(normal.z()) < kAlike && end.fan.isInside(inward) &&
               std::ranges::any_of(end.ridges, [&](const RidgeEnd& other) {
                   return std::abs(other.into.dot(normal)) < kAstray &&
                          other.into.dot(ridge.outward) > kAstray;
               });
    });
    return rises ? slack : 0.0;
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
            triangle.ridges[c] = 0.0;
        }
        track.triangles.push_back(triangle);
    }

    // Keep the strictly convex edges, and take the slack of their triangles away again.
    std::map<int, VertexSurroundings> surroundings;
    std::vector<std::pair<int, int>> ends;        // of track.edges: mesh vertices
    std::vector<std::array<RidgeEnd, 2>> ridges;  // likewise, as seen from there
    const EdgeMap edges = findEdges(mesh, usable);
    const auto directionOf = [&](const std::pair<int, int>& key) -> Vec3 {
        return (mesh.vertices[key.second] - mesh.vertices[key.first]).normalized();
    };
    for (const auto& [key, use] : edges) {
        const double length = (mesh.vertices[key.second] - mesh.vertices[key.first]).norm();
        for (const int v : {key.first, key.second}) {
            VertexSurroundings& here = surroundings[v];
            here.edges.push_back(v == key.first ? directionOf(key) : Vec3(-directionOf(key)));
            here.shortest = std::min(here.shortest, length);
        }
    }
    for (const int t : usable) {
        for (int c = 0; c < 3; ++c) {
            const Vec3& vertex = mesh.vertices[mesh.triangles[t][c]];
            const Vec3& next = mesh.vertices[mesh.triangles[t][(c + 1) % 3]];
            const Vec3& last = mesh.vertices[mesh.triangles[t][(c + 2) % 3]];
            surroundings[mesh.triangles[t][c]].fan.add((next - vertex).normalized(),
                                                       (last - vertex).normalized());
        }
    }
    for (const auto& [key, use] : edges) {
        if (use.triangle[1] < 0) continue;
        TrackTriangle& t0 = track.triangles[placeOf[use.triangle[0]]];
        TrackTriangle& t1 = track.triangles[placeOf[use.triangle[1]]];
        const Vec3& out0 = t0.edgeNormal[use.corner[0]];
        const Vec3& out1 = t1.edgeNormal[use.corner[1]];
        const double convexity = calcConvexity(t0.normal, t1.normal, out0);
        if (convexity < -kConvexAngle) {
            // No farther than there is something of the other flank to be inside of.
            t0.edgeOffset[use.corner[0]] +=
                calcValleySlack(mesh, use.triangle[1], use.corner[1]) - kEdgeSlack;
            t1.edgeOffset[use.corner[1]] +=
                calcValleySlack(mesh, use.triangle[0], use.corner[0]) - kEdgeSlack;
        }
        if (convexity < kConvexAngle) continue;
        const double taken = kEdgeSlack + calcRidgeInset(convexity);
        t0.edgeOffset[use.corner[0]] -= taken;
        t1.edgeOffset[use.corner[1]] -= taken;
        t0.ridges[use.corner[0]] = kFar;
        t1.ridges[use.corner[1]] = kFar;
        TrackEdge edge;
        edge.direction = directionOf(key);
        edge.into[0] = -out0;
        edge.into[1] = -out1;
        const Vec3 sum = t0.normal + t1.normal;
        // A blade folded flat onto itself has no mean normal: it points away from both faces' insides.
        edge.outward = sum.norm() > 1e-9 ? Vec3(sum.normalized()) : Vec3((out0 + out1).normalized());
        edge.from = mesh.vertices[key.first];
        edge.to = mesh.vertices[key.second];
        edge.centre = Vec3::Zero();  // with its ends, below
        edge.radius = 0.0;
        track.edges.push_back(edge);
        ends.push_back(key);
        ridges.push_back({RidgeEnd{edge.direction, edge.outward, {t0.normal, t1.normal}},
                          RidgeEnd{-edge.direction, edge.outward, {t0.normal, t1.normal}}});
        surroundings[key.first].ridges.push_back(ridges.back()[0]);
        surroundings[key.second].ridges.push_back(ridges.back()[1]);
    }
    for (std::size_t e = 0; e < ends.size(); ++e) {
        TrackEdge& edge = track.edges[e];
        edge.from -= calcCornerSlack(surroundings[ends[e].first], ridges[e][0]) * edge.direction;
        edge.to += calcCornerSlack(surroundings[ends[e].second], ridges[e][1]) * edge.direction;
        edge.centre = 0.5 * (edge.from + edge.to);
        edge.radius = 0.5 * (edge.to - edge.from).norm();
    }
    for (const auto& [vertex, here] : surroundings) {
        if (here.ridges.empty()) continue;
        const std::vector<Vec3>& directions = here.edges;
        track.vertices.push_back({mesh.vertices[vertex], static_cast<int>(track.vertexEdges.size()),
                                  static_cast<int>(directions.size())});
        track.vertexEdges.insert(track.vertexEdges.end(), directions.begin(), directions.end());
    }
    return track;
}

}  // namespace trapwright::contact
