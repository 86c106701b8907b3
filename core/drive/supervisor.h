#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/drive/drive.h"

namespace trapwright::drive {

enum class State {
    disconnected,
    idle,      // connected, at rest
    ramping,   // on the way to the wish
    running,   // where the operator wants it
    stopping,  // told to rest; not all readings say so yet
    faulted    // told to rest; moves again only after acknowledge() and start()
};

/// "disconnected", "idle" and so on.
std::string_view nameOf(State state);

/// What may be asked of a drive, as a study sets it.
struct Limits {
    double highest = 1.0;        // set-point, share of full
    double rampPerSecond = 0.5;  // set-point up and down while it runs; a stop knows no ramp

    friend bool operator==(const Limits&, const Limits&) = default;
};

/// When readings disagree with commands; from the profile.
struct Agreement {
    double tolerance = 0.02;                 // share of full
    double settlingTime = 0.5;               // [s]
    std::optional<double> restAcceleration;  // [m/s^2]: above it the feeder moves
    double longestGap = 1.0;  // [s] between two heartbeats before the drive may have stopped by itself
};

/// Decides what a drive is told: the operator's wishes and the drive's readings go in, commands come out.
/// Pure: the caller hands the time in, in seconds of a clock that only goes forward, and calls from one
/// thread.
///
/// Nothing moves without start(). stop() is rest at once. A failed exchange, a fault of the drive, a reading
/// that no command of the last settlingTime explains, motion at rest, and a heartbeat that came too late are
/// faults: rest at once, and nothing moves before acknowledge() and another start().
class Supervisor {
 public:
    Supervisor(const Limits& limits, const Agreement& agreement);

    /// What the operator wants. None of them moves a drive that start() did not set going.
    void setTarget(double setPoint);  // clamped to 0 ... Limits::highest
    void setFrequency(std::optional<double> frequency);
    void setLimits(const Limits& limits);
    /// Error: it is not at rest and connected, or a fault is not acknowledged.
    base::Status start();
    void stop();
    /// After a fault: back to rest. Error: the drive is not connected, or still tells the fault or moves.
    base::Status acknowledge();

    /// What happened to the drive.
    void connected(double now);
    void disconnected();                      // as the operator wished
    void failed(const std::string& message);  // connecting or an exchange
    void fault(const std::string& message);   // found by somebody else; the connection is as it was
    void observe(const Reading& reading, double now);

    /// What to tell the drive now; moves on along the ramp. To be called once for each heartbeat.
    Command command(double now);

    /// The drive was not told to move since it last said that it does what it is told, and rests.
    [[nodiscard]] bool restConfirmed() const { return !mayMove_; }
    /// It should rest, and nobody knows that it does: it does not answer, or says otherwise.
    [[nodiscard]] bool mayMove() const {
        return mayMove_ && (state_ == State::faulted || state_ == State::disconnected);
    }
    /// It answers, had its time to come to rest, and says that it does not rest.
    [[nodiscard]] bool defiesRest(double now) const;

    [[nodiscard]] State state() const { return state_; }
    [[nodiscard]] double target() const { return target_; }
    [[nodiscard]] const Limits& limits() const { return limits_; }
    /// Why it is faulted, or why there is no connection; empty otherwise.
    [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
    struct Told {
        double time;
        Command command;
    };

    [[nodiscard]] std::optional<std::string> findDisagreement(const Reading& reading, double now) const;
    [[nodiscard]] bool isExplained(const Reading& reading) const;
    [[nodiscard]] bool isAtRest(const Reading& reading) const;
    [[nodiscard]] bool saysOff(const Reading& reading) const;
    [[nodiscard]] bool vibrates(const Reading& reading) const;

    Limits limits_;
    Agreement agreement_;
    State state_ = State::disconnected;
    double target_ = 0.0;
    std::optional<double> frequency_;
    double setPoint_ = 0.0;
    bool linked_ = false;                // there is a connection
    double connectedAt_ = 0.0;           // [s]
    std::optional<double> lastCommand_;  // [s]
    double restSince_ = 0.0;             // [s], when it was told to rest
    std::optional<double> restTold_;     // [s], likewise, over all connections; none while it is to move
    bool mayMove_ = false;
    std::optional<Reading> reading_;
    std::deque<Told> told_;  // the commands that may explain a reading, oldest first
    std::string fault_;
};

}  // namespace trapwright::drive
