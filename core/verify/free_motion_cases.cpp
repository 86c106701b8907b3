#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/verify/cases.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kMillimetre;
using base::Vec3;

namespace {

/// Rebound over impact speed of a part dropped so that it hits a plane at `speed`: from the heights of its
/// centre.
double measureRebound(const trial::Engine& engine, const base::Quaternion& rotation, double speed,
                      double restitution, const base::RunControl& control) {
    const auto part = makePaperCuboid();
    const auto track = makeFlat();
    double lowest = 0.0;
    for (const Vec3& vertex : part->hull.vertices)
        lowest = std::min(lowest, (rotation * vertex).z());
    const double rest = 15.0 * kMillimetre - lowest;
    const double drop = speed * speed / (2.0 * base::kStandardGravity);
    const double flight = speed / base::kStandardGravity;
    trial::TrialBatch scene = makeStillScene(track, part, {rotation, Vec3(0.1, 0.0, rest + drop)},
                                             flight + restitution * 2.0 * flight + 2e-3);
    scene.contact.restitution = restitution;
    const trial::Trajectory trajectory = replayScene(engine, scene, 1e-4, control);
    double apex = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples)
        if (sample.time > flight + 0.25 * restitution * flight + 5e-4)
            apex = std::max(apex, sample.parts[0].room.position.z() - rest);
    return std::sqrt(std::max(apex, 0.0) / drop);
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

std::vector<Row> runBounce(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    std::vector<Row> rows;
    const base::Quaternion onCorner = base::Quaternion::FromTwoVectors(Vec3(2, 4, 6), Vec3::UnitZ());
    for (const double restitution : {0.0, 0.3, 0.6}) {
        for (const double speed : {0.03, 0.1, 0.5}) {
            const double flat =
                measureRebound(*engine, base::Quaternion::Identity(), speed, restitution, control);
            const double corner = measureRebound(*engine, onCorner, speed, restitution, control);
            rows.push_back({fmt::format("bounce at {:g} m/s, e = {:g}", speed, restitution),
                            fmt::format("{:g} within 0.03", restitution),
                            fmt::format("flat {:.3f}, on a corner {:.3f}", flat, corner),
                            std::abs(flat - restitution) < 0.03 && std::abs(corner - restitution) < 0.03});
        }
    }
    return rows;
}

}  // namespace trapwright::verify
