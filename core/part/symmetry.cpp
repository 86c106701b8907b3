#include "core/part/symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/part/rotation_group.h"
#include "core/part/self_map.h"

namespace trapwright::part {

namespace {

using base::kDegree;
using base::kPi;
using base::Quaternion;
using base::Vec3;

constexpr int kHighestOrder = 24;
// Principal moments closer than this share of the largest may be equal ones of a faceted or nearly symmetric
// part.
constexpr double kEqualMoments = 0.03;
constexpr double kSearchStep = 1.0 * kDegree;
constexpr double kSameAxis = 0.5 * kDegree;
constexpr double kSameRotation = 3.0 * kDegree;

struct Axis {
    Vec3 direction;
    int order;
};

Quaternion rotationAbout(const Vec3& axis, double angle) {
    return Quaternion(Eigen::AngleAxisd(angle, axis));
}

/// The highest n for which a turn by 2 pi / n maps the surface onto itself.
int findOrder(const SelfMap& map, const Vec3& axis, int highest) {
    for (int n = highest; n > 1; --n) {
        if (map.maps(rotationAbout(axis, 2.0 * kPi / n))) return n;
    }
    return 1;
}

std::optional<SymmetryGroup> findContinuous(const SelfMap& map, const std::vector<Vec3>& axes) {
    for (const Vec3& axis : axes) {
        if (!map.isTurned(axis)) continue;
        SymmetryGroup group;
        group.continuous = true;
        // Either direction would do; a fixed choice keeps poses and pictures the same.
        Vec3::Index main = 0;
        axis.cwiseAbs().maxCoeff(&main);
        group.axis = axis[main] < 0.0 ? Vec3(-axis) : axis;
        group.flip = map.mapsTurned(rotationAbout(axis.unitOrthogonal(), kPi), axis);
        group.name = group.flip ? "Dinf" : "Cinf";
        return group;
    }
    return std::nullopt;
}

/// A two-fold axis across `axis`, searched over all directions: a scan with a step, then a descent from each
/// place that could come within the slack.
std::optional<Axis> findCrossAxis(const SelfMap& map, const Vec3& axis, double radius) {
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    const auto direction = [&](double angle) { return Vec3(std::cos(angle) * u + std::sin(angle) * v); };
    const auto deviation = [&](double angle, double limit) {
        return map.calcDeviation(rotationAbout(direction(angle), kPi), limit);
    };
    // Half a step off turns the image by a whole step.
    const double coarse = map.slack() + kSearchStep * radius;
    const int steps = static_cast<int>(std::lround(kPi / kSearchStep));
    for (int i = 0; i < steps; ++i) {
        if (deviation(i * kSearchStep, coarse) > coarse) continue;
        double low = (i - 1) * kSearchStep;
        double high = (i + 1) * kSearchStep;
        for (int round = 0; round < 20; ++round) {
            const double a = low + (high - low) / 3.0;
            const double b = high - (high - low) / 3.0;
            if (deviation(a, radius) < deviation(b, radius)) {
                high = b;
            } else {
                low = a;
            }
        }
        const Vec3 found = direction(0.5 * (low + high));
        if (map.maps(rotationAbout(found, kPi))) return Axis{found, 2};
    }
    return std::nullopt;
}

/// Directions of the hull's faces, edges and vertices, opposite and equal ones once.
std::vector<Vec3> collectFeatures(const geometry::ConvexPolytope& hull) {
    std::vector<Vec3> result;
    const auto add = [&](const Vec3& direction) {
        if (direction.norm() < 1e-12) return;
        const Vec3 unit = direction.normalized();
        const bool known = std::any_of(result.begin(), result.end(), [&](const Vec3& other) {
            return std::abs(other.dot(unit)) > std::cos(kSameAxis);
        });
        if (!known) result.push_back(unit);
    };
    const auto vertex = [&](int i) { return hull.vertices[static_cast<std::size_t>(i)]; };
    for (const geometry::PolytopeFace& face : hull.faces)
        add(face.normal);
    for (const Vec3& point : hull.vertices)
        add(point);
    for (const geometry::PolytopeEdge& edge : hull.edges)
        add(0.5 * (vertex(edge.from) + vertex(edge.to)));
    return result;
}

/// The group that the axes generate; axes that do not fit the others are left out.
SymmetryGroup buildGroup(std::vector<Axis> axes) {
    std::stable_sort(axes.begin(), axes.end(),
                     [](const Axis& a, const Axis& b) { return a.order > b.order; });
    SymmetryGroup group;
    for (const Axis& axis : axes) {
        const Quaternion rotation = rotationAbout(axis.direction, 2.0 * kPi / axis.order);
        if (hasRotation(group.rotations, rotation, kSameRotation)) continue;
        if (auto extended = extendGroup(group.rotations, rotation)) group.rotations = std::move(*extended);
    }
    group.name = nameGroup(group.rotations);
    return group;
}

}  // namespace

SymmetryGroup findSymmetry(const geometry::TriangleMesh& mesh, const geometry::ConvexPolytope& hull,
                           const base::Mat3& inertia, const SymmetryOptions& options) {
    double radius = 0.0;
    for (const Vec3& vertex : hull.vertices)
        radius = std::max(radius, vertex.norm());
    const SelfMap map(mesh, options.tolerance * radius, options.roundness);

    const Eigen::SelfAdjointEigenSolver<base::Mat3> solver(inertia);
    const Vec3& moments = solver.eigenvalues();  // ascending
    std::vector<Vec3> axes = {solver.eigenvectors().col(0), solver.eigenvectors().col(1),
                              solver.eigenvectors().col(2)};
    const bool lowEqual = moments[1] - moments[0] < kEqualMoments * moments[2];
    const bool highEqual = moments[2] - moments[1] < kEqualMoments * moments[2];

    if (lowEqual && highEqual) {
        if (map.isSphere()) {
            SymmetryGroup group;
            group.name = "SO3";
            group.sphere = true;
            return group;
        }
        const std::vector<Vec3> features = collectFeatures(hull);
        axes.insert(axes.end(), features.begin(), features.end());
    }
    if (lowEqual || highEqual) {
        if (const auto continuous = findContinuous(map, axes)) return *continuous;
    }

    std::vector<Axis> found;
    for (const Vec3& axis : axes) {
        const int order = findOrder(map, axis, lowEqual || highEqual ? kHighestOrder : 2);
        if (order > 1) found.push_back({axis, order});
    }
    if (lowEqual != highEqual) {
        const Vec3& unique = lowEqual ? axes[2] : axes[0];
        if (const auto cross = findCrossAxis(map, unique, radius)) found.push_back(*cross);
    }
    return buildGroup(std::move(found));
}

}  // namespace trapwright::part
