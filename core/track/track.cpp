#include "core/track/track.h"

#include <algorithm>
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

double segmentsToFinish(const Track& track, double x) {
    assert(track.sections.size() >= 2);
    return std::max(0.0, segmentsFromBegin(track, track.finish) - segmentsFromBegin(track, x));
}

}  // namespace trapwright::track
