#pragma once

#include <optional>
#include <vector>

#include "core/track/print_solid.h"

namespace trapwright::track {

/// y of the outer faces of what stands beside the surface at either side: walls, of which one may not be
/// there, rims, or the track's width. [m]
double outerSideOf(const Track& track, const PrintOptions& options);

/// Half a flange is as wide as its bolts are from its edge. [m]
double flangeWidthOf(const PrintOptions& options);

/// What of the options cannot be made, if any; the first of it.
std::optional<PrintProblem> findPrintProblem(const Track& track, const PrintOptions& options);

/// The centres of the bolt holes in the room: as many as fit with these distances, in the middle of the
/// flange's length. The options must be without problems. [m]
std::vector<base::Vec2> placeBolts(const Track& track, const PrintOptions& options);

}  // namespace trapwright::track
