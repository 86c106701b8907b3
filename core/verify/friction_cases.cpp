#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/track/track_builder.h"
#include "core/verify/cases.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

using base::kDegree;
using base::kMillimetre;
using base::Quaternion;
using base::Vec3;

namespace {

constexpr double kFriction = 0.5;

/// A part standing on makeSlope(slopeX, slopeY) with its face -z down, turned by `heading` about the slope's
/// normal.
trial::TrialBatch makeOnSlope(std::shared_ptr<const part::Part> part, double halfHeight, double slopeX,
                              double slopeY, double heading, double duration) {
    const auto track = makeSlope(slopeX, slopeY);
    const Vec3 normal = Vec3(-std::tan(slopeX), -std::tan(slopeY), 1.0).normalized();
    const Vec3 foot(0.33, 0.01, findSurfaceHeight(*track, 0.33, 0.01));
    const Quaternion rotation = Quaternion::FromTwoVectors(Vec3::UnitZ(), normal) *
                                Quaternion(Eigen::AngleAxisd(heading, Vec3::UnitZ()));
    return makeStillScene(track, std::move(part), {rotation, foot + (halfHeight + 1e-6) * normal}, duration);
}

/// A flat block that does not topple: 12 x 12 x 4 mm.
std::shared_ptr<const part::Part> makeFlatBlock() {
    return makeCuboid(Vec3(12, 12, 4) * kMillimetre, 1040.0);
}

const trial::TrajectorySample& sampleAt(const trial::Trajectory& trajectory, double time) {
    const auto at = std::lower_bound(trajectory.samples.begin(), trajectory.samples.end(), time - 1e-9,
                                     [](const trial::TrajectorySample& s, double t) { return s.time < t; });
    return at == trajectory.samples.end() ? trajectory.samples.back() : *at;
}

}  // namespace

std::vector<Row> runSlope(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double creep = 0.0;
    double worst = 0.0;
    for (const bool along : {true, false}) {
        for (const double heading : {0.0, 0.5}) {
            const auto slope = [&](double angle) {
                return makeOnSlope(makeFlatBlock(), 2.0 * kMillimetre, along ? angle : 0.0,
                                   along ? 0.0 : angle, heading, 1.5);
            };
            trial::TrialBatch below = slope(24.0 * kDegree);
            below.contact = {kFriction, kFriction, 0.0};
            const trial::Trajectory rest = replayScene(*engine, below, 0.1, control);
            creep = std::max(creep, (sampleAt(rest, 1.4).parts[0].room.position -
                                     sampleAt(rest, 0.4).parts[0].room.position)
                                        .norm());

            const double angle = 30.0 * kDegree;
            trial::TrialBatch above = slope(angle);
            above.contact = {kFriction, kFriction, 0.0};
            const trial::Trajectory slide = replayScene(*engine, above, 0.01, control);
            // Samples are at whole steps of the engine.
            const trial::TrajectorySample& from = sampleAt(slide, 0.05);
            const trial::TrajectorySample& to = sampleAt(slide, 0.25);
            const double gained = (to.parts[0].velocity - from.parts[0].velocity).norm();
            const double expected = base::kStandardGravity * (std::sin(angle) - kFriction * std::cos(angle));
            const double error = gained / (to.time - from.time) / expected - 1.0;
            if (std::abs(error) > std::abs(worst)) worst = error;
        }
    }
    return {{"rest on a 24 deg slope, friction 0.5 (26.6 deg)", "creep < 0.1 mm/s",
             fmt::format("{:.2g} mm/s", creep * 1e3), creep < 1e-4},
            {"slide on a 30 deg slope, friction 0.5", "g (sin - mu cos) within 1 %",
             fmt::format("off by {:+.3f} %", worst * 100), std::abs(worst) < 0.01}};
}

