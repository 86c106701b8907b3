#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/verify/cases.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kDegree;
using base::kMillimetre;
using base::Quaternion;
using base::Vec3;

namespace {

constexpr double kRidgeX = 0.1;
constexpr double kRidgeTop = 20.0 * kMillimetre;

/// A ridge across the track, 5 mm high with flanks of `run` [m].
std::shared_ptr<const track::Track> makeRidge(double run) {
    return makeSurface({0.0, kRidgeX - run, kRidgeX, kRidgeX + run, 0.3}, {-0.03, -0.01, 0.01, 0.03},
                       [](double x, double) { return x == kRidgeX ? kRidgeTop : 15.0 * kMillimetre; });
}

/// The cuboid with its 8 x 12 mm face down, 12 mm along x.
Quaternion lyingAlong() {
    base::Mat3 r;
    r.col(0) = Vec3::UnitZ();
    r.col(1) = Vec3::UnitY();
    r.col(2) = -Vec3::UnitX();
    return Quaternion(r);
}

/// How deep the ridge's crest is inside the part at worst: distance to the part's nearest face. [m]
double findDeepest(const trial::Trajectory& trajectory, const part::Part& part) {
    double deepest = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        const base::Mat3 back = sample.parts[0].room.rotation.toRotationMatrix().transpose();
        for (int i = -60; i <= 60; ++i) {
            const Vec3 p =
                back * (Vec3(kRidgeX, 0.5 * kMillimetre * i, kRidgeTop) - sample.parts[0].room.position);
            double outside = -1e300;
            for (const auto& face : part.hull.faces)
                outside = std::max(outside, face.normal.dot(p) - face.offset);
            deepest = std::max(deepest, -outside);
        }
    }
    return deepest;
}

/// The same as a share of the kinetic and lift energy at hand.
double findEnergyGainShare(const trial::TrialBatch& scene, const trial::Trajectory& trajectory) {
    const double first = calcEnergy(scene, trajectory.samples.front());
    return findEnergyGain(scene, trajectory) /
           (first - scene.parts[0]->massProperties.mass * scene.gravity * 15.0 * kMillimetre);
}

/// Energy may rise by this share: overlaps of a few micrometres are lifted out.
constexpr double kEnergyNoise = 2e-3;

}  // namespace

std::vector<Row> runRidgeBalance(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    // Off the crest by a tenth of a millimetre the part must tip that way, on both sides alike; on it, stay.
    const auto tilt = [&](double offset) {
        const trial::TrialBatch scene = makeStillScene(
            makeRidge(10.0 * kMillimetre), makePaperCuboid(),
            {lyingAlong(), Vec3(kRidgeX + offset, 0.0, kRidgeTop + 2.0 * kMillimetre + 1e-9)}, 0.15);
        const trial::Trajectory trajectory = replayScene(*engine, scene, 0.01, control);
        return (trajectory.samples.back().parts[0].room.rotation * Vec3::UnitX())
            .x();  // sine of the tilt toward +x
    };
    const double centred = tilt(0.0);
    const double forward = tilt(0.1 * kMillimetre);
    const double backward = tilt(-0.1 * kMillimetre);
    return {{"cuboid resting on a ridge for 0.15 s",
             "centred: level; 0.1 mm off: tips that way, alike on both sides",
             fmt::format("{:.1e}, {:+.3f} and {:+.3f} rad", centred, std::asin(forward), std::asin(backward)),
             std::abs(centred) < 1e-3 && forward > 0.02 && backward < -0.02 &&
                 std::abs(forward + backward) < 0.1 * forward}};
}

