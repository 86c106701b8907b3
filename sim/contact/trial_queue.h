#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/trial/batch.h"

namespace trapwright::contact {

/// Trials that an engine can simulate side by side: of like parts, gravity and steps.
struct LikeTrials {
    struct Member {
        std::size_t batch = 0;  // its place
        std::vector<std::size_t> trials;
    };

    const trial::TrialBatch* batch = nullptr;  // one of theirs
    const part::Part* part = nullptr;          // of trials of one part
    std::vector<Member> members;
};

/// All trials of the batches that are of one part.
inline std::vector<LikeTrials> groupLikeTrials(std::span<const trial::TrialBatch> batches) {
    std::vector<LikeTrials> groups;
    const auto findGroup = [&](const trial::TrialBatch& batch, const part::Part& part) -> LikeTrials& {
        for (LikeTrials& group : groups) {
            const trial::TrialBatch& like = *group.batch;
            if (group.part == &part && like.gravityVector() == batch.gravityVector() &&
                like.step == batch.step && like.drive.frequency == batch.drive.frequency)
                return group;
        }
        return groups.emplace_back(LikeTrials{&batch, &part, {}});
    };
    for (std::size_t b = 0; b < batches.size(); ++b) {
        for (std::size_t i = 0; i < batches[b].trials.size(); ++i) {
            if (!isOfOnePart(batches[b], batches[b].trials[i])) continue;
            LikeTrials& group = findGroup(batches[b], batches[b].partOf(batches[b].trials[i]));
            if (group.members.empty() || group.members.back().batch != b) group.members.push_back({b, {}});
            group.members.back().trials.push_back(i);
        }
    }
    return groups;
}

/// All trials of the batches that are not of one part: like ones are of the same kinds of parts.
inline std::vector<LikeTrials> groupLikeStreams(std::span<const trial::TrialBatch> batches) {
    std::vector<LikeTrials> groups;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        const trial::TrialBatch& batch = batches[b];
        LikeTrials::Member member{b, {}};
        for (std::size_t i = 0; i < batch.trials.size(); ++i)
            if (!isOfOnePart(batch, batch.trials[i])) member.trials.push_back(i);
        if (member.trials.empty()) continue;
        auto group = std::ranges::find_if(groups, [&](const LikeTrials& other) {
            const trial::TrialBatch& like = *other.batch;
            return like.parts == batch.parts && like.gravityVector() == batch.gravityVector() &&
                   like.step == batch.step && like.drive.frequency == batch.drive.frequency;
        });
        if (group == groups.end()) group = groups.insert(group, LikeTrials{&batch, nullptr, {}});
        group->members.push_back(std::move(member));
    }
    return groups;
}

/// Like trials, handed out one by one to the threads of an engine. A `Scene` is what an engine prepares for
/// all of them in one batch; it is made, by the batch's place, when the first one is handed out.
template <class Scene>
class TrialQueue {
 public:
    using MakeScene = std::function<std::shared_ptr<const Scene>(std::size_t batch)>;

    TrialQueue(std::span<const LikeTrials::Member> members, MakeScene make)
        : members_(members), make_(std::move(make)) {
        for (const LikeTrials::Member& member : members_)
            total_ += member.trials.size();
    }

    struct Job {
        std::shared_ptr<const Scene> scene;
        std::size_t batch;
        std::size_t trial;
    };

    [[nodiscard]] std::size_t total() const { return total_; }

    std::optional<Job> next() {
        const std::lock_guard lock(mutex_);
        while (member_ < members_.size() && trial_ == members_[member_].trials.size()) {
            scene_.reset();  // trials that still run keep it alive
            ++member_;
            trial_ = 0;
        }
        if (member_ == members_.size()) return std::nullopt;
        const LikeTrials::Member& member = members_[member_];
        if (!scene_) scene_ = make_(member.batch);
        return Job{scene_, member.batch, member.trials[trial_++]};
    }

 private:
    std::span<const LikeTrials::Member> members_;
    MakeScene make_;
    std::shared_ptr<const Scene> scene_;
    std::mutex mutex_;
    std::size_t member_ = 0;
    std::size_t trial_ = 0;
    std::size_t total_ = 0;
};

}  // namespace trapwright::contact
