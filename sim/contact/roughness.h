#pragma once

#include "core/base/math.h"
#include "core/trial/contact.h"

namespace trapwright::contact {

/// How wide the grains of a rough surface are: about a line of a print. [m]
inline constexpr double kGrain = 0.4e-3;

/// The direction in which a rough surface presses at `point` (track frame [m]), where a smooth one would
/// along the unit `normal`: off it by up to ContactParameters::roughness, evenly over that disc, the same all
/// over a grain (decisions.md#roughness). The normal itself of a smooth surface.
base::Vec3 tiltNormal(const trial::ContactParameters& law, const base::Vec3& point, const base::Vec3& normal);

}  // namespace trapwright::contact
