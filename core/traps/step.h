#pragma once

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// The run of a step's edge: what stands for upright in a surface that is made of sections. [m]
inline constexpr double kStepEdge = 1e-3;
/// The most that a step's tread may be inclined across the track. [rad]
inline constexpr double kSteepestTread = 30.0 * base::kDegree;

/// A level step, the oldest of traps: the track goes down or up by a height at once, then runs level for a
/// length, inclined across the track by an angle (positive: down towards the outer edge). What would leave
/// the box of the segment is cut off at it. Three numbers, of any value: nothing ties them to bits.
TrapKind step();

}  // namespace trapwright::traps
