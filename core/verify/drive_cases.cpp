#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/trial/predicted_speed.h"
#include "core/verify/cases.h"
#include "core/verify/known_motions.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kMillimetre;
using base::Quaternion;
using base::Vec3;

namespace {

/// Below lift-off speeds are told from here to there. [periods]
constexpr int kSettled = 25;
constexpr int kEnd = 50;

/// The paper's cuboid lying on the flat track (8 x 12 mm face down) under a drive.
trial::TrialBatch makeLying(const trial::Vibration& drive, double duration,
                            const track::FeederShape& shape = {}) {
    constexpr double kFrom = 0.08;  // along the track [m]
    const Quaternion lying = Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3::UnitZ());
    const base::Mat3 frame = shape.tangentFrame(kFrom);
    const Vec3 surface = shape.toRoom({kFrom, 0.0, 15.0 * kMillimetre});
    trial::TrialBatch scene = makeStillScene(
        makeFlat(shape), makePaperCuboid(),
        {Quaternion(frame) * lying, surface + (2.0 * kMillimetre + 1e-9) * frame.col(2)}, duration);
    scene.drive = drive;
    return scene;
}

/// A feeder whose track climbs; a bowl, if any, so large that its track is straight.
track::FeederShape climbing(track::FeederType type, double slope) {
    track::FeederShape shape;
    shape.type = type;
    shape.bowlRadius = 50.0;
    shape.slope = slope;
    return shape;
}

/// Level at 15 mm but for what one tooth of 2 mm does, over and over: places in it and how deep they are. [m]
struct Tooth {
    const char* name;
    std::vector<std::pair<double, double>> profile;
};

std::shared_ptr<const track::Track> makeTeeth(const Tooth& tooth) {
    constexpr double kFirst = 0.06;
    constexpr double kPitch = 2.0 * kMillimetre;
    constexpr int kTeeth = 50;
    std::vector<double> xs{0.0};
    std::vector<double> depths{0.0};
    for (int i = 0; i < kTeeth; ++i)
        for (const auto& [place, depth] : tooth.profile) {
            xs.push_back(kFirst + i * kPitch + place);
            depths.push_back(depth);
        }
    xs.insert(xs.end(), {kFirst + kTeeth * kPitch, 0.4});
    depths.insert(depths.end(), {0.0, 0.0});
    return makeSurface(xs, {-0.03, -0.01, 0.01, 0.03}, [&](double x, double) {
        const auto at = std::lower_bound(xs.begin(), xs.end(), x) - xs.begin();
        return 15.0 * kMillimetre - depths[static_cast<std::size_t>(at)];
    });
}

/// Mean velocity of a point that slides and sticks on a track that leans by `lean` to its side, along the
/// track and down the lean: Newton's equations in small steps. Below lift-off. [m/s]
std::pair<double, double> calcCreep(const trial::Vibration& drive, double friction, double lean,
                                    double gravity) {
    constexpr double kStep = 1e-6;  // [s]
    const double omega = drive.angularFrequency();
    const auto steps = std::lround(drive.period() / kStep);
    double along = 0.0;
    double down = 0.0;
    double wayAlong = 0.0;
    double wayDown = 0.0;
    for (long step = 0; step < kEnd * steps; ++step) {
        const double push =
            -drive.halfStroke * omega * omega * std::sin(omega * (static_cast<double>(step) + 0.5) * kStep);
        const double weight = gravity + push * std::sin(drive.angle);  // per mass, on the vibrating track
        along -= kStep * push * std::cos(drive.angle);
        down += kStep * weight * std::sin(lean);
        const double speed = std::hypot(along, down);
        const double held = kStep * friction * weight * std::cos(lean);
        const double left = speed > held ? 1.0 - held / speed : 0.0;
        along *= left;
        down *= left;
        if (step < kSettled * steps) continue;
        wayAlong += kStep * along;
        wayDown += kStep * down;
    }
    const double time = (kEnd - kSettled) * drive.period();
    return {wayAlong / time, wayDown / time};
}

/// Mean speed along the surface between two whole numbers of periods, of samples one period apart, on a track
/// that climbs. [m/s]
double calcClimbingSpeed(const trial::Trajectory& trajectory, const track::FeederShape& shape, double period,
                         int fromPeriod, int toPeriod) {
    const auto& samples = trajectory.samples;
    if (static_cast<int>(samples.size()) <= toPeriod) return std::nan("");
    // On a linear feeder x is along the surface, on a bowl along the level.
    const double share = shape.type == track::FeederType::bowl ? std::cos(shape.slope) : 1.0;
    return (samples[toPeriod].parts[0].track.position.x() - samples[fromPeriod].parts[0].track.position.x()) /
           ((toPeriod - fromPeriod) * period * share);
}

