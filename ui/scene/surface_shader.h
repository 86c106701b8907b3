#pragma once

#include <span>

#include "ui/scene/camera.h"

class vtkActor;

namespace trapwright::scene {

/// How surfaces are shaded: a light sky over a darker ground, one soft key light fixed in the room, and a
/// little light from the eye, so that hills, valleys and undersides read from everywhere without looking wet.

enum class SurfaceKind {
    track,  // takes light from a light map (texture "lightMap") and the shadows of parts
    plain,  // a part, a solid, marks
    ghost,  // shows its rim more than its middle
};

/// What throws a shadow on a track: a box around a part, or the ellipsoid in it. [mm]
struct Shade {
    base::Mat3 toUnit;  // room, from the centre, to where the half edges are 1
    base::Vec3 centre;
    bool isBox = true;
};
inline constexpr std::size_t kMostShades = 16;

/// Puts the shading into an actor. Once per actor.
void setSurfaceShading(vtkActor& actor, SurfaceKind kind);

/// Turns the room's lights into the camera's axes. Before every picture, for every shaded actor.
void setLights(vtkActor& actor, const Camera& camera);

/// For tracks: colours by height between these heights [mm]; where the places from which heights count are at
/// the track's two ends [mm]; shadows of these parts, the first kMostShades.
void setHeightRange(vtkActor& actor, bool shaded, double low, double high);
void setRise(vtkActor& actor, double atBegin, double atEnd);
void setShades(vtkActor& actor, std::span<const Shade> shades);

/// Draws an actor a little nearer than it is, so that a surface that it lies on does not hide it.
void setInFront(vtkActor& actor);
/// Draws an actor before everything else, as if nothing could hide it.
void setBeforeAll(vtkActor& actor);

}  // namespace trapwright::scene
