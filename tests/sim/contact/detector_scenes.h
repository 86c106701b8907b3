#pragma once

#include <memory>
#include <vector>

#include "core/verify/scenes.h"
#include "sim/contact/detector.h"

namespace trapwright::testing {

/// A part and a track prepared for detection.
struct DetectorScene {
    std::shared_ptr<const track::Track> track;
    std::shared_ptr<const part::Part> part;
    contact::ContactTrack contactTrack;
    contact::ContactBody contactBody;

    DetectorScene(std::shared_ptr<const track::Track> t, std::shared_ptr<const part::Part> p)
        : track(std::move(t)),
          part(std::move(p)),
          contactTrack(contact::prepareTrack(track->solid)),
          contactBody(contact::prepareBody(part->pieces)) {}

    /// By a detector that has seen nothing before.
    [[nodiscard]] std::vector<contact::Contact> findAfresh(const base::Pose& pose, double margin) const {
        contact::Detector detector(contactTrack, contactBody);
        std::vector<contact::Contact> contacts;
        detector.findContacts(pose, {}, 0.0, margin, contacts);
        return contacts;
    }
};

/// Height of the lowest corner over the surface right below it. [m]
inline double findClearance(const DetectorScene& scene, const base::Pose& pose) {
    double least = 1e300;
    for (const base::Vec3& vertex : scene.part->hull.vertices) {
        const base::Vec3 corner = pose.apply(vertex);
        least = std::min(least, corner.z() - verify::findSurfaceHeight(*scene.track, corner.x(), corner.y()));
    }
    return least;
}

/// Anyhow over the middle of the rough track, its lowest corner at `clearance` over the surface.
inline base::Pose drawPose(const DetectorScene& scene, base::Random& random, double clearance) {
    base::Pose pose{random.rotation(), {random.uniform(0.06, 0.34), random.uniform(-0.015, 0.015), 0.1}};
    pose.position.z() += clearance - findClearance(scene, pose);
    return pose;
}

}  // namespace trapwright::testing
