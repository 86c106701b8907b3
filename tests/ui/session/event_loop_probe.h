#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <algorithm>
#include <vector>

namespace trapwright::session {

/// Measures how late the event loop of this thread answers: a timer of 5 ms, and by how much each of its
/// events comes after its time. Begins when it is made.
class EventLoopProbe {
 public:
    struct Delays {
        double worst = 0.0;  // [ms]
        double most = 0.0;   // 99.9 % are not later [ms]
        int events = 0;
    };

    EventLoopProbe() {
        timer_.setTimerType(Qt::PreciseTimer);
        timer_.setInterval(kInterval);
        QObject::connect(&timer_, &QTimer::timeout, [this] {
            late_.push_back(std::max(1e-6 * static_cast<double>(clock_.nsecsElapsed()) - kInterval, 0.0));
            clock_.restart();
        });
        clock_.start();
        timer_.start();
    }

    [[nodiscard]] Delays delays() const {
        if (late_.empty()) return {};
        std::vector<double> sorted = late_;
        std::sort(sorted.begin(), sorted.end());
        const auto rank = static_cast<std::size_t>(0.999 * static_cast<double>(sorted.size() - 1));
        return {sorted.back(), sorted[rank], static_cast<int>(sorted.size())};
    }

 private:
    static constexpr int kInterval = 5;  // [ms]

    QTimer timer_;
    QElapsedTimer clock_;
    std::vector<double> late_;
};

}  // namespace trapwright::session
