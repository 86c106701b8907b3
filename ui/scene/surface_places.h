#pragma once

#include <QString>

#include <vector>

#include "core/base/math.h"
#include "core/track/track.h"
#include "ui/scene/camera.h"

namespace trapwright::scene {

/// Places on a track, for what is drawn onto it. All in the room and in metres; x and y in track coordinates.

/// Track coordinates of the vertices that the track's surface uses, by vertex; zero for the others.
std::vector<base::Vec3> surfaceInTrackCoordinates(const track::Track& track);

/// Highest point of the surface at (x, y); at z = 0 where there is none.
base::Vec3 surfacePoint(const track::Track& track, double x, double y);

/// The surface's line across the track at x, from the inner to the outer edge.
std::vector<base::Vec3> lineAcross(const track::Track& track, double x);

/// A line along the foot of the track's side, from one x to another, bent with a bowl. `y` is the distance
/// from the middle.
std::vector<base::Vec3> lineAlong(const track::Track& track, double from, double to, double y, double z);

/// One of the track's three parts as a dimension line beside the track (paper, Figure 3). [m]
struct SectionSpan {
    QString name;                   // for people
    double length = 0.0;            // along x
    std::vector<base::Vec3> line;   // from its begin to its end
    base::Vec3 middle;              // of the line
    base::Vec3 inside;              // on the track beside it
    std::vector<base::Vec3> ticks;  // pairs of ends of short strokes across the line, at begin and end
};

/// Lead-in, trap and lead-out, on the side of the track that is nearer to the eye.
std::vector<SectionSpan> sectionSpans(const track::Track& track, const Camera& camera);

}  // namespace trapwright::scene
