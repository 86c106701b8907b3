#pragma once

#include <QElapsedTimer>
#include <QEventLoop>
#include <QObject>
#include <QTimer>
#include <algorithm>
#include <vector>

namespace trapwright::session {

/// How late the event loop of a thread answers: a timer of 5 ms, and by how much each of its events comes
/// after its time.
struct EventDelays {
    double worst = 0.0;  // [ms]
    double most = 0.0;   // 99.9 % are not later [ms]
    int events = 0;
};

/// Lets this thread's events be handled for so long [ms]. By a loop of its own: QTest::qWait sleeps between
/// events.
inline EventDelays watchEvents(int duration) {
    constexpr int kInterval = 5;  // [ms]
    QTimer timer;
    QElapsedTimer clock;
    std::vector<double> late;
    timer.setTimerType(Qt::PreciseTimer);
    timer.setInterval(kInterval);
    QObject::connect(&timer, &QTimer::timeout, [&] {
        late.push_back(std::max(1e-6 * static_cast<double>(clock.nsecsElapsed()) - kInterval, 0.0));
        clock.restart();
    });
    QEventLoop loop;
    QTimer::singleShot(duration, &loop, &QEventLoop::quit);
    clock.start();
    timer.start();
    loop.exec();
    if (late.empty()) return {1.0 * duration, 1.0 * duration, 0};
    std::sort(late.begin(), late.end());
    const auto rank = static_cast<std::size_t>(0.999 * static_cast<double>(late.size() - 1));
    return {late.back(), late[rank], static_cast<int>(late.size())};
}

/// Notes how late the events of its thread are while something is done, whichever loop handles them.
class LateEvents {
 public:
    LateEvents() {
        timer_.setTimerType(Qt::PreciseTimer);
        timer_.setInterval(kInterval);
        QObject::connect(&timer_, &QTimer::timeout, [this] { note(); });
    }
    void start() {
        worst_ = 0.0;
        clock_.start();
        timer_.start();
    }
    /// Since start(), and nothing is noted any more. [ms]
    double stop() {
        note();
        timer_.stop();
        return worst_;
    }

 private:
    static constexpr int kInterval = 10;  // [ms]

    void note() {
        worst_ = std::max(worst_, 1e-6 * static_cast<double>(clock_.nsecsElapsed()) - kInterval);
        clock_.restart();
    }

    QTimer timer_;
    QElapsedTimer clock_;
    double worst_ = 0.0;
};

}  // namespace trapwright::session
