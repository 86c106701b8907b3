#include "core/trial/finish.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace trapwright::trial {

namespace {

using base::Vec2;

constexpr double kStep = 1e-4;   // between the lines along the track on which heights are compared [m]
constexpr double kEqual = 2e-5;  // heights of the centre that count as one [m]
constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Heights on lines along the track, kStep apart: of the lowest points of a part, or of the highest of a
/// track.
struct Profile {
    int first = 0;                // line: y = first * kStep
    std::vector<double> heights;  // infinite where there is nothing

    [[nodiscard]] double at(int line) const {
        const int place = line - first;
        return place >= 0 && place < static_cast<int>(heights.size())
                   ? heights[static_cast<std::size_t>(place)]
                   : kNothing;
    }
    [[nodiscard]] int last() const { return first + static_cast<int>(heights.size()) - 1; }
};

Profile emptyProfile(double low, double high, double height) {
    Profile profile;
    profile.first = static_cast<int>(std::floor(low / kStep));
    const auto count = static_cast<std::size_t>(std::ceil(high / kStep)) - profile.first + 1;
    profile.heights.assign(count, height);
    return profile;
}

/// Calls `use` with every line that the stretch from a to b crosses, and the height there.
template <class Use>
void cross(const Vec2& a, const Vec2& b, Use use) {
    const Vec2& left = a.x() <= b.x() ? a : b;
    const Vec2& right = a.x() <= b.x() ? b : a;
    const double width = right.x() - left.x();
    for (int line = static_cast<int>(std::ceil(left.x() / kStep)); line * kStep <= right.x(); ++line) {
        const double share = width > 0.0 ? (line * kStep - left.x()) / width : 0.0;
        use(line, left.y() + share * (right.y() - left.y()));
    }
}

/// How much shorter heights are along the upward axis of the frame at the finish than upright.
double leanOf(const track::Track& track) {
    return track::orientationFrame(track, track.finish).col(2).z();
}

/// The last functional section, which the lead-out and the chute repeat, in the frame at the finish.
Profile surfaceOf(const track::Track& track) {
    std::vector<Vec2> points = track.sections[static_cast<std::size_t>(track.lastTrapSection)].points;
    for (Vec2& point : points)
        point.y() *= leanOf(track);
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    Profile profile = emptyProfile(low->x(), high->x(), -kNothing);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        cross(points[i], points[i + 1], [&](int line, double height) {
            double& here = profile.heights[static_cast<std::size_t>(line - profile.first)];
            here = std::max(here, height);
        });
    }
    return profile;
}

/// The part's lowest points seen along the track, about its centre of mass.
Profile undersideOf(const part::Part& part, const base::Mat3& toTrack) {
    std::vector<Vec2> seen;
    double low = kNothing;
    double high = -kNothing;
    for (const base::Vec3& vertex : part.mesh.vertices) {
        const base::Vec3 turned = toTrack * vertex;
        seen.emplace_back(turned.y(), turned.z());
        low = std::min(low, turned.y());
        high = std::max(high, turned.y());
    }
    Profile profile = emptyProfile(low, high, kNothing);
    for (const geometry::Triangle& triangle : part.mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            cross(seen[static_cast<std::size_t>(triangle[i])],
                  seen[static_cast<std::size_t>(triangle[(i + 1) % 3])], [&](int line, double height) {
                      double& here = profile.heights[static_cast<std::size_t>(line - profile.first)];
                      here = std::min(here, height);
                  });
        }
    }
    return profile;
}

/// How high the centre must be for the part to touch the surface, `shift` lines from the middle.
double findHeight(const Profile& surface, const Profile& underside, int shift) {
    double height = -kNothing;
    for (int line = underside.first; line <= underside.last(); ++line) {
        const double below = surface.at(line + shift);
        const double part = underside.at(line);
        if (std::isfinite(below) && std::isfinite(part)) height = std::max(height, below - part);
    }
    return height;
}

}  // namespace

base::Pose findFinishPose(const track::Track& track, const part::Part& part,
                          const base::Quaternion& orientation) {
    assert(!part.mesh.vertices.empty());
    const base::Mat3 frame = track::orientationFrame(track, track.finish);
    base::Mat3 toTrack = orientation.normalized().toRotationMatrix();
    // Track coordinates are left-handed on an anticlockwise bowl: y is outward, the frame's axis inward.
    const bool inward = track.shape.type == track::FeederType::bowl &&
                        track.shape.conveying == track::Conveying::anticlockwise;
    if (inward) toTrack.row(1) *= -1.0;
    const Profile surface = surfaceOf(track);
    const Profile underside = undersideOf(part, toTrack);
    // The whole part on the track, or, if it is too wide, its centre.
    int low = surface.first - underside.first;
    int high = surface.last() - underside.last();
    if (low > high) {
        low = surface.first;
        high = surface.last();
    }
    const int middle = (surface.first + surface.last()) / 2;
    int best = middle;
    double lowest = kNothing;
    for (int shift = low; shift <= high; ++shift) {
        const double height = findHeight(surface, underside, shift);
        const bool equal = std::abs(height - lowest) <= kEqual;
        if (height < lowest - kEqual || (equal && std::abs(shift - middle) < std::abs(best - middle))) {
            best = shift;
            lowest = std::min(lowest, height);
        }
    }
    return {(base::Quaternion(frame) * orientation).normalized(),
            track.shape.toRoom(
                {track.finish, best * kStep,
                 findHeight(surface, underside, best) / leanOf(track) - chuteFall(track, track.finish)})};
}

}  // namespace trapwright::trial
