#include "core/trial/termination_monitor.h"

#include <cmath>

namespace trapwright::trial {

base::Pose TerminationMonitor::toTrackCoordinates(const base::Pose& pose) const {
    base::Pose result;
    result.position = track_->shape.toTrack(pose.position, lastX_);
    result.rotation =
        base::Quaternion(track_->shape.tangentFrame(result.position.x()).transpose()) * pose.rotation;
    return result;
}

std::optional<Ending> TerminationMonitor::update(double time, const base::Pose& pose) {
    if (!started_) lastX_ = track_->start;
    const base::Pose here = toTrackCoordinates(pose);
    const double x = here.position.x();
    lastX_ = x;
    outcome_.time = time;
    if (!started_) {
        started_ = true;
        outcome_.initial = here;
        outcome_.farthest = here;
        markedX_ = x;
        markedTime_ = time;
    }
    if (x > outcome_.farthest.position.x()) outcome_.farthest = here;
    if (x >= markedX_ + termination_.stuckProgress) {
        markedX_ = x;
        markedTime_ = time;
    }
    const std::optional<Ending> ending = findEnding(time, here.position);
    if (ending) outcome_.ending = *ending;
    return ending;
}

std::optional<Ending> TerminationMonitor::findEnding(double time, const base::Vec3& position) const {
    if (position.x() >= track_->finish) return Ending::finished;
    // The surface lies at z >= 0: a centre of mass below that has left it.
    const bool aside =
        std::abs(position.y()) > track_->width || position.x() < track_->begin() - track_->width;
    if (position.z() < 0.0 || aside) return Ending::fellOff;
    if (time - markedTime_ >= termination_.stuckTime) return Ending::stuck;
    if (time >= termination_.timeLimit) return Ending::timedOut;
    return std::nullopt;
}

}  // namespace trapwright::trial
