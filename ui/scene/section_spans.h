#pragma once

#include <QString>
#include <vector>

#include "core/track/track.h"
#include "ui/scene/camera.h"

namespace trapwright::scene {

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
