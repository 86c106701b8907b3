#pragma once

#include <cstddef>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace trapwright::trial {

/// A trial that its engine could not finish, so that the reference engine made it again.
struct RemadeTrial {
    base::StreamKey stream;  // names the trial
    std::string engine;      // that could not finish it
    std::string reason;      // "its pose is not a number"
    bool isStuck = false;    // the reference could not either: it counts as stuck

    friend bool operator==(const RemadeTrial&, const RemadeTrial&) = default;
};

/// Those of a run, in the order in which they came up. Safe to use from several threads.
class RemadeTrials {
 public:
    void add(RemadeTrial trial);
    [[nodiscard]] std::vector<RemadeTrial> list() const;
    [[nodiscard]] std::size_t count() const;

 private:
    mutable std::mutex mutex_;
    std::vector<RemadeTrial> trials_;
};

/// "trial 3 of individual 5 of generation 2 (native: its pose is not a number; counts as stuck)".
std::string describe(const RemadeTrial& trial);

/// One sentence or two for people: how many there are, and the first of them by name. Empty if there are
/// none.
std::string describe(std::span<const RemadeTrial> trials);

}  // namespace trapwright::trial
