#pragma once

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// Traps that keep parts in the middle of the track. Their surface falls with them: heights are counted from
/// where the trap before ends (TrapKind::build), and what would leave the box of the segment is cut off.
/// Points of a section: the first and the last at the track's edges, the middle one at the groove's bottom.

/// A groove's walls in which parts lie down along the track: steep enough to turn those that lie across it,
/// and gentle enough that none leans on one of them. [rad]
inline constexpr double kRestingWall = 24.0 * base::kDegree;
/// How much that groove falls along the track. [rad]
inline constexpr double kRestingFall = 6.0 * base::kDegree;

/// A groove out of the middle of the track, as deep as its walls are steep: what comes lying anyhow goes on
/// lying along the track. Four numbers: length, fall along the track, how steep its walls are, and how much
/// it is inclined across the track.
TrapKind groove();

/// A groove that ends at a sharp edge, and another one below. What comes heavy end first tips over the edge
/// sooner than what comes light end first, and falls with more spin; a fall of a third to half of its length
/// turns one of them and lets the other pass (learning.md). A groove in which parts lie down again, of the
/// form and length that is right for most, ends it, so that one drop can follow another.
TrapKind drop();

}  // namespace trapwright::traps
