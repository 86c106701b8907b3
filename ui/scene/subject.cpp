#include "ui/scene/subject.h"

#include <algorithm>

#include "ui/scene/pose_row.h"

namespace trapwright::scene {

bool isEmpty(const SceneContents& contents) {
    return !contents.track && !contents.solid && !contents.stablePoses && contents.parts.empty();
}

double tiltOf(const SceneContents& contents) {
    const bool tilted = contents.track && contents.track->shape.type == track::FeederType::linear;
    return tilted ? contents.track->shape.slope : 0.0;
}

Camera homeCamera(const SceneContents& contents) {
    Camera camera = turnedTo(Camera(), StandardView::home);
    camera.tilt = tiltOf(contents);
    // A row is read from the front.
    if (contents.stablePoses) {
        camera.azimuth = -80.0 * base::kDegree;
        camera.elevation = 32.0 * base::kDegree;
    }
    return camera;
}

geometry::Box boxOf(const SceneContents& contents) {
    if (contents.track) return geometry::calcBoundingBox(contents.track->solid);
    if (contents.solid) return geometry::calcBoundingBox(*contents.solid);
    geometry::Box box;
    if (contents.stablePoses) {
        const PoseRow row = makePoseRow(*contents.stablePoses);
        box.include(row.flat.low);
        box.include(row.flat.high);
        for (const base::Pose& pose : row.poses)
            box.include({pose.position.x(), pose.position.y(), 2.0 * pose.position.z()});
    } else {
        for (const PartInScene& shown : contents.parts) {
            const geometry::Box placed = boxOf(*shown.part, shown.pose);
            box.include(placed.low);
            box.include(placed.high);
        }
    }
    return box;
}

std::vector<PartInScene> partsOf(const SceneContents& contents) {
    if (!contents.stablePoses) return contents.parts;
    std::vector<PartInScene> row;
    for (const base::Pose& pose : makePoseRow(*contents.stablePoses).poses)
        row.push_back({contents.stablePoses, pose});
    return row;
}

bool isShadedByHeight(const SceneContents& contents) {
    return contents.heightShading && (contents.track || contents.solid);
}

HeightRange heightRangeOf(const SceneContents& contents) {
    HeightRange range{1e300, -1e300};
    if (contents.track) {
        for (const track::CrossSection& section : contents.track->sections) {
            for (const base::Vec2& point : section.points) {
                range.low = std::min(range.low, point.y());
                range.high = std::max(range.high, point.y());
            }
        }
    } else if (contents.solid) {
        const geometry::Box box = geometry::calcBoundingBox(*contents.solid);
        range = {box.low.z(), box.high.z()};
    } else {
        return {};
    }
    // A flat track needs a range, too.
    if (range.high - range.low < 1e-3) {
        range.low -= 0.5e-3;
        range.high += 0.5e-3;
    }
    return range;
}

}  // namespace trapwright::scene
