#include "core/study/pose_drops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/parallel.h"
#include "core/part/stable_poses.h"
#include "core/track/track_builder.h"
#include "core/trial/start.h"

namespace trapwright::study {

namespace {

// Most parts rest so soon after they have fallen; the others are watched longer. [s]
constexpr double kDurations[] = {0.6, 2.0, 6.0};
constexpr double kInterval = 0.05;                    // between two looks at a part [s]
constexpr int kLooks = 5;                             // at the end, in which it must stay as it is
constexpr double kLargestTilt = 3.0 * base::kDegree;  // from the pose that a part has come to rest in
constexpr double kRestSpeed = 2e-3;                   // of any point of the part [m/s]
constexpr double kSamePose = 1e-6;                    // between two rotations [rad]

/// A level square, so large that hardly a part rolls off it.
base::Result<track::Track> buildPlane(const part::Part& part, double height) {
    const double size = 40.0 * (height + 2.0 * part.boundingRadius);
    track::TrackParameters parameters;
    parameters.segmentWidth = size;
    parameters.leadInLength = size;
    parameters.startFromLeadInEnd = 0.5 * size;
    parameters.maxSegmentLength = size;
    track::CrossSection section;
    section.x = size;
    for (const double y : {-0.5 * size, 0.5 * size})
        section.points.emplace_back(y, 0.5 * parameters.segmentHeight);
    return track::buildTrack(parameters, std::vector{section});
}

/// The stable pose in which the part stays through the last looks; none if it does not.
std::optional<std::size_t> findLastingPose(const part::Part& part, const trial::Trajectory& trajectory) {
    const auto& samples = trajectory.samples;
    if (trajectory.outcome.parts.front().ending != trial::Ending::timedOut || samples.size() < kLooks)
        return std::nullopt;
    std::optional<std::size_t> pose;
    for (std::size_t i = samples.size() - kLooks; i < samples.size(); ++i) {
        const part::NearestPose nearest = part::findStablePose(part, samples[i].parts.front().room.rotation);
        if (nearest.angle >= kLargestTilt || (pose && *pose != nearest.index)) return std::nullopt;
        pose = nearest.index;
    }
    return pose;
}

bool rests(const part::Part& part, const trial::PartState& state) {
    return state.velocity.norm() + state.angularVelocity.norm() * part.boundingRadius < kRestSpeed;
}

bool isLowest(const part::Part& part, std::size_t pose) {
    return std::none_of(part.stablePoses.begin(), part.stablePoses.end(), [&](const part::StablePose& other) {
        return other.height < part.stablePoses[pose].height - 1e-6 * part.boundingRadius;
    });
}

/// Drops one part; -1 if it comes to rest in no pose.
base::Result<int> dropOne(const trial::Engine& engine, trial::TrialBatch batch, std::size_t index,
                          double fall, base::RunControl control) {
    const part::Part& part = *batch.parts.front();
    for (const double duration : kDurations) {
        batch.termination = {fall + duration, 2.0 * (fall + duration), 1e-3};
        // A replay counts itself; a drop counts once.
        if (duration != kDurations[0]) control.advance(-1);
        auto trajectory = engine.replay(batch, index, kInterval, control);
        if (!trajectory) return trajectory.error();
        const auto pose = findLastingPose(part, *trajectory);
        const bool last = duration == std::end(kDurations)[-1];
        if (pose &&
            (rests(part, trajectory->samples.back().parts.front()) || (last && isLowest(part, *pose))))
            return static_cast<int>(*pose);
    }
    return -1;
}

bool samePoses(const std::vector<base::Quaternion>& a, const std::vector<base::Quaternion>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const base::Quaternion& one, const base::Quaternion& other) {
                          return one.angularDistance(other) < kSamePose;
                      });
}

std::vector<base::Quaternion> posesOf(const part::Part& part) {
    std::vector<base::Quaternion> poses;
    poses.reserve(part.stablePoses.size());
    for (const part::StablePose& pose : part.stablePoses)
        poses.push_back(pose.rotation);
    return poses;
}

}  // namespace

bool operator==(const DropSettings& a, const DropSettings& b) {
    const auto fields = [](const DropSettings& s) {
        return std::tie(s.drops, s.height, s.contact.staticFriction, s.contact.kineticFriction,
                        s.contact.restitution, s.gravity, s.seed);
    };
    return fields(a) == fields(b);
}

