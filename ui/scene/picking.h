#pragma once

#include <optional>

#include "ui/scene/camera.h"

namespace trapwright::scene {

/// Where a line of sight meets a mesh first.
struct Hit {
    int triangle = 0;
    double distance = 0.0;  // from the ray's origin [m]
};

/// Looks at every triangle (Moeller and Trumbore 1997); for clicks, not for frames. The mesh lies in the room
/// in this pose.
std::optional<Hit> findHit(const geometry::TriangleMesh& mesh, const base::Pose& pose, const Ray& ray);

}  // namespace trapwright::scene
