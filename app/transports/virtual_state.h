#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <vector>

#include "app/transports/virtual_feeder.h"
#include "core/drive/feeder_model.h"

namespace trapwright::transports {

/// What the thread of a virtual feeder shares with all others: the model with its clock, and what goes wrong.
/// Every member locks for itself.
class VirtualState {
 public:
    explicit VirtualState(const drive::FeederProperties& properties) : model_(properties) {}

    void setTrouble(Trouble trouble);
    [[nodiscard]] Trouble trouble() const;

    void tell(const drive::Command& command);
    void hear();
    drive::Reading read();

    [[nodiscard]] double halfStroke() const;
    [[nodiscard]] bool isAtRest() const;
    [[nodiscard]] bool watchdogActed() const;
    [[nodiscard]] drive::Command command() const;
    [[nodiscard]] std::vector<drive::Command> commands() const;

 private:
    [[nodiscard]] double clock() const;  // [s] since it was made

    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    mutable std::mutex mutex_;
    mutable drive::FeederModel model_;  // goes on whenever it is looked at
    Trouble trouble_ = Trouble::none;
    std::deque<drive::Command> commands_;  // the newest
};

/// How long a late answer takes.
inline constexpr std::chrono::milliseconds kLateAnswer{1000};

}  // namespace trapwright::transports