std::vector<Row> runRidgeDrop(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double deepest = 0.0;
    double gain = -1.0;
    base::Random random({1, 0, 0, 0, base::Purpose::test});
    for (int i = 0; i < 40; ++i) {
        const Quaternion rotation = i == 0 ? lyingAlong() : random.rotation();
        trial::TrialBatch scene = makeStillScene(
            makeRidge(i % 2 ? 10.0 * kMillimetre : 1.0 * kMillimetre), makePaperCuboid(),
            {rotation, Vec3(kRidgeX + random.uniform(-2e-3, 2e-3), 0.0, kRidgeTop + 8.0 * kMillimetre)}, 0.2);
        scene.trials[0].parts[0].velocity = Vec3(0.0, 0.0, -1.0);
        scene.trials[0].parts[0].angularVelocity =
            i == 0 ? Vec3::Zero().eval()
                   : Vec3(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
        const trial::Trajectory trajectory = replayScene(*engine, scene, 2e-4, control);
        deepest = std::max(deepest, findDeepest(trajectory, *scene.parts[0]));
        gain = std::max(gain, findEnergyGainShare(scene, trajectory));
    }
    return {{"dropped on a ridge at 1 m/s, 40 ways: overlap", "< 0.1 mm",
             fmt::format("{:.4f} mm", deepest * 1e3), deepest < 1e-4},
            {"dropped on a ridge at 1 m/s, 40 ways: energy", "never grows",
             fmt::format("by {:.1e} at most", gain), gain < kEnergyNoise}};
}

std::vector<Row> runRidgeSlide(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double deepest = 0.0;
    double gain = -1.0;
    double least = 1e300;
    for (const double heading : {0.0, 30.0, 75.0}) {
        const Quaternion rotation =
            Quaternion(Eigen::AngleAxisd(heading * kDegree, Vec3::UnitZ())) * lyingAlong();
        trial::TrialBatch scene =
            makeStillScene(makeRidge(20.0 * kMillimetre), makePaperCuboid(),
                           {rotation, Vec3(kRidgeX - 0.035, 0.0, 17.0 * kMillimetre + 1e-9)}, 0.5);
        scene.contact = {0.1, 0.1, 0.3};
        scene.trials[0].parts[0].velocity = Vec3(0.8, 0.0, 0.0);
        const trial::Trajectory trajectory = replayScene(*engine, scene, 2e-4, control);
        deepest = std::max(deepest, findDeepest(trajectory, *scene.parts[0]));
        gain = std::max(gain, findEnergyGainShare(scene, trajectory));
        least = std::min(least, trajectory.samples.back().parts[0].room.position.x());
    }
    return {{"sliding over a ridge at 0.8 m/s: overlap", "< 0.1 mm, gets across",
             fmt::format("{:.4f} mm, {:.0f} mm past the crest", deepest * 1e3, (least - kRidgeX) * 1e3),
             deepest < 1e-4 && least > kRidgeX},
            {"sliding over a ridge at 0.8 m/s: energy", "never grows", fmt::format("by {:.1e} at most", gain),
             gain < kEnergyNoise}};
}

std::vector<Row> runThinWall(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    // A blade 0.1 mm thick at its foot and 15 mm high; parts flung against it at 1 m/s.
    const auto track =
        makeSurface({0.0, kRidgeX - 0.05e-3, kRidgeX, kRidgeX + 0.05e-3, 0.3}, {-0.03, -0.01, 0.01, 0.03},
                    [](double x, double) { return x == kRidgeX ? 30.0 * kMillimetre : 15.0 * kMillimetre; });
    base::Random random({2, 0, 0, 0, base::Purpose::test});
    int through = 0;
    constexpr int kThrows = 40;
    for (int i = 0; i < kThrows; ++i) {
        trial::TrialBatch scene = makeStillScene(
            track, makePaperCuboid(),
            {random.rotation(), Vec3(kRidgeX - 0.02, random.uniform(-0.01, 0.01), 23.0 * kMillimetre)}, 0.12);
        scene.trials[0].parts[0].velocity = Vec3(1.0, 0.0, 0.0);
        const trial::Trajectory trajectory = replayScene(*engine, scene, 2e-4, control);
        // Over the top is allowed; below it no centre may get to the other side.
        for (const trial::TrajectorySample& sample : trajectory.samples)
            if (sample.parts[0].room.position.x() > kRidgeX &&
                sample.parts[0].room.position.z() < 28.0 * kMillimetre) {
                ++through;
                break;
            }
    }
    return {{fmt::format("{} parts against a thin wall at 1 m/s", kThrows), "none passes",
             fmt::format("{} passed", through), through == 0}};
}

std::vector<Row> runStillTrack(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double drift = 0.0;
    base::Random random({3, 0, 0, 0, base::Purpose::test});
    const auto track = makeRough();
    for (int i = 0; i < 6; ++i) {
        const double x = random.uniform(0.05, 0.3);
        const double y = random.uniform(-0.015, 0.015);
        const trial::TrialBatch scene = makeStillScene(
            track, makePaperCuboid(),
            {random.rotation(), Vec3(x, y, findSurfaceHeight(*track, x, y) + 12.0 * kMillimetre)}, 11.01);
        const trial::Trajectory trajectory = replayScene(*engine, scene, 1.0, control);
        if (trajectory.samples.size() < 12)
            return {{"no vibration on a rough track", "drift < 1 um in 10 s", "the part fell off", false}};
        drift = std::max(drift, (trajectory.samples[11].parts[0].room.position -
                                 trajectory.samples[1].parts[0].room.position)
                                    .norm());
    }
    return {{"no vibration on a rough track, 6 parts", "drift < 1 um in 10 s",
             fmt::format("{:.3g} um", drift * 1e6), drift < 1e-6}};
}

}  // namespace trapwright::verify
