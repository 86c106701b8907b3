#pragma once

#include <QObject>
#include <QPointer>
#include <QTimer>
#include <memory>
#include <mutex>
#include <vector>

#include "core/calibration/drive_setting.h"
#include "core/drive/drive_loop.h"
#include "ui/session/environment.h"

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

/// The drive that the operator connected, as the window sees it: wishes go to its loop, what the loop tells
/// goes to the study's log and to the views. Ends, with set-point zero and enable off, with the study:
/// whoever closes it calls leaveDrive() first, and waits until nothing is linked(), while the window goes on.
class DriveLink : public QObject {
    Q_OBJECT
 public:
    DriveLink(session::DriveAccess access, QObject* parent);
    ~DriveLink() override;

    /// Ends a connection that is still there, as disconnectDrive().
    void setFeeder(session::StudyFeeder* feeder);
    [[nodiscard]] const session::DriveAccess& access() const { return access_; }

    /// Connects in the background; snapshot() tells what comes of it. A virtual feeder is served first, and
    /// has an address of its own then. Nothing while there is a connection: that one is left first.
    void connectDrive(const drive::Profile& profile, const drive::Address& address);
    /// Set-point zero, enable off, end of the connection, in the background: linkChanged() tells when it is
    /// done, within longestFarewell().
    void leaveDrive();
    /// The same for whoever is about to be destroyed: the calling thread waits until it is done.
    void disconnectDrive();
    /// The most that leaving the drive takes. [s]
    [[nodiscard]] double longestFarewell() const { return drive::DriveLoop::longestFarewell(profile_); }

    /// Whether there is a connection, or one is tried.
    [[nodiscard]] bool linked() const { return loop_ != nullptr; }
    /// leaveDrive() is not done yet.
    [[nodiscard]] bool leaving() const { return leaving_; }
    /// Of the last drive.
    [[nodiscard]] const drive::Profile& profile() const { return profile_; }
    [[nodiscard]] const drive::Snapshot& snapshot() const { return snapshot_; }
    /// It was started and not stopped.
    [[nodiscard]] bool moves() const;
    /// Where start() takes the drive, share of full.
    [[nodiscard]] double target() const { return target_; }

    /// What the drive does, or will do, at its set-point: measured while it runs, else by calibration or
    /// profile.
    [[nodiscard]] calibration::DriveSetting setting() const;
    /// The same beside what the study simulates; nothing without a study or a drive.
    [[nodiscard]] calibration::DriveComparison comparison() const;

    void start();
    void stop();
    void setTarget(double setPoint);
    void acknowledge();
    /// Puts the operator's words into the log.
    void note(const QString& text);

 signals:
    /// Another drive, or none.
    void linkChanged();
    /// The connection is over; `warning`: that the drive may still move, and what to do. Empty: it rests.
    void left(const QString& warning);
    /// About ten times a second while linked.
    void polled();
    void stateChanged();
    void targetChanged();
    /// What was told and read since the last time, in order.
    void logged(const std::vector<trapwright::drive::LogEntry>& entries);
    void failed(const QString& what, const QString& message);

 private:
    /// Filled on the loop's thread.
    struct Inbox {
        std::mutex mutex;
        std::vector<drive::LogEntry> entries;
    };

    [[nodiscard]] drive::Limits limits() const;
    void followSettings();
    void poll();
    void forgetDrive();
    void takeLog();
    void saveLog();

    const session::DriveAccess access_;
    QPointer<session::StudyFeeder> feeder_;
    drive::Profile profile_;
    drive::Snapshot snapshot_;
    double target_ = 0.0;
    QTimer tick_;
    int ticks_ = 0;
    bool leaving_ = false;
    std::vector<drive::LogEntry> unsaved_;
    std::shared_ptr<Inbox> inbox_;
    session::ServedFeeder served_;  // outlives the loop
    std::unique_ptr<drive::DriveLoop> loop_;
};

}  // namespace trapwright::feeder
