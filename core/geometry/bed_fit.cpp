#include "core/geometry/bed_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trapwright::geometry {

namespace {

constexpr double kRounding = 1e-9;  // of a size; what exactly fits does

double crossOf(const base::Vec2& a, const base::Vec2& b, const base::Vec2& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The two corners of the footprint between which it is widest along this direction.
base::Vec2 findSpan(const std::vector<base::Vec2>& footprint, const base::Vec2& direction) {
    const auto [least, most] = std::minmax_element(
        footprint.begin(), footprint.end(),
        [&](const base::Vec2& a, const base::Vec2& b) { return a.dot(direction) < b.dot(direction); });
    return *most - *least;
}

/// The footprint's size on the bed's axes when it is turned.
base::Vec2 sizeAt(const std::vector<base::Vec2>& footprint, double turn) {
    const base::Vec2 x(std::cos(turn), -std::sin(turn));
    const base::Vec2 y(std::sin(turn), std::cos(turn));
    return {findSpan(footprint, x).dot(x), findSpan(footprint, y).dot(y)};
}

/// Turns at which an edge lies along a side of the bed, in [0, pi), in order.
std::vector<double> listTurns(const std::vector<base::Vec2>& footprint) {
    std::vector<double> turns{0.0};
    for (std::size_t i = 0; i < footprint.size(); ++i) {
        const base::Vec2 edge = footprint[(i + 1) % footprint.size()] - footprint[i];
        for (const double side : {0.0, 0.5 * base::kPi}) {
            const double turn = std::fmod(side - std::atan2(edge.y(), edge.x()) + 4.0 * base::kPi, base::kPi);
            turns.push_back(turn);
        }
    }
    std::sort(turns.begin(), turns.end());
    turns.push_back(base::kPi);
    return turns;
}

}  // namespace

std::vector<base::Vec2> computeFootprint(const TriangleMesh& mesh) {
    std::vector<base::Vec2> points;
    points.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        for (const int vertex : t)
            points.emplace_back(mesh.vertices[vertex].head<2>());
    }
    std::sort(points.begin(), points.end(), [](const base::Vec2& a, const base::Vec2& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<base::Vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t first = hull.size();
        for (const base::Vec2& point : points) {
            while (hull.size() >= first + 2 && crossOf(hull[hull.size() - 2], hull.back(), point) <= 0.0)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

BedFit fitOnBed(const TriangleMesh& mesh, const BuildSpace& space) {
    BedFit best;
    if (mesh.triangles.empty()) return best;
    const std::vector<base::Vec2> footprint = computeFootprint(mesh);
    const double height = calcBoundingBox(mesh).size().z();
    double least = std::numeric_limits<double>::infinity();
    const auto attempt = [&](double turn) {
        const base::Vec2 size = sizeAt(footprint, turn);
        const double share = std::max(size.x() / space.x, size.y() / space.y);
        // Of equal turns the smaller one.
        if (share >= least * (1.0 - kRounding)) return;
        least = share;
        best.turn = turn;
        best.size = {size.x(), size.y(), height};
    };
    // What fits as it lies is not turned, nor is what fits by a quarter turn turned further.
    for (const double turn : {0.0, 0.5 * base::kPi}) {
        attempt(turn);
        if (least <= 1.0 + kRounding) break;
    }
    const std::vector<double> turns = least <= 1.0 + kRounding ? std::vector{0.0} : listTurns(footprint);
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
        attempt(turns[i]);
        if (turns[i + 1] - turns[i] < kRounding) continue;
        // Between them the same corners count; where the shares are equal a tangent tells.
        const double middle = 0.5 * (turns[i] + turns[i + 1]);
        const base::Vec2 x = findSpan(footprint, {std::cos(middle), -std::sin(middle)});
        const base::Vec2 y = findSpan(footprint, {std::sin(middle), std::cos(middle)});
        // (x.x cos - x.y sin) / space.x = (y.x sin + y.y cos) / space.y
        double turn = std::atan2(x.x() / space.x - y.y() / space.y, y.x() / space.y + x.y() / space.x);
        if (turn < 0.0) turn += base::kPi;
        if (turn > turns[i] && turn < turns[i + 1]) attempt(turn);
    }
    const base::Vec3 room(space.x, space.y, space.height);
    for (int axis = 0; axis < 3; ++axis) {
        const double over = best.size[axis] - room[axis];
        if (over > kRounding * room[axis]) best.excess[axis] = over;
    }
    best.fits = best.excess.isZero();
    return best;
}

}  // namespace trapwright::geometry
