#include "ui/scene/surface_places.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

#include "core/track/track_solid.h"

namespace trapwright::scene {

namespace {

using base::Vec2;
using base::Vec3;

/// The section at x, interpolated between the two that are nearest.
std::vector<Vec2> sectionAt(const track::Track& track, double x) {
    const auto& sections = track.sections;
    const auto next = std::upper_bound(sections.begin() + 1, sections.end() - 1, x,
                                       [](double place, const auto& section) { return place < section.x; });
    const auto& before = *(next - 1);
    const double length = next->x - before.x;
    const double share = length > 0.0 ? std::clamp((x - before.x) / length, 0.0, 1.0) : 0.0;
    std::vector<Vec2> points(before.points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = (1.0 - share) * before.points[i] + share * next->points[i];
    return points;
}

using base::Vec3;

}  // namespace

std::vector<Vec3> surfaceInTrackCoordinates(const track::Track& track) {
    std::vector<Vec3> places(track.solid.vertices.size(), Vec3::Zero());
    // The triangles follow each other along x, so that a vertex is never far from the one before it.
    double near = track.begin();
    for (std::size_t i = 0; i < track.surfaceTriangles; ++i) {
        for (const int vertex : track.solid.triangles[i]) {
            const auto at = static_cast<std::size_t>(vertex);
            places[at] = track.shape.toTrack(track.solid.vertices[at], near);
            near = places[at].x();
        }
    }
    return places;
}

Vec3 surfacePoint(const track::Track& track, double x, double y) {
    const std::vector<Vec2> section = sectionAt(track, x);
    double height = -1e300;
    for (std::size_t i = 0; i + 1 < section.size(); ++i) {
        const Vec2& a = section[i];
        const Vec2& b = section[i + 1];
        if (y < std::min(a.x(), b.x()) || y > std::max(a.x(), b.x())) continue;
        const double share = b.x() != a.x() ? (y - a.x()) / (b.x() - a.x()) : 1.0;
        height = std::max(height, a.y() + share * (b.y() - a.y()));
    }
    return track.shape.toRoom({x, y, height > -1e299 ? height : 0.0});
}

std::vector<Vec3> lineAcross(const track::Track& track, double x) {
    std::vector<Vec3> line;
    for (const Vec2& point : sectionAt(track, x))
        line.push_back(track.shape.toRoom({x, point.x(), point.y()}));
    return line;
}

std::vector<Vec3> lineAlong(const track::Track& track, double from, double to, double y, double z) {
    constexpr double kStep = 4e-3;  // fine enough for the smallest bowl
    const int pieces = track.shape.type == track::FeederType::linear
                           ? 1
                           : std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kStep)));
    std::vector<Vec3> line;
    for (int i = 0; i <= pieces; ++i)
        line.push_back(track.shape.toRoom({from + (to - from) * i / pieces, y, z}));
    return line;
}

std::vector<SectionSpan> sectionSpans(const track::Track& track, const Camera& camera) {
    const double aside = 0.5 * track.width + 0.12 * track.width;
    const double gap = 0.012 * track.width;  // between one span and the next
    const double tick = 0.035 * track.width;
    const double floor = track::findBase(track.shape, track.sections, track.baseThickness);
    const auto onFloor = [&](double x, double y) {
        const Vec3 place = track.shape.toRoom({x, y, 0.0});
        return Vec3(place.x(), place.y(), floor);
    };
    const double middle = 0.5 * (track.begin() + track.end());
    const auto depth = [&](double y) { return onFloor(middle, y).dot(camera.forward()); };
    const double side = depth(-aside) <= depth(aside) ? -1.0 : 1.0;

    const double trapBegin = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
    const double trapEnd = track.sections[static_cast<std::size_t>(track.lastTrapSection)].x;
    const auto makeSpan = [&](const QString& name, double from, double to) {
        SectionSpan span;
        span.name = name;
        span.length = to - from;
        const double shrink = std::min(gap, 0.2 * span.length);
        span.line = lineAlong(track, from + shrink, to - shrink, side * aside, 0.0);
        for (Vec3& place : span.line)
            place.z() = floor;
        span.middle = onFloor(0.5 * (from + to), side * aside);
        span.inside = onFloor(0.5 * (from + to), 0.0);
        for (const double x : {from + shrink, to - shrink}) {
            span.ticks.push_back(onFloor(x, side * (aside - tick)));
            span.ticks.push_back(onFloor(x, side * (aside + tick)));
        }
        return span;
    };
    const bool isSpiral = track::spiralOf(track).width > 0.0;
    const double chute = track::chuteOf(track).length;
    std::vector<SectionSpan> spans{
        makeSpan(isSpiral ? QCoreApplication::translate("scene", "Spiral")
                          : QCoreApplication::translate("scene", "Lead-in"),
                 track.begin(), trapBegin),
        makeSpan(QCoreApplication::translate("scene", "Trap"), trapBegin, trapEnd),
        makeSpan(QCoreApplication::translate("scene", "Lead-out"), trapEnd, track.end() - chute)};
    if (chute > 0.0)
        spans.push_back(
            makeSpan(QCoreApplication::translate("scene", "Chute"), track.end() - chute, track.end()));
    return spans;
}

}  // namespace trapwright::scene
