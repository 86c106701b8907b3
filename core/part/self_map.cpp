#include "core/part/self_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trapwright::part {

namespace {

using base::Quaternion;
using base::Vec3;

constexpr std::size_t kVertexSamples = 600;
constexpr std::size_t kFaceSamples = 600;

// Multiples of the golden angle fall on no n-fold symmetry.
constexpr double kGoldenAngle = 2.399963229728653;
constexpr int kTurns = 7;

/// Vertices (every k-th of a large mesh) and points spread evenly over the area: a golden-ratio sequence
/// picks the triangle and the place in it.
std::vector<Vec3> sampleSurface(const geometry::TriangleMesh& mesh) {
    std::vector<Vec3> samples;
    const std::size_t stride = mesh.vertices.size() / kVertexSamples + 1;
    for (std::size_t i = 0; i < mesh.vertices.size(); i += stride)
        samples.push_back(mesh.vertices[i]);

    std::vector<double> areas;
    double total = 0.0;
    for (const geometry::Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        total += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
        areas.push_back(total);
    }
    for (std::size_t i = 0; i < kFaceSamples; ++i) {
        const double index = static_cast<double>(i) + 0.5;
        const double target = total * index / static_cast<double>(kFaceSamples);
        const auto found = std::lower_bound(areas.begin(), areas.end(), target);
        const auto triangle = static_cast<std::size_t>(std::min(found, areas.end() - 1) - areas.begin());
        // Roberts' R2 sequence, folded into the triangle.
        double u = std::fmod(index * 0.7548776662466927, 1.0);
        double v = std::fmod(index * 0.5698402909980532, 1.0);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const geometry::Triangle& t = mesh.triangles[triangle];
        const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
        const Vec3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
        const Vec3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
        samples.emplace_back(a + u * (b - a) + v * (c - a));
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Vec3& a, const Vec3& b) { return a.squaredNorm() > b.squaredNorm(); });
    return samples;
}

Quaternion turn(const Vec3& axis, int step) {
    return Quaternion(Eigen::AngleAxisd(step * kGoldenAngle, axis));
}

}  // namespace

SelfMap::SelfMap(const geometry::TriangleMesh& mesh, double slack, double roundness)
    : surface_(mesh), samples_(sampleSurface(mesh)), slack_(slack), roundness_(roundness) {}

bool SelfMap::mapsWithin(const Quaternion& rotation,
                         const std::function<double(const Vec3&)>& allowed) const {
    return std::all_of(samples_.begin(), samples_.end(), [&](const Vec3& sample) {
        return surface_.calcDistance(rotation * sample) <= allowed(sample);
    });
}

bool SelfMap::maps(const Quaternion& rotation) const {
    return calcDeviation(rotation, slack_) <= slack_;
}

bool SelfMap::mapsTurned(const Quaternion& rotation, const Vec3& axis) const {
    return mapsWithin(rotation, [&](const Vec3& sample) {
        return std::max(slack_, roundness_ * (sample - sample.dot(axis) * axis).norm());
    });
}

bool SelfMap::isTurned(const Vec3& axis) const {
    for (int step = 1; step <= kTurns; ++step) {
        if (!mapsTurned(turn(axis, step), axis)) return false;
    }
    return true;
}

bool SelfMap::isSphere() const {
    const std::array<Vec3, 3> axes = {Vec3(0.36, 0.48, 0.8), Vec3(0.8, -0.6, 0.0), Vec3(-0.28, 0.576, 0.768)};
    for (const Vec3& axis : axes) {
        for (int step = 1; step <= kTurns; ++step) {
            const bool mapped = mapsWithin(turn(axis.normalized(), step), [&](const Vec3& sample) {
                return std::max(slack_, roundness_ * sample.norm());
            });
            if (!mapped) return false;
        }
    }
    return true;
}

double SelfMap::calcDeviation(const Quaternion& rotation, double limit) const {
    double largest = 0.0;
    for (const Vec3& sample : samples_) {
        largest = std::max(largest, surface_.calcDistance(rotation * sample));
        if (largest > limit) break;
    }
    return largest;
}

}  // namespace trapwright::part
