#include "ui/scene/picking.h"

#include <cmath>

namespace trapwright::scene {

namespace {

using base::Vec3;

std::optional<double> distanceTo(const Vec3& a, const Vec3& b, const Vec3& c, const Ray& ray) {
    const Vec3 edge1 = b - a;
    const Vec3 edge2 = c - a;
    const Vec3 across = ray.direction.cross(edge2);
    const double determinant = edge1.dot(across);
    if (std::abs(determinant) < 1e-18) return std::nullopt;
    const Vec3 offset = ray.origin - a;
    const double u = offset.dot(across) / determinant;
    if (u < 0.0 || u > 1.0) return std::nullopt;
    const Vec3 turned = offset.cross(edge1);
    const double v = ray.direction.dot(turned) / determinant;
    if (v < 0.0 || u + v > 1.0) return std::nullopt;
    const double distance = edge2.dot(turned) / determinant;
    if (distance < 0.0) return std::nullopt;
    return distance;
}

}  // namespace

std::optional<Hit> findHit(const geometry::TriangleMesh& mesh, const base::Pose& pose, const Ray& ray) {
    const base::Quaternion back = pose.rotation.conjugate();
    const Ray local{back * (ray.origin - pose.position), back * ray.direction};
    std::optional<Hit> nearest;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const geometry::Triangle& corners = mesh.triangles[i];
        const auto vertex = [&](std::size_t corner) {
            return mesh.vertices[static_cast<std::size_t>(corners[corner])];
        };
        const auto distance = distanceTo(vertex(0), vertex(1), vertex(2), local);
        if (distance && (!nearest || *distance < nearest->distance))
            nearest = {static_cast<int>(i), *distance};
    }
    return nearest;
}

}  // namespace trapwright::scene
