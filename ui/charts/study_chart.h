#pragma once

#include <memory>
#include <vector>

#include "ui/charts/curve_chart.h"
#include "ui/charts/study_curves.h"

namespace trapwright::charts {

/// A chart of a learning run, or of two to be compared.
class StudyChart : public CurveChart {
    Q_OBJECT
 public:
    /// What to draw of these studies; empty plots if there is nothing to draw.
    using SheetMaker = ChartSheet (*)(const std::vector<StudyCurves>& studies);

    StudyChart(const QString& name, const QString& title, SheetMaker make, QWidget* parent);

    /// One study, or two: the second is drawn lighter, with other dashes.
    void setStudies(std::vector<StudyCurves> studies);
    /// The same, of somebody who shows them in several charts and tells when there is more of them.
    void shareStudies(std::shared_ptr<const std::vector<StudyCurves>> studies);
    void studiesChanged();
    [[nodiscard]] const std::vector<StudyCurves>& studies() const { return *studies_; }

 protected:
    /// What is shown instead of curves: `before` the first generation, `without` where generations have none.
    void setEmptyTexts(const QString& before, const QString& without);

 private:
    SheetMaker make_;
    QString before_;
    QString without_;
    std::shared_ptr<const std::vector<StudyCurves>> studies_;
};

/// Success of each generation's winner with its bounds, and the mean of the top 30 %.
class SuccessChart : public StudyChart {
    Q_OBJECT
 public:
    explicit SuccessChart(QWidget* parent = nullptr);
};

/// F_C, F_D and F_O in a plot each: best, mean of the top 30 %, best attainable (paper, Figure 6).
class FitnessChart : public StudyChart {
    Q_OBJECT
 public:
    explicit FitnessChart(QWidget* parent = nullptr);
};

/// What the search tells of itself; of the genetic one p_x, p_dm and p_s on a logarithmic axis (paper, Figure
/// 7).
class SearchChart : public StudyChart {
    Q_OBJECT
 public:
    explicit SearchChart(QWidget* parent = nullptr);
};

/// Simulated trials per second.
class SpeedChart : public StudyChart {
    Q_OBJECT
 public:
    explicit SpeedChart(QWidget* parent = nullptr);
};

/// Each winner's success, F_D and F_O in the engine that learned and in the reference, on the same trials.
class EngineChart : public StudyChart {
    Q_OBJECT
 public:
    explicit EngineChart(QWidget* parent = nullptr);
};

}  // namespace trapwright::charts