/// Mean speed along x between two whole numbers of periods, of samples one period apart. [m/s]
double calcSpeed(const trial::Trajectory& trajectory, double period, int fromPeriod, int toPeriod) {
    const auto& samples = trajectory.samples;
    if (static_cast<int>(samples.size()) <= toPeriod) return std::nan("");
    return (samples[toPeriod].parts[0].room.position.x() - samples[fromPeriod].parts[0].room.position.x()) /
           ((toPeriod - fromPeriod) * period);
}

double measureSpeed(const trial::Engine& engine, const trial::TrialBatch& scene, int fromPeriod, int toPeriod,
                    const base::RunControl& control) {
    const double period = scene.drive.period();
    return calcSpeed(replayScene(engine, scene, period, control), period, fromPeriod, toPeriod);
}

/// A row for each speed, which must be right within a share.
std::vector<Row> judgeSpeeds(const std::vector<KnownMotion>& motions, const trial::EngineKind& kind,
                             double tolerance, int decimals, const base::RunControl& control) {
    const auto engine = kind.make({});
    std::vector<Row> rows;
    for (const KnownMotion& motion : motions) {
        const double got = motion.measure(replayScene(*engine, motion.batch, motion.interval, control));
        const double error = got / motion.expected - 1.0;
        rows.push_back(
            {motion.name,
             fmt::format("{:.{}f} mm/s within {:g} %", motion.expected * 1e3, decimals, tolerance * 100),
             fmt::format("{:.{}f} mm/s ({:+.2f} %)", got * 1e3, decimals, error * 100),
             std::abs(error) < tolerance});
    }
    return rows;
}

/// Whether the lying cuboid ever loses contact within ten periods.
bool leavesTrack(const trial::Engine& engine, double halfStroke, const base::RunControl& control) {
    trial::Vibration drive;
    drive.halfStroke = halfStroke;
    trial::TrialBatch scene = makeLying(drive, 0.2);
    scene.contact.restitution = 0.0;
    const trial::Trajectory trajectory = replayScene(engine, scene, 1e-5, control);
    return std::any_of(trajectory.samples.begin(), trajectory.samples.end(),
                       [](const trial::TrajectorySample& sample) {
                           return sample.time > 0.04 && sample.parts[0].contacts == 0;
                       });
}

/// Length of the first flight under vertical vibration without restitution, from the instant at which the
/// track's acceleration passes -g (known in closed form) to the landing, found between two samples. [s]
double measureFlight(const trial::Engine& engine, double throwNumber, const base::RunControl& control) {
    trial::Vibration drive;
    drive.angle = 90.0 * base::kDegree;
    drive.halfStroke =
        throwNumber * base::kStandardGravity / (drive.angularFrequency() * drive.angularFrequency());
    trial::TrialBatch scene = makeLying(drive, 0.06);
    scene.contact.restitution = 0.0;
    scene.trials[0].phase = -0.5 * base::kPi;  // at rest, like the part
    const trial::Trajectory trajectory = replayScene(engine, scene, 1e-6, control);
    const double takeOff = (0.5 * base::kPi + std::asin(1.0 / throwNumber)) / drive.angularFrequency();
    const double rest = trajectory.samples.front().parts[0].track.position.z();
    const auto gap = [&](std::size_t i) { return trajectory.samples[i].parts[0].track.position.z() - rest; };
    for (std::size_t i = 2; i < trajectory.samples.size(); ++i) {
        const double time = trajectory.samples[i - 1].time;
        if (time < takeOff + 0.25 * drive.period() || gap(i) > 1e-7) continue;
        // The last two samples in flight tell the speed of approach.
        const double speed = (gap(i - 2) - gap(i - 1)) / (time - trajectory.samples[i - 2].time);
        return time + gap(i - 1) / speed - takeOff;
    }
    return 2.0 * drive.period();
}

}  // namespace

std::vector<KnownMotion> makeStickSlip() {
    std::vector<KnownMotion> motions;
    for (const double halfStroke : {0.25e-3, 0.35e-3, 0.45e-3}) {
        for (const double friction : {0.3, 0.5}) {
            trial::Vibration drive;
            drive.halfStroke = halfStroke;
            const double period = drive.period();
            trial::TrialBatch scene = makeLying(drive, (kEnd + 0.5) * period);
            scene.contact = {friction, friction, 0.3};
            const double expected = trial::calcStickSlipSpeed(drive, friction, scene.gravity);
            motions.push_back(
                {fmt::format("stick-slip, half-stroke {:g} mm, friction {:g}", halfStroke * 1e3, friction),
                 std::move(scene), period, expected, [period](const trial::Trajectory& trajectory) {
                     return calcSpeed(trajectory, period, kSettled, kEnd);
                 }});
        }
    }
    return motions;
}