bool operator==(const DropRecord& a, const DropRecord& b) {
    return a.settings == b.settings && a.engine == b.engine && samePoses(a.poses, b.poses) &&
           a.result == b.result && a.time == b.time;
}

int DropResult::drops() const {
    return std::accumulate(counts.begin(), counts.end(), unsettled);
}

void DropResult::add(const DropResult& other) {
    counts.resize(std::max(counts.size(), other.counts.size()));
    for (std::size_t i = 0; i < other.counts.size(); ++i)
        counts[i] += other.counts[i];
    unsettled += other.unsettled;
}

double DropRecord::share(std::size_t pose) const {
    const int drops = result.drops();
    return drops == 0 ? 0.0 : static_cast<double>(result.counts[pose]) / drops;
}

stats::Interval DropRecord::bounds(std::size_t pose) const {
    return stats::calcClopperPearson(result.counts[pose], result.drops());
}

std::vector<std::string> findProblems(const DropSettings& settings) {
    std::vector<std::string> problems;
    const auto hold = [&](const char* what, double value, double low, double high, const char* unit) {
        if (value >= low && value <= high) return;
        problems.push_back(fmt::format("The {} is {}{}; it must be within {} and {}{}.", what, value, unit,
                                       low, high, unit));
    };
    hold("number of drops", settings.drops, 1, kMostDrops, "");
    hold("drop height", settings.height * 1e3, 0.0, kGreatestDropHeight * 1e3, " mm");
    hold("static friction", settings.contact.staticFriction, 0.0, 2.0, "");
    hold("kinetic friction", settings.contact.kineticFriction, 0.0, 2.0, "");
    hold("restitution", settings.contact.restitution, 0.0, 1.0, "");
    return problems;
}

base::Result<DropResult> simulateDrops(const trial::Engine& engine, std::shared_ptr<const part::Part> part,
                                       const DropSettings& settings, unsigned threads,
                                       base::RunControl control, int first, int count) {
    if (const auto problems = findProblems(settings); !problems.empty()) return base::Error{problems.front()};
    if (part->stablePoses.empty())
        return base::Error{"The part " + part->name + " has no stable poses to come to rest in."};
    auto plane = buildPlane(*part, settings.height);
    if (!plane) return plane.error();
    trial::TrialBatch batch;
    batch.track = std::make_shared<const track::Track>(*std::move(plane));
    batch.parts.push_back(std::move(part));
    const part::Part& dropped = *batch.parts.front();
    batch.contact = settings.contact;
    batch.gravity = settings.gravity;
    batch.drive.halfStroke = 0.0;
    const int end = count < 0 ? settings.drops : std::min(settings.drops, first + count);
    for (int i = first; i < end; ++i) {
        trial::TrialSpec& drop = batch.trials.emplace_back(trial::drawTrial(
            *batch.track, dropped, {},
            {settings.seed, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::stablePoseDrop}));
        drop.parts.front().pose.position.z() += settings.height;
    }

    const double fall = std::sqrt(2.0 * settings.height / settings.gravity);  // [s]
    std::vector<int> poseOf(batch.trials.size(), -1);
    std::vector<base::Status> statuses(batch.trials.size(), base::success());
    base::parallelFor(batch.trials.size(), threads, [&](std::size_t i, unsigned) {
        if (!control.mayGoOn()) {
            statuses[i] = base::Error{"The drop test was cancelled."};
            return;
        }
        const auto pose = dropOne(engine, batch, i, fall, control);
        if (pose) {
            poseOf[i] = *pose;
        } else {
            statuses[i] = pose.error();
        }
    });
    for (const base::Status& status : statuses)
        if (!status) return status.error();

    DropResult result;
    result.counts.resize(dropped.stablePoses.size());
    for (const int pose : poseOf)
        ++(pose < 0 ? result.unsettled : result.counts[static_cast<std::size_t>(pose)]);
    return result;
}

DropRecord makeDropRecord(const part::Part& part, const DropSettings& settings, std::string engine,
                          DropResult result) {
    return {settings, std::move(engine), posesOf(part), std::move(result)};
}

bool holdsFor(const DropRecord& record, const part::Part& part) {
    return samePoses(record.poses, posesOf(part));
}

}  // namespace trapwright::study