std::vector<Row> runTiltedFeeder(const trial::EngineKind& kind, const base::RunControl& control) {
    constexpr double kSlippery = 0.2;
    constexpr double kHeld = 10.0 * kDegree;
    constexpr double kSlides = 14.0 * kDegree;
    const auto engine = kind.make({});
    double creep = 0.0;
    double worst = 0.0;
    for (const double sense : {1.0, -1.0}) {
        for (const double heading : {0.0, 0.5}) {
            const auto tilted = [&](double angle) {
                track::FeederShape shape;
                shape.slope = sense * angle;
                const Quaternion turned(Eigen::AngleAxisd(heading, Vec3::UnitZ()));
                trial::TrialBatch scene =
                    makeStillScene(makeFlat(shape), makeFlatBlock(),
                                   {turned, Vec3(0.2, 0.0, 17.0 * kMillimetre + 1e-6)}, 1.5);
                scene.contact = {kSlippery, kSlippery, 0.0};
                return scene;
            };
            const trial::Trajectory rest = replayScene(*engine, tilted(kHeld), 0.1, control);
            creep = std::max(creep, (sampleAt(rest, 1.4).parts[0].room.position -
                                     sampleAt(rest, 0.4).parts[0].room.position)
                                        .norm());
            const trial::Trajectory slide = replayScene(*engine, tilted(kSlides), 0.01, control);
            const trial::TrajectorySample& from = sampleAt(slide, 0.05);
            const trial::TrajectorySample& to = sampleAt(slide, 0.45);
            const double gained = -sense * (to.parts[0].velocity - from.parts[0].velocity).x();
            const double expected =
                base::kStandardGravity * (std::sin(kSlides) - kSlippery * std::cos(kSlides));
            const double error = gained / (to.time - from.time) / expected - 1.0;
            if (std::abs(error) > std::abs(worst)) worst = error;
        }
    }
    return {{"rest on a feeder tilted by 10 deg, friction 0.2 (11.3 deg)", "creep < 0.1 mm/s",
             fmt::format("{:.2g} mm/s", creep * 1e3), creep < 1e-4},
            {"slide on a feeder tilted by 14 deg, friction 0.2", "g (sin - mu cos) within 1 %",
             fmt::format("off by {:+.3f} %", worst * 100), std::abs(worst) < 0.01}};
}

std::vector<Row> runLedgeSlide(const trial::EngineKind& kind, const base::RunControl& control) {
    constexpr double kSlippery = 0.3;
    track::TrackParameters parameters;
    parameters.spiral = {24.0 * kMillimetre, 10.0 * kMillimetre, 20.0 * kDegree};
    const track::CrossSection section = track::makeLeadIn(parameters, 0.2, 8);
    const auto track =
        std::make_shared<const track::Track>(track::buildTrack(parameters, {{section}}).value());
    // Normal forces of ledge and wall carry the weight, and nothing moves across: N1 n1 + N2 n2 = -m g.
    const std::vector<base::Vec2>& points = section.points;
    const base::Vec2 foot = points[points.size() - 3];
    const auto upFrom = [](const base::Vec2& along) {
        return base::Vec2(-along.y(), along.x()).normalized();
    };
    Eigen::Matrix2d normals;
    normals.col(0) = upFrom(foot - points.front());
    normals.col(1) = upFrom(points[points.size() - 2] - foot);
    const base::Vec2 forces = normals.inverse() * base::Vec2(0.0, base::kStandardGravity);
    const double expected = kSlippery * forces.sum();

    // Flat on the ledge, the upper edge of its outer side on the wall.
    const Quaternion leaning(Eigen::AngleAxisd(-parameters.spiral.inclination, Vec3::UnitX()));
    const Vec3 corner = leaning * (Vec3(0.0, 6.0, 2.0) * kMillimetre);
    const Vec3 below = leaning * (Vec3(0.0, 0.0, -2.0) * kMillimetre);
    constexpr double kGap = 1e-6;
    double y = foot.x() - corner.y();
    // The wall leans out as it rises.
    const double fall = std::tan(parameters.spiral.inclination);
    double z = 0.0;
    for (int i = 0; i < 4; ++i) {
        z = 0.5 * parameters.segmentHeight - fall * (y + below.y()) - below.z() + kGap;
        const double lean = -normals(1, 1) / normals(0, 1);  // dy / dz of the wall
        y = foot.x() + lean * (z + corner.z() - foot.y()) - corner.y() - kGap;
    }
    trial::TrialBatch scene = makeStillScene(track, makeFlatBlock(), {leaning, Vec3(0.06, y, z)}, 0.2);
    scene.contact = {kSlippery, kSlippery, 0.0};
    scene.trials[0].parts[0].velocity = Vec3(0.5, 0.0, 0.0);
    const trial::Trajectory slide = replayScene(*kind.make({}), scene, 1e-3, control);
    const trial::TrajectorySample& from = sampleAt(slide, 0.02);
    const trial::TrajectorySample& to = sampleAt(slide, 0.08);
    const double loss = (from.parts[0].velocity - to.parts[0].velocity).x();
    const double error = loss / (to.time - from.time) / expected - 1.0;
    return {{"slide on a 20 deg ledge along its wall, mu 0.3", "mu (N1 + N2) / m within 1 %",
             fmt::format("off by {:+.3f} %", error * 100), std::abs(error) < 0.01}};
}

