#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace trapwright::pages {

/// The clock of a replay: which moment is shown, and how time goes on. It knows nothing of what is shown.
class ReplayPlayer : public QObject {
    Q_OBJECT
 public:
    static constexpr double kSlowest = 0.05;
    static constexpr double kFastest = 4.0;

    explicit ReplayPlayer(QObject* parent);

    /// From 0 to `duration` [s]. The moment stays where it is, if it is within.
    void setDuration(double duration);
    [[nodiscard]] double duration() const { return duration_; }
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] bool playing() const { return timer_.isActive(); }
    /// Simulated over real time, between kSlowest and kFastest.
    void setSpeed(double speed);
    [[nodiscard]] double speed() const { return speed_; }
    /// At the end it begins again instead of standing still.
    void setLoop(bool loop) { loop_ = loop; }
    [[nodiscard]] bool loop() const { return loop_; }

    void setTime(double time);
    /// From the beginning, if it is at the end.
    void play();
    void pause();
    void toggle();
    /// Stands still a little later or earlier. [s]
    void step(double by);

 signals:
    void timeChanged(double time);
    void durationChanged(double duration);
    void playingChanged(bool playing);
    void speedChanged(double speed);

 private:
    void tick();
    void moveTo(double time);

    QTimer timer_;
    QElapsedTimer clock_;  // since the last tick
    double duration_ = 0.0;
    double time_ = 0.0;
    double speed_ = 1.0;
    bool loop_ = false;
};

}  // namespace trapwright::pages
