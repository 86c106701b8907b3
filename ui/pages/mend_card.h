#pragma once

#include <QPointer>
#include <QWidget>
#include <memory>
#include <optional>

#include "core/geometry/print_check.h"
#include "core/study/records.h"

class QLabel;
class QPushButton;

namespace trapwright::session {
struct PrintedTrack;
class StudyRuns;
}  // namespace trapwright::session

namespace trapwright::workflow {
struct MendingReport;
}

namespace trapwright::pages {

class JobProgress;

/// Mends a learned track of which something cannot be printed: says how much that is and what mending costs,
/// how far it has come, and what it gave, beside the track before. Takes no room where there is nothing to
/// mend and nothing to tell.
class MendCard : public QWidget {
    Q_OBJECT
 public:
    explicit MendCard(QWidget* parent);

    void setRuns(session::StudyRuns* runs);
    /// The track that is shown, and what can be printed.
    void show(const study::Individual& track, const session::PrintedTrack& printed,
              const geometry::PrintLimits& limits);
    /// No track is shown.
    void clear();

 private:
    void start();
    void update();
    void tell(const workflow::MendingReport& report);

    QPointer<session::StudyRuns> runs_;
    std::optional<study::Individual> track_;
    geometry::PrintLimits limits_;
    double unprintable_ = 0.0;  // of it [m^2]
    QString result_;            // of the last mending, until another study is shown
    QPushButton* mend_;
    QLabel* cost_;
    JobProgress* progress_;
    QLabel* told_;
};

}  // namespace trapwright::pages
