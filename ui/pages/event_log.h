#pragma once

#include <QIcon>
#include <QPointer>
#include <QWidget>
#include <array>

#include "ui/session/run_state.h"

class QStackedLayout;
class QTreeWidget;

namespace trapwright::session {
class StudySession;
}

namespace trapwright::pages {

/// What happened to the open study since it was opened, oldest first.
class EventLog : public QWidget {
    Q_OBJECT
 public:
    explicit EventLog(QWidget* parent = nullptr);

    /// Begins anew.
    void setSession(session::StudySession* session);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    enum class Kind { info, good, warning, error };

    void add(Kind kind, const QString& text);
    void colour();
    void tellState(session::RunState state);
    void tellGeneration(int generation);
    void tellCheck(int generation);

    QPointer<session::StudySession> session_;
    session::RunState last_ = session::RunState::idle;
    std::array<QIcon, 4> signs_;  // by kind
    QTreeWidget* list_;
    QStackedLayout* stack_;
};

}  // namespace trapwright::pages
