#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/search/design_space.h"
#include "core/study/evaluator.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

/// The plan of one chain of traps, all of grooves or all of ledges: its traps are tried by themselves, chains
/// are put together from what they do (chain_search.h), and the best are judged by trials of whole tracks.
/// What is planned, and of which chains, says planning.h.

/// Chains that are judged in the end.
inline constexpr std::size_t kJudgedChains = 16;

/// What a chain is for that ledges follow: as many parts as can be are to come to one way, whatever becomes
/// of the others, which the ledges throw out.
struct ChainAim {
    double room = 0.0;          // how much lower than the chain the track still goes behind it [m]
    bool isRightAlone = false;  // right ones of all that are fed count, by their bits
    traps::TrapChain then{};    // goes on behind it as plain as it can be: how parts lie there counts
};

/// Whether the settings sum up the objective purity.
bool seeksPurity(const EvolutionSettings& settings);

/// The best designs of this chain, at most `most`, best first. The settings' chain is it. Errors: as of
/// planDesigns.
base::Result<std::vector<search::Design>> planChain(const StudyInputs& inputs, const traps::TrapChain& chain,
                                                    const ChainAim& aim, std::size_t most,
                                                    std::function<void(const GenerationPlan&)> planned,
                                                    const LearningControl& control);

/// What such a plan meets on this machine.
struct ChainSample {
    int ways = 0;          // in which parts lie when they come to the first trap
    double seconds = 0.0;  // of a trial of a trap by itself, all threads at work
};
/// Simulates some hundred parts up to the first trap, then traps at random for about `budget` seconds.
/// Errors: engine, cancelled.
base::Result<ChainSample> sampleChain(const StudyInputs& inputs, const traps::TrapChain& chain,
                                      const ChainAim& aim, double budget, const base::RunControl& control);

/// What traps at random do by themselves with the parts that come to the first one.
struct AloneSample {
    double best = 0.0;      // share of the parts that the best trap leaves in one way
    double unturned = 0.0;  // largest share that comes in one way
};
/// Tries so many of the chain's traps, and the best of them again; nothing but 0 where no parts come through
/// the grooves. The settings' chain is it. Errors: engine, cancelled.
base::Result<AloneSample> sampleAlone(const StudyInputs& inputs, const traps::TrapChain& chain, int traps,
                                      const base::RunControl& control);
/// Trials that this takes where parts lie in so many ways. An estimate.
std::int64_t estimateAloneTrials(int traps, int ways);

/// Trials of traps by themselves that a plan takes where parts lie in so many ways. An estimate.
std::int64_t estimateTrapTrials(const EvolutionSettings& settings, int ways);
/// Trials of whole tracks by which the best of so many designs are judged.
std::int64_t estimateJudgingOf(const EvolutionSettings& settings, std::size_t designs);

}  // namespace trapwright::study
