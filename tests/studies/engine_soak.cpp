// Trials of anything on anything, for as long as one likes: random tracks, parts, conditions and steps; or
// with --track FILE --part NAME of a given track, which a search has had the time to find faults in. Counts
// what no engine may do: poses that are not numbers, parts that are thrown off, energy that grows, parts
// inside the track or falling through its surface. Each finding is told with what makes it again:
// engine_soak --seed S --first R --rounds 1; with --trial T besides the way of that trial alone is told, by
// the moments of its last fifth of a second.

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
#include "core/track/track_file.h"
#include "core/verify/scenes.h"
#include "core/workflow/part_source.h"
#include "sim/engines/registry.h"

using namespace trapwright;

namespace {

constexpr int kTrials = 96;              // of a round
constexpr int kWatched = 16;             // every so manieth is looked at all the way
constexpr double kInterval = 8e-3;       // between two looks [s]
constexpr double kCloseInterval = 1e-3;  // of a way that is told [s]
constexpr double kDeep = 0.5e-3;         // inside the track, more than recovery leaves for a moment [m]
constexpr double kProbeDistance = 0.2;   // of two points on an edge, in radii of the part
constexpr double kFarOff = 1.0;          // off the track [m]
constexpr double kTold = 0.2;            // of a way [s]
constexpr double kEnergyMargin = 2.0;    // over what the drive can give

struct Options {
    double seconds = 600.0;
    std::uint64_t seed = 1;
    unsigned first = 0;
    unsigned rounds = 0;  // 0: by time
    int trial = -1;       // -1: all
    std::string engine = "native";
    std::string track;  // a track's file; none: random ones
    std::string part;   // a bundled one, on that track
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
        if (key == "--trial") options.trial = std::atoi(value);
        if (key == "--engine") options.engine = value;
        if (key == "--track") options.track = value;
        if (key == "--part") options.part = value;
    }
    return options;
}

/// One track, part and step, and trials all over a wide box.
struct Round {
    std::string about;
    study::Settings settings;
    trial::TrialBatch batch;
};

void drawTrackSettings(study::Settings& settings, const part::Part& part, base::Random& random) {
    const std::uint32_t kind = random.below(5);
    settings = kind == 4   ? study::ledgeMode(settings, part)
               : kind == 3 ? study::sortingMode(settings, part)
                           : study::turningMode(settings, part);
    // The paper's free points make surfaces that overhang; few of them do not cross themselves.
    if (kind < 3) settings.track.crossSections = 1 + static_cast<int>(random.below(5));
    if (kind == 2) settings.track.encoding = traps::PointEncoding::free;
    if (random.boolean())
        settings.track.shape = {track::FeederType::bowl, 0.175, track::Conveying::clockwise};
}

void drawSimulation(study::Settings& settings, base::Random& random) {
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
}

/// None where the design gives no track, or one that crosses itself: those are not simulated.
std::shared_ptr<const track::Track> drawTrack(const study::TrackSettings& settings, base::Random& random) {
    search::Design design;
    for (std::size_t i = 0; i < study::designSpace(settings).dimensions.size(); ++i)
        design.push_back(random.uniform());
    auto built = study::decodeTrack(settings, design);
    if (!built || geometry::countOverlappingTriangles(built->solid, built->surfaceTriangles) > 0) return {};
    return std::make_shared<const track::Track>(std::move(*built));
}

/// `given`: the track, or none for a random one.
std::optional<Round> makeRound(const Options& options, unsigned number,
                               std::span<const std::shared_ptr<const part::Part>> parts,
                               const std::shared_ptr<const track::Track>& given) {
    base::Random random({options.seed, number, 0, 0, base::Purpose::test});
    const std::shared_ptr<const part::Part>& part =
        parts[random.below(static_cast<std::uint32_t>(parts.size()))];
    Round round;
    study::Settings& settings = round.settings;
    auto preset = study::presetSettings("cuboid");
    if (!preset) return std::nullopt;
    settings = *preset;
    settings.evolution.seed = options.seed;
    drawTrackSettings(settings, *part, random);
    drawSimulation(settings, random);
    const std::shared_ptr<const track::Track> track = given ? given : drawTrack(settings.track, random);
    if (!track) return std::nullopt;
    round.batch = study::makeLearningBatch(study::makeScene(settings, part, track),
                                           {static_cast<int>(number), 0}, kTrials);
    round.about =
        fmt::format("{} on {}{}, step {:g} ms", part->name, given ? options.track : settings.track.traps,
                    track->shape.type == track::FeederType::bowl ? " in a bowl" : "",
                    settings.evolution.learningStep * 1e3);
    return round;
}

