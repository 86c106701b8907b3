#include "core/track/track.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/track/track_builder.h"

namespace trapwright::track {

namespace {

// How many segments lie between the track's beginning and x, the current one counted by its fraction.
double segmentsFromBegin(const Track& track, double x) {
    const auto& sections = track.sections;
    if (x <= sections.front().x) return 0.0;
    const auto after =
        std::upper_bound(sections.begin(), sections.end(), x,
                         [](double value, const CrossSection& section) { return value < section.x; });
    if (after == sections.end()) return static_cast<double>(sections.size() - 1);
    const auto before = after - 1;
    return static_cast<double>(before - sections.begin()) + (x - before->x) / (after->x - before->x);
}

}  // namespace

Spiral spiralOf(const Track& track) {
    const Spiral none;
    const std::vector<base::Vec2>& points = track.sections.front().points;
    if (track.firstTrapSection < 1 || points.size() < kLeastSpiralPoints) return none;
    const base::Vec2& inner = points.front();
    const base::Vec2& foot = points[points.size() - 3];
    const base::Vec2& top = points[points.size() - 2];
    const double width = foot.x() - inner.x();
    const double height = top.y() - foot.y();
    if (!(width > 0.0 && height > 0.0 && points.back().y() == top.y())) return none;
    const double fall = (inner.y() - foot.y()) / width;
    constexpr double kRounding = 1e-9;
    for (std::size_t j = 1; j + 3 < points.size(); ++j) {
        const double plane = inner.y() - fall * (points[j].x() - inner.x());
        if (std::abs(points[j].y() - plane) > kRounding) return none;
    }
    return {width, height, std::atan(fall)};
}

Chute chuteOf(const Track& track) {
    const std::size_t count = track.sections.size();
    if (track.lastTrapSection + 2 >= static_cast<int>(count)) return {};
    const CrossSection& from = track.sections[count - 2];
    const CrossSection& to = track.sections[count - 1];
    const double fall = from.points.front().y() - to.points.front().y();
    if (!(fall > 0.0)) return {};
    return {to.x - from.x, std::atan2(fall, to.x - from.x)};
}

double chuteFall(const Track& track, double x) {
    const Chute chute = chuteOf(track);
    const double along = x - (track.end() - chute.length);
    return chute.length > 0.0 && along > 0.0 ? along * std::tan(chute.angle) : 0.0;
}

base::Mat3 orientationFrame(const Track& track, double x) {
    base::Mat3 frame = track.shape.tangentFrame(x);
    if (!(chuteFall(track, x) > 0.0)) return frame;
    // A linear feeder is tilted as a whole; in a bowl the chute falls from a track that climbs in the room.
    const double slope = track.shape.type == FeederType::bowl ? track.shape.slope : 0.0;
    const double turn = slope - std::atan(std::tan(slope) - std::tan(chuteOf(track).angle));
    return frame * Eigen::AngleAxisd(turn, base::Vec3::UnitY()).toRotationMatrix();
}

bool isBelowSurface(const Track& track, const base::Vec3& roomPoint) {
    // Of an overhang the upright line meets an underside, too: what is above then is as much air as solid.
    int above = 0;
    for (std::size_t t = 0; t < track.surfaceTriangles; ++t) {
        const auto& [a, b, c] = track.solid.triangles[t];
        const std::array<base::Vec3, 3> corners = {track.solid.vertices[a] - roomPoint,
                                                   track.solid.vertices[b] - roomPoint,
                                                   track.solid.vertices[c] - roomPoint};
        // Twice the areas that the point spans with each edge, seen from above: of one sign inside. An edge
        // counts for the triangle on one of its sides alone.
        std::array<bool, 3> isLeft{};
        std::array<double, 3> areas{};
        for (std::size_t k = 0; k < 3; ++k) {
            const base::Vec3& from = corners[(k + 1) % 3];
            const base::Vec3& to = corners[(k + 2) % 3];
            areas[k] = from.x() * to.y() - from.y() * to.x();
            isLeft[k] = areas[k] > 0.0;
        }
        const double area = areas[0] + areas[1] + areas[2];
        if (area == 0.0 || isLeft[0] != isLeft[1] || isLeft[1] != isLeft[2]) continue;
        const double height =
            (areas[0] * corners[0].z() + areas[1] * corners[1].z() + areas[2] * corners[2].z()) / area;
        if (height > 0.0) above += area > 0.0 ? 1 : -1;
    }
    return above > 0;
}

double segmentsToFinish(const Track& track, double x) {
    assert(track.sections.size() >= 2);
    return std::max(0.0, segmentsFromBegin(track, track.finish) - segmentsFromBegin(track, x));
}

}  // namespace trapwright::track
