#include "core/drive/drive_loop.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace trapwright::drive {

namespace {

using std::chrono::steady_clock;

constexpr double kLongestQuestion = 1.0;  // [s] until a drive that is left must say that it rests
// Two beats of five time-outs, one that has begun and the last one of the farewell, and the end.
constexpr double kTimeOutsOfEnd = 11.0;

steady_clock::duration toDuration(double seconds) {
    return std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

DriveLoop::DriveLoop(const Profile& profile, const Limits& limits, DriveMaker makeDrive, Log log)
    : period_(1.0 / profile.heartbeat),
      farewellTime_(std::min(profile.settlingTime, kLongestQuestion)),
      heartbeat_(profile, limits, std::move(makeDrive), std::move(log)),
      thread_([this] { run(); }) {}

DriveLoop::~DriveLoop() {
    finish();
}

double DriveLoop::longestFarewell(const Profile& profile) {
    return kLongestQuestion + kTimeOutsOfEnd * profile.timeOut;
}

void DriveLoop::finish() {
    end();
    if (thread_.joinable()) thread_.join();
}

void DriveLoop::start() {
    post([this] { heartbeat_.start(); }, Haste::atOnce);
}

void DriveLoop::stop() {
    post([this] { heartbeat_.supervisor().stop(); }, Haste::atOnce);
}

void DriveLoop::setTarget(double setPoint) {
    post([this, setPoint] { heartbeat_.supervisor().setTarget(setPoint); }, Haste::withBeat);
}

void DriveLoop::setFrequency(std::optional<double> frequency) {
    post([this, frequency] { heartbeat_.supervisor().setFrequency(frequency); }, Haste::withBeat);
}

void DriveLoop::setLimits(const Limits& limits) {
    post([this, limits] { heartbeat_.supervisor().setLimits(limits); }, Haste::withBeat);
}

void DriveLoop::acknowledge() {
    post([this] { heartbeat_.acknowledge(); }, Haste::atOnce);
}

void DriveLoop::attend() {
    post([this] { heartbeat_.attend(); }, Haste::withBeat);
}

void DriveLoop::note(const std::string& text) {
    post([this, text] { heartbeat_.note(text); }, Haste::withBeat);
}

void DriveLoop::end() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    wake_.notify_one();
}

Snapshot DriveLoop::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
}

void DriveLoop::post(Wish wish, Haste haste) {
    {
        const std::lock_guard lock(mutex_);
        wishes_.push_back(std::move(wish));
        hasty_ = hasty_ || haste == Haste::atOnce;
    }
    wake_.notify_one();
}

void DriveLoop::run() {
    const auto period = toDuration(period_);
    auto next = steady_clock::now();
    while (true) {
        bool over = false;
        std::vector<Wish> wishes;
        {
            std::unique_lock lock(mutex_);
            wake_.wait_until(lock, next, [this] { return over_ || hasty_; });
            wishes.swap(wishes_);
            hasty_ = false;
            over = over_;
        }
        for (const Wish& wish : wishes)
            wish();
        heartbeat_.noteState();
        if (over) break;
        // A beat out of turn does not leave a longer pause behind it.
        const auto begun = std::min(next, steady_clock::now());
        heartbeat_.beat();
        publish();
        next = std::max(begun + period, steady_clock::now());
    }
    sayFarewell();
    heartbeat_.finish();
    publish();
    ended_ = true;
}

void DriveLoop::sayFarewell() {
    heartbeat_.supervisor().stop();
    heartbeat_.noteState();
    // Nobody will ask it again: what was moving must say now that it does not any more.
    const Deadline deadline(farewellTime_);
    while (!heartbeat_.supervisor().restConfirmed()) {
        heartbeat_.beat();
        publish();
        if (deadline.left() <= 0.0) break;
        if (!heartbeat_.supervisor().restConfirmed())
            std::this_thread::sleep_for(toDuration(std::min(period_, deadline.left())));
    }
}

void DriveLoop::publish() {
    Snapshot snapshot = heartbeat_.snapshot();
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(snapshot);
}

}  // namespace trapwright::drive
