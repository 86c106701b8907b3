#include "core/trial/remade_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trapwright::trial {

namespace {

/// How many are told by name.
constexpr std::size_t kNamed = 3;

}  // namespace

void RemadeTrials::add(RemadeTrial trial) {
    const std::lock_guard lock(mutex_);
    trials_.push_back(std::move(trial));
}

std::vector<RemadeTrial> RemadeTrials::list() const {
    const std::lock_guard lock(mutex_);
    return trials_;
}

std::size_t RemadeTrials::count() const {
    const std::lock_guard lock(mutex_);
    return trials_.size();
}

std::string describe(const RemadeTrial& trial) {
    return fmt::format("trial {} of individual {} of generation {} ({}: {}{})", trial.stream.trial,
                       trial.stream.individual, trial.stream.generation, trial.engine, trial.reason,
                       trial.isStuck ? "; counts as stuck" : "");
}

std::string describe(std::span<const RemadeTrial> trials) {
    if (trials.empty()) return "";
    const auto stuck = std::ranges::count(trials, true, &RemadeTrial::isStuck);
    std::string text = trials.size() == 1
                           ? "1 trial could not be finished and was made again with the reference engine"
                           : fmt::format(
                                 "{} trials could not be finished and were made again with the "
                                 "reference engine",
                                 trials.size());
    if (stuck > 0) text += fmt::format(", {} of them in vain", stuck);
    text += ": ";
    for (std::size_t i = 0; i < std::min(trials.size(), kNamed); ++i)
        text += (i > 0 ? ", " : "") + describe(trials[i]);
    return text + (trials.size() > kNamed ? ", ..." : ".");
}

}  // namespace trapwright::trial
