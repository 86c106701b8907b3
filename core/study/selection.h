#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/part/stable_poses.h"
#include "core/stats/stratified.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// The `count` fittest of these winners, best first, no design twice (the highest score of each counts).
/// Among equals the later generation is first: what all of a generation do well owes less to luck.
std::vector<Individual> rankWinners(std::vector<Individual> winners, int count);

/// Whether parts that fall off are thrown back and come again, so that fitness, not the success of all parts,
/// says which track is best: the objective sorting or purity counts.
bool forgivesFalls(const EvolutionSettings& settings);

/// The winner that is best by what was counted while learning: the greatest success, then the highest
/// fitness, then the latest generation; where falls are forgiven fitness comes first. A success that is not
/// known is below any, and one over the box alone below those that count its corners, too, which are harder.
/// Null if there are no winners.
const Individual* findBestWinner(std::span<const Individual> winners, bool fallsAreForgiven);

/// Those trials of each winner that are in corners of the operating box: none where nothing varies.
int countCornerTrials(const Settings& settings);

/// Selecting the final solution (paper, section 6.1.1; decisions.md#selection-and-success): the highest of
/// all generations' winners are re-simulated with many fresh trials each. Best first: by the number of parts
/// that finish within the tolerance of what is wanted, or of that track's modal orientation, over the
/// operating box and, where trials vary over one, in its corners, on average of both; then by fitness, then
/// the earlier generation; where falls are forgiven or throughput counts (streams are sent as measureStreams
/// does at the study's inflow) by fitness first. Errors: settings or part that cannot be
/// used, no winners, engine, cancelled.
base::Result<SelectionRecord> selectWinners(const StudyInputs& inputs, std::vector<Individual> winners,
                                            base::RunControl control);

/// What is known of a track's success, the share of parts that finish in the expected orientation. Where
/// parts that fall off come again, it is that of the parts that arrive: they are *correct*.
struct TrackSuccess {
    enum class Source { validation, selection, learning };

    Source source = Source::learning;  // whose trials tell it
    bool ofArriving = false;           // of the parts that arrive alone
    double rate = 0.0;                 // of a validation: weighted by how often parts land in each pose
    double arriving = 0.0;             // the share of parts that arrive, weighted alike
    stats::Count count;                // right ones of all its trials, all alike
    int finished = 0;                  // of these
    std::vector<stats::ArrivalStratum> strata;  // what `rate` is made of

    /// 95 %, as stats::estimateWeighted or estimateCorrect finds it; takes milliseconds, 0.1 s for a long
    /// validation.
    [[nodiscard]] stats::Interval calcInterval() const;
};

/// The success of an individual, as every page shows it: of its newest validation, which chose nothing and so
/// flatters nobody, or else of the newest selection that it is in, or else as it was learned. None if it was
/// never counted. `groups` are the part's (weighPoseGroups); if none of them was tried, all trials count
/// alike. With `fallsAreForgiven` (forgivesFalls) of the parts that arrive, if any did.
std::optional<TrackSuccess> findSuccess(std::span<const SelectionRecord> selections,
                                        std::span<const ValidationRecord> validations,
                                        const Individual& individual, std::span<const part::PoseGroup> groups,
                                        bool fallsAreForgiven);

}  // namespace trapwright::study
