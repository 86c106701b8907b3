#pragma once

#include <QPointer>
#include <QWidget>
#include <optional>

#include "core/study/records.h"

class QAction;
class QLabel;
class QProgressBar;
class QPushButton;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

/// Starts the comparison of the best winners and the validation of one track, and shows how far they have
/// come.
class JudgingCard : public QWidget {
    Q_OBJECT
 public:
    explicit JudgingCard(QWidget* parent);

    void setRuns(session::StudyRuns* runs);
    /// The track that would be validated; none if there is none.
    void setWinner(const std::optional<study::Individual>& winner);

    [[nodiscard]] QAction* compareAction() { return compare_; }
    [[nodiscard]] QAction* validateAction() { return validate_; }

 private:
    QWidget* makeProgress();
    QPushButton* makeButton(QAction* action);
    void update();
    void showProgress();

    QPointer<session::StudyRuns> runs_;
    std::optional<study::Individual> winner_;
    QAction* compare_;
    QAction* validate_;
    QLabel* compareText_;
    QLabel* validateText_;
    QWidget* busy_;
    QLabel* busyText_;
    QProgressBar* bar_;
};

}  // namespace trapwright::pages
