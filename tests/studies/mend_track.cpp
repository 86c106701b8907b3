// Mends a track for the printer: moves a point at a time, at random and little, keeps what leaves less that
// cannot be printed, until nothing is left. Does so from several seeds, judges each that was mended over the
// operating box and in its corners, and keeps the best: mend_track TRACK PART OUT [--seeds N] [--lead-out N]
// [--trials N].

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/self_overlap.h"
#include "core/study/evaluator.h"
#include "core/study/presets.h"
#include "core/study/trial_batches.h"
#include "core/track/print_flaws.h"
#include "core/track/track_builder.h"
#include "core/track/track_file.h"
#include "core/workflow/part_source.h"
#include "sim/engines/registry.h"

using namespace trapwright;
using track::CrossSection;

namespace {

constexpr int kMostMoves = 6000;
constexpr std::array kSteps = {0.3e-3, 0.5e-3, 0.8e-3};  // of a move, in turns from seed to seed [m]

struct Options {
    std::string track;
    std::string part;
    std::string out;
    unsigned seeds = 8;
    int leadOut = -1;  // segments; -1: as the track has it
    int trials = 480;  // over the box, and as many in its corners
};

std::optional<Options> readOptions(int count, char** texts) {
    if (count < 4) return std::nullopt;
    Options options{texts[1], texts[2], texts[3]};
    for (int i = 4; i + 1 < count; i += 2) {
        const std::string_view key = texts[i];
        const int value = std::atoi(texts[i + 1]);
        if (key == "--seeds") options.seeds = static_cast<unsigned>(value);
        if (key == "--lead-out") options.leadOut = value;
        if (key == "--trials") options.trials = value;
    }
    return options;
}

/// What a track of these functional sections is built with, x from the lead-in's end.
struct Plan {
    track::TrackParameters parameters;
    std::vector<CrossSection> trap;
};

Plan planOf(const track::Track& track, int leadOut) {
    Plan plan;
    const auto first = static_cast<std::size_t>(track.firstTrapSection);
    const auto last = static_cast<std::size_t>(track.lastTrapSection);
    const double begin = track.sections[first].x;
    for (std::size_t i = first + 1; i <= last; ++i) {
        plan.trap.push_back(track.sections[i]);
        plan.trap.back().x -= begin;
    }
    track::TrackParameters& parameters = plan.parameters;
    parameters.shape = track.shape;
    parameters.segmentWidth = track.width;
    parameters.segmentHeight = track.height;
    parameters.maxSegmentLength = track.sections[last + 1].x - track.sections[last].x;
    parameters.leadInLength = begin - track.begin();
    parameters.startFromLeadInEnd = begin - track.start;
    parameters.leadOutSegments = leadOut < 0 ? static_cast<int>(track.sections.size() - 1 - last) : leadOut;
    parameters.baseThickness = track.baseThickness;
    return plan;
}

/// The area that cannot be printed [m^2], and the track; none of what is no track or crosses itself.
struct Built {
    std::shared_ptr<const track::Track> track;
    double flaws = 0.0;
};

std::optional<Built> build(const Plan& plan) {
    auto track = track::buildTrack(plan.parameters, plan.trap);
    if (!track || geometry::countOverlappingTriangles(track->solid, track->surfaceTriangles) > 0)
        return std::nullopt;
    const track::PrintFlaws flaws = track::findPrintFlaws(*track);
    return Built{std::make_shared<const track::Track>(std::move(*track)), flaws.thin + flaws.overhang};
}

/// Mends the plan as far as it can.
Built mend(Plan& plan, Built built, unsigned seed) {
    base::Random random({seed, 0, 0, 0, base::Purpose::test});
    const double step = kSteps[seed % kSteps.size()];
    const track::TrackParameters& parameters = plan.parameters;
    for (int move = 0; move < kMostMoves && built.flaws > 0.0; ++move) {
        CrossSection& section = plan.trap[random.below(static_cast<std::uint32_t>(plan.trap.size()))];
        const auto points = static_cast<std::uint32_t>(section.points.size());
        const std::uint32_t number = random.below(points);
        base::Vec2& point = section.points[number];
        const base::Vec2 before = point;
        if (random.boolean()) {  // within its own strip, so that the section does not cross itself
            const double strip = parameters.segmentWidth / points;
            const double low = -parameters.segmentWidth / 2 + strip * number;
            point.x() = std::clamp(point.x() + step * random.normal(), low, low + strip);
        } else {
            point.y() = std::clamp(point.y() + step * random.normal(), 0.0, parameters.segmentHeight);
        }
        const auto moved = build(plan);
        if (moved && moved->flaws < built.flaws) {
            built = *moved;
        } else {
            point = before;
        }
    }
    return built;
}

struct Judged {
    trial::Tally overBox;
    trial::Tally corners;

