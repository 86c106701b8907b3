#pragma once

#include <QElapsedTimer>
#include <QEventLoop>
#include <QString>
#include <QTimer>
#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/drive/drive_loop.h"
#include "tests/app/transports/feeder_run.h"
#include "tests/app/transports/hostile_peer.h"

namespace trapwright::tests {

/// The virtual feeder's profile for one of "tcp", "rtu", "reo".
inline drive::Profile hostileProfile(const QString& link) {
    drive::Profile profile = bundledProfile(link == "reo" ? "virtual-reo" : "virtual-modbus");
    if (link != "rtu") return profile;
    profile.protocol = drive::Protocol::modbusRtu;
    profile.modbus.baud = 115200;
    profile.modbus.parity = 'N';  // a pseudo-terminal has none
    return profile;
}

/// What came of a sequence.
struct Outcome {
    std::uint64_t seed = 0;
    QString mood;            // during the stop
    QString reason;          // of the stop
    double rest = 0.0;       // [s] from the stop until the feeder rested
    bool rested = false;     // in time
    bool told = false;       // the operator was told that it may still move
    bool started = false;    // it moved before
    bool selfMoved = false;  // it was set in motion without being started
    bool recovered = true;   // with the link in order again it was told to rest, and the warning ended
    double end = 0.0;        // [s] that the end of the connection took
};

/// One drive loop against one hostile peer over the real transports: starts it, changes the peer's mood, asks
/// for the stop in one of several ways and looks until the feeder rests. step() is called again and again in
/// the event loop and never waits.
class HostileSequence {
 public:
    /// [s]: core/drive/README.md, "In the worst case"; 0.5 s of it for a busy computer.
    static double restTime(const drive::Profile& profile) {
        return 1.5 + 8.0 * profile.timeOut + 1.0 / profile.heartbeat + profile.watchdog.value() + 0.4 + 0.5;
    }

    HostileSequence(const drive::Profile& profile, std::uint64_t seed, const std::string& folder)
        : profile_(profile), random_(seed), peer_(profile, seed, folder) {
        outcome_.seed = seed;
        clock_.start();
        loop_ = std::make_unique<drive::DriveLoop>(
            profile_, drive::Limits{0.9, 4.0},
            [this] { return transports::makeDrive(profile_, peer_.address()); }, drive::DriveLoop::Log());
        moodAt_ = draw(0.2, 1.0);
        hangsAt_ = moodAt_;
        stopAt_ = moodAt_ + draw(-0.1, 0.6);
        reason_ = static_cast<int>(random_() % kReasons.size());
        mood_ = static_cast<Mood>(1 + random_() % static_cast<unsigned>(Mood::last));
    }
    HostileSequence(const HostileSequence&) = delete;
    HostileSequence& operator=(const HostileSequence&) = delete;
    ~HostileSequence() = default;

    /// False once it is over.
    bool step() {
        switch (phase_) {
            case Phase::connecting:
                connect();
                break;
            case Phase::running:
                run();
                break;
            case Phase::stopping:
                watch();
                break;
            case Phase::healing:
                heal();
                break;
            case Phase::ending:
                return !end();
        }
        return true;
    }

