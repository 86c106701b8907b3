#include "core/study/mending.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <optional>
#include <span>

#include "core/base/parallel.h"
#include "core/geometry/self_overlap.h"
#include "core/study/runner.h"
#include "core/study/track_design.h"
#include "core/track/print_flaws.h"

namespace trapwright::study {

namespace {

constexpr int kMostIdle = 600;  // moves in a row that helped nothing
/// Each move of a number that changes nothing of what cannot be printed makes it that much less likely to be
/// moved again, down to the least: most of a track is far from what is wrong with it.
constexpr double kForget = 0.5;
constexpr double kLeastWeight = 0.02;
/// Standard deviations of a move, in turns from variant to variant: of millimetres [mm], and of all other
/// units as a share of the range.
constexpr std::array kSteps = {0.3, 0.5, 0.8};
constexpr double kSharePerStep = 0.05;
constexpr int kHalvings = 4;  // of the way back to where a number was
constexpr int kMostVariants = 1000;
constexpr int kMostTrials = 1'000'000;

/// The numbers that may move.
std::vector<std::size_t> findMovable(const search::DesignSpace& space) {
    std::vector<std::size_t> all;
    std::vector<std::size_t> ofPoints;
    for (std::size_t i = 0; i < space.dimensions.size(); ++i) {
        all.push_back(i);
        if (space.dimensions[i].ofPoint) ofPoints.push_back(i);
    }
    return ofPoints.empty() ? all : ofPoints;
}

/// One of them, by their weights.
std::size_t draw(std::span<const double> weights, base::Random& random) {
    double left = random.uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
    std::size_t at = 0;
    while (at + 1 < weights.size() && left >= weights[at])
        left -= weights[at++];
    return at;
}

double moveBy(const search::Dimension& dimension, double value, double step) {
    const double range = dimension.high - dimension.low;
    const double share = dimension.unit == "mm" && range > 0.0 ? step / range : step * kSharePerStep;
    return search::roundToBits(std::clamp(value + share, 0.0, 1.0), dimension.bits);
}

/// Takes longer than to find out what cannot be printed.
bool crossesItself(const track::Track& track) {
    return geometry::countOverlappingTriangles(track.solid, track.surfaceTriangles) > 0;
}

/// Takes back of every number's move what is not needed for a track that has nothing left that cannot be
/// printed: moves find their way at random, and what parts do may hang on tenths of a millimetre.
void takeBack(const TrackSettings& settings, const search::Design& before, const search::DesignSpace& space,
              const MendingPlan& plan, const base::RunControl& control, search::Design& mended) {
    const auto isMended = [&] {
        const auto track = decodeTrack(settings, mended);
        return track && track::findPrintFlaws(*track, plan.limits).total() == 0.0 && !crossesItself(*track);
    };
    for (std::size_t i = 0; i < mended.size(); ++i) {
        double needed = mended[i];
        double towards = before[i];
        for (int halving = 0; halving <= kHalvings && needed != towards && control.mayGoOn(); ++halving) {
            mended[i] = towards;
            if (isMended()) {
                needed = towards;
                towards = before[i];
            }
            mended[i] = needed;
            towards = search::roundToBits(0.5 * (needed + towards), space.dimensions[i].bits);
        }
    }
}

}  // namespace

base::Status MendingPlan::check() const {
    const auto range = [](const char* name, int value, int low, int high) -> base::Status {
        if (value >= low && value <= high) return base::success();
        return base::Error{fmt::format("{} must be {} to {}, and is {}.", name, low, high, value)};
    };
    if (auto checked = range("The number of variants", variants, 1, kMostVariants); !checked) return checked;
    if (auto checked = range("The number of trials of each variant", trials, 1, kMostTrials); !checked)
        return checked;
    if (auto checked = range("The number of moves", moves, 1, kMostTrials); !checked) return checked;
    return range("The number of variants that are compared", compared, 1, kMostVariants);
}

base::Result<double> measureUnprintable(const TrackSettings& settings, const search::Design& design,
                                        const geometry::PrintLimits& limits) {
    const auto track = decodeTrack(settings, design);
    if (!track) return track.error();
    if (crossesItself(*track))
        return base::Error{"The track crosses itself, which mending does not cure. Choose another one."};
    return track::findPrintFlaws(*track, limits).total();
}

base::Result<MendedDesign> mendDesign(const TrackSettings& settings, const search::Design& design,
                                      const MendingPlan& plan, const base::StreamKey& stream,
                                      const base::RunControl& control) {
    const auto before = measureUnprintable(settings, design, plan.limits);
    if (!before) return before.error();
    const search::DesignSpace space = designSpace(settings);
    const std::vector<std::size_t> movable = findMovable(space);
    base::Random random(stream);
    const double step = kSteps[stream.individual % kSteps.size()];

    MendedDesign mended{design, *before};
    std::vector<double> weights(movable.size(), 1.0);
    for (int move = 0, idle = 0; move < plan.moves && idle < kMostIdle && mended.unprintable > 0.0; ++move) {
        if (!control.mayGoOn()) break;
        ++idle;
        const std::size_t drawn = draw(weights, random);
        const std::size_t number = movable[drawn];
        const double kept = mended.design[number];
        mended.design[number] = moveBy(space.dimensions[number], kept, step * random.normal());
        if (mended.design[number] == kept) continue;
        const auto track = decodeTrack(settings, mended.design);
        const std::optional<double> left =
            track ? std::optional(track::findPrintFlaws(*track, plan.limits).total()) : std::nullopt;
        const bool changesNothing = left == mended.unprintable;
        weights[drawn] = changesNothing ? std::max(kLeastWeight, kForget * weights[drawn]) : 1.0;
        if (left && *left < mended.unprintable && !crossesItself(*track)) {
            mended.unprintable = *left;
            idle = 0;
        } else {
            mended.design[number] = kept;
        }
    }
    if (mended.unprintable == 0.0) takeBack(settings, design, space, plan, control, mended.design);
    return mended;
}

base::Result<std::vector<MendedDesign>> mendVariants(const StudyInputs& inputs, int index,
                                                     const Individual& track, const MendingPlan& plan,
                                                     const base::RunControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    if (const auto checked = plan.check(); !checked) return checked.error();
    const TrackSettings& settings = inputs.settings.track;
    const search::Design& design = track.record.design;
    if (const auto measured = measureUnprintable(settings, design, plan.limits); !measured)
        return measured.error();
    std::vector<MendedDesign> variants(static_cast<std::size_t>(plan.variants));
    base::parallelFor(variants.size(), inputs.threads, [&](std::size_t i, unsigned /*worker*/) {
        const base::StreamKey stream{inputs.settings.evolution.seed, static_cast<std::uint32_t>(index),
                                     static_cast<std::uint32_t>(i), 0, base::Purpose::mending};
        variants[i] = mendDesign(settings, design, plan, stream, control).value();
    });
    if (control.cancelled()) return base::Error{"The mending was cancelled."};
    return variants;
}

base::Result<GenerationRecord> judgeVariants(const StudyInputs& inputs, const LearningState& last,
                                             const Individual& track, std::vector<MendedDesign> variants,
                                             const MendingPlan& plan, const base::RunControl& control) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<search::Proposal> proposals;
    for (MendedDesign& variant : variants)
        if (variant.unprintable <= 0.0) proposals.push_back({std::move(variant.design), track.record.traits});
    StudyInputs judging = inputs;
    judging.settings.evolution.trialsPerEvaluation = plan.trials;
    judging.settings.evolution.racingTrials = 0;
    const int index = last.index + 1;
    auto evaluation = evaluateGeneration(judging, index, proposals, {}, control);
    if (!evaluation) return evaluation.error();
    GenerationRecord record = completeGeneration(index, std::move(evaluation->individuals), {},
                                                 summedObjectives(inputs.settings.evolution));
    record.mendedFrom = track;
    record.made = {makerOf(*inputs.engine), std::move(evaluation->outcomes)};
    record.searchState = last.search;
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return record;
}

}  // namespace trapwright::study
