#pragma once

#include <QTimer>
#include <QWidget>

class QAction;
class QBoxLayout;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QToolButton;

namespace trapwright::feeder {

class ExpectedPose;
class GuideActions;
class TrialGuide;

/// Below the scene: what to do now in letters that are read from a metre away, the time, a button for every
/// key, and beside them what success looks like.
class GuideBar : public QWidget {
    Q_OBJECT
 public:
    GuideBar(TrialGuide& guide, GuideActions& actions);

    /// Beside the buttons: what success looks like.
    [[nodiscard]] ExpectedPose* expected() const { return expected_; }

 protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

 private:
    QToolButton* makeButton(QAction* action, bool large);
    QWidget* makeNote();
    void addKeys(QBoxLayout& column, GuideActions& actions);
    QHBoxLayout* makeOthers(GuideActions& actions);
    void refresh();
    void showTime();
    void claimHeight();
    void askForNote();
    void takeNote();
    [[nodiscard]] QString sentence() const;
    [[nodiscard]] QString progress() const;

    TrialGuide& guide_;
    ExpectedPose* expected_;
    QLabel* sentence_;
    QLabel* progress_;
    QLabel* time_;
    QLabel* trouble_;
    QLabel* noteLabel_;
    QLineEdit* noteEdit_;
    QWidget* noteRow_;
    QTimer tick_;
};

}  // namespace trapwright::feeder
