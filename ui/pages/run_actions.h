#pragma once

#include <QAction>
#include <QObject>
#include <QPointer>

namespace trapwright::session {
class StudySession;
}

namespace trapwright::pages {

/// The actions that start and end learning, for the menu, the tool bar and the Evolve page alike. Each is
/// enabled when the open study can take it; where Start is not, its tool tip tells why.
class RunActions : public QObject {
    Q_OBJECT
 public:
    explicit RunActions(QObject* parent = nullptr);

    void setSession(session::StudySession* session);

    /// Starts learning, or goes on with it when it is paused.
    QAction* start() { return start_; }
    QAction* pause() { return pause_; }
    QAction* stopAfterGeneration() { return stopAfterGeneration_; }
    QAction* stopNow() { return stopNow_; }

 private:
    void update();

    QPointer<session::StudySession> session_;
    QAction* start_;
    QAction* pause_;
    QAction* stopAfterGeneration_;
    QAction* stopNow_;
};

}  // namespace trapwright::pages
