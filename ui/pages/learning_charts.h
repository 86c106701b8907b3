#pragma once

#include <QObject>
#include <QPointer>
#include <filesystem>
#include <optional>
#include <vector>

#include "ui/charts/study_curves.h"
#include "ui/pages/page.h"
#include "ui/session/work_thread.h"

namespace trapwright::charts {
class StudyChart;
}

namespace trapwright::pages {

/// The charts of the open study, which grow while it learns, and of another study to compare it with.
class LearningCharts : public QObject {
    Q_OBJECT
 public:
    explicit LearningCharts(QObject* parent);

    /// Success, engines, speed, and the details of the algorithm (fitness, search) in one panel.
    /// Asked for once; who asks owns the charts.
    [[nodiscard]] std::vector<Panel> panels() const;

    void setSession(const session::StudySession* session);
    /// Reads the other study in the background; it may be learning in another process.
    void compareWith(const std::filesystem::path& study);
    void endComparison();
    /// Name of the other study; empty: none.
    [[nodiscard]] QString comparedName() const;

 signals:
    void comparisonChanged();
    void picked(int generation);
    void failed(const QString& what, const QString& message);

 private:
    void showStudies();
    void add(charts::StudyChart* chart);

    QPointer<const session::StudySession> session_;
    std::optional<charts::StudyCurves> other_;
    session::NewestTask reading_;
    std::vector<charts::StudyChart*> charts_;
    std::size_t firstDetail_ = 0;  // of charts_: this and all after it show the algorithm
};

}  // namespace trapwright::pages