/// What the energy of a trial's part may be, over height 0: what it has as high as the track is anywhere, and
/// half the square of the speed at which bouncing on the track gains no more. [J]
double calcMostEnergy(const trial::TrialBatch& batch) {
    const trial::TrialSpec& spec = batch.trials.front();
    const trial::Vibration& drive = batch.driveOf(spec);
    const double e = batch.contactOf(spec).restitution;
    const double speed = drive.angularFrequency() * drive.halfStroke * (1.0 + e) / (1.0 - e);
    const double mass = batch.partOf(spec).massProperties.mass;
    double top = spec.parts.front().pose.position.z();
    for (const base::Vec3& vertex : batch.track->solid.vertices)
        top = std::max(top, vertex.z() + batch.partOf(spec).boundingRadius);
    const double begin = spec.parts.front().velocity.squaredNorm();
    return mass * (batch.gravity * top + 0.5 * begin + kEnergyMargin * 0.5 * speed * speed);
}

/// Corners of the part, and points on its edges: one that lies over a crest has its corners in the air.
std::vector<base::Vec3> listProbes(const part::Part& part) {
    std::vector<base::Vec3> probes;
    for (const geometry::ConvexPolytope& piece : part.pieces) {
        probes.insert(probes.end(), piece.vertices.begin(), piece.vertices.end());
        for (const geometry::PolytopeEdge& edge : piece.edges) {
            const base::Vec3& from = piece.vertices[edge.from];
            const base::Vec3 along = piece.vertices[edge.to] - from;
            const int between = static_cast<int>(along.norm() / (kProbeDistance * part.boundingRadius));
            for (int i = 1; i <= between; ++i)
                probes.emplace_back(from + i / (between + 1.0) * along);
        }
    }
    return probes;
}

/// Of some points the one that is deepest inside the track.
struct Deepest {
    double depth = 0.0;                        // [m]
    base::Vec3 place = base::Vec3::Zero();     // in the frame of the track's mesh [m]
    base::Vec3 ownPlace = base::Vec3::Zero();  // in the part frame [m]
};

Deepest findDeepest(const geometry::SolidProbe& probe, std::span<const base::Vec3> points,
                    const track::Track& track, const base::Pose& pose) {
    const base::Pose there{base::Quaternion(track.shape.tangentFrame(pose.position.x())) * pose.rotation,
                           track.shape.toRoom(pose.position)};
    Deepest deepest;
    for (const base::Vec3& own : points) {
        const base::Vec3 point = there.apply(own);
        if (!probe.isInside(point)) continue;
        const double depth = (probe.findNearest(point) - point).norm();
        if (depth > deepest.depth) deepest = {depth, point, own};
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
    if (outcome.parts.front().throughSurface) return {"fell through", ""};
    const base::Vec3& there = outcome.parts.front().farthest.position;
    const double off = std::max({there.x() - batch.track->finish, std::abs(there.y()), std::abs(there.z())});
    if (off > kFarOff) return {"thrown", fmt::format("{:g} m", off)};
    return {};
}

/// Of all that is wrong the worst.
Finding judgeWay(const trial::TrialBatch& batch, const trial::Trajectory& trajectory,
                 const geometry::SolidProbe& probe) {
    const double most = calcMostEnergy(batch);
    const std::vector<base::Vec3> points = listProbes(batch.partOf(batch.trials.front()));
    double energy = 0.0;
    double depth = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        energy = std::max(energy, verify::calcEnergy(batch, sample) / most);
        depth = std::max(depth, findDeepest(probe, points, *batch.track, sample.parts.front().track).depth);
    }
    if (energy > 1.0) return {"too quick", fmt::format("{:.2f} times the most", energy)};
    if (depth > kDeep) return {"inside the track", fmt::format("{:.2f} mm", depth * 1e3)};
    return {};
}

