#include "core/part/stable_poses.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace trapwright::part {

namespace {

using base::kDegree;
using base::kPi;
using base::Quaternion;
using base::Vec3;
using geometry::ConvexPolytope;
using geometry::PolytopeEdge;

// A pair of faces that are facets of one round surface: at least 24 facets to the circle.
constexpr double kFacetAngle = 15.0 * kDegree;
constexpr double kFacetLift = 0.01;  // lift of the centre of mass between them, as a share of its height
constexpr double kAlikeAngle = 6.0 * kDegree;
constexpr double kAlikeHeight = 0.03;  // of the bounding radius

/// Where a face lets the part go.
struct Neighbour {
    int face = -1;        // across the edge that the foot of the centre of mass is nearest to crossing
    double inside = 0.0;  // distance of the foot from that edge, negative beyond it [m]
};

/// A set of faces that are one pose.
struct Cluster {
    std::size_t face;  // that stands for it
    double probability;
    int multiplicity;
};

class Union {
 public:
    explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i)
            i = parent_[i];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        const std::size_t rootA = find(a);
        const std::size_t rootB = find(b);
        parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
    }

 private:
    std::vector<std::size_t> parent_;
};

Vec3 vertexOf(const ConvexPolytope& hull, int index) {
    return hull.vertices[static_cast<std::size_t>(index)];
}

/// For every face the edge that the centre of mass is nearest to tipping over, or farthest beyond.
std::vector<Neighbour> findWeakestEdges(const ConvexPolytope& hull) {
    std::vector<Neighbour> weakest(hull.faces.size());
    const auto consider = [&](const PolytopeEdge& edge, int face, int across, double direction) {
        const geometry::PolytopeFace& plane = hull.faces[static_cast<std::size_t>(face)];
        const Vec3 from = vertexOf(hull, edge.from);
        const Vec3 along = direction * (vertexOf(hull, edge.to) - from).normalized();
        const Vec3 foot = plane.offset * plane.normal;
        const double inside = plane.normal.cross(along).dot(foot - from);
        Neighbour& best = weakest[static_cast<std::size_t>(face)];
        if (best.face < 0 || inside < best.inside) best = {across, inside};
    };
    for (const PolytopeEdge& edge : hull.edges) {
        consider(edge, edge.left, edge.right, 1.0);
        consider(edge, edge.right, edge.left, -1.0);
    }
    return weakest;
}

/// The lift of the centre of mass from the lower of two neighbouring faces to the top over their edge. [m]
double calcLift(const ConvexPolytope& hull, const PolytopeEdge& edge) {
    const Vec3 from = vertexOf(hull, edge.from);
    const Vec3 along = (vertexOf(hull, edge.to) - from).normalized();
    const double top = (from - from.dot(along) * along).norm();
    return top - std::min(hull.faces[static_cast<std::size_t>(edge.left)].offset,
                          hull.faces[static_cast<std::size_t>(edge.right)].offset);
}

/// A plane that the part may rest on, in the part frame.
struct RestingPlane {
    Vec3 normal;          // outward
    double offset = 0.0;  // from the centre of mass [m]
};

/// Whether the symmetry maps one plane onto the other. With `facetsOnly` only facets of one surface round a
/// continuous group's axis count.
bool areAlike(const SymmetryGroup& symmetry, const RestingPlane& first, const RestingPlane& second,
              double radius, bool facetsOnly) {
    if (symmetry.sphere) return true;
    if (std::abs(first.offset - second.offset) > kAlikeHeight * radius) return false;
    if (symmetry.continuous) {
        const double angleA = std::acos(std::clamp(first.normal.dot(symmetry.axis), -1.0, 1.0));
        const double angleB = std::acos(std::clamp(second.normal.dot(symmetry.axis), -1.0, 1.0));
        if (std::abs(angleA - angleB) < kAlikeAngle) return true;
        return !facetsOnly && symmetry.flip && std::abs(angleA - (kPi - angleB)) < kAlikeAngle;
    }
    if (facetsOnly || symmetry.rotations.empty()) return false;
    // The identity comes first and makes nothing alike but a plane and itself.
    return std::any_of(symmetry.rotations.begin() + 1, symmetry.rotations.end(),
                       [&](const Quaternion& rotation) {
                           return (rotation * first.normal).dot(second.normal) > std::cos(kAlikeAngle);
                       });
}

