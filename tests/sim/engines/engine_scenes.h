#pragma once

#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/track/track_solid.h"
#include "core/verify/scenes.h"

namespace trapwright::testing {

/// Trials on the vibrating rough track: parts dropped anyhow from a few millimetres.
inline trial::TrialBatch makeRoughBatch(std::shared_ptr<const part::Part> part, std::uint64_t seed,
                                        int trials, double duration) {
    trial::TrialBatch batch = verify::makeStillScene(verify::makeRough(), std::move(part), {}, duration);
    batch.drive.halfStroke = 0.8e-3;
    batch.trials.clear();
    for (int i = 0; i < trials; ++i) {
        trial::TrialSpec spec;
        spec.stream = {seed, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::test};
        base::Random random(spec.stream);
        const double x = random.uniform(0.05, 0.3);
        const double y = random.uniform(-0.015, 0.015);
        spec.parts.resize(1);
        spec.parts[0].pose = {random.rotation(),
                              {x, y, verify::findSurfaceHeight(*batch.track, x, y) + 9e-3}};
        spec.phase = random.uniform(0.0, 2.0 * base::kPi);
        // Every trial's material is its own.
        const double frictionScale = random.uniform(0.8, 1.2);
        const double restitutionScale = random.uniform(0.5, 1.5);
        spec.contact = {batch.contact.staticFriction * frictionScale,
                        batch.contact.kineticFriction * frictionScale,
                        batch.contact.restitution * restitutionScale};
        batch.trials.push_back(spec);
    }
    return batch;
}

/// A level track, 60 mm wide, on a feeder of this shape; the surface at 15 mm.
inline std::shared_ptr<const track::Track> makeLevelOn(const track::FeederShape& shape, double length) {
    auto result = std::make_shared<track::Track>();
    result->shape = shape;
    constexpr int kSections = 11;
    for (int i = 0; i < kSections; ++i)
        result->sections.push_back(
            {length * i / (kSections - 1),
             {base::Vec2(-0.03, 0.015), base::Vec2(0.0, 0.015), base::Vec2(0.03, 0.015)}});
    const track::TrackSolid solid = track::buildTrackSolid(shape, result->sections, 3e-3);
    result->solid = solid.mesh;
    result->surfaceTriangles = solid.surfaceTriangles;
    result->lastTrapSection = kSections - 1;
    result->start = 0.06;
    result->finish = length;
    result->width = 0.06;
    result->height = 0.03;
    return result;
}

/// The paper's cuboid on its 8 x 12 mm face on such a track: its centre at track coordinates (x, y), turned
/// by `heading` out of the conveying direction. On a bowl that climbs it is let down from a tenth of a
/// millimetre, as a helix is nowhere flat.
inline trial::TrialBatch makeLyingOn(const track::FeederShape& shape, double heading, double duration) {
    const auto level = makeLevelOn(shape, 0.5);
    const base::Quaternion lying = base::Quaternion::FromTwoVectors(base::Vec3::UnitX(), base::Vec3::UnitZ());
    const base::Quaternion turn(Eigen::AngleAxisd(heading, base::Vec3::UnitZ()));
    const base::Quaternion frame(shape.tangentFrame(0.1));
    base::Pose pose{frame * turn * lying, shape.toRoom({0.1, 0.002, 0.017 + 1e-7})};
    if (shape.type == track::FeederType::bowl && shape.slope != 0.0)
        pose.position = shape.toRoom({0.1, 0.002, 0.015}) + 0.0021 * shape.tangentFrame(0.1).col(2);
    trial::TrialBatch batch = verify::makeStillScene(level, verify::makePaperCuboid(), pose, duration);
    batch.drive = {};
    return batch;
}

}  // namespace trapwright::testing