std::vector<KnownMotion> makeStickSlipOnCrests() {
    constexpr double kMm = kMillimetre;
    const Tooth teeth[] = {
        {"teeth that fall forward", {{0.0, 0.0}, {0.25 * kMm, 0.5 * kMm}}},
        {"teeth that fall backward", {{0.0, 0.0}, {1.75 * kMm, 0.5 * kMm}}},
        {"upright teeth that fall forward", {{0.0, 0.0}, {0.01 * kMm, 0.5 * kMm}}},
        {"upright teeth that fall backward", {{0.0, 0.0}, {1.99 * kMm, 0.5 * kMm}}},
        {"slots", {{0.0, 0.0}, {0.01 * kMm, 1.0 * kMm}, {0.5 * kMm, 1.0 * kMm}, {0.51 * kMm, 0.0}}}};
    std::vector<KnownMotion> motions;
    for (const Tooth& tooth : teeth) {
        trial::Vibration drive;
        drive.halfStroke = 0.45e-3;
        const double period = drive.period();
        trial::TrialBatch scene = makeLying(drive, (kEnd + 0.5) * period);
        scene.track = makeTeeth(tooth);
        const double expected =
            trial::calcStickSlipSpeed(drive, scene.contact.kineticFriction, scene.gravity);
        motions.push_back({fmt::format("stick-slip on {}", tooth.name), std::move(scene), period, expected,
                           [period](const trial::Trajectory& trajectory) {
                               return calcSpeed(trajectory, period, kSettled, kEnd);
                           }});
    }
    return motions;
}

std::vector<KnownMotion> makeCreep() {
    constexpr double kX = 0.1;
    std::vector<KnownMotion> motions;
    for (const double lean : {3.0 * base::kDegree, 8.0 * base::kDegree}) {
        trial::Vibration drive;
        drive.halfStroke = 0.45e-3;
        const double period = drive.period();
        const auto track = makeSlope(0.0, lean);
        const Vec3 normal(0.0, -std::sin(lean), std::cos(lean));
        const Quaternion lying = Quaternion::FromTwoVectors(Vec3::UnitZ(), normal) *
                                 Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3::UnitZ());
        const Vec3 foot(kX, 0.0, findSurfaceHeight(*track, kX, 0.0));
        trial::TrialBatch scene =
            makeStillScene(track, makePaperCuboid(), {lying, foot + (2.0 * kMillimetre + 1e-9) * normal},
                           (kEnd + 0.5) * period);
        scene.drive = drive;
        const auto [along, down] = calcCreep(drive, scene.contact.kineticFriction, lean, scene.gravity);
        const std::string about = fmt::format("leaning by {:g} deg", lean / base::kDegree);
        motions.push_back({about + ": along", scene, period, along, [period](const trial::Trajectory& way) {
                               return calcSpeed(way, period, kSettled, kEnd);
                           }});
        motions.push_back({about + ": creep down", std::move(scene), period, down,
                           [period, lean](const trial::Trajectory& way) {
                               if (static_cast<int>(way.samples.size()) <= kEnd) return std::nan("");
                               const double across = way.samples[kSettled].parts[0].room.position.y() -
                                                     way.samples[kEnd].parts[0].room.position.y();
                               return across / std::cos(lean) / ((kEnd - kSettled) * period);
                           }});
    }
    return motions;
}

std::vector<KnownMotion> makeHopping() {
    constexpr int kPeriods = 50;
    std::vector<KnownMotion> motions;
    for (const double halfStroke : {0.62e-3, 0.7e-3, 0.8e-3}) {
        for (const double restitution : {0.0, 0.2, 0.4}) {
            trial::Vibration drive;
            drive.halfStroke = halfStroke;
            const double period = drive.period();
            trial::TrialBatch scene = makeLying(drive, (2 * kPeriods + 1) * period);
            scene.contact = {0.5, 0.5, restitution};
            const double expected = trial::calcHoppingSpeed(drive, 0.5, restitution, scene.gravity, kPeriods);
            motions.push_back(
                {fmt::format("hopping, half-stroke {:g} mm, e = {:g}", halfStroke * 1e3, restitution),
                 std::move(scene), period, expected, [period](const trial::Trajectory& trajectory) {
                     return calcSpeed(trajectory, period, kPeriods, 2 * kPeriods);
                 }});
        }
    }
    return motions;
}