    [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
    enum class Phase { connecting, running, stopping, healing, ending };
    static constexpr int kAttempts = 5;          // to set it in motion
    static constexpr double kLongestEnd = 60.0;  // [s], many times what is stated
    static constexpr std::array<const char*, 4> kReasons = {"stop", "window hangs", "window closes", "fault"};

    double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    [[nodiscard]] double time() const { return 1e-3 * static_cast<double>(clock_.elapsed()); }
    void enter(Phase phase) {
        phase_ = phase;
        clock_.restart();
    }

    void connect() {
        const drive::Snapshot now = loop_->snapshot();
        if (time() > 15.0 || attempts_ >= kAttempts) return enter(Phase::ending);
        // A busy computer may have been late: that is a fault as well.
        if (now.state == drive::State::faulted) loop_->acknowledge();
        if (now.state != drive::State::idle) return;
        loop_->attend();
        loop_->setTarget(draw(0.3, 0.9));
        loop_->start();
        ++attempts_;
        enter(Phase::running);
    }

    void run() {
        const drive::State state = loop_->snapshot().state;
        if (state == drive::State::ramping || state == drive::State::running) outcome_.started = true;
        // On a busy computer an exchange may be late between its rest and its start.
        if (!outcome_.started && state == drive::State::faulted) return tryAgain();
        if (reason_ != 1 || time() < hangsAt_) loop_->attend();
        if (time() > moodAt_) peer_.setMood(nextMood());
        const bool faulted = outcome_.started && state == drive::State::faulted;
        if (!faulted && time() < runsUntil()) return;
        outcome_.reason = faulted ? "fault" : kReasons[static_cast<std::size_t>(reason_)];
        if (!faulted && (reason_ == 0 || reason_ == 3)) loop_->stop();
        if (!faulted && reason_ == 2) loop_->end();
        startings_ = -1;
        enter(Phase::stopping);
    }

    // [s]. A mood in which nothing is wrong ends in no fault, but a window that hangs does, after 2 s and
    // what the loop has begun by then.
    [[nodiscard]] double runsUntil() const {
        if (reason_ == 1) return hangsAt_ + 2.5 + 5.0 * profile_.timeOut;
        return reason_ == 3 ? std::max(stopAt_, 4.0) : stopAt_;
    }

    void tryAgain() {
        peer_.setMood(Mood::honest);
        outcome_.mood.clear();
        moodAt_ = hangsAt_;
        enter(Phase::connecting);
    }

    // Holds one for a while, as a real trouble does, so that what it does to a whole exchange is seen.
    Mood nextMood() {
        if (moodAt_ < stopAt_ + 60.0) outcome_.mood += QString(" %1").arg(static_cast<int>(mood_));
        const Mood mood = mood_;
        mood_ = static_cast<Mood>(random_() % (static_cast<unsigned>(Mood::last) + 1));
        moodAt_ = time() + draw(0.3, 3.0);
        return mood;
    }

    void watch() {
        // What was on its way when the stop was asked for may still arrive within two time-outs.
        if (time() > 2.0 * profile_.timeOut) noteStartings();
        // A hung window that is there again stops nothing and starts nothing.
        loop_->attend();
        if (time() > moodAt_ && time() < 2.0) peer_.setMood(nextMood());
        outcome_.told = outcome_.told || !loop_->snapshot().warning.empty();
        const bool rests = peer_.isAtRest();
        if (!rests && time() < 2.0 * restTime(profile_)) return;
        outcome_.rest = time();
        outcome_.rested = rests && time() < restTime(profile_);
        peer_.setMood(Mood::honest);
        // The way back takes its time: not every sequence goes it.
        enter(outcome_.seed % 4 == 0 && outcome_.reason != "window closes" ? Phase::healing : Phase::ending);
    }

    void heal() {
        noteStartings();
        loop_->attend();
        const drive::Snapshot now = loop_->snapshot();
        const bool well = now.connected && now.warning.empty() && peer_.isAtRest();
        if (!well && time() < 15.0) return;
        outcome_.recovered = well;
        enter(Phase::ending);
    }

    bool end() {
        noteStartings();
        loop_->end();
        // Its thread cannot be ended from outside, and nothing would tell who waits for what.
        if (time() > kLongestEnd) qFatal("the drive loop of seed %llu does not end", outcome_.seed + 0ULL);
        if (!loop_->ended()) return false;
        outcome_.end = time();
        loop_.reset();
        return true;
    }

    void noteStartings() {
        const int startings = peer_.startings();
        if (startings_ >= 0 && startings != startings_) outcome_.selfMoved = true;
        startings_ = startings;
    }

    const drive::Profile profile_;
    std::mt19937_64 random_;
    HostilePeer peer_;
    std::unique_ptr<drive::DriveLoop> loop_;
    Phase phase_ = Phase::connecting;
    QElapsedTimer clock_;  // since the phase began
    Outcome outcome_;
    double moodAt_ = 0.0;   // [s]
    double hangsAt_ = 0.0;  // [s]
    double stopAt_ = 0.0;   // [s]
    int attempts_ = 0;
    int reason_ = 0;
    Mood mood_ = Mood::honest;
    int startings_ = -1;
};

/// Runs the sequences of these seeds, so many at a time, in the event loop of this thread.
inline std::vector<Outcome> runHostile(const QString& link, std::uint64_t first, std::uint64_t last,
                                       std::size_t atOnce, const std::string& folder) {
    const drive::Profile profile = hostileProfile(link);
    std::vector<Outcome> outcomes;
    std::vector<std::unique_ptr<HostileSequence>> running;
    QEventLoop loop;
    QTimer timer;
    timer.setInterval(20);
    QObject::connect(&timer, &QTimer::timeout, &loop, [&] {
        if (running.size() < atOnce && first <= last)
            running.push_back(std::make_unique<HostileSequence>(profile, first++, folder));
        for (auto& sequence : running) {
            if (sequence->step()) continue;
            outcomes.push_back(sequence->outcome());
            sequence.reset();
        }
        std::erase(running, nullptr);
        if (running.empty() && first > last) loop.quit();
    });
    timer.start();
    loop.exec();
    return outcomes;
}

}  // namespace trapwright::tests
