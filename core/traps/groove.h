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
/// The numbers of such a groove in which parts lie down, of the longest length.
std::vector<double> restingGroove(const TrapParameters& parameters);

/// A groove that ends at a sharp edge, and another one below. What comes heavy end first tips over the edge
/// sooner than what comes light end first, and falls with more spin; a fall of a third to half of its length
/// turns one of them and lets the other pass (learning.md). A groove in which parts lie down again, of the
/// form and length that is right for most, ends it, so that one drop can follow another.
TrapKind drop();

/// A floor along a wall, cut away from the other side, over a length, down to nothing: what does not find
/// support on either end of the cut or on what is left of the width falls off, and back into the bowl. It is
/// the ledge of feeders' craft, which carries only what lies close to the wall; cut beyond the wall's foot
/// the gap, which the heavier end does not cross (Boothroyd 2005). Seven numbers; a groove in which parts lie
/// down again ends it.
TrapKind cutOut();

/// A cut-out with a step: the track goes on lower behind the cut, or is lower from the cut's beginning on. A
/// level cut is the same from either side, so that what lies on it at rest is carried or not whichever end
/// comes first; over a step what reaches across with its light end passes, and what tips with its heavy end
/// falls (learning.md). Its eight numbers are a cut-out's and the step's height.
TrapKind gap();

/// A slot along the groove's middle, between two rails: what is thinner than it is wide sinks in, and hangs
/// by what is thicker, a head or a collar, whichever end came first. Where the rails fall again, or the
/// slot's floor rises, it leans over and lies down, all alike (decisions.md#slot): the craft's device for
/// headed parts (Boothroyd 2005, chapter 3). Nine numbers: length before it, fall, how steep the walls beside
/// it are, how wide and how deep it is, how long its beginning is, it itself, and its end, and how much lower
/// the track is behind it. A groove in which parts lie down again ends it. Of at least six points a section.
TrapKind slot();

/// A slot that does not end: the lead-out goes on with it, and parts leave hanging between two rails, their
/// thicker end up, as screws come to a screwdriver. The last of its chain. Seven numbers, a slot's without
/// its end and step.
TrapKind rails();

/// Rails that reject: behind their length the track is cut away from both sides, walls too
/// (track::PrintOutline), but for two narrow rails that fall outward, as a roof does, and so to its end.
/// What hangs between them goes on; what lies on them slides off. Eleven numbers: those of rails, how long it
/// takes to become narrow, how wide each rail is then, how steep the roof, and how long they are before the
/// lead-out, which is alike.
TrapKind narrowRails();

}  // namespace trapwright::traps
