#include "ui/scene/section_spans.h"

#include <QCoreApplication>
#include <algorithm>

#include "ui/scene/surface_places.h"

namespace trapwright::scene {

namespace {

using base::Vec3;

}  // namespace

std::vector<SectionSpan> sectionSpans(const track::Track& track, const Camera& camera) {
    const double aside = 0.5 * track.width + 0.12 * track.width;
    const double gap = 0.012 * track.width;  // between one span and the next
    const double tick = 0.035 * track.width;
    const double z = -track.baseThickness;
    const double middle = 0.5 * (track.begin() + track.end());
    const auto depth = [&](double y) { return track.shape.toRoom({middle, y, z}).dot(camera.forward()); };
    const double side = depth(-aside) <= depth(aside) ? -1.0 : 1.0;

    const double trapBegin = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
    const double trapEnd = track.sections[static_cast<std::size_t>(track.lastTrapSection)].x;
    const auto makeSpan = [&](const QString& name, double from, double to) {
        SectionSpan span;
        span.name = name;
        span.length = to - from;
        const double shrink = std::min(gap, 0.2 * span.length);
        span.line = lineAlong(track, from + shrink, to - shrink, side * aside, z);
        span.middle = track.shape.toRoom({0.5 * (from + to), side * aside, z});
        span.inside = track.shape.toRoom({0.5 * (from + to), 0.0, z});
        for (const double x : {from + shrink, to - shrink}) {
            span.ticks.push_back(track.shape.toRoom({x, side * (aside - tick), z}));
            span.ticks.push_back(track.shape.toRoom({x, side * (aside + tick), z}));
        }
        return span;
    };
    return {makeSpan(QCoreApplication::translate("scene", "Lead-in"), track.begin(), trapBegin),
            makeSpan(QCoreApplication::translate("scene", "Trap"), trapBegin, trapEnd),
            makeSpan(QCoreApplication::translate("scene", "Lead-out"), trapEnd, track.end())};
}

}  // namespace trapwright::scene
