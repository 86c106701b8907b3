#pragma once

#include <QWidget>

#include "core/trial/predicted_speed.h"
#include "ui/session/work_thread.h"

class QLabel;

namespace trapwright::study {
struct Settings;
}

namespace trapwright::pages {

/// Throw number of a drive on a scale from sliding to hopping.
class ThrowGauge : public QWidget {
    Q_OBJECT
 public:
    explicit ThrowGauge(QWidget* parent);

    void show(double throwNumber);
    [[nodiscard]] QSize sizeHint() const override;

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    double throwNumber_ = 0.0;
};

/// What a drive does to a flat part: throw number and predicted conveying speed, found in the background.
class DriveCard : public QWidget {
    Q_OBJECT
 public:
    explicit DriveCard(QWidget* parent);

    void show(const study::Settings& settings);

 private:
    void tell(const trial::ConveyingPrediction& prediction);

    ThrowGauge* gauge_;
    QLabel* throw_;
    QLabel* speed_;
    session::NewestTask task_;
};

}  // namespace trapwright::pages
