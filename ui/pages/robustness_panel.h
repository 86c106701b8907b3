#pragma once

#include <QWidget>
#include <optional>
#include <set>
#include <vector>

#include "core/trial/orientations.h"
#include "core/workflow/study_trials.h"
#include "ui/session/study_runs.h"

namespace trapwright::charts {
class RobustnessChart;
}

namespace trapwright::pages {

class PanelHead;

/// How robust a track is: success as set, over the operating box and in its worst corners, each a link to the
/// trials, above the curves.
class RobustnessPanel : public QWidget {
    Q_OBJECT
 public:
    RobustnessPanel();

    /// Null: it was not measured.
    void setMeasured(const study::RobustnessRecord* measured, const study::Settings& settings);

 signals:
    /// Someone wants to see them: all, or where there are any only those that ended so.
    void trialsWanted(const trapwright::workflow::RobustnessTrials& trials, const QString& name,
                      const std::set<trapwright::trial::Verdict>& verdicts);
    void failed(const QString& what, const QString& message);

 private:
    void showHead();
    void goTo(const study::PlaceTrials& trials);
    [[nodiscard]] QString nameOf(const study::PlaceTrials& trials) const;

    std::optional<study::RobustnessRecord> measured_;
    study::Settings settings_;               // with the box that it was measured in
    std::vector<study::PlaceResult> links_;  // of the head, in their order
    charts::RobustnessChart* chart_;
    PanelHead* head_;
};

}  // namespace trapwright::pages
