#pragma once

#include <QPointer>
#include <QString>
#include <QWidget>
#include <functional>
#include <vector>

class QFrame;
class QLabel;
class QPushButton;
class QTimer;

namespace trapwright::window {

/// One thing that a tour points at.
struct TourStep {
    QString page;    // that has to be shown
    QString widget;  // its object name
    QString title;
    QString text;
};

/// The window in five steps.
std::vector<TourStep> windowTour();

/// Lies over a window, darkens it but for one widget after the other, and tells what each is for. Return and
/// the right arrow go on, the left arrow goes back, Esc ends it. Follows the widgets when the window changes
/// its size or somebody changes the page.
class Tour : public QWidget {
    Q_OBJECT
 public:
    /// `showPage` is called with the page of each step.
    Tour(QWidget& window, std::vector<TourStep> steps, std::function<void(const QString&)> showPage);

    void start();
    [[nodiscard]] int step() const { return step_; }
    /// What is pointed at, in the window's coordinates; empty while its page is not shown.
    [[nodiscard]] QRect spot() const { return spot_; }

 signals:
    /// It was ended, or gone through; it deletes itself.
    void ended();

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    bool focusNextPrevChild(bool next) override;

 private:
    void go(int step);
    void end();
    void follow();
    void placeBubble();
    [[nodiscard]] QRect findSpot() const;

    QWidget& window_;
    std::vector<TourStep> steps_;
    std::function<void(const QString&)> showPage_;
    QPointer<QWidget> before_;  // that had the focus
    int step_ = 0;
    QRect spot_;
    QTimer* following_;
    QFrame* bubble_;
    QLabel* title_;
    QLabel* text_;
    QLabel* away_;
    QLabel* count_;
    QPushButton* skip_;
    QPushButton* back_;
    QPushButton* next_;
};

}  // namespace trapwright::window
