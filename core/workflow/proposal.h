#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"

namespace trapwright::workflow {

/// What a track does with parts that come the wrong way.
enum class TrackIdea {
    turning,  // turns them over, on a free-form trap (study::turningMode)
    gaps,     // throws them out by gaps (study::sortingMode)
    ledges,   // the same, and by ledges behind the gaps (study::ledgeMode)
    hanging,  // lets them hang in slots, so that their thicker end comes one way (study::slotMode)
    rails,    // the same to the track's end, so that it is up (study::railsMode)
};

/// Changes settings to those of a track of this idea, in proportion to the part.
study::Settings applyIdea(TrackIdea idea, study::Settings settings, const part::Part& part);

/// What is to be learned for a part in the time that the user has.
struct Proposal {
    study::Settings settings;
    double seconds = 0.0;              // of learning, estimated
    std::vector<std::string> reasons;  // what was chosen and why, a sentence each
};

/// The shortest time that something can be proposed for [s].
inline constexpr double kShortestTime = 60.0;

/// Chooses by the part how a track is learned, unless that is `asked` for, and by the time how much of it
/// (decisions.md#automatic-settings): a part that is wanted as it hangs is brought onto rails; one that
/// looks another way with its other end in front hangs in slots if some slots that are tried show that this
/// brings most of it one way, or else is sorted; any other is turned. Lengths are in proportion to the part.
/// Population, trials and generations are as many as take `seconds`, by trials that are timed on this machine
/// for a few seconds. Drive, contact, engine, seed and all that is not learning stay as they are in `inputs`.
/// Errors: less than kShortestTime, a part for which not even the smallest search fits, settings or part that
/// cannot be used, engine, cancelled.
base::Result<Proposal> proposeSettings(const study::StudyInputs& inputs, double seconds,
                                       const base::RunControl& control,
                                       std::optional<TrackIdea> asked = std::nullopt);

}  // namespace trapwright::workflow