/// The shortest turn that brings the face down.
Quaternion turnDown(const Vec3& normal) {
    if (normal.z() > 1.0 - 1e-12) return {0.0, 1.0, 0.0, 0.0};  // any horizontal axis would do: x
    return Quaternion::FromTwoVectors(normal, -Vec3::UnitZ());
}

}  // namespace

double calcSolidAngleShare(const ConvexPolytope& hull, std::size_t face) {
    const std::vector<int>& loop = hull.faces[face].loop;
    const Vec3 a = vertexOf(hull, loop[0]).normalized();
    double total = 0.0;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        // Van Oosterom and Strackee 1983.
        const Vec3 b = vertexOf(hull, loop[i]).normalized();
        const Vec3 c = vertexOf(hull, loop[i + 1]).normalized();
        total += 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    }
    return total / (4.0 * kPi);
}

std::vector<StablePose> computeStablePoses(const ConvexPolytope& hull, const SymmetryGroup& symmetry,
                                           bool mergeAlike) {
    const std::size_t count = hull.faces.size();
    const std::vector<Neighbour> weakest = findWeakestEdges(hull);
    double radius = 0.0;
    for (const Vec3& vertex : hull.vertices)
        radius = std::max(radius, vertex.norm());

    // Rolling over an edge that the centre of mass is beyond always lowers it, so this ends.
    std::vector<double> probability(count, 0.0);
    for (std::size_t face = 0; face < count; ++face) {
        std::size_t rest = face;
        for (std::size_t rolls = 0; weakest[rest].inside < 0.0 && rolls < count; ++rolls) {
            rest = static_cast<std::size_t>(weakest[rest].face);
        }
        probability[rest] += calcSolidAngleShare(hull, face);
    }
    const auto stable = [&](std::size_t face) { return weakest[face].inside >= 0.0; };

    Union facets(count);
    for (const PolytopeEdge& edge : hull.edges) {
        const auto left = static_cast<std::size_t>(edge.left);
        const auto right = static_cast<std::size_t>(edge.right);
        if (!stable(left) || !stable(right)) continue;
        const double cosine = hull.faces[left].normal.dot(hull.faces[right].normal);
        const double height = std::min(hull.faces[left].offset, hull.faces[right].offset);
        if (cosine > std::cos(kFacetAngle) && calcLift(hull, edge) < kFacetLift * height)
            facets.join(left, right);
    }
    const auto planeOf = [&](std::size_t face) {
        return RestingPlane{hull.faces[face].normal, hull.faces[face].offset};
    };
    for (std::size_t a = 0; a < count; ++a) {
        if (!stable(a)) continue;
        for (std::size_t b = a + 1; b < count; ++b) {
            if (stable(b) && areAlike(symmetry, planeOf(a), planeOf(b), radius, !mergeAlike))
                facets.join(a, b);
        }
    }

    // The lowest face of a set stands for it: there the part comes to rest.
    std::vector<Cluster> clusters;
    std::vector<std::size_t> clusterOf(count, count);
    for (std::size_t face = 0; face < count; ++face) {
        if (!stable(face)) continue;
        const std::size_t root = facets.find(face);
        if (clusterOf[root] == count) {
            clusterOf[root] = clusters.size();
            clusters.push_back({face, 0.0, 0});
        }
        Cluster& cluster = clusters[clusterOf[root]];
        cluster.probability += probability[face];
        ++cluster.multiplicity;
        if (hull.faces[face].offset < hull.faces[cluster.face].offset - 1e-9 * radius) cluster.face = face;
    }
    // Like faces keep the hull's order, whatever the last bits of their probabilities say.
    const auto rank = [](const Cluster& cluster) { return std::llround(cluster.probability * 1e9); };
    std::stable_sort(clusters.begin(), clusters.end(),
                     [&](const Cluster& a, const Cluster& b) { return rank(a) > rank(b); });

    std::vector<StablePose> poses;
    poses.reserve(clusters.size());
    for (const Cluster& cluster : clusters) {
        const geometry::PolytopeFace& face = hull.faces[cluster.face];
        poses.push_back({turnDown(face.normal), face.offset, cluster.probability, cluster.multiplicity});
    }
    return poses;
}