    [[nodiscard]] int successes() const { return overBox.success + corners.success; }
};

std::optional<Judged> judge(const study::StudyInputs& inputs, const study::Specimens& specimens,
                            const std::shared_ptr<const track::Track>& track, const trial::Goal& goal,
                            int trials) {
    const study::TrialScene scene = study::makeScene(inputs.settings, specimens, track);
    const std::array batches = {study::makeSelectionBatch(scene, {0, 0}, trials),
                                study::makeCornerBatch(scene, {0, 0}, trials)};
    const auto outcomes = study::runTrials(*inputs.engine, batches, {});
    if (!outcomes) return std::nullopt;
    const auto count = [&](std::size_t batch) {
        return trial::tally((*outcomes)[batch], goal, inputs.part->symmetry,
                            inputs.settings.validation.tolerance);
    };
    return Judged{count(0), count(1)};
}

}  // namespace

int main(int count, char** texts) {
    const auto options = readOptions(count, texts);
    if (!options) {
        fmt::print("mend_track TRACK PART OUT [--seeds N] [--lead-out N] [--trials N]\n");
        return 2;
    }
    const auto file = track::readTrackFile(options->track);
    const auto part = workflow::importPart({options->part});
    const auto engine = engines::registry().make("native", {});
    auto settings = study::presetSettings(options->part == "cone" ? "cone" : "cuboid");
    if (!file || !part || !engine || !settings) {
        fmt::print("{}\n", !file     ? file.error().message
                           : !part   ? part.error().failure.message
                           : !engine ? engine.error().message
                                     : settings.error().message);
        return 1;
    }
    if (!file->expectedOrientation) {
        fmt::print("{} does not tell the orientation that is expected.\n", options->track);
        return 1;
    }
    const trial::Goal goal = trial::makeGoal(*file->expectedOrientation);
    const study::StudyInputs inputs{*settings, part->part, *engine};
    const study::Specimens specimens = study::makeSpecimens(*settings, part->part);
    const Plan plan = planOf(file->track, options->leadOut);
    const auto before = build(plan);
    if (!before) {
        fmt::print("These sections make no track, or one that crosses itself.\n");
        return 1;
    }
    fmt::print("{:.2f} mm^2 cannot be printed\n", before->flaws * 1e6);

    std::optional<Judged> best;
    for (unsigned seed = 1; seed <= options->seeds; ++seed) {
        Plan mended = plan;
        const Built built = mend(mended, *before, seed);
        if (built.flaws > 0.0) {
            fmt::print("seed {}: {:.2f} mm^2 left\n", seed, built.flaws * 1e6);
            continue;
        }
        double farthest = 0.0;
        int moved = 0;
        for (std::size_t i = 0; i < plan.trap.size(); ++i) {
            for (std::size_t j = 0; j < plan.trap[i].points.size(); ++j) {
                const double way = (mended.trap[i].points[j] - plan.trap[i].points[j]).norm();
                if (way > 0.0) ++moved;
                farthest = std::max(farthest, way);
            }
        }
        const auto judged = judge(inputs, specimens, built.track, goal, options->trials);
        if (!judged) continue;
        fmt::print(
            "seed {}: {} points moved, by {:.2f} mm at most; over the box {:.1f} %, corners {:.1f} %\n", seed,
            moved, farthest * 1e3, 100.0 * judged->overBox.success / options->trials,
            100.0 * judged->corners.success / options->trials);
        std::fflush(stdout);
        if (best && judged->successes() <= best->successes()) continue;
        best = judged;
        const auto written = track::writeTrackFile(
            options->out, {file->about + ", mended for printing", *built.track, file->expectedOrientation});
        if (!written) {
            fmt::print("{}\n", written.error().message);
            return 1;
        }
    }
    return best ? 0 : 1;
}
