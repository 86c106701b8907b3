#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/geometry/print_check.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// Mending a learned track for the printer (decisions.md#mending). Learning it anew so that it can be printed
/// takes as long as learning did; most tracks lack little.

struct MendingPlan {
    int variants = 20;  // how often the track is mended, each time by other moves
    int trials = 200;   // by which each variant is judged, as while learning
    int compared = 5;   // the best of them, with the track that they come from, by the trials of a selection
    int moves = 2000;   // that are tried for a variant at most
    geometry::PrintLimits limits{};

    /// An error that names the first number that is out of its range.
    [[nodiscard]] base::Status check() const;
};

/// A design after mending.
struct MendedDesign {
    search::Design design;
    double unprintable = 0.0;  // what is left of track::PrintFlaws, all together [m^2]
};

/// How much of the track of a design cannot be printed, all together. An error if it is no track, or crosses
/// itself. [m^2]
base::Result<double> measureUnprintable(const TrackSettings& settings, const search::Design& design,
                                        const geometry::PrintLimits& limits);

/// Changes a number of the design at a time, at random and little, and keeps what leaves less that cannot be
/// printed, until nothing is left or nothing helps any more; then takes back of every move what is not
/// needed. Of a design space with points only these move. The same stream gives the same design, wherever it
/// is not cancelled. An error as measureUnprintable.
base::Result<MendedDesign> mendDesign(const TrackSettings& settings, const search::Design& design,
                                      const MendingPlan& plan, const base::StreamKey& stream,
                                      const base::RunControl& control);

/// MendingPlan::variants designs mended from a track of the study, each from a stream of its own, for
/// generation `index`; not all need be free of what cannot be printed. Errors: settings or part that cannot
/// be used, a plan that is none, as measureUnprintable, cancelled.
base::Result<std::vector<MendedDesign>> mendVariants(const StudyInputs& inputs, int index,
                                                     const Individual& track, const MendingPlan& plan,
                                                     const base::RunControl& control);

/// Those of which all can be printed, at least one, as the generation after `last`
/// (GenerationRecord::mendedFrom): judged as in learning by MendingPlan::trials each. The search is not told
/// of them; it goes on from `last`, where it was. Errors: engine, cancelled.
base::Result<GenerationRecord> judgeVariants(const StudyInputs& inputs, const LearningState& last,
                                             const Individual& track, std::vector<MendedDesign> variants,
                                             const MendingPlan& plan, const base::RunControl& control);

}  // namespace trapwright::study
