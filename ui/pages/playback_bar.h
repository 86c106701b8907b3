#pragma once

#include <QList>
#include <QWidget>

#include "ui/pages/replay_player.h"
#include "ui/pages/replay_scene.h"

class QAction;
class QComboBox;
class QHBoxLayout;
class QLabel;
class QSlider;

namespace trapwright::look {
class MessageBar;
}

namespace trapwright::pages {

/// What is below a scene in which something is replayed: the time line, and the buttons of a player. Each
/// button is an action with a key.
class PlaybackBar : public QWidget {
    Q_OBJECT
 public:
    explicit PlaybackBar(ReplayPlayer& player);

    /// Of the drive: time is also told in its periods. [Hz]
    void setFrequency(double frequency);
    /// What is said while there is nothing to play.
    void setHint(const QString& hint);
    /// What is said above the time line about the replay that is shown: `what`, and below it `message`; both
    /// empty: nothing.
    void setWarning(const QString& what, const QString& message);
    [[nodiscard]] ReplayView view() const;

 signals:
    void viewChanged(const trapwright::pages::ReplayView& view);

 private:
    QAction* addButton(QHBoxLayout& row, const QString& name, const QString& icon, const QString& text,
                       const QKeySequence& key);
    QAction* addSwitch(QHBoxLayout& row, const QString& name, const QString& icon, const QString& text,
                       const QKeySequence& key, bool on);
    void addPlayerButtons(QHBoxLayout& row);
    void addSpeed(QHBoxLayout& row);
    void addKey(const QString& name, const QString& text, const QKeySequence& key, double cycles);
    void changeSpeed(int by);
    void showTime();
    void showPlaying();

    ReplayPlayer& player_;
    double frequency_ = 50.0;
    QString hint_;
    look::MessageBar* warning_;
    QSlider* line_;
    QLabel* time_;
    QComboBox* speed_;
    QAction* play_ = nullptr;
    QAction* trace_ = nullptr;
    QAction* forces_ = nullptr;
};

}  // namespace trapwright::pages
