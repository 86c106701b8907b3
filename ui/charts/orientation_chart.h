#pragma once

#include "core/study/orientation_shares.h"
#include "ui/charts/chart_panel.h"

namespace trapwright::charts {

class PoseBars;
class Plot;

/// How parts lie at the start and at the end: shares of the stable poses as stacked bars, and the share of
/// parts within an angle of the expected orientation.
class OrientationChart : public ChartPanel {
    Q_OBJECT
 public:
    explicit OrientationChart(QWidget* parent = nullptr);

    /// `tolerance` of the expected orientation is drawn as a line. [rad]
    void setShares(study::OrientationShares shares, double tolerance);
    void clear();

    [[nodiscard]] QString csv() const override;

 protected:
    void applyTheme(const ChartTheme& theme) override;

 private:
    void update();

    study::OrientationShares shares_;
    double tolerance_ = 0.0;
    PoseBars* bars_;
    Plot* angles_;
};

}  // namespace trapwright::charts
