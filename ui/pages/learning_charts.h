#pragma once

#include <QObject>
#include <QPointer>
#include <filesystem>
#include <memory>
#include <vector>

#include "ui/charts/study_curves.h"
#include "ui/pages/page.h"
#include "ui/session/study_curves.h"
#include "ui/session/work_thread.h"

namespace trapwright::charts {
class StudyChart;
}

namespace trapwright::pages {

/// The charts of the open study, which grow while it learns, and of another study to compare it with, or of
/// several: then of the median of all, the open one among them, between the quartiles.
class LearningCharts : public QObject {
    Q_OBJECT
 public:
    explicit LearningCharts(QObject* parent);

    /// Success, engines, speed, and the details of the algorithm (fitness, search) in one panel.
    /// Asked for once; who asks owns the charts.
    [[nodiscard]] std::vector<Panel> panels() const;

    void setSession(const session::StudySession* session);
    /// Reads the other studies in the background; they may be learning in other processes.
    void compareWith(const std::vector<std::filesystem::path>& studies);
    void endComparison();
    /// The other studies; empty: there is no comparison.
    [[nodiscard]] std::vector<study::ComparedStudy> others() const;
    /// The open study as it is compared.
    [[nodiscard]] study::ComparedStudy own() const;

 signals:
    void comparisonChanged();
    void picked(int generation);
    void failed(const QString& what, const QString& message);

 private:
    void showStudies();
    [[nodiscard]] charts::StudyCurves ownCurves() const;
    [[nodiscard]] charts::StudyCurves otherCurves() const;
    void add(charts::StudyChart* chart);

    QPointer<const session::StudySession> session_;
    std::vector<session::StoredCurves> others_;
    session::NewestTask reading_;
    std::vector<charts::StudyChart*> charts_;
    std::shared_ptr<std::vector<charts::StudyCurves>> shown_;  // by all of them
    std::size_t firstDetail_ = 0;  // of charts_: this and all after it show the algorithm
};

}  // namespace trapwright::pages