std::vector<PoseGroup> findPoseGroups(const Part& part) {
    const std::size_t count = part.stablePoses.size();
    double radius = part.boundingRadius;
    for (const StablePose& pose : part.stablePoses)
        radius = std::max(radius, pose.height);
    const auto planeOf = [&](std::size_t pose) {
        const StablePose& stable = part.stablePoses[pose];
        return RestingPlane{stable.rotation.conjugate() * -Vec3::UnitZ(), stable.height};
    };
    Union alike(count);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            if (areAlike(part.symmetry, planeOf(a), planeOf(b), radius, false)) alike.join(a, b);
        }
    }
    std::vector<PoseGroup> groups;
    std::vector<std::size_t> groupOf(count, count);
    for (std::size_t pose = 0; pose < count; ++pose) {
        const std::size_t root = alike.find(pose);
        if (groupOf[root] == count) {
            groupOf[root] = groups.size();
            groups.emplace_back();
        }
        PoseGroup& group = groups[groupOf[root]];
        group.poses.push_back(static_cast<int>(pose));
        group.probability += part.stablePoses[pose].probability;
    }
    const auto rank = [](const PoseGroup& group) { return std::llround(group.probability * 1e9); };
    std::stable_sort(groups.begin(), groups.end(),
                     [&](const PoseGroup& a, const PoseGroup& b) { return rank(a) > rank(b); });
    return groups;
}

int findPoseGroup(const std::vector<PoseGroup>& groups, int pose) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::vector<int>& poses = groups[i].poses;
        if (std::find(poses.begin(), poses.end(), pose) != poses.end()) return static_cast<int>(i);
    }
    return -1;
}

std::string namePoses(std::span<const int> poses) {
    std::string text;
    for (std::size_t first = 0; first < poses.size();) {
        std::size_t last = first;
        while (last + 1 < poses.size() && poses[last + 1] == poses[last] + 1)
            ++last;
        if (!text.empty()) text += ", ";
        text += std::to_string(poses[first] + 1);
        if (last > first) text += "-" + std::to_string(poses[last] + 1);
        first = last + 1;
    }
    return text;
}

NearestPose findStablePose(const Part& part, const Quaternion& orientation) {
    assert(!part.stablePoses.empty());
    const auto downIn = [](const Quaternion& rotation) {
        return Vec3(rotation.conjugate() * -Vec3::UnitZ());
    };
    const auto angleOf = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
    const SymmetryGroup& symmetry = part.symmetry;
    const Vec3 down = downIn(orientation);

    NearestPose nearest{0, 2.0 * kPi};
    for (std::size_t i = 0; i < part.stablePoses.size(); ++i) {
        const Vec3 poseDown = downIn(part.stablePoses[i].rotation);
        double angle = angleOf(down.dot(poseDown));
        if (symmetry.continuous) {
            angle = std::abs(angleOf(down.dot(symmetry.axis)) - angleOf(poseDown.dot(symmetry.axis)));
        }
        if (symmetry.sphere) angle = 0.0;
        if (angle < nearest.angle) nearest = {i, angle};
    }
    return nearest;
}

