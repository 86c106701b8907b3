#include "ui/pages/replay_player.h"

#include <algorithm>
#include <cmath>

namespace trapwright::pages {

namespace {

constexpr int kTick = 16;  // [ms]

}  // namespace

ReplayPlayer::ReplayPlayer(QObject* parent) : QObject(parent) {
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(kTick);
    connect(&timer_, &QTimer::timeout, this, &ReplayPlayer::tick);
}

void ReplayPlayer::setDuration(double duration) {
    if (duration == duration_) return;
    duration_ = duration;
    if (duration_ <= 0.0) pause();
    emit durationChanged(duration_);
    setTime(time_);
}

void ReplayPlayer::setSpeed(double speed) {
    speed = std::clamp(speed, kSlowest, kFastest);
    if (speed == speed_) return;
    speed_ = speed;
    emit speedChanged(speed_);
}

void ReplayPlayer::setTime(double time) {
    moveTo(std::clamp(time, 0.0, duration_));
}

void ReplayPlayer::play() {
    if (playing() || duration_ <= 0.0) return;
    if (time_ >= duration_) moveTo(0.0);
    clock_.start();
    timer_.start();
    emit playingChanged(true);
}

void ReplayPlayer::pause() {
    if (!playing()) return;
    timer_.stop();
    emit playingChanged(false);
}

void ReplayPlayer::toggle() {
    if (playing()) {
        pause();
    } else {
        play();
    }
}

void ReplayPlayer::step(double by) {
    pause();
    setTime(time_ + by);
}

void ReplayPlayer::tick() {
    double time = time_ + 1e-9 * static_cast<double>(clock_.nsecsElapsed()) * speed_;
    clock_.restart();
    if (time >= duration_) {
        if (loop_) {
            time = std::fmod(time, duration_);
        } else {
            time = duration_;
            pause();
        }
    }
    moveTo(time);
}

void ReplayPlayer::moveTo(double time) {
    if (time == time_) return;
    time_ = time;
    emit timeChanged(time_);
}

}  // namespace trapwright::pages
