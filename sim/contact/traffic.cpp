#include "sim/contact/traffic.h"

#include <algorithm>

#include "core/geometry/convex_separation.h"

namespace trapwright::contact {

namespace {

/// A part comes only where it is at least so far from the others: no step of theirs may find it inside. [m]
constexpr double kClearance = 0.1e-3;

}  // namespace

Traffic::Traffic(const trial::TrialBatch& batch, const trial::TrialSpec& spec)
    : batch_(&batch), spec_(&spec), progress_(batch, spec) {}

bool Traffic::hasRoom(const trial::PartStart& start, std::span<const base::Pose> posesInTrack) const {
    const part::Part& part = *batch_->parts[start.part];
    for (std::size_t slot = 0; slot < posesInTrack.size(); ++slot) {
        if (!partOf_[slot]) continue;
        const part::Part& other = *batch_->parts[spec_->parts[*partOf_[slot]].part];
        const base::Pose& pose = posesInTrack[slot];
        const double balls = part.boundingRadius + other.boundingRadius + kClearance;
        if ((pose.position - start.pose.position).squaredNorm() >= balls * balls) continue;
        if (!geometry::areApart(part.pieces, start.pose, other.pieces, pose, kClearance)) return false;
    }
    return true;
}

std::optional<Traffic::Entry> Traffic::admit(double time, std::span<const base::Pose> posesInTrack) {
    if (next_ == spec_->parts.size()) return std::nullopt;
    const trial::PartStart& start = spec_->parts[next_];
    if (start.time > time) return std::nullopt;
    // What a trial begins with is its own business.
    if (start.time > 0.0 && !hasRoom(start, posesInTrack)) return std::nullopt;
    auto slot = std::ranges::find_if(partOf_, [](const auto& part) { return !part.has_value(); });
    if (slot == partOf_.end()) slot = partOf_.insert(slot, std::nullopt);
    *slot = next_;
    return Entry{next_++, static_cast<int>(slot - partOf_.begin())};
}

bool Traffic::isOver(double time) {
    const double until = batch_->termination.until;
    if (until > 0.0 && time >= until)
        for (; next_ < spec_->parts.size(); ++next_)
            progress_.leaveOut(next_, time);
    return progress_.isOver();
}

}  // namespace trapwright::contact
