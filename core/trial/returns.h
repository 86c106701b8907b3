#pragma once

#include "core/track/track.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// Where a part that falls off the track comes again: it falls back into the bowl, or into a tray that is
/// emptied into it, and the bowl brings it once more, in a new pose (decisions.md#returns). What falls
/// elsewhere is lost.
enum class Returns { nowhere, innerSide, outerSide, anywhere };

/// Whether a part that fell off came down where it comes again. Which side it is at is told by where it had
/// come farthest: beyond the middle of what the track is there, so that a part in a cut-out is on the side
/// that is cut away. False for a part that did not fall.
bool comesAgain(const PartOutcome& outcome, const track::Track& track, Returns returns);

}  // namespace trapwright::trial
