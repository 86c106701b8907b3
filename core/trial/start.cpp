#include "core/trial/start.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "core/track/track_solid.h"

namespace trapwright::trial {

namespace {

// Above the lead-in, so that no contact acts at time 0. [m]
constexpr double kClearance = 1e-5;

/// How far the facets of a helix stand out of it at most, on the lead-in: a quad of the mesh is two
/// triangles, and the edge between them lies off the helix by so much in its middle. [m]
double facetsAbove(const track::Track& track) {
    if (track.shape.type == track::FeederType::linear) return 0.0;
    const std::vector<base::Vec2>& points = track.sections.front().points;
    double widest = 0.0;
    for (std::size_t j = 0; j + 1 < points.size(); ++j)
        widest = std::max(widest, points[j + 1].x() - points[j].x());
    return 0.25 * std::abs(std::tan(track.shape.slope)) * widest * track::kLargestBowlStep;
}

base::Quaternion drawRotation(const StartPolicy& policy, base::Random& random) {
    if (!policy.nearPose) return random.rotation();
    // Tilting about two horizontal axes by independent normal angles has no preferred direction.
    const double aboutX = policy.tilt * random.normal();
    const double aboutY = policy.tilt * random.normal();
    const base::Vec3 tilt(aboutX, aboutY, 0.0);
    const double angle = tilt.norm();
    base::Quaternion rotation = *policy.nearPose;
    if (angle > 0.0) rotation = Eigen::AngleAxisd(angle, tilt / angle) * rotation;
    const double heading = random.uniform(0.0, 2.0 * base::kPi);
    return base::Quaternion(Eigen::AngleAxisd(heading, base::Vec3::UnitZ())) * rotation;
}

/// A spiral's ledge where parts start: the plane z = middle - fall y, and where its wall begins.
struct Ledge {
    double middle = 0.0;
    double fall = 0.0;
    double wallAt = 0.0;
};

std::optional<Ledge> ledgeOf(const track::Track& track) {
    const track::Spiral spiral = track::spiralOf(track);
    if (spiral.width == 0.0) return std::nullopt;
    const base::Vec2& inner = track.sections.front().points.front();
    const double fall = std::tan(spiral.inclination);
    return Ledge{inner.y() + fall * inner.x(), fall, inner.x() + spiral.width};
}

/// Onto the ledge, as far to the side as it was drawn but not into the wall. `rotation`: in the tangent
/// frame.
base::Vec3 placeOnLedge(const track::Track& track, const part::Part& part, const Ledge& ledge, double y,
                        const base::Quaternion& rotation) {
    const base::Quaternion inRoom(track.shape.tangentFrame(track.start) * rotation.toRotationMatrix());
    const auto inTrack = [&](double side, const base::Vec3& vertex) {
        const base::Pose pose{inRoom, track.shape.toRoom({track.start, side, 0.0})};
        return track.shape.toTrack(pose.apply(vertex), track.start);
    };
    double outermost = -std::numeric_limits<double>::infinity();
    for (const base::Vec3& vertex : part.hull.vertices)
        outermost = std::max(outermost, inTrack(y, vertex).y());
    y = std::min(y, ledge.wallAt - kClearance - (outermost - y));
    double needed = -std::numeric_limits<double>::infinity();
    for (const base::Vec3& vertex : part.hull.vertices) {
        const base::Vec3 place = inTrack(y, vertex);
        needed = std::max(needed, ledge.middle - ledge.fall * place.y() - place.z());
    }
    return track.shape.toRoom({track.start, y, needed + kClearance + facetsAbove(track)});
}

// The lead-in is flat; of one that is not, the highest point is safe.
double findLeadInHeight(const track::Track& track) {
    double height = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= track.firstTrapSection; ++i) {
        for (const base::Vec2& point : track.sections[static_cast<std::size_t>(i)].points) {
            height = std::max(height, point.y());
        }
    }
    return height;
}

}  // namespace

TrialSpec drawTrial(const track::Track& track, const part::Part& part, const StartPolicy& policy,
                    const base::StreamKey& stream) {
    assert(!part.hull.vertices.empty());
    base::Random random(stream);
    TrialSpec trial;
    trial.stream = stream;
    trial.phase = random.uniform(0.0, 2.0 * base::kPi);
    const double y = random.uniform(-policy.lateral, policy.lateral);
    base::Quaternion inTrack = drawRotation(policy, random);
    PartStart& start = trial.parts.emplace_back();
    if (const auto ledge = ledgeOf(track)) {
        // The frame's second axis points inward on an anticlockwise bowl.
        const bool isInward = track.shape.type == track::FeederType::bowl &&
                              track.shape.conveying == track::Conveying::anticlockwise;
        const double roll = isInward ? std::atan(ledge->fall) : -std::atan(ledge->fall);
        inTrack = base::Quaternion(Eigen::AngleAxisd(roll, base::Vec3::UnitX())) * inTrack;
        start.pose.rotation =
            (base::Quaternion(track.shape.tangentFrame(track.start)) * inTrack).normalized();
        start.pose.position = placeOnLedge(track, part, *ledge, y, inTrack);
        return trial;
    }
    start.pose.rotation = (base::Quaternion(track.shape.tangentFrame(track.start)) * inTrack).normalized();
    const bool climbs = track.shape.type == track::FeederType::bowl && track.shape.slope != 0.0;
    const base::Pose onPlane{start.pose.rotation, track.shape.toRoom({track.start, y, 0.0})};
    double lowest = std::numeric_limits<double>::infinity();
    for (const base::Vec3& vertex : part.hull.vertices) {
        // Upright from a track that climbs around a bowl, which is nowhere the tangent frame's plane.
        lowest = std::min(lowest, climbs ? track.shape.toTrack(onPlane.apply(vertex), track.start).z()
                                         : (inTrack * vertex).z());
    }
    const double clearance = kClearance + (climbs ? facetsAbove(track) : 0.0);
    const double z = findLeadInHeight(track) + clearance - lowest;
    start.pose.position = track.shape.toRoom({track.start, y, z});
    return trial;
}

base::Pose startInTrack(const track::Track& track, const PartStart& start) {
    base::Pose pose;
    pose.position = track.shape.toTrack(start.pose.position, track.start);
    pose.rotation =
        base::Quaternion(track.shape.tangentFrame(pose.position.x()).transpose()) * start.pose.rotation;
    return pose;
}

}  // namespace trapwright::trial
