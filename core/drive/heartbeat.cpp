#include "core/drive/heartbeat.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trapwright::drive {

namespace {

constexpr double kAttention = 2.0;        // [s] that a window may hang while the feeder moves
constexpr double kRetryPause = 0.5;       // [s] between two attempts to reach a drive
constexpr double kQuietOfWatchdog = 1.5;  // how long a drive is left to its watchdog, of its time
constexpr int kPatience = 2;              // failures in a row before it is

Agreement agreementOf(const Profile& profile) {
    constexpr double kOfWatchdog = 0.75;
    Agreement agreement;
    agreement.tolerance = profile.tolerance;
    agreement.settlingTime = profile.settlingTime;
    agreement.restAcceleration = profile.restAcceleration;
    if (profile.watchdog) {
        agreement.longestGap = std::min(agreement.longestGap, kOfWatchdog * *profile.watchdog);
    }
    return agreement;
}

bool isMoving(State state) {
    return state == State::ramping || state == State::running;
}

}  // namespace

Heartbeat::Heartbeat(const Profile& profile, const Limits& limits, DriveMaker makeDrive, Log log, Clock clock)
    : profile_(profile),
      makeDrive_(std::move(makeDrive)),
      log_(std::move(log)),
      clock_(std::move(clock)),
      supervisor_(limits, agreementOf(profile)) {}

void Heartbeat::beat() {
    if (linked_ || reach()) {
        exchange();
        // A fault that has just been found does not wait for the next beat.
        if (isMoving(noted_) && supervisor_.state() == State::faulted && linked_) {
            noteState();
            exchange();
        }
    }
    noteState();
    noteWarning();
}

bool Heartbeat::reach() {
    if (clock() < quietUntil_ || (tried_ && clock() - *tried_ < kRetryPause)) return false;
    const bool first = !tried_;
    auto status = makeOnce();
    if (status) status = drive_->connect();
    tried_ = clock();
    if (!status) {
        const std::string message = status.error().message;
        if (first || message != trouble_) write(LogKind::note, "no connection: " + message);
        trouble_ = message;
        supervisor_.failed(message);
        // It hears us and does not obey.
        if (drive_ && drive_->connected()) {
            drive_->disconnect();
            countFailure();
        }
        return false;
    }
    trouble_.clear();
    linked_ = true;
    write(LogKind::connected, profile_.title);
    supervisor_.connected(clock());
    return true;
}

base::Status Heartbeat::makeOnce() {
    if (drive_) return base::success();
    auto drive = makeDrive_();
    if (!drive) return drive.error();
    drive_ = std::move(*drive);
    return base::success();
}

void Heartbeat::exchange() {
    if (attended_ && isMoving(supervisor_.state()) && clock() - *attended_ > kAttention) {
        supervisor_.fault(
            "the window did not respond for 2 s, and nobody could have stopped the feeder in it");
    }
    now_.command = supervisor_.command(clock());
    writeCommand(now_.command);
    const double begin = clock();
    const auto reading = drive_->exchange(now_.command);
    const double end = clock();
    now_.longestExchange = std::max(now_.longestExchange, end - begin);
    if (!reading) {
        supervisor_.failed(reading.error().message);
        return leave();
    }
    now_.reading = *reading;
    writeReading(*reading);
    supervisor_.observe(*reading, end);
    if (supervisor_.restConfirmed()) failures_ = 0;
    // Whoever goes on speaking to it keeps its watchdog from acting.
    if (supervisor_.defiesRest(end) && profile_.watchdog) {
        failures_ = std::max(failures_, kPatience);
        supervisor_.failed("the drive was told to rest and does not do so");
        leave();
    }
}

void Heartbeat::leave() {
    noteState();
    countFailure();
    rest();
}

void Heartbeat::rest() {
    if (!linked_) return;
    now_.command = Command{};
    now_.reading = Reading{};
    writeCommand(now_.command);
    drive_->disconnect();
    linked_ = false;
    write(LogKind::disconnected, {});
}

void Heartbeat::countFailure() {
    ++failures_;
    if (failures_ < kPatience || supervisor_.restConfirmed() || !profile_.watchdog) return;
    quietUntil_ = clock() + profile_.timeOut + kQuietOfWatchdog * *profile_.watchdog;
}

void Heartbeat::finish() {
    supervisor_.stop();
    rest();
    supervisor_.disconnected();
    noteState();
    drive_.reset();
    noteWarning();
}

std::string Heartbeat::warning() const {
    if (!supervisor_.mayMove()) return {};
    std::string text =
        "the drive may still be moving: it was told to rest and has not confirmed it. Keep your hands "
        "away and switch it off by hand";
    if (profile_.watchdog)
        text += fmt::format("; by itself it should rest after {:g} s of silence", *profile_.watchdog);
    return text;
}

void Heartbeat::noteWarning() {
    const std::string text = warning();
    if (!text.empty() && !warned_) write(LogKind::note, text);
    if (text.empty() && warned_) write(LogKind::note, "the drive has confirmed that it rests");
    warned_ = !text.empty();
}

void Heartbeat::refuse(const base::Status& status) {
    now_.refusal = status ? std::string() : status.error().message;
    if (!status) write(LogKind::note, "refused: " + now_.refusal);
}

void Heartbeat::noteState() {
    const State state = supervisor_.state();
    if (state == noted_) return;
    noted_ = state;
    if (state == State::faulted) write(LogKind::fault, supervisor_.fault());
    write(LogKind::state, std::string(nameOf(state)));
}

Snapshot Heartbeat::snapshot() const {
    Snapshot snapshot = now_;
    snapshot.state = supervisor_.state();
    snapshot.connected = linked_;
    snapshot.target = supervisor_.target();
    snapshot.limits = supervisor_.limits();
    snapshot.fault = supervisor_.fault();
    snapshot.warning = warning();
    return snapshot;
}

void Heartbeat::writeCommand(const Command& command) {
    LogEntry entry;
    entry.kind = LogKind::command;
    entry.setPoint = command.setPoint;
    entry.frequency = command.frequency;
    entry.enabled = command.enable;
    write(std::move(entry));
}

void Heartbeat::writeReading(const Reading& reading) {
    LogEntry entry;
    entry.kind = LogKind::reading;
    entry.setPoint = reading.setPoint;
    entry.frequency = reading.frequency;
    entry.enabled = reading.enabled;
    entry.acceleration = reading.acceleration;
    entry.halfStroke = reading.halfStroke;
    entry.current = reading.current;
    entry.text = reading.fault.value_or(std::string());
    write(std::move(entry));
}

void Heartbeat::write(LogKind kind, std::string text) {
    LogEntry entry;
    entry.kind = kind;
    entry.text = std::move(text);
    write(std::move(entry));
}

void Heartbeat::write(LogEntry entry) {
    entry.number = ++entries_;
    entry.time = epoch_ + clock();
    if (log_) log_(entry);
}

}  // namespace trapwright::drive
