#pragma once

#include <QPointer>
#include <QWidget>
#include <optional>

#include "core/study/records.h"

class QAction;
class QLabel;
class QPushButton;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

class JobProgress;

/// Starts the comparison of the best winners, the validation of one track, the measurement of how robust it
/// and the others of the last comparison are, and streams of parts on it, and shows how far they have come.
class JudgingCard : public QWidget {
    Q_OBJECT
 public:
    explicit JudgingCard(QWidget* parent);

    void setRuns(session::StudyRuns* runs);
    /// The track that would be validated; none if there is none.
    void setWinner(const std::optional<study::Individual>& winner);

    [[nodiscard]] QAction* compareAction() { return compare_; }
    [[nodiscard]] QAction* validateAction() { return validate_; }
    [[nodiscard]] QAction* robustnessAction() { return robustness_; }
    [[nodiscard]] QAction* allRobustnessAction() { return allRobustness_; }
    [[nodiscard]] QAction* streamAction() { return stream_; }

 signals:
    void failed(const QString& what, const QString& message);

 private:
    QPushButton* makeButton(QAction* action);
    void update();
    void showRobustness(const QString& obstacle);
    void showStream(const QString& obstacle);
    void measureAll();

    QPointer<session::StudyRuns> runs_;
    std::optional<study::Individual> winner_;
    QAction* compare_;
    QAction* validate_;
    QAction* robustness_;
    QAction* allRobustness_;
    QAction* stream_;
    QAction* oneStream_;
    QLabel* compareText_;
    QLabel* validateText_;
    QLabel* robustnessText_;
    QLabel* allRobustnessText_;
    QLabel* streamText_;
    JobProgress* progress_;
};

}  // namespace trapwright::pages
