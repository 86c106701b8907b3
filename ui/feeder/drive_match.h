#pragma once

#include <QPointer>
#include <QWidget>
#include <array>

#include "core/calibration/drive_setting.h"

class QFrame;
class QLabel;
class QPushButton;

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

class DriveLink;

/// How far the drive is from what the study simulated, in sentences for the page and the report; empty where
/// nothing is more than 5 % off. What to do is the last sentence.
QString differenceText(const calibration::DriveComparison& comparison);
/// Why the half-stroke of a drive is not known and what to do, or else where it is known from.
QString strokeSourceText(calibration::StrokeSource source);

/// In the inspector: half-stroke and frequency of the drive beside those that the study simulated, and a
/// warning where they differ by more than 5 %. It can be dismissed, and is back when the set-point, the drive
/// or the study is another.
class DriveMatch : public QWidget {
    Q_OBJECT
 public:
    DriveMatch(DriveLink& link, QWidget* parent);

    void setFeeder(const session::StudyFeeder* feeder);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    /// What the user saw when he dismissed the warning.
    struct Seen {
        QString drive;
        double setPoint = 0.0;
        double halfStroke = 0.0;  // simulated [m]
        double frequency = 0.0;   // simulated [Hz]
        friend bool operator==(const Seen&, const Seen&) = default;
    };

    QWidget* makeNumbers();
    void makeWarning();
    void refresh();
    void showWarning(const calibration::DriveComparison& comparison,
                     const calibration::DriveSetting& setting);
    void takeSetPoint();
    [[nodiscard]] Seen now() const;

    DriveLink& link_;
    QPointer<const session::StudyFeeder> feeder_;
    // Half-stroke, frequency: of the drive, of the study, difference.
    std::array<std::array<QLabel*, 3>, 2> numbers_{};
    QLabel* source_;
    QFrame* warning_;
    QLabel* sign_ = nullptr;
    QLabel* text_ = nullptr;
    QPushButton* set_ = nullptr;
    double setPoint_ = 0.0;  // that would agree, share of full
    Seen dismissed_;
};

}  // namespace trapwright::feeder
