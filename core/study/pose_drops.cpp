#include "core/study/pose_drops.h"

#include "core/base/parallel.h"
#include "core/part/stable_poses.h"
#include "core/track/track_builder.h"
#include "core/trial/start.h"

namespace trapwright::study {

namespace {

constexpr double kDuration = 2.0;                     // [s]
constexpr double kLargestTilt = 3.0 * base::kDegree;  // from the pose that a part has come to rest in
constexpr double kRestSpeed = 2e-3;                   // of any point of the part [m/s]

/// A level square, ten times as large as the drop is high and the part is long.
base::Result<track::Track> buildPlane(const part::Part& part, double height) {
    const double size = 10.0 * (height + 2.0 * part.boundingRadius);
    track::TrackParameters parameters;
    parameters.width = size;
    parameters.leadInLength = size;
    parameters.startFromLeadInEnd = 0.5 * size;
    parameters.leadOutSegmentLength = size;
    track::CrossSection section;
    section.x = size;
    for (const double y : {-0.5 * size, 0.5 * size})
        section.points.emplace_back(y, 0.5 * parameters.height);
    return track::buildTrack(parameters, std::vector{section});
}

}  // namespace

base::Result<DropResult> simulateDrops(const trial::Engine& engine, std::shared_ptr<const part::Part> part,
                                       const DropSettings& settings, unsigned threads,
                                       base::RunControl control) {
    auto plane = buildPlane(*part, settings.height);
    if (!plane) return plane.error();
    trial::TrialBatch batch;
    batch.track = std::make_shared<const track::Track>(*std::move(plane));
    batch.part = part;
    batch.contact = settings.contact;
    batch.gravity = settings.gravity;
    batch.drive.halfStroke = 0.0;
    batch.termination = {kDuration, 2.0 * kDuration, 1e-3};
    for (int i = 0; i < settings.drops; ++i) {
        trial::TrialSpec spec;
        spec.stream = {settings.seed, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::stablePoseDrop};
        base::Random random(spec.stream);
        spec.start = trial::drawStart(*batch.track, *part, {}, random);
        spec.start.pose.position.z() += settings.height;
        batch.trials.push_back(spec);
    }

    // The last moment counts, which only a replay tells.
    std::vector<int> poseOf(batch.trials.size(), -1);
    std::vector<base::Status> statuses(batch.trials.size(), base::success());
    base::parallelFor(batch.trials.size(), threads, [&](std::size_t i, unsigned) {
        auto trajectory = engine.replay(batch, i, kDuration, control);
        if (!trajectory) {
            statuses[i] = trajectory.error();
            return;
        }
        const trial::TrajectorySample& last = trajectory->samples.back();
        const double speed = last.velocity.norm() + last.angularVelocity.norm() * part->boundingRadius;
        const part::NearestPose pose = part::findStablePose(*part, last.room.rotation);
        if (trajectory->outcome.ending == trial::Ending::timedOut && speed < kRestSpeed &&
            pose.angle < kLargestTilt)
            poseOf[i] = static_cast<int>(pose.index);
    });
    for (const base::Status& status : statuses)
        if (!status) return status.error();

    DropResult result;
    result.counts.resize(part->stablePoses.size());
    for (const int pose : poseOf)
        ++(pose < 0 ? result.unsettled : result.counts[static_cast<std::size_t>(pose)]);
    return result;
}

}  // namespace trapwright::study
