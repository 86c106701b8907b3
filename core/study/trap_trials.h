#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/search/design_space.h"
#include "core/study/chain_search.h"
#include "core/study/evaluator.h"
#include "core/study/operating_box.h"
#include "core/traps/trap_chain.h"
#include "core/trial/engine.h"

namespace trapwright::study {

/// What a plan of a chain (chain_planner.h) asks of trials: in which ways parts lie when they come to the
/// first trap, what a trap does with them, and where they are behind the first traps of a chain.

/// The traps at the beginning of a chain that are none to be planned. Of grooves the first turns parts along
/// the track, the second is the run-up; of ledges the run-up: what comes before goes over to it.
inline constexpr std::size_t kGroovesBefore = 2;
inline constexpr std::size_t kLedgesBefore = 1;

/// That tell in which ways parts come to the first trap.
inline constexpr int kTrialsOfWays = 3000;

/// Traps that are none to be planned, with their numbers.
struct FixedTraps {
    traps::TrapChain traps;
    search::Design numbers;
};

/// A chain to be planned, and what stands before and behind it.
struct ChainFrame {
    FixedTraps before;                          // the grooves or the ledge that parts come up to it on
    std::vector<const traps::TrapKind*> kinds;  // of the traps to be planned, each once
    std::vector<std::size_t> places;            // kinds, along the track
    FixedTraps then;                            // goes on behind it; none: nothing
    double room = 0.0;  // how much lower than the chain the track still goes behind it [m]
};

/// Of a whole chain, whose first traps are not planned, and of what follows it, as plain as it can be.
ChainFrame makeFrame(const traps::TrapChain& chain, const traps::TrapChain& then, double room,
                     const TrackSettings& settings);

/// How many trials a trap is still to be tried from each way.
struct Work {
    KnownTrap* trap = nullptr;
    std::vector<int> trials;
};

/// Traps that follow each other: a chain, or the beginning of one.
using TrapRow = std::vector<const KnownTrap*>;

/// Tries traps. Errors of all: engine, cancelled. The same calls in the same order end in the same bits.
class TrapTrials {
 public:
    /// The inputs must outlive it.
    TrapTrials(const StudyInputs& inputs, ChainFrame frame, base::RunControl run);

    /// First of all: in which ways parts come to the first trap, by so many trials. That is the problem's
    /// ways, rows, arriving, mostFall and wanted, and, where something follows the chain, its then; where
    /// nothing comes to the trap, or hardly two parts alike, its ways are none.
    base::Status findWays(int trials, ChainProblem& problem);

    /// ErrorKind::unattainable if there are no such ways, or if something is wanted and none of them is:
    /// traps take parts from one of them to another.
    [[nodiscard]] base::Status checkWays() const;

    /// So many trials more of each trap, from each way; half of them with parts that followParts() met.
    base::Status measure(std::span<const Work> works);

    /// Where parts are behind each, all with the same ones.
    base::Result<std::vector<WayShares>> findShares(std::span<const TrapRow> beginnings, int trials);

    /// So many parts before each trap but the first of these chains: traps are measured with them from then
    /// on, beside those that lie in the plain groove, as within its way a part lies as the traps before have
    /// laid it. `keepsLast`: of each way those alone that come farthest along a chain.
    base::Status followParts(std::span<const TrapRow> chains, int trials, bool keepsLast);
    void forgetFollowed() { met_.clear(); }

    [[nodiscard]] const ChainFrame& frame() const { return frame_; }
    /// That traps are tried from: the ways, and the others together.
    [[nodiscard]] std::size_t rows() const { return starts_.size(); }

 private:
    [[nodiscard]] const Settings& settings() const { return inputs_->settings; }
    base::Status findWaysThen(ChainProblem& problem, int each);
    [[nodiscard]] std::vector<std::size_t> listWanted() const;
    [[nodiscard]] std::string describeEnds() const;
    [[nodiscard]] base::Error tellNoWays() const;
    [[nodiscard]] TrackSettings withoutGiven() const;
    [[nodiscard]] base::Result<std::shared_ptr<const track::Track>> build(const FixedTraps& traps,
                                                                          TrackSettings shortened) const;
    [[nodiscard]] base::Result<std::shared_ptr<const track::Track>> build(
        std::span<const KnownTrap* const> traps) const;
    trial::TrialBatch makeBatch(std::shared_ptr<const track::Track> track, int trials);
    void placeParts(trial::TrialBatch& batch, const std::vector<std::size_t>& ways, double shareOfMet) const;
    [[nodiscard]] const base::Pose& chooseStart(std::size_t way, double shareOfMet,
                                                base::Random& random) const;
    [[nodiscard]] std::vector<std::size_t> shareWays(int trials) const;
    [[nodiscard]] std::size_t findColumn(const trial::Outcome& outcome,
                                         std::span<const base::Quaternion> ways) const;

    const StudyInputs* inputs_;
    ChainFrame frame_;
    base::RunControl run_;
    Specimens specimens_;
    int batches_ = 0;                              // so far
    ChainProblem problem_;                         // as findWays() left it
    double fallBefore_ = 0.0;                      // of the traps before the chain [m]
    std::vector<base::Quaternion> ways_;           // in which parts lie
    std::vector<base::Quaternion> ends_;           // likewise, behind what follows the chain
    std::vector<std::vector<base::Pose>> starts_;  // of each way, and of others; z from the groove's bottom
    std::vector<std::vector<base::Pose>> met_;     // the same, behind the traps of the best chains
};

}  // namespace trapwright::study
