#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/trial/batch.h"

namespace trapwright::contact {

/// The trials of several batches, handed out one by one to the threads of an engine. A `Scene` is what an
/// engine prepares for all trials of one batch; it is made, from the batch, when its first trial is handed
/// out.
template <class Scene>
class TrialQueue {
 public:
    /// members: the places of the batches to be simulated.
    TrialQueue(std::span<const trial::TrialBatch> batches, std::vector<std::size_t> members)
        : batches_(batches), members_(std::move(members)), scenes_(members_.size()) {
        for (const std::size_t m : members_)
            total_ += batches_[m].trials.size();
    }

    struct Job {
        std::shared_ptr<const Scene> scene;
        std::size_t batch;
        std::size_t trial;
    };

    [[nodiscard]] std::size_t total() const { return total_; }

    std::optional<Job> next() {
        const std::lock_guard lock(mutex_);
        while (member_ < members_.size() && trial_ == batches_[members_[member_]].trials.size()) {
            scenes_[member_].reset();  // trials that still run keep it alive
            ++member_;
            trial_ = 0;
        }
        if (member_ == members_.size()) return std::nullopt;
        const std::size_t batch = members_[member_];
        if (!scenes_[member_]) scenes_[member_] = std::make_shared<const Scene>(batches_[batch]);
        return Job{scenes_[member_], batch, trial_++};
    }

 private:
    std::span<const trial::TrialBatch> batches_;
    std::vector<std::size_t> members_;
    std::vector<std::shared_ptr<const Scene>> scenes_;
    std::mutex mutex_;
    std::size_t member_ = 0;
    std::size_t trial_ = 0;
    std::size_t total_ = 0;
};

/// The places of the batches, those with the same parts, gravity and steps together.
inline std::vector<std::vector<std::size_t>> groupByPart(std::span<const trial::TrialBatch> batches) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        bool placed = false;
        for (std::vector<std::size_t>& group : groups) {
            const trial::TrialBatch& like = batches[group.front()];
            if (like.parts != batches[b].parts || like.gravity != batches[b].gravity ||
                like.step != batches[b].step || like.drive.frequency != batches[b].drive.frequency)
                continue;
            group.push_back(b);
            placed = true;
            break;
        }
        if (!placed) groups.push_back({b});
    }
    return groups;
}

}  // namespace trapwright::contact
