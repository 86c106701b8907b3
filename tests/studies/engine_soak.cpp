// Trials of anything on anything, for as long as one likes: random tracks, parts, conditions and steps.
// Counts what no engine may do: poses that are not numbers, parts that are thrown off, energy that grows,
// parts inside the track. Each finding is told with what makes it again: engine_soak --seed S --first R
// --rounds 1.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parallel.h"
#include "core/geometry/self_overlap.h"
#include "core/geometry/solid_probe.h"
#include "core/part/bundled.h"
#include "core/study/presets.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/verify/scenes.h"
#include "core/workflow/part_source.h"
#include "sim/engines/registry.h"

using namespace trapwright;

namespace {

constexpr int kTrials = 96;            // of a round
constexpr int kWatched = 16;           // every so manieth is looked at all the way
constexpr double kInterval = 8e-3;     // between two looks [s]
constexpr double kDeep = 0.5e-3;       // inside the track, more than recovery leaves for a moment [m]
constexpr double kFarOff = 1.0;        // off the track [m]
constexpr double kEnergyMargin = 2.0;  // over what the drive can give

struct Options {
    double seconds = 600.0;
    std::uint64_t seed = 1;
    unsigned first = 0;
    unsigned rounds = 0;  // 0: by time
    std::string engine = "native";
};

Options readOptions(int count, char** texts) {
    Options options;
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string_view key = texts[i];
        const char* value = texts[i + 1];
        if (key == "--seconds") options.seconds = std::atof(value);
        if (key == "--seed") options.seed = std::strtoull(value, nullptr, 10);
        if (key == "--first") options.first = static_cast<unsigned>(std::atoi(value));
        if (key == "--rounds") options.rounds = static_cast<unsigned>(std::atoi(value));
        if (key == "--engine") options.engine = value;
    }
    return options;
}

/// One track, part and step, and trials all over a wide box.
struct Round {
    std::string about;
    study::Settings settings;
    trial::TrialBatch batch;
};

/// None where the design gives no track, or one that crosses itself: those are not simulated.
std::optional<Round> makeRound(const Options& options, unsigned number,
                               std::span<const std::shared_ptr<const part::Part>> parts) {
    base::Random random({options.seed, number, 0, 0, base::Purpose::test});
    const std::shared_ptr<const part::Part>& part =
        parts[random.below(static_cast<std::uint32_t>(parts.size()))];
    Round round;
    study::Settings& settings = round.settings;
    auto preset = study::presetSettings("cuboid");
    if (!preset) return std::nullopt;
    settings = *preset;
    settings.evolution.seed = options.seed;
    const std::uint32_t kind = random.below(4);
    settings = kind == 3 ? study::sortingMode(settings, *part) : study::turningMode(settings, *part);
    // The paper's free points make surfaces that overhang; few of them do not cross themselves.
    if (kind < 3) settings.track.crossSections = 1 + static_cast<int>(random.below(5));
    if (kind == 2) settings.track.encoding = traps::PointEncoding::free;
    if (random.boolean())
        settings.track.shape = {track::FeederType::bowl, 0.175, track::Conveying::clockwise};

    settings.simulation.contact.kineticFriction = random.uniform(0.15, 1.0);
    settings.simulation.contact.staticFriction =
        settings.simulation.contact.kineticFriction * random.uniform(1.0, 1.4);
    settings.simulation.contact.restitution = random.uniform(0.0, 0.7);
    settings.simulation.drive.frequency = random.boolean() ? 50.0 : random.uniform(30.0, 100.0);
    const double stroke = 50.0 / settings.simulation.drive.frequency;
    settings.simulation.drive.halfStroke = random.uniform(0.1e-3, 1.2e-3) * stroke * stroke;
    settings.simulation.drive.angle = random.uniform(5.0, 30.0) * base::kDegree;
    settings.box = {
        trial::BoxDistribution::uniform, 0.1, 0.1, 0.2, 0.05, 3.0 * base::kDegree, 0.2e-3, 0.2e-3, 0.2e-3};
    settings.evolution.conditions = study::TrialConditions::varied;
    constexpr std::array kSteps = {0.0, 0.1e-3, 0.2e-3, 0.3e-3, 0.5e-3, 1e-3};
    settings.evolution.learningStep = kSteps[random.below(kSteps.size())];

    search::Design design;
    for (std::size_t i = 0; i < study::designSpace(settings.track).dimensions.size(); ++i)
        design.push_back(random.uniform());
    auto built = study::decodeTrack(settings.track, design);
    if (!built || geometry::countOverlappingTriangles(built->solid, built->surfaceTriangles) > 0)
        return std::nullopt;
    round.batch = study::makeLearningBatch(
        study::makeScene(settings, part, std::make_shared<const track::Track>(std::move(*built))),
        {static_cast<int>(number), 0}, kTrials);
    round.about = fmt::format("{} on {}{}, step {:g} ms", part->name, settings.track.traps,
                              settings.track.shape.type == track::FeederType::bowl ? " in a bowl" : "",
                              settings.evolution.learningStep * 1e3);
    return round;
}

