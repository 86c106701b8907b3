#pragma once

#include <QPointer>
#include <QStatusBar>

class QLabel;
class QProgressBar;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::window {

/// What the open study is doing, at the bottom of the window: state, generation, individual, trials per
/// second, time left, success of the track that counts, and what the reference engine says of the last winner
/// that it checked.
class StatusLine : public QStatusBar {
    Q_OBJECT
 public:
    explicit StatusLine(QWidget* parent);

    void setRuns(const session::StudyRuns* runs);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    QLabel* addField(const QString& name, const QString& meaning);
    void update();
    void updateSuccess();
    void updateEngines();

    QPointer<const session::StudyRuns> runs_;
    QLabel* sign_;
    QLabel* state_;
    QProgressBar* bar_;
    QLabel* generation_;
    QLabel* success_;
    QLabel* individual_;
    QLabel* speed_;
    QLabel* left_;
    QLabel* engines_;
};

}  // namespace trapwright::window
