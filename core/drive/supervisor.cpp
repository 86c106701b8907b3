#include "core/drive/supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trapwright::drive {

namespace {

constexpr std::array<std::pair<State, std::string_view>, 6> kStates = {{
    {State::disconnected, "disconnected"},
    {State::idle, "idle"},
    {State::ramping, "ramping"},
    {State::running, "running"},
    {State::stopping, "stopping"},
    {State::faulted, "faulted"},
}};

constexpr double kCoastTime = 1.5;  // [s] that a feeder may take from the end of its drive to rest

/// Limits that are no numbers would limit nothing: with these nothing moves.
Limits keepSafe(Limits limits) {
    limits.highest = limits.highest > 0.0 ? std::min(limits.highest, 1.0) : 0.0;
    limits.rampPerSecond = limits.rampPerSecond > 0.0 ? limits.rampPerSecond : 0.0;
    return limits;
}

/// Whether all that it measures are numbers.
bool isSound(const Reading& reading) {
    const auto sound = [](const std::optional<double>& value) { return !value || std::isfinite(*value); };
    return sound(reading.setPoint) && sound(reading.frequency) && sound(reading.acceleration) &&
           sound(reading.current);
}

bool isRest(const Command& command) {
    return !command.enable && command.setPoint == 0.0;
}

}  // namespace

std::string_view nameOf(State state) {
    for (const auto& [known, name] : kStates) {
        if (known == state) return name;
    }
    return {};
}

Supervisor::Supervisor(const Limits& limits, const Agreement& agreement)
    : limits_(keepSafe(limits)), agreement_(agreement) {}

void Supervisor::setTarget(double setPoint) {
    // Not a number is no wish: nothing is safer than zero.
    target_ = setPoint > 0.0 ? std::min(setPoint, limits_.highest) : 0.0;
    if (state_ == State::running && setPoint_ != target_) state_ = State::ramping;
}

void Supervisor::setFrequency(std::optional<double> frequency) {
    frequency_ = frequency;
}

void Supervisor::setLimits(const Limits& limits) {
    limits_ = keepSafe(limits);
    setTarget(target_);
}

base::Status Supervisor::start() {
    switch (state_) {
        case State::idle:
            break;
        case State::ramping:
        case State::running:
            return base::success();
        case State::disconnected:
            return base::Error{"there is no drive to start. Connect one first"};
        case State::stopping:
            return base::Error{"the drive is still coming to rest. Start it once it rests"};
        case State::faulted:
            return base::Error{"the drive had a fault. Look at the feeder, then acknowledge the fault"};
    }
    setPoint_ = 0.0;
    state_ = State::ramping;
    return base::success();
}

void Supervisor::stop() {
    setPoint_ = 0.0;
    if (state_ == State::ramping || state_ == State::running) state_ = State::stopping;
}

base::Status Supervisor::acknowledge() {
    if (state_ != State::faulted) return base::success();
    if (!linked_ || !reading_) {
        return base::Error{
            "the drive does not answer. Check its power and its cable; it is being looked for"};
    }
    if (reading_->fault) {
        return base::Error{
            fmt::format("the drive still tells a fault: {}. Clear it at the drive", *reading_->fault)};
    }
    if (!isAtRest(*reading_)) {
        return base::Error{"the drive does not say that it rests. Switch it off by hand and look why"};
    }
    fault_.clear();
    state_ = State::idle;
    return base::success();
}

void Supervisor::connected(double now) {
    linked_ = true;
    connectedAt_ = now;
    lastCommand_.reset();
    restSince_ = now;
    reading_.reset();
    told_.clear();
    if (state_ != State::disconnected) return;
    fault_.clear();
    state_ = State::idle;
}

void Supervisor::disconnected() {
    linked_ = false;
    setPoint_ = 0.0;
    state_ = State::disconnected;
}

void Supervisor::failed(const std::string& message) {
    linked_ = false;
    reading_.reset();
    fault(message);
}

void Supervisor::observe(const Reading& reading, double now) {
    reading_ = reading;
    if (restTold_) {
        mayMove_ = !saysOff(reading) || (vibrates(reading) && now - *restTold_ > kCoastTime);
    }
    if (!isSound(reading)) return fault("the drive tells something that is no number");
    if (reading.fault) return fault("the drive tells a fault: " + *reading.fault);
    if (const auto disagreement = findDisagreement(reading, now)) return fault(*disagreement);
    if (state_ == State::stopping && isAtRest(reading)) state_ = State::idle;
}