/// What the energy of a trial's part may be, over height 0: what it began with, and half the square of the
/// speed at which bouncing on the track gains no more. [J]
double calcMostEnergy(const trial::TrialBatch& batch) {
    const trial::TrialSpec& spec = batch.trials.front();
    const trial::Vibration& drive = batch.driveOf(spec);
    const double e = batch.contactOf(spec).restitution;
    const double speed = drive.angularFrequency() * drive.halfStroke * (1.0 + e) / (1.0 - e);
    const double mass = batch.partOf(spec).massProperties.mass;
    return mass *
           (batch.gravity * spec.parts.front().pose.position.z() + kEnergyMargin * 0.5 * speed * speed);
}

/// How deep any corner of the part is inside the track. [m]
double calcDepth(const geometry::SolidProbe& probe, const part::Part& part, const track::Track& track,
                 const base::Pose& pose) {
    const base::Pose there{base::Quaternion(track.shape.tangentFrame(pose.position.x())) * pose.rotation,
                           track.shape.toRoom(pose.position)};
    double deepest = 0.0;
    for (const auto& piece : part.pieces) {
        for (const base::Vec3& vertex : piece.vertices) {
            const base::Vec3 point = there.apply(vertex);
            if (point.z() > track.height || point.z() < 0.0 || !probe.isInside(point)) continue;
            deepest = std::max(deepest, (probe.findNearest(point) - point).norm());
        }
    }
    return deepest;
}

/// What went wrong in a trial.
struct Finding {
    std::string kind;  // empty: nothing
    std::string about;
};

Finding judgeEnd(const trial::TrialBatch& batch, const trial::Outcome& outcome) {
    if (outcome.parts.size() != 1 || !trial::isFinite(outcome)) return {"not a number", ""};
    const base::Vec3& there = outcome.parts.front().farthest.position;
    const double off = std::max({there.x() - batch.track->finish, std::abs(there.y()), std::abs(there.z())});
    if (off > kFarOff) return {"thrown", fmt::format("{:g} m", off)};
    return {};
}

/// Of all that is wrong the worst.
Finding judgeWay(const trial::TrialBatch& batch, const trial::Trajectory& trajectory,
                 const geometry::SolidProbe& probe) {
    const double most = calcMostEnergy(batch);
    double energy = 0.0;
    double depth = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        energy = std::max(energy, verify::calcEnergy(batch, sample) / most);
        depth = std::max(depth, calcDepth(probe, batch.partOf(batch.trials.front()), *batch.track,
                                          sample.parts.front().track));
    }
    if (energy > 1.0) return {"too quick", fmt::format("{:.2f} times the most", energy)};
    if (depth > kDeep) return {"through the surface", fmt::format("{:.2f} mm", depth * 1e3)};
    return {};
}

}  // namespace

int main(int count, char** texts) {
    const Options options = readOptions(count, texts);
    const trial::EngineKind* kind = engines::registry().find(options.engine);
    if (kind == nullptr) return 2;
    const auto engine = kind->make({});
    std::vector<std::shared_ptr<const part::Part>> parts;
    for (const part::BundledPart& bundled : part::listBundledParts()) {
        const auto loaded = workflow::importPart({std::string(bundled.name)});
        if (loaded) parts.push_back(loaded->part);
    }
    std::map<std::string, int> findings;
    std::map<std::string, int> endings;
    int trials = 0;
    int watched = 0;
    unsigned rounds = 0;
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    for (unsigned number = options.first;
         options.rounds > 0 ? number < options.first + options.rounds : seconds() < options.seconds;
         ++number) {
        const auto round = makeRound(options, number, parts);
        if (!round) continue;
        ++rounds;
        const trial::TrialBatch& batch = round->batch;
        const auto tell = [&](std::size_t trial, const Finding& finding) {
            if (finding.kind.empty()) return;
            ++findings[finding.kind];
            fmt::print("round {} trial {}: {} {} ({})\n", number, trial, finding.kind, finding.about,
                       round->about);
        };
        const auto outcomes = engine->run({&batch, 1}, {});
        if (!outcomes) {
            tell(0, {"error", outcomes.error().message});
            continue;
        }
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < batch.trials.size(); ++i) {
            const trial::Outcome& outcome = outcomes->front()[i];
            ++trials;
            ++endings[std::string(trial::endingName(outcome.parts.front().ending))];
            tell(i, judgeEnd(batch, outcome));
            if (i % kWatched == 0) chosen.push_back(i);
        }
        std::vector<Finding> ways(chosen.size());
        const geometry::SolidProbe probe(batch.track->solid);
        base::parallelFor(chosen.size(), base::availableThreads(), [&](std::size_t k, unsigned /*worker*/) {
            trial::TrialBatch alone = batch;
            alone.trials = {batch.trials[chosen[k]]};
            const auto replay = engine->replay(alone, 0, kInterval, {});
            ways[k] = replay ? judgeWay(alone, *replay, probe) : Finding{"error", replay.error().message};
        });
        watched += static_cast<int>(chosen.size());
        for (std::size_t k = 0; k < chosen.size(); ++k)
            tell(chosen[k], ways[k]);
        std::fflush(stdout);
    }
    fmt::print("{}: {} rounds, {} trials, {} of them watched, {:.0f} s\n", options.engine, rounds, trials,
               watched, seconds());
    for (const auto& [name, number] : endings)
        fmt::print("{}: {}\n", name, number);
    for (const char* name : {"error", "not a number", "thrown", "too quick", "through the surface"})
        fmt::print("{}: {}\n", name, findings[name]);
    return 0;
}
