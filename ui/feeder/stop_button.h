#pragma once

#include <QObject>

class QAction;
class QPushButton;
class QWidget;

namespace trapwright::feeder {

class DriveLink;

/// The large red button of an action that stops the drive; says that it is no emergency stop.
QPushButton* makeStopButton(QAction& action, QWidget* parent);

/// Stops the drive by Esc, whatever has the focus: another page, a dialog, a menu. Whoever else knows the key
/// gets it, too. A window that is about to close stops the drive, and one that has closed disconnects it.
class StopKey : public QObject {
    Q_OBJECT
 public:
    /// `inside`: any widget of the window.
    StopKey(DriveLink& link, QWidget* inside);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    [[nodiscard]] QObject* window() const;

    DriveLink& link_;
    QWidget* inside_;
};

}  // namespace trapwright::feeder
