#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/drive/heartbeat.h"

namespace trapwright::drive {

/// A drive and its heartbeat on a thread of their own. Wishes may come from any thread and return at once;
/// stop() wakes the thread, which tells the drive to rest without waiting for the next beat.
class DriveLoop {
 public:
    using DriveMaker = Heartbeat::DriveMaker;  // called on the loop's thread
    using Log = Heartbeat::Log;                // likewise

    /// Connects, and keeps the connection alive from then on; after a fault it goes on trying to reach the
    /// drive, to tell it to rest.
    DriveLoop(const Profile& profile, const Limits& limits, DriveMaker makeDrive, Log log);
    DriveLoop(const DriveLoop&) = delete;
    DriveLoop& operator=(const DriveLoop&) = delete;
    /// Set-point zero, enable off, end of the connection and of the thread. Takes some milliseconds where the
    /// drive answers, and at most longestFarewell() where it moves and does not: a window calls end() and
    /// waits for ended() before it.
    ~DriveLoop();

    /// The most that the end takes: 1 s and eleven time-outs of the profile. [s]
    [[nodiscard]] static double longestFarewell(const Profile& profile);

    void start();
    void stop();
    void setTarget(double setPoint);
    void setFrequency(std::optional<double> frequency);
    void setLimits(const Limits& limits);
    void acknowledge();
    /// The window is alive. From the first call on motion ends in a fault when there was none for 2 s: nobody
    /// could press stop in a window that hangs.
    void attend();
    /// Puts the operator's words into the log.
    void note(const std::string& text);
    /// As the destructor, without waiting for it. Nothing can be wished after it.
    void end();
    /// The thread has nothing left to do: finish() and the destructor return at once, and snapshot() is the
    /// last one.
    [[nodiscard]] bool ended() const { return ended_; }
    /// end(), and waits for it: as long as the destructor.
    void finish();

    [[nodiscard]] Snapshot snapshot() const;

 private:
    using Wish = std::function<void()>;  // runs on the thread
    enum class Haste { withBeat, atOnce };

    void post(Wish wish, Haste haste);
    void run();
    void sayFarewell();
    void publish();

    const double period_;        // [s]
    const double farewellTime_;  // [s]

    mutable std::mutex mutex_;  // guards the next five
    std::condition_variable wake_;
    std::vector<Wish> wishes_;
    bool hasty_ = false;  // one of the wishes does not wait for the beat
    bool over_ = false;
    Snapshot snapshot_;

    Heartbeat heartbeat_;  // the thread's own
    std::atomic<bool> ended_ = false;

    std::thread thread_;  // last: it uses all of the above
};

}  // namespace trapwright::drive