Command Supervisor::command(double now) {
    const double gap = lastCommand_ ? now - *lastCommand_ : 0.0;
    lastCommand_ = now;
    Command command;
    command.frequency = frequency_;
    if (state_ == State::ramping || state_ == State::running) {
        if (gap > agreement_.longestGap) {
            fault(
                fmt::format("the heartbeat came {:.1f} s late, and the drive may have stopped by itself. "
                            "Was the computer suspended, or is it overloaded?",
                            gap));
        } else {
            const double step = limits_.rampPerSecond * gap;
            setPoint_ = std::clamp(target_, setPoint_ - step, setPoint_ + step);
            setPoint_ = std::min(setPoint_, limits_.highest);
            state_ = setPoint_ == target_ ? State::running : State::ramping;
            command.setPoint = setPoint_;
            command.enable = true;
        }
    }
    if (isRest(command)) {
        if (!restTold_) restTold_ = now;
    } else {
        restSince_ = now;
        restTold_.reset();
        mayMove_ = true;
    }
    told_.push_back({now, command});
    // The command that was in force when the time to settle began stays.
    while (told_.size() > 1 && told_[1].time <= now - agreement_.settlingTime)
        told_.pop_front();
    return command;
}

void Supervisor::fault(const std::string& message) {
    setPoint_ = 0.0;
    // What began it all is worth more to the operator than what followed from it.
    if (state_ == State::faulted && !fault_.empty()) return;
    fault_ = message;
    if (state_ != State::disconnected) state_ = State::faulted;
}

std::optional<std::string> Supervisor::findDisagreement(const Reading& reading, double now) const {
    // A drive may be found in any state, and gets the time to settle to be told otherwise.
    if (now - connectedAt_ > agreement_.settlingTime && !isExplained(reading)) {
        const Command& told = told_.back().command;
        if (reading.setPoint && reading.enabled) {
            return fmt::format("the drive was told {:.1f} % {} and says {:.1f} % {}", 100.0 * told.setPoint,
                               told.enable ? "on" : "off", 100.0 * *reading.setPoint,
                               *reading.enabled ? "on" : "off");
        }
        if (reading.setPoint) {
            return fmt::format("the drive was told {:.1f} % and says {:.1f} %", 100.0 * told.setPoint,
                               100.0 * *reading.setPoint);
        }
        return fmt::format("the drive was told \"{}\" and says \"{}\"", told.enable ? "on" : "off",
                           *reading.enabled ? "on" : "off");
    }
    const bool coasted = now - restSince_ > kCoastTime;
    if (coasted && vibrates(reading)) {
        return fmt::format(
            "the feeder was told to rest and still vibrates with {:.1f} m/s^2. Switch it off by hand",
            *reading.acceleration);
    }
    return std::nullopt;
}

bool Supervisor::isExplained(const Reading& reading) const {
    if (told_.empty()) return true;
    const auto [low, high] = std::minmax_element(
        told_.begin(), told_.end(),
        [](const Told& a, const Told& b) { return a.command.setPoint < b.command.setPoint; });
    if (reading.setPoint && (*reading.setPoint < low->command.setPoint - agreement_.tolerance ||
                             *reading.setPoint > high->command.setPoint + agreement_.tolerance)) {
        return false;
    }
    return !reading.enabled || std::any_of(told_.begin(), told_.end(), [&](const Told& told) {
        return told.command.enable == *reading.enabled;
    });
}

bool Supervisor::isAtRest(const Reading& reading) const {
    return saysOff(reading) && !vibrates(reading);
}

// A number that is none says nothing that could be relied on: it compares as false.
bool Supervisor::saysOff(const Reading& reading) const {
    if (reading.enabled.value_or(false)) return false;
    return std::abs(reading.setPoint.value_or(0.0)) <= agreement_.tolerance;
}

bool Supervisor::vibrates(const Reading& reading) const {
    if (!reading.acceleration || !agreement_.restAcceleration) return false;
    return !(std::abs(*reading.acceleration) <= *agreement_.restAcceleration);
}

bool Supervisor::defiesRest(double now) const {
    if (!linked_ || !reading_ || !restTold_) return false;
    const double told = now - *restTold_;
    if (!saysOff(*reading_))
        return told > agreement_.settlingTime && now - connectedAt_ > agreement_.settlingTime;
    return told > kCoastTime && vibrates(*reading_);
}

}  // namespace trapwright::drive
