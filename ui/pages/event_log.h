#pragma once

#include <QIcon>
#include <QPointer>
#include <QWidget>
#include <array>

#include "ui/session/study_runs.h"

class QStackedLayout;
class QTreeWidget;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// What happened to the open study since it was opened, oldest first.
class EventLog : public QWidget {
    Q_OBJECT
 public:
    explicit EventLog(QWidget* parent = nullptr);

    /// Begins anew.
    void setRuns(const session::StudyRuns* runs);
    /// See StudySession::failed().
    void tellFailure(const QString& what, const QString& message);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    enum class Kind { info, good, warning, error };

    void add(Kind kind, const QString& text);
    void colour();
    void tellState(session::RunState state);
    void tellJob(const session::FollowedJob& job);
    void tellGeneration(int generation);
    void tellCheck(int generation);
    void tellRemade();

    QPointer<const session::StudyRuns> runs_;
    session::RunState last_ = session::RunState::idle;
    std::size_t remade_ = 0;      // trials of the present run that were told of
    std::array<QIcon, 4> signs_;  // by kind
    QTreeWidget* list_;
    QStackedLayout* stack_;
};

}  // namespace trapwright::pages
