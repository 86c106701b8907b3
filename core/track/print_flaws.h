#pragma once

#include "core/geometry/print_check.h"
#include "core/track/track.h"

namespace trapwright::track {

/// How much of a track cannot be printed.
struct PrintFlaws {
    double thin = 0.0;      // of walls thinner than the thinnest, one side [m^2]
    double ridges = 0.0;    // of what tapers to ridges and is thinner than that, one side, at most [m^2]
    double overhang = 0.0;  // of what is steeper than the steepest overhang [m^2]

    [[nodiscard]] double total() const { return thin + ridges + overhang; }
};

/// What geometry::checkForPrinting says of the track as it is learned with the rims that it is printed with,
/// as wide as the thinnest wall, and without the walls and the flange that it may be printed with. Ridges
/// that lose less than 10 micrometres of their height are none.
PrintFlaws findPrintFlaws(const Track& track, const geometry::PrintLimits& limits = {});

}  // namespace trapwright::track