/// One trial's last moments.
void tellWay(const trial::TrialBatch& batch, const trial::Trajectory& trajectory,
             const geometry::SolidProbe& probe) {
    const std::vector<base::Vec3> points = listProbes(batch.partOf(batch.trials.front()));
    const trial::PartOutcome& end = trajectory.outcome.parts.front();
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        if (sample.time < end.time - kTold) continue;
        const trial::PartState& state = sample.parts.front();
        const base::Vec3 at = state.track.position * 1e3;
        const Deepest deepest = findDeepest(probe, points, *batch.track, state.track);
        fmt::print("{:.4f} s: ({:.2f}, {:.2f}, {:.2f}) mm, {:.3f} m/s, {:.1f} rad/s, {:.3f} mm inside",
                   sample.time, at.x(), at.y(), at.z(), state.velocity.norm(), state.angularVelocity.norm(),
                   1e3 * deepest.depth);
        if (deepest.depth > 0.0)
            fmt::print(" at ({:.3f}, {:.3f}, {:.3f}) mm, the part's ({:.3f}, {:.3f}, {:.3f})",
                       1e3 * deepest.place.x(), 1e3 * deepest.place.y(), 1e3 * deepest.place.z(),
                       1e3 * deepest.ownPlace.x(), 1e3 * deepest.ownPlace.y(), 1e3 * deepest.ownPlace.z());
        fmt::print("\n");
        for (const trial::ContactForce& contact : sample.forces) {
            const base::Vec3 place = contact.point * 1e3;
            const base::Vec3 push = contact.force * 1e3;
            fmt::print("    at ({:.3f}, {:.3f}, {:.3f}) mm: ({:.1f}, {:.1f}, {:.1f}) mN\n", place.x(),
                       place.y(), place.z(), push.x(), push.y(), push.z());
        }
    }
    fmt::print("{} after {:.4f} s{}\n", trial::endingName(end.ending), end.time,
               end.throughSurface ? ", through the surface" : "");
}

}  // namespace

int main(int count, char** texts) {
    const Options options = readOptions(count, texts);
    const trial::EngineKind* kind = engines::registry().find(options.engine);
    if (kind == nullptr) return 2;
    const auto engine = kind->make({});
    std::vector<std::shared_ptr<const part::Part>> parts;
    std::shared_ptr<const track::Track> given;
    if (!options.track.empty()) {
        auto file = track::readTrackFile(options.track);
        if (!file) {
            fmt::print(stderr, "{}\n", file.error().message);
            return 2;
        }
        given = std::make_shared<const track::Track>(std::move(file->track));
    }
    for (const part::BundledPart& bundled : part::listBundledParts()) {
        if (!options.part.empty() && bundled.name != options.part) continue;
        const auto loaded = workflow::importPart({std::string(bundled.name)});
        if (loaded) parts.push_back(loaded->part);
    }
    if (parts.empty()) {
        fmt::print(stderr, "--part {}: the bundled parts are {}\n", options.part, part::nameBundledParts());
        return 2;
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
        const auto round = makeRound(options, number, parts, given);
        if (!round) continue;
        ++rounds;
        const trial::TrialBatch& batch = round->batch;
        const auto tell = [&](std::size_t trial, const Finding& finding) {
            if (finding.kind.empty()) return;
            ++findings[finding.kind];
            fmt::print("round {} trial {}: {} {} ({})\n", number, trial, finding.kind, finding.about,
                       round->about);
        };
        if (options.trial >= 0) {
            const auto replay =
                engine->replay(batch, static_cast<std::size_t>(options.trial), kCloseInterval, {});
            if (!replay) {
                tell(static_cast<std::size_t>(options.trial), {"error", replay.error().message});
                continue;
            }
            trial::TrialBatch alone = batch;
            alone.trials = {batch.trials.at(static_cast<std::size_t>(options.trial))};
            fmt::print("{}\n", round->about);
            tellWay(alone, *replay, geometry::SolidProbe(batch.track->solid));
            continue;
        }
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
    for (const char* name :
         {"error", "not a number", "thrown", "fell through", "too quick", "inside the track"})
        fmt::print("{}: {}\n", name, findings[name]);
    return 0;
}
