#pragma once

#include <QPointer>
#include <QWidget>

class QLabel;
class QProgressBar;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// How far what simulates tracks that are there has come (session::isJudging), with a button that stops it.
/// Takes no room while nothing does. Its children are `name`.progress and `name`.stop.
class JobProgress : public QWidget {
    Q_OBJECT
 public:
    JobProgress(const QString& name, QWidget* parent);

    void setRuns(session::StudyRuns* runs);

 private:
    void update();

    QPointer<session::StudyRuns> runs_;
    QLabel* text_;
    QProgressBar* bar_;
};

}  // namespace trapwright::pages