std::vector<Row> runSliding(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    double least = 1e300;
    double most = 0.0;
    for (const double heading : {0.0, 45.0, 90.0, 20.0}) {
        const Quaternion turned(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
        trial::TrialBatch scene = makeStillScene(makeFlat(), makeFlatBlock(),
                                                 {turned, Vec3(0.1, 0, 17.0 * kMillimetre + 1e-7)}, 0.2);
        scene.contact = {kFriction, kFriction, 0.0};
        scene.trials[0].parts[0].velocity =
            0.3 * Vec3(std::cos(heading * kDegree), std::sin(heading * kDegree), 0.0);
        const trial::Trajectory slide = replayScene(*engine, scene, 1e-3, control);
        const double loss =
            sampleAt(slide, 0.005).parts[0].velocity.norm() - sampleAt(slide, 0.045).parts[0].velocity.norm();
        least = std::min(least, loss / 0.04);
        most = std::max(most, loss / 0.04);
    }
    const double expected = kFriction * base::kStandardGravity;
    return {{"sliding along x, y, 45 and 20 deg", "same deceleration within 0.5 %",
             fmt::format("{:.4f} to {:.4f} m/s2 (mu g = {:.4f})", least, most, expected),
             most - least < 0.005 * expected && std::abs(most / expected - 1.0) < 0.01}};
}

std::vector<Row> runToppling(const trial::EngineKind& kind, const base::RunControl& control) {
    const auto engine = kind.make({});
    // 8 mm wide, 12 mm high: topples about its lower edge from atan(8 / 12) on.
    const double limit = std::atan2(8.0, 12.0);
    const auto topples = [&](double angle) {
        trial::TrialBatch scene = makeOnSlope(makeCuboid(Vec3(8, 8, 12) * kMillimetre, 1040.0),
                                              6.0 * kMillimetre, angle, 0.0, 0.0, 1.5);
        scene.contact = {1.5, 1.5, 0.0};
        const trial::Trajectory trajectory = replayScene(*engine, scene, 0.01, control);
        const Vec3 up = scene.trials[0].parts[0].pose.rotation * Vec3::UnitZ();
        const Vec3 end = trajectory.samples.back().parts[0].room.rotation * Vec3::UnitZ();
        return end.dot(up) < std::cos(30.0 * kDegree);
    };
    double low = limit - 1.5 * kDegree;
    double high = limit + 1.5 * kDegree;
    if (topples(low) || !topples(high))
        return {
            {"toppling of an 8 x 12 mm block", "at 33.7 deg within 0.5 deg", "not within 1.5 deg", false}};
    while (high - low > 0.05 * kDegree)
        (topples(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    const double found = 0.5 * (low + high);
    return {{"toppling of an 8 x 12 mm block", fmt::format("at {:.2f} deg within 0.5 deg", limit / kDegree),
             fmt::format("{:.2f} deg", found / kDegree), std::abs(found - limit) < 0.5 * kDegree}};
}

}  // namespace trapwright::verify
