#include "core/trial/termination_monitor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trapwright::trial {

base::Pose TerminationMonitor::toTrackCoordinates(std::size_t part, const base::Pose& pose) const {
    base::Pose result;
    result.position = track_->shape.toTrack(pose.position, parts_[part].lastX);
    const base::Mat3 frame = track::orientationFrame(*track_, result.position.x());
    result.rotation = base::Quaternion(frame.transpose()) * pose.rotation;
    return result;
}

std::optional<Ending> TerminationMonitor::update(std::size_t part, double time, const base::Pose& pose) {
    Progress& progress = parts_[part];
    PartOutcome& outcome = outcome_.parts[part];
    if (!progress.started) progress.lastX = track_->start;
    outcome.time = time;
    if (!isFinite(pose)) {
        // It shows in the outcome, so that the trial is made again (BackedEngine).
        outcome.farthest = pose;
        outcome.ending = Ending::stuck;
        --running_;
        return Ending::stuck;
    }
    const base::Pose here = toTrackCoordinates(part, pose);
    const double x = here.position.x();
    progress.lastX = x;
    if (!progress.started) {
        progress = {true, time, x, x, time};
        outcome.entered = time;
        outcome.initial = here;
        outcome.farthest = here;
    }
    if (x > outcome.farthest.position.x()) outcome.farthest = here;
    if (x >= progress.markedX + batch_->termination.stuckProgress) {
        noteStop(part, progress, time);
        progress.markedX = x;
        progress.markedTime = time;
    }
    const std::optional<Ending> ending = findEnding(progress, time, here.position);
    if (ending) {
        noteStop(part, progress, time);
        outcome.ending = *ending;
        outcome.throughSurface = *ending == Ending::fellOff && isInside(part, pose);
        --running_;
    }
    return ending;
}

bool TerminationMonitor::isInside(std::size_t part, const base::Pose& pose) const {
    if (!track::isBelowSurface(*track_, pose.position)) return false;
    const std::vector<geometry::ConvexPolytope>& pieces = batch_->parts[spec_->parts[part].part]->pieces;
    return std::ranges::any_of(pieces, [&](const geometry::ConvexPolytope& piece) {
        const base::Vec3 sum =
            std::accumulate(piece.vertices.begin(), piece.vertices.end(), base::Vec3(base::Vec3::Zero()));
        const base::Vec3 middle = pose.apply(sum / static_cast<double>(piece.vertices.size()));
        const double height = track_->shape.toTrack(middle, parts_[part].lastX).z();
        return height > -track_->baseThickness && track::isBelowSurface(*track_, middle);
    });
}

void TerminationMonitor::leaveOut(std::size_t part, double time) {
    PartOutcome& outcome = outcome_.parts[part];
    outcome.ending = Ending::timedOut;
    outcome.time = time;
    outcome.entered.reset();
    --running_;
}

void TerminationMonitor::noteStop(std::size_t part, const Progress& progress, double time) {
    if (batch_->termination.until > 0.0 && time - progress.markedTime >= batch_->termination.stuckTime)
        outcome_.stops.push_back({part, progress.markedTime, time});
}

std::optional<Ending> TerminationMonitor::findEnding(const Progress& progress, double time,
                                                     const base::Vec3& position) const {
    if (position.x() >= track_->finish) return Ending::finished;
    // The surface lies at z >= 0, but for the chute's: a centre of mass below that has left it.
    const bool aside =
        std::abs(position.y()) > track_->width || position.x() < track_->begin() - track_->width;
    if (position.z() < -track::chuteFall(*track_, position.x()) || aside) return Ending::fellOff;
    if (batch_->termination.until > 0.0)
        return time >= batch_->termination.until ? std::optional(Ending::timedOut) : std::nullopt;
    if (time - progress.markedTime >= batch_->termination.stuckTime) return Ending::stuck;
    if (time - progress.startTime >= batch_->termination.timeLimit) return Ending::timedOut;
    return std::nullopt;
}

}  // namespace trapwright::trial
