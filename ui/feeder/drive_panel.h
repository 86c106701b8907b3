#pragma once

#include <QPointer>
#include <QWidget>
#include <array>

class QDoubleSpinBox;
class QFrame;
class QLabel;
class QPushButton;
class QSlider;

namespace trapwright::session {
class StudyDesign;
class StudyFeeder;
}  // namespace trapwright::session

namespace trapwright::feeder {

class ConnectionCard;
class DriveLink;
class DriveMatch;

/// The drive in the inspector: state, fault, set-point, what it measures, connection, limits.
class DrivePanel : public QWidget {
    Q_OBJECT
 public:
    DrivePanel(DriveLink& link, QWidget* parent);

    /// Null, both of them: no study is open.
    void setStudy(session::StudyDesign* design, const session::StudyFeeder* feeder);
    /// The page is shown: what profiles there are may have changed.
    void refresh();

 signals:
    void failed(const QString& what, const QString& message);
    /// A set-point was typed and Enter pressed: the keys belong to the trials again.
    void setPointGiven();

 private:
    QWidget* makeSetPoint();
    QWidget* makeReadings();
    QWidget* makeFault();
    QWidget* makeLimits();
    void showSettings();
    void showTarget();
    void showSnapshot();
    void changeLimits();

    DriveLink& link_;
    QPointer<session::StudyDesign> design_;
    ConnectionCard* connection_;
    DriveMatch* match_;
    QLabel* state_;
    QWidget* motion_;  // all that needs a drive
    QSlider* slider_ = nullptr;
    QDoubleSpinBox* setPoint_ = nullptr;
    QWidget* setPointRow_ = nullptr;
    QPushButton* start_ = nullptr;
    QLabel* refusal_ = nullptr;
    std::array<QLabel*, 6> readings_{};
    QFrame* fault_ = nullptr;
    QLabel* faultText_ = nullptr;
    QPushButton* acknowledge_ = nullptr;
    QDoubleSpinBox* highest_ = nullptr;
    QDoubleSpinBox* ramp_ = nullptr;
};

}  // namespace trapwright::feeder
