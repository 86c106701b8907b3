#include "app/transports/virtual_state.h"

namespace trapwright::transports {

void VirtualState::setTrouble(Trouble trouble) {
    constexpr double kOff = 0.5;
    const std::lock_guard lock(mutex_);
    trouble_ = trouble;
    const double offset = model_.command().setPoint < kOff ? kOff : -kOff;
    model_.setDisagreement(trouble == Trouble::disagrees ? offset : 0.0, clock());
    model_.setFault(trouble == Trouble::fault ? "over temperature" : "", clock());
}

Trouble VirtualState::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void VirtualState::tell(const drive::Command& command) {
    const std::lock_guard lock(mutex_);
    model_.tell(command, clock());
    constexpr std::size_t kMostKept = 20000;  // half an hour and more
    if (commands_.size() == kMostKept) commands_.pop_front();
    commands_.push_back(command);
}

void VirtualState::hear() {
    const std::lock_guard lock(mutex_);
    model_.hear(clock());
}

drive::Reading VirtualState::read() {
    const std::lock_guard lock(mutex_);
    return model_.read(clock());
}

double VirtualState::halfStroke() const {
    const std::lock_guard lock(mutex_);
    return model_.halfStroke(clock());
}

bool VirtualState::isAtRest() const {
    const std::lock_guard lock(mutex_);
    return model_.isAtRest(clock());
}

bool VirtualState::watchdogActed() const {
    const std::lock_guard lock(mutex_);
    return model_.watchdogActed(clock());
}

drive::Command VirtualState::command() const {
    const std::lock_guard lock(mutex_);
    static_cast<void>(model_.watchdogActed(clock()));
    return model_.command();
}

std::vector<drive::Command> VirtualState::commands() const {
    const std::lock_guard lock(mutex_);
    return {commands_.begin(), commands_.end()};
}

double VirtualState::clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace trapwright::transports