Quaternion layDown(const Part& part, const Quaternion& orientation) {
    const SymmetryGroup& symmetry = part.symmetry;
    if (symmetry.sphere) return orientation;
    const Quaternion& pose = part.stablePoses[findStablePose(part, orientation).index].rotation;
    Vec3 down = pose.conjugate() * -Vec3::UnitZ();
    if (symmetry.continuous) {
        // Of all the ways to lie around the axis, the one in which it is already turned.
        const double along = down.dot(symmetry.axis);
        const Vec3 now = orientation.conjugate() * -Vec3::UnitZ();
        const Vec3 aside = now - now.dot(symmetry.axis) * symmetry.axis;
        if (aside.norm() > 1e-9)
            down = along * symmetry.axis + std::sqrt(std::max(0.0, 1.0 - along * along)) * aside.normalized();
    }
    return (Quaternion::FromTwoVectors(orientation * down, -Vec3::UnitZ()) * orientation).normalized();
}

LengthInPose findLength(const Part& part, const StablePose& pose) {
    constexpr int kDirections = 720;  // of half a turn
    LengthInPose found;
    double narrowest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kDirections; ++k) {
        const double angle = kPi * k / kDirections;
        const Vec3 along = pose.rotation.conjugate() * Vec3(std::cos(angle), std::sin(angle), 0.0);
        const Vec3 across = pose.rotation.conjugate() * Vec3(-std::sin(angle), std::cos(angle), 0.0);
        const auto extent = [&](const Vec3& direction) {
            std::pair range(std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity());
            for (const Vec3& vertex : part.hull.vertices) {
                range.first = std::min(range.first, direction.dot(vertex));
                range.second = std::max(range.second, direction.dot(vertex));
            }
            return range;
        };
        const auto [left, right] = extent(across);
        if (right - left >= narrowest) continue;
        narrowest = right - left;
        const auto [rear, front] = extent(along);
        found = {front - rear, 0.5 * std::abs(front + rear)};
    }
    return found;
}

LengthInPose findUnevenLength(const Part& part) {
    constexpr double kOften = 0.1;
    assert(!part.stablePoses.empty());
    LengthInPose uneven = findLength(part, part.stablePoses.front());
    for (const StablePose& pose : part.stablePoses) {
        if (pose.probability < kOften) continue;
        const LengthInPose length = findLength(part, pose);
        if (length.offset * uneven.length > uneven.offset * length.length) uneven = length;
    }
    return uneven;
}

namespace {

/// The axis about which the moment of inertia is another than about those across it, which are alike; of
/// three that differ that of the least.
Vec3 findMainAxis(const base::Mat3& inertia) {
    constexpr double kAlike = 0.02;
    const Eigen::SelfAdjointEigenSolver<base::Mat3> solved(inertia);
    const Vec3& moments = solved.eigenvalues();  // rising
    const bool isFlat =
        moments[1] - moments[0] < kAlike * moments[1] && moments[2] - moments[1] > kAlike * moments[2];
    return solved.eigenvectors().col(isFlat ? 2 : 0);
}

}  // namespace

std::optional<base::Quaternion> findHanging(const Part& part) {
    constexpr double kAsWide = 0.9;  // of the greatest distance from the axis
    constexpr double kAbove = 0.05;  // the centre of mass, in bounding radii
    if (part.symmetry.sphere) return std::nullopt;
    const Vec3 axis = findMainAxis(part.massProperties.inertia);
    const auto radiusOf = [&](const Vec3& vertex) { return axis.cross(vertex).norm(); };
    const double widest = radiusOf(*std::ranges::max_element(part.hull.vertices, {}, radiusOf));
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec3& vertex : part.hull.vertices) {
        if (radiusOf(vertex) < kAsWide * widest) continue;
        low = std::min(low, axis.dot(vertex));
        high = std::max(high, axis.dot(vertex));
    }
    const double above = std::max(low, -high);
    if (above < kAbove * part.boundingRadius) return std::nullopt;
    return base::Quaternion::FromTwoVectors(low > 0.0 ? axis : Vec3(-axis), Vec3::UnitZ());
}

}  // namespace trapwright::part
