#pragma once

#include <QPointer>
#include <QWidget>

class QComboBox;
class QLabel;
class QStackedWidget;

namespace trapwright::session {
class StudyFeeder;
}

namespace trapwright::feeder {

class DriveLink;
class ExpectedPose;
class PlanCards;
class PlanForm;
class TrialGuide;

/// At the left: which validation is gone on with and how far its poses are, or the plan of a new one.
class PlanPanel : public QWidget {
    Q_OBJECT
 public:
    PlanPanel(TrialGuide& guide, DriveLink& link, QWidget* parent);

    void setFeeder(const session::StudyFeeder* feeder);
    /// What can be planned may have changed.
    void refresh();
    /// Below the plan: what success looks like.
    [[nodiscard]] ExpectedPose* expected() const { return expected_; }

 private:
    QWidget* makeOverview();
    void listValidations();
    void showProgress();
    void showForm(bool form);

    TrialGuide& guide_;
    QPointer<const session::StudyFeeder> feeder_;
    QComboBox* list_ = nullptr;
    QLabel* facts_ = nullptr;
    PlanCards* cards_ = nullptr;
    ExpectedPose* expected_ = nullptr;
    PlanForm* form_ = nullptr;
    QStackedWidget* stack_;
};

}  // namespace trapwright::feeder