std::vector<KnownMotion> makeClimbing(track::FeederType type) {
    // As steep as drives of bowls are, so that what the slope takes from the angle leaves a speed to tell.
    const bool bowl = type == track::FeederType::bowl;
    const double angle = bowl ? 20.0 * base::kDegree : trial::Vibration().angle;
    const std::vector<double> halfStrokes =
        bowl ? std::vector{0.18e-3, 0.24e-3} : std::vector{0.35e-3, 0.45e-3};
    std::vector<KnownMotion> motions;
    for (const double slope : {3.0 * base::kDegree, -3.0 * base::kDegree}) {
        for (const double halfStroke : halfStrokes) {
            for (const double friction : {0.3, 0.5}) {
                const track::FeederShape shape = climbing(type, slope);
                trial::Vibration drive;
                drive.halfStroke = halfStroke;
                drive.angle = angle;
                const double period = drive.period();
                trial::TrialBatch scene = makeLying(drive, (kEnd + 0.5) * period, shape);
                scene.contact = {friction, friction, 0.3};
                const double expected = trial::calcStickSlipSpeed(trial::seenFromTrack(drive, shape),
                                                                  friction, scene.gravity, slope);
                motions.push_back(
                    {fmt::format("{} at {:+g} deg, half-stroke {:g} mm, friction {:g}",
                                 bowl ? "bowl" : "linear", slope / base::kDegree, halfStroke * 1e3, friction),
                     std::move(scene), period, expected,
                     [shape, period](const trial::Trajectory& trajectory) {
                         return calcClimbingSpeed(trajectory, shape, period, kSettled, kEnd);
                     }});
            }
        }
    }
    return motions;
}

std::vector<Row> runStickSlip(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeStickSlip(), kind, 0.02, 3, control);
}

std::vector<Row> runStickSlipOnCrests(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeStickSlipOnCrests(), kind, 0.02, 3, control);
}

std::vector<Row> runCreep(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeCreep(), kind, 0.03, 3, control);
}

std::vector<Row> runSlopedFeeder(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeClimbing(track::FeederType::linear), kind, 0.02, 3, control);
}

std::vector<Row> runClimbingBowl(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeClimbing(track::FeederType::bowl), kind, 0.03, 3, control);
}

std::vector<Row> runHopping(const trial::EngineKind& kind, const base::RunControl& control) {
    return judgeSpeeds(makeHopping(), kind, 0.03, 2, control);
}

std::vector<Row> runLiftOff(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    const bool early = leavesTrack(*engine, 0.47e-3, control);
    const bool late = leavesTrack(*engine, 0.49e-3, control);
    return {{"lift-off at 50 Hz, 12 deg", "first flight between 0.47 and 0.49 mm",
             fmt::format("{} at 0.47 mm, {} at 0.49 mm", early ? "flies" : "stays", late ? "flies" : "stays"),
             !early && late}};
}

std::vector<Row> runPlasticHop(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    const double expected = std::sqrt(1.0 + base::kPi * base::kPi);
    double low = 0.95 * expected;
    double high = 1.05 * expected;
    const double period = trial::Vibration{}.period();
    for (int i = 0; i < 8; ++i) {
        const double middle = 0.5 * (low + high);
        (measureFlight(*engine, middle, control) < period ? low : high) = middle;
    }
    const double got = 0.5 * (low + high);
    return {{"plastic hop of one period", fmt::format("throw number {:.3f} within 2 %", expected),
             fmt::format("{:.3f} ({:+.2f} %)", got, (got / expected - 1.0) * 100),
             std::abs(got / expected - 1.0) < 0.02}};
}

std::vector<Row> runStepHalved(const trial::EngineKind& kind, const base::RunControl& control) {
    std::vector<Row> rows;
    const double step = kind.make({})->step();
    for (const double halfStroke : {0.4e-3, 0.62e-3, 0.7e-3, 0.8e-3, 0.9e-3}) {
        trial::Vibration drive;
        drive.halfStroke = halfStroke;
        const trial::TrialBatch scene = makeLying(drive, 1.31);
        const double whole = measureSpeed(*kind.make({0, step}), scene, 25, 65, control);
        const double half = measureSpeed(*kind.make({0, 0.5 * step}), scene, 25, 65, control);
        rows.push_back({fmt::format("step halved, flat speed at half-stroke {:g} mm", halfStroke * 1e3),
                        "changes < 3 %",
                        fmt::format("{:.2f} and {:.2f} mm/s ({:+.2f} %)", whole * 1e3, half * 1e3,
                                    (half / whole - 1.0) * 100),
                        std::abs(half / whole - 1.0) < 0.03});
    }
    return rows;
}

}  // namespace trapwright::verify
