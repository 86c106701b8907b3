#pragma once

#include <QAction>
#include <QObject>
#include <QPointer>

class QTimer;

namespace trapwright::session {
class StudyDesign;
class StudyRuns;
}  // namespace trapwright::session

namespace trapwright::pages {

/// The actions that start and end learning, for the menu, the tool bar and the pages alike. Each is enabled
/// when the open study can take it; where Start is not, its tool tip tells why. Has the study timed as soon
/// as it rests, so that what starting means is known before.
class RunActions : public QObject {
    Q_OBJECT
 public:
    explicit RunActions(QObject* parent = nullptr);

    /// Null, both of them: no study is open.
    void setStudy(session::StudyDesign* design, session::StudyRuns* runs);

    /// Starts learning, or goes on with it when it is paused.
    QAction* start() { return start_; }
    /// Takes over the settings of a draft and learns with them. Its tool tip tells how long that takes here.
    QAction* draft() { return draft_; }
    /// Has corners of the operating box learned from the next generation on (study::learnInCorners).
    QAction* corners() { return corners_; }
    /// Asks for what a job of a cluster is to have; whoever shows that listens to it.
    QAction* cluster() { return cluster_; }
    QAction* pause() { return pause_; }
    QAction* stopAfterGeneration() { return stopAfterGeneration_; }
    QAction* stopNow() { return stopNow_; }

 signals:
    /// The user started learning, or had it go on; what follows is told by the session.
    void started();

 private:
    void update();
    void startDraft();
    void startCorners();

    QPointer<session::StudyDesign> design_;
    QPointer<session::StudyRuns> runs_;
    QTimer* estimateDelay_;
    QAction* start_;
    QAction* draft_;
    QAction* corners_;
    QAction* cluster_;
    QAction* pause_;
    QAction* stopAfterGeneration_;
    QAction* stopNow_;
};

}  // namespace trapwright::pages
