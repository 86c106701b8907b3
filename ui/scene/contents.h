#pragma once

#include <QColor>
#include <memory>
#include <vector>

#include "core/base/math.h"
#include "core/part/part.h"
#include "core/track/track.h"
#include "ui/scene/theme.h"

namespace trapwright::scene {

/// What is drawn at a track beside its solid (paper, Figure 3).
struct TrackMarks {
    bool startPoint = true;
    bool finishLine = true;
    bool conveyingArrow = true;
    bool sectionNames = true;  // lead-in, trap, lead-out with their lengths

    static TrackMarks none() { return {false, false, false, false}; }
    friend bool operator==(const TrackMarks&, const TrackMarks&) = default;
};

/// A part where it lies or flies.
struct PartInScene {
    std::shared_ptr<const part::Part> part;  // never null
    base::Pose pose;                         // part frame to room
    QColor colour{};                         // invalid: the theme's
    bool ghost = false;                      // see-through, without shadow and edges
};

/// The path of one part's centre of mass.
struct Trace {
    std::vector<base::Vec3> points;  // in the room [m]
    QColor colour;                   // invalid: the theme's

    friend bool operator==(const Trace&, const Trace&) = default;
};

/// A force that acts on a part. Drawn with a length that grows with the square root of force / weight of the
/// first part.
struct ContactArrow {
    base::Vec3 point;  // in the room [m]
    base::Vec3 force;  // [N]

    friend bool operator==(const ContactArrow&, const ContactArrow&) = default;
};

/// A place of what is shown that is to be looked at: regions and lines on its surface, as thin walls,
/// overhangs, ridges, or lines inside it, as dowel holes, which are seen through the surface.
struct Highlight {
    std::shared_ptr<const geometry::TriangleMesh> patch;  // lies on the surface; null: none. In the room [m]
    std::vector<std::vector<base::Vec3>> lines;           // in the room [m]
    QColor colour;
    bool through = false;  // nothing hides the lines

    friend bool operator==(const Highlight&, const Highlight&) = default;
};

/// Everything that a scene shows, as values. At most one of track, solid and stablePoses is set.
struct SceneContents {
    SceneTheme theme = SceneTheme::light();
    std::shared_ptr<const track::Track> track;
    TrackMarks marks;
    std::shared_ptr<const geometry::TriangleMesh> solid;
    std::shared_ptr<const part::Part> stablePoses;  // of this part, side by side on a flat
    std::vector<double> poseShares;  // of parts, by group of alike poses; empty: the part's own
    std::vector<PartInScene> parts;
    std::vector<Trace> traces;
    std::vector<ContactArrow> contacts;
    std::vector<Highlight> highlights;
    bool heightShading = false;
    bool edges = false;
    bool forceLegend = false;  // how long the arrow of which force on the first part is
};

}  // namespace trapwright::scene
