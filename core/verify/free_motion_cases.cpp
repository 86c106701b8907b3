#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/verify/cases.h"
#include "core/verify/known_motions.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kMillimetre;
using base::Vec3;

namespace {

/// The cuboid, dropped so that it hits a plane at `speed` [m/s]; the rebound is told from the heights of its
/// centre.
KnownMotion makeBounce(const std::string& name, const base::Quaternion& rotation, double speed,
                       double restitution) {
    const auto part = makePaperCuboid();
    double lowest = 0.0;
    for (const Vec3& vertex : part->hull.vertices)
        lowest = std::min(lowest, (rotation * vertex).z());
    const double rest = 15.0 * kMillimetre - lowest;
    const double drop = speed * speed / (2.0 * base::kStandardGravity);
    const double flight = speed / base::kStandardGravity;
    trial::TrialBatch scene = makeStillScene(makeFlat(), part, {rotation, Vec3(0.1, 0.0, rest + drop)},
                                             flight + restitution * 2.0 * flight + 2e-3);
    scene.contact.restitution = restitution;
    return {name, std::move(scene), 1e-4, restitution, [=](const trial::Trajectory& trajectory) {
                double apex = 0.0;
                for (const trial::TrajectorySample& sample : trajectory.samples)
                    if (sample.time > flight + 0.25 * restitution * flight + 5e-4)
                        apex = std::max(apex, sample.parts[0].room.position.z() - rest);
                return std::sqrt(std::max(apex, 0.0) / drop);
            }};
}

}  // namespace

std::vector<Row> runTumbling(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    trial::TrialBatch scene =
        makeStillScene(makeFlat(), makePaperCuboid(),
                       {base::Quaternion(0.9, 0.3, -0.2, 0.1).normalized(), Vec3(0.1, 0, 0.1)}, 10.0);
    scene.gravity = 0.0;
    scene.trials[0].parts[0].angularVelocity = Vec3(12.0, 9.0, -15.0);
    const trial::Trajectory trajectory = replayScene(*engine, scene, 0.01, control);

    const auto momentum = [&](const trial::TrajectorySample& s) -> Vec3 {
        const base::Mat3 r = s.parts[0].room.rotation.toRotationMatrix();
        return r * (scene.parts[0]->massProperties.inertia * (r.transpose() * s.parts[0].angularVelocity));
    };
    const Vec3 momentum0 = momentum(trajectory.samples.front());
    const double energy0 = calcEnergy(scene, trajectory.samples.front());
    double energyError = 0.0;
    double momentumError = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        energyError = std::max(energyError, std::abs(calcEnergy(scene, sample) / energy0 - 1.0));
        momentumError = std::max(momentumError, (momentum(sample) - momentum0).norm() / momentum0.norm());
    }
    const double tolerance = kind.freeMotionTolerance;
    const bool whole = trajectory.outcome.parts[0].time > 9.9;
    return {{"tumbling for 10 s: energy", fmt::format("within {:.0e}", tolerance),
             fmt::format("{:.1e}", energyError), whole && energyError < tolerance},
            {"tumbling for 10 s: angular momentum", fmt::format("within {:.0e}", tolerance),
             fmt::format("{:.1e}", momentumError), whole && momentumError < tolerance}};
}

std::vector<KnownMotion> makeBounces() {
    std::vector<KnownMotion> motions;
    const base::Quaternion onCorner = base::Quaternion::FromTwoVectors(Vec3(2, 4, 6), Vec3::UnitZ());
    for (const double restitution : {0.0, 0.3, 0.6}) {
        for (const double speed : {0.03, 0.1, 0.5}) {
            const std::string name = fmt::format("bounce at {:g} m/s, e = {:g}", speed, restitution);
            motions.push_back(makeBounce(name, base::Quaternion::Identity(), speed, restitution));
            motions.push_back(makeBounce(name, onCorner, speed, restitution));
        }
    }
    return motions;
}

std::vector<Row> runBounce(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    std::vector<Row> rows;
    const std::vector<KnownMotion> motions = makeBounces();
    const auto measure = [&](const KnownMotion& motion) {
        return motion.measure(replayScene(*engine, motion.batch, motion.interval, control));
    };
    for (std::size_t i = 0; i < motions.size(); i += 2) {
        const double expected = motions[i].expected;
        const double flat = measure(motions[i]);
        const double corner = measure(motions[i + 1]);
        rows.push_back({motions[i].name, fmt::format("{:g} within 0.03", expected),
                        fmt::format("flat {:.3f}, on a corner {:.3f}", flat, corner),
                        std::abs(flat - expected) < 0.03 && std::abs(corner - expected) < 0.03});
    }
    return rows;
}

}  // namespace trapwright::verify
