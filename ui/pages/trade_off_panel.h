#pragma once

#include <QPointer>
#include <QWidget>
#include <optional>
#include <string>

#include "core/study/records.h"
#include "ui/session/work_thread.h"

class QComboBox;

namespace trapwright::charts {
class TradeOffChart;
}

namespace trapwright::session {
class StudySession;
}

namespace trapwright::pages {

class PanelHead;

/// What the tracks of the open study have of two objectives that pull against each other, with the Pareto
/// front; each point opens its track. Reads the scores from the file in the background, and only while it is
/// seen.
class TradeOffPanel : public QWidget {
    Q_OBJECT
 public:
    TradeOffPanel();

    void setSession(const session::StudySession* session);
    /// Which track is in the scene; none: none that was learned.
    void setShown(const std::optional<study::IndividualId>& track);

 signals:
    void picked(const trapwright::study::Individual& individual);
    void failed(const QString& what, const QString& message);

 protected:
    void showEvent(QShowEvent* event) override;

 private:
    QWidget* makeChoice();
    /// What the study measured of its tracks, with what it trades, or is likely to be asked for, chosen.
    void offerObjectives();
    void load();
    void showTracks();
    void pick(const study::IndividualId& track);

    QPointer<const session::StudySession> session_;
    session::NewestTask reading_;
    /// What was read last, which may not be what is chosen by now.
    std::vector<study::ScorePair> tracks_;
    const objectives::Objective* readAcross_ = nullptr;
    const objectives::Objective* readUp_ = nullptr;
    std::optional<study::IndividualId> shown_;
    QComboBox* across_;
    QComboBox* up_;
    charts::TradeOffChart* chart_;
    PanelHead* head_;
    bool isStale_ = true;
};

}  // namespace trapwright::pages
