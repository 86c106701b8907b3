#pragma once

#include <optional>
#include <vector>

#include "core/study/records.h"
#include "ui/charts/curve_chart.h"

namespace trapwright::charts {

/// Two objectives of a study's tracks, one against the other.
struct TradeOff {
    const objectives::Objective* across = nullptr;  // along x
    const objectives::Objective* up = nullptr;      // along y
    std::vector<study::ScorePair> tracks;           // first: of `across`
    std::vector<std::size_t> front;                 // of tracks: study::findParetoFront, best across first
    std::vector<study::ScorePair> measured{};       // by more trials than while learning (a selection)
    std::optional<study::IndividualId> shown{};     // in the scene
};

/// A point for each track, those of the Pareto front with the border of what can be had, those that were
/// measured anew as well, and the one that is in the scene.
ChartSheet tradeOffSheet(const TradeOff& tradeOff);

class TradeOffChart : public CurveChart {
    Q_OBJECT
 public:
    explicit TradeOffChart(QWidget* parent = nullptr);

    void setTradeOff(TradeOff tradeOff);

    /// A line for each track: generation, individual, both values, trials, whether it is on the front, both
    /// values and trials measured anew.
    [[nodiscard]] QString csv() const override;

 signals:
    void trackPicked(const trapwright::study::IndividualId& track);

 private:
    TradeOff tradeOff_;
};

}  // namespace trapwright::charts
