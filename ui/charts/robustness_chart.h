#pragma once

#include <optional>
#include <vector>

#include "core/study/robustness.h"
#include "core/study/settings.h"
#include "ui/charts/chart_panel.h"

class QHBoxLayout;
class QScrollArea;

namespace trapwright::charts {

class PairMap;
class Plot;

/// How a track does where the physics is not quite what was set: success with its bounds against each
/// condition, and over the worst two of them as a map; conveying speed if the user says so.
class RobustnessChart : public ChartPanel {
    Q_OBJECT
 public:
    explicit RobustnessChart(QWidget* parent = nullptr);

    /// `settings`: those that it was measured with.
    void setRobustness(const study::Settings& settings, study::Robustness robustness);
    void clear();

    /// A line for each place: as set, over the box, along each condition, worst corners, map.
    [[nodiscard]] QString csv() const override;

 signals:
    /// A point or a cell was clicked.
    void picked(const trapwright::study::PlaceTrials& trials);

 protected:
    void applyTheme(const ChartTheme& theme) override;

 private:
    struct Sweep {
        Plot* plot;
        bool isSpeed;
        std::size_t condition;  // index into the robustness's sweeps
    };

    void addSweeps(bool isSpeed);
    void showMap();
    void updateShown();
    void pick(const Sweep& sweep, double x);
    [[nodiscard]] double valueAt(const study::PlaceResult& result, trial::Condition condition) const;

    study::Settings settings_;
    std::optional<study::Robustness> robustness_;
    QScrollArea* scroll_;
    QWidget* row_;
    QHBoxLayout* layout_;
    std::vector<Sweep> sweeps_;
    PairMap* map_;
};

}  // namespace trapwright::charts
