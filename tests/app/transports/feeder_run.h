#pragma once

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/transports/make_drive.h"
#include "app/transports/virtual_feeder.h"
#include "core/drive/drive_loop.h"
#include "core/drive/profile_folder.h"

namespace trapwright::tests {

/// The longest that a virtual feeder may move on, whatever happens. [ms]
inline constexpr int kRestTime = 2500;

inline drive::Profile bundledProfile(const std::string& name) {
    const auto folder =
        drive::readProfileFolder(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/drives");
    for (const drive::Profile& profile : folder.profiles) {
        if (profile.name == name) return profile;
    }
    qFatal("no profile %s", name.c_str());
    return {};
}

/// A log that a DriveLoop fills from its thread.
class Log {
 public:
    [[nodiscard]] drive::DriveLoop::Log sink() {
        return [this](const drive::LogEntry& entry) {
            const std::lock_guard lock(mutex_);
            entries_.push_back(entry);
        };
    }
    [[nodiscard]] std::vector<drive::LogEntry> entries() const {
        const std::lock_guard lock(mutex_);
        return entries_;
    }

 private:
    mutable std::mutex mutex_;
    std::vector<drive::LogEntry> entries_;
};

/// Why a log is not whole; empty if it is. Whole: numbered without a gap, in the order of time, and every
/// set-point that reached the feeder is in it, in that order.
inline QString findGap(const std::vector<drive::LogEntry>& log, const std::vector<drive::Command>& received) {
    std::vector<double> logged = {0.0};
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log[i].number != static_cast<std::int64_t>(i) + 1)
            return QString("entry %1 is missing").arg(i + 1);
        if (i > 0 && log[i].time < log[i - 1].time) return QString("time goes back at entry %1").arg(i + 1);
        if (log[i].kind == drive::LogKind::command) logged.push_back(log[i].setPoint.value());
        // Whoever connects tells the drive to rest.
        if (log[i].kind == drive::LogKind::connected) logged.push_back(0.0);
    }
    auto at = logged.begin();
    for (const drive::Command& command : received) {
        // What the protocol rounds.
        const auto isIt = [&](double setPoint) { return std::abs(setPoint - command.setPoint) < 1e-4; };
        at = std::find_if(at, logged.end(), isIt);
        if (at == logged.end()) return QString("a command of %1 is missing").arg(command.setPoint);
    }
    return {};
}

/// A virtual feeder and a loop that drives it, over the real protocol.
struct FeederRun {
    drive::Profile profile;
    std::unique_ptr<transports::VirtualFeeder> feeder;
    Log log;
    std::unique_ptr<drive::DriveLoop> loop;

    explicit FeederRun(const std::string& name) : profile(bundledProfile(name)) {
        auto served = transports::serveVirtualFeeder(profile);
        if (!served) qFatal("%s", served.error().message.c_str());
        feeder = std::move(*served);
    }

    void connect(const drive::Limits& limits = {0.9, 1.0}) {
        loop = std::make_unique<drive::DriveLoop>(
            profile, limits, [this] { return transports::makeDrive(profile, feeder->address()); },
            log.sink());
    }

    [[nodiscard]] bool isIn(drive::State state, int time = 5000) const {
        return QTest::qWaitFor([&] { return loop->snapshot().state == state; }, time);
    }

    /// Until it runs at this set-point and the feeder moves as it must.
    [[nodiscard]] bool runAt(double target) {
        if (!isIn(drive::State::idle)) return false;
        loop->setTarget(target);
        loop->start();
        const double halfStroke = target * profile.fullHalfStroke.value();
        return isIn(drive::State::running) &&
               QTest::qWaitFor([&] { return std::abs(feeder->halfStroke() / halfStroke - 1.0) < 0.05; },
                               3000);
    }

    /// The time until the feeder rests. [ms]
    [[nodiscard]] qint64 timeToRest() const {
        QElapsedTimer timer;
        timer.start();
        static_cast<void>(QTest::qWaitFor([this] { return feeder->isAtRest(); }, 2 * kRestTime));
        const qint64 time = timer.elapsed();
        qInfo("at rest after %lld ms", static_cast<long long>(time));
        return time;
    }
};

}  // namespace trapwright::tests
