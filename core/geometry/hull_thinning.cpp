#include "core/geometry/hull_thinning.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/geometry/convex_hull.h"
#include "core/geometry/surface_distance.h"

namespace trapwright::geometry {

namespace {

using base::Vec3;

constexpr double kApart = 0.3;  // corners that are added at once, of the size

/// How far each of the corners is outside the hull of some of them. [m]
std::vector<double> calcDistances(const TriangleMesh& hull, const std::vector<Vec3>& corners) {
    const SurfaceDistance surface(hull);
    std::vector<double> distances;
    distances.reserve(corners.size());
    for (const Vec3& corner : corners)
        distances.push_back(surface.calcDistance(corner));
    return distances;
}

/// Chooses the corner that is farthest outside, and others that are too far, none near one chosen before:
/// fewer hulls have to be made than if there was but one at a time. False if there is none.
bool chooseMore(const std::vector<Vec3>& corners, const std::vector<double>& distances, double tolerance,
                double apart, std::vector<char>& chosen) {
    std::vector<std::size_t> order(corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distances[a] > distances[b]; });
    std::vector<Vec3> added;
    for (const std::size_t i : order) {
        if (distances[i] <= tolerance) break;
        const bool isNear = std::any_of(added.begin(), added.end(), [&](const Vec3& other) {
            return (other - corners[i]).norm() < apart;
        });
        if (isNear || chosen[i] != 0) continue;
        chosen[i] = 1;
        added.push_back(corners[i]);
    }
    return !added.empty();
}

/// The corners farthest along the axes, and those farthest from their line and plane: they span a volume.
std::vector<char> chooseFirst(const std::vector<Vec3>& corners) {
    std::vector<char> chosen(corners.size(), 0);
    const auto choose = [&](auto&& measure) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < corners.size(); ++i)
            if (measure(corners[i]) > measure(corners[best])) best = i;
        chosen[best] = 1;
        return corners[best];
    };
    for (int axis = 0; axis < 3; ++axis) {
        choose([&](const Vec3& p) { return p[axis]; });
        choose([&](const Vec3& p) { return -p[axis]; });
    }
    const Vec3 a = corners.front();
    const Vec3 b = choose([&](const Vec3& p) { return (p - a).norm(); });
    const Vec3 c = choose([&](const Vec3& p) { return (b - a).cross(p - a).norm(); });
    const Vec3 normal = (b - a).cross(c - a);
    choose([&](const Vec3& p) { return normal.dot(p - a); });
    choose([&](const Vec3& p) { return -normal.dot(p - a); });
    return chosen;
}

std::vector<Vec3> take(const std::vector<Vec3>& corners, const std::vector<char>& chosen) {
    std::vector<Vec3> taken;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (chosen[i] != 0) taken.push_back(corners[i]);
    return taken;
}

}  // namespace

base::Result<ThinnedHull> thinHull(std::span<const Vec3> points, double tolerance) {
    auto whole = computeHullMesh(points);
    if (!whole) return whole.error();
    const std::vector<Vec3> corners = whole->vertices;
    const double apart = kApart * calcBoundingBox(*whole).size().norm();
    std::vector<char> chosen = chooseFirst(corners);
    while (true) {
        auto hull = computeHullMesh(take(corners, chosen));
        if (!hull) break;
        const std::vector<double> distances = calcDistances(*hull, corners);
        const double worst = *std::max_element(distances.begin(), distances.end());
        if (worst <= tolerance) return ThinnedHull{std::move(*hull), worst};
        if (!chooseMore(corners, distances, tolerance, apart, chosen)) break;  // rounding
    }
    return ThinnedHull{std::move(*whole), 0.0};
}

}  // namespace trapwright::geometry
