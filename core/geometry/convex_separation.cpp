#include "core/geometry/convex_separation.h"

#include <algorithm>
#include <limits>

namespace trapwright::geometry {

using base::Pose;
using base::Vec3;

namespace {

/// Edges whose directions are nearer to parallel span no plane. (square of the sine)
constexpr double kParallel = 1e-12;

std::vector<Vec3> moveVertices(const ConvexPolytope& body, const Pose& pose) {
    std::vector<Vec3> moved;
    moved.reserve(body.vertices.size());
    for (const Vec3& vertex : body.vertices)
        moved.push_back(pose.apply(vertex));
    return moved;
}

struct Extent {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};

Extent calcExtent(const std::vector<Vec3>& points, const Vec3& axis) {
    Extent extent;
    for (const Vec3& point : points) {
        const double along = axis.dot(point);
        extent.least = std::min(extent.least, along);
        extent.most = std::max(extent.most, along);
    }
    return extent;
}

/// Unit, each direction once, whichever way it points.
std::vector<Vec3> findDirections(const ConvexPolytope& body, const Pose& pose) {
    std::vector<Vec3> directions;
    for (const PolytopeEdge& edge : body.edges) {
        const Vec3 direction = (body.vertices[static_cast<std::size_t>(edge.to)] -
                                body.vertices[static_cast<std::size_t>(edge.from)])
                                   .normalized();
        const bool known = std::ranges::any_of(
            directions, [&](const Vec3& other) { return direction.cross(other).squaredNorm() < kParallel; });
        if (!known) directions.push_back(direction);
    }
    for (Vec3& direction : directions)
        direction = pose.rotation * direction;
    return directions;
}

/// Stops as soon as `enough` is reached.
double calcSeparation(const ConvexPolytope& a, const Pose& poseA, const ConvexPolytope& b, const Pose& poseB,
                      double enough) {
    const std::vector<Vec3> ofA = moveVertices(a, poseA);
    const std::vector<Vec3> ofB = moveVertices(b, poseB);
    double widest = -std::numeric_limits<double>::infinity();
    const auto look = [&](const Vec3& axis) {
        const Extent alongA = calcExtent(ofA, axis);
        const Extent alongB = calcExtent(ofB, axis);
        widest = std::max({widest, alongB.least - alongA.most, alongA.least - alongB.most});
        return widest >= enough;
    };
    for (const PolytopeFace& face : a.faces)
        if (look(poseA.rotation * face.normal)) return widest;
    for (const PolytopeFace& face : b.faces)
        if (look(poseB.rotation * face.normal)) return widest;
    const std::vector<Vec3> directions = findDirections(b, poseB);
    for (const Vec3& first : findDirections(a, poseA)) {
        for (const Vec3& second : directions) {
            const Vec3 axis = first.cross(second);
            if (axis.squaredNorm() > kParallel && look(axis.normalized())) return widest;
        }
    }
    return widest;
}

}  // namespace

double calcSeparation(const ConvexPolytope& a, const Pose& poseA, const ConvexPolytope& b,
                      const Pose& poseB) {
    return calcSeparation(a, poseA, b, poseB, std::numeric_limits<double>::infinity());
}

bool areApart(const std::vector<ConvexPolytope>& a, const Pose& poseA, const std::vector<ConvexPolytope>& b,
              const Pose& poseB, double clearance) {
    return std::ranges::all_of(a, [&](const ConvexPolytope& first) {
        return std::ranges::all_of(b, [&](const ConvexPolytope& second) {
            return calcSeparation(first, poseA, second, poseB, clearance) >= clearance;
        });
    });
}

}  // namespace trapwright::geometry
