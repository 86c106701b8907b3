#pragma once

#include <QWidget>
#include <optional>

#include "core/study/stream.h"
#include "core/workflow/study_trials.h"

namespace trapwright::charts {
class CurveChart;
}

namespace trapwright::pages {

class PanelHead;

/// Parts that follow each other on a track: how many a minute leave it as wanted, over how many come. Each
/// inflow is a link to a film of its streams.
class StreamPanel : public QWidget {
    Q_OBJECT
 public:
    StreamPanel();

    /// Null: there were no streams.
    void setStreams(const study::StreamsRecord* streams);

 signals:
    /// Someone wants to see the streams of an inflow.
    void filmWanted(const trapwright::workflow::StreamTrials& trials, const QString& name);
    void failed(const QString& what, const QString& message);

 private:
    void showHead();
    void film(std::size_t result);

    std::optional<study::StreamsRecord> streams_;
    charts::CurveChart* chart_;
    PanelHead* head_;
};

}  // namespace trapwright::pages
