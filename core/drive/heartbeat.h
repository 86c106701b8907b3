#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/drive/deadline.h"
#include "core/drive/drive.h"
#include "core/drive/log_entry.h"
#include "core/drive/profile.h"
#include "core/drive/supervisor.h"

namespace trapwright::drive {

/// What a window shows of a drive.
struct Snapshot {
    State state = State::disconnected;
    bool connected = false;
    double target = 0.0;  // what the operator wants, share of full
    Limits limits;
    Command command;      // the last one
    Reading reading;      // the last one
    std::string fault;    // why it is faulted; empty otherwise
    std::string refusal;  // why the last start() or acknowledge() did nothing; empty if it did
    std::string warning;  // that it may still move, and what to do; empty while there is no reason to
    double longestExchange = 0.0;  // [s]
};

/// One drive and what is done with it at each heartbeat: reach it, tell it the supervisor's command, judge
/// what it answers, and leave it to its own watchdog where it does not come to rest otherwise. No thread and
/// no clock of its own: DriveLoop gives it both.
class Heartbeat {
 public:
    /// Makes the drive; called by the first beat, in whose thread the drive then lives.
    using DriveMaker = std::function<base::Result<std::unique_ptr<Drive>>()>;
    /// Takes what is logged, in order. Must return at once.
    using Log = std::function<void(const LogEntry&)>;

    Heartbeat(const Profile& profile, const Limits& limits, DriveMaker makeDrive, Log log,
              Clock clock = steadyTime);

    /// Wishes go to the supervisor; the next beat tells the drive.
    Supervisor& supervisor() { return supervisor_; }
    void start() { refuse(supervisor_.start()); }
    void acknowledge() { refuse(supervisor_.acknowledge()); }
    void attend() { attended_ = clock(); }
    void note(std::string text) { write(LogKind::note, std::move(text)); }

    /// Takes at most five time-outs of the profile: three to reach the drive, one to ask it and one to leave
    /// it.
    void beat();
    /// Notes a state that a wish has changed.
    void noteState();
    /// Tells the drive to rest and ends the connection. Takes at most one time-out.
    void finish();

    [[nodiscard]] Snapshot snapshot() const;

 private:
    bool reach();
    base::Status makeOnce();
    void exchange();
    void leave();
    void rest();
    void countFailure();
    void noteWarning();
    [[nodiscard]] std::string warning() const;
    void refuse(const base::Status& status);
    void writeCommand(const Command& command);
    void writeReading(const Reading& reading);
    void write(LogKind kind, std::string text);
    void write(LogEntry entry);
    [[nodiscard]] double clock() const { return clock_() - begin_; }  // [s] since it began

    const Profile profile_;
    const DriveMaker makeDrive_;
    const Log log_;
    const Clock clock_;
    const double begin_ = clock_();
    // The system's clock is asked once: times in the log never go back.
    const double epoch_ =
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();

    Supervisor supervisor_;
    std::unique_ptr<Drive> drive_;
    bool linked_ = false;
    Snapshot now_;
    State noted_ = State::disconnected;
    std::optional<double> tried_;     // [s], when it last looked for the drive
    double quietUntil_ = 0.0;         // [s], its watchdog is given that long
    int failures_ = 0;                // since it last said that it does what it is told
    std::optional<double> attended_;  // [s]
    std::string trouble_;             // why there was no connection the last time
    bool warned_ = false;
    std::int64_t entries_ = 0;
};

}  // namespace trapwright::drive
