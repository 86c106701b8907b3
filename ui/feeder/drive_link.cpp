#include "ui/feeder/drive_link.h"

#include <QCoreApplication>
#include <algorithm>
#include <utility>

#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"

namespace trapwright::feeder {

using drive::State;
using session::StudyDesign;
using session::StudyFeeder;

namespace {

constexpr int kTick = 100;         // [ms]
constexpr int kTicksPerSave = 10;  // each one is synced to the disk

}  // namespace

DriveLink::DriveLink(session::DriveAccess access, QObject* parent)
    : QObject(parent), access_(std::move(access)) {
    tick_.setInterval(kTick);
    tick_.setTimerType(Qt::PreciseTimer);
    connect(&tick_, &QTimer::timeout, this, &DriveLink::poll);
    connect(qApp, &QCoreApplication::aboutToQuit, this, &DriveLink::disconnectDrive);
}

DriveLink::~DriveLink() {
    // Whoever would show it is being destroyed as well.
    disconnect(this, &DriveLink::failed, nullptr, nullptr);
    disconnectDrive();
}

void DriveLink::setFeeder(StudyFeeder* feeder) {
    disconnectDrive();
    if (feeder_) feeder_->design().disconnect(this);
    feeder_ = feeder;
    target_ = 0.0;
    if (feeder_) connect(&feeder_->design(), &StudyDesign::settingsChanged, this, &DriveLink::followSettings);
    emit targetChanged();
}

void DriveLink::connectDrive(const drive::Profile& profile, const drive::Address& address) {
    if (loop_ || !feeder_ || !access_.makeDrive) return;
    drive::Address reached = address;
    if (profile.isVirtual) {
        auto served = access_.serveFeeder(profile);
        if (!served) {
            emit failed(tr("The virtual feeder cannot be served"),
                        QString::fromStdString(served.error().message));
            return;
        }
        served_ = std::move(*served);
        reached = served_.address;
    }
    profile_ = profile;
    inbox_ = std::make_shared<Inbox>();
    loop_ = std::make_unique<drive::DriveLoop>(
        profile, limits(), [make = access_.makeDrive, profile, reached] { return make(profile, reached); },
        [inbox = inbox_](const drive::LogEntry& entry) {
            const std::lock_guard lock(inbox->mutex);
            inbox->entries.push_back(entry);
        });
    followSettings();
    tick_.start();
    poll();
    emit linkChanged();
}

void DriveLink::disconnectDrive() {
    if (!loop_) return;
    loop_->finish();
    forgetDrive();
}

void DriveLink::leaveDrive() {
    if (!loop_ || leaving_) return;
    loop_->end();
    leaving_ = true;
    emit linkChanged();
}

void DriveLink::forgetDrive() {
    tick_.stop();
    leaving_ = false;
    const std::string warning = loop_->snapshot().warning;
    loop_.reset();
    takeLog();
    saveLog();
    served_ = {};
    snapshot_ = {};
    emit stateChanged();
    emit linkChanged();
    // Nobody tells it to rest any more.
    if (!warning.empty()) emit failed(tr("The drive may still be moving"), QString::fromStdString(warning));
    emit left(QString::fromStdString(warning));
}

bool DriveLink::moves() const {
    return snapshot_.state == State::ramping || snapshot_.state == State::running;
}

calibration::DriveSetting DriveLink::setting() const {
    if (!feeder_ || !loop_) return {};
    const drive::Reading& reading = snapshot_.reading;
    calibration::DriveState state;
    state.setPoint = target_;
    state.frequency = reading.frequency ? reading.frequency : profile_.frequency;
    if (snapshot_.state == State::running) state.halfStroke = reading.halfStroke;
    state.fullHalfStroke = profile_.fullHalfStroke;
    return calibration::findDriveSetting(state, feeder_->calibrations());
}

calibration::DriveComparison DriveLink::comparison() const {
    if (!feeder_ || !loop_) return {};
    return calibration::compareDrive(setting(), feeder_->design().settings().simulation.drive);
}

void DriveLink::start() {
    if (!loop_) return;
    loop_->setTarget(target_);
    loop_->start();
    poll();
}

void DriveLink::stop() {
    if (!loop_) return;
    loop_->stop();
    poll();
}

void DriveLink::setTarget(double setPoint) {
    const double wanted = std::clamp(setPoint, 0.0, limits().highest);
    if (wanted == target_) return;
    target_ = wanted;
    if (loop_) loop_->setTarget(target_);
    emit targetChanged();
}

void DriveLink::acknowledge() {
    if (!loop_) return;
    loop_->acknowledge();
    poll();
}

void DriveLink::note(const QString& text) {
    if (loop_) loop_->note(text.toStdString());
}

drive::Limits DriveLink::limits() const {
    drive::Limits limits;
    if (!feeder_) return limits;
    const study::FeederSettings& settings = feeder_->design().settings().feeder;
    limits.rampPerSecond = settings.rampPerSecond;
    // A drive that is only on or off knows no share of full.
    if (!loop_ || profile_.hasSetPoint()) limits.highest = settings.highestSetPoint;
    return limits;
}

void DriveLink::followSettings() {
    if (!feeder_) return;
    if (loop_) {
        loop_->setLimits(limits());
        if (profile_.hasFrequency())
            loop_->setFrequency(feeder_->design().settings().simulation.drive.frequency);
        else
            loop_->setFrequency(std::nullopt);
    }
    setTarget(loop_ && !profile_.hasSetPoint() ? 1.0 : target_);
    if (loop_) loop_->setTarget(target_);
}

void DriveLink::poll() {
    if (!loop_) return;
    // A window that hangs does not come here, and the drive is told to rest.
    loop_->attend();
    const State before = snapshot_.state;
    const std::string fault = snapshot_.fault;
    snapshot_ = loop_->snapshot();
    takeLog();
    if (++ticks_ % kTicksPerSave == 0) saveLog();
    emit polled();
    if (snapshot_.state != before || snapshot_.fault != fault) emit stateChanged();
    if (leaving_ && loop_ && loop_->ended()) forgetDrive();
}

void DriveLink::takeLog() {
    std::vector<drive::LogEntry> entries;
    {
        const std::lock_guard lock(inbox_->mutex);
        entries.swap(inbox_->entries);
    }
    if (entries.empty()) return;
    unsaved_.insert(unsaved_.end(), entries.begin(), entries.end());
    emit logged(entries);
}

void DriveLink::saveLog() {
    if (unsaved_.empty()) return;
    if (feeder_) feeder_->appendDriveLog(std::move(unsaved_));
    unsaved_.clear();
}

}  // namespace trapwright::feeder
