#pragma once

#include <QPointer>
#include <QWidget>
#include <optional>

#include "core/study/records.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace trapwright::session {
class StudyRuns;
}

namespace trapwright::pages {

class FactList;
class SuccessCard;

/// Which track of a study is looked at, what is known of it, and whether it is the final one. Making one
/// final on which nothing succeeded is asked about first.
class TrackChoice : public QWidget {
    Q_OBJECT
 public:
    explicit TrackChoice(QWidget* parent);

    void setRuns(session::StudyRuns* runs);
    [[nodiscard]] const std::optional<study::Individual>& winner() const { return winner_; }
    /// Any individual of the study.
    void setWinner(const study::IndividualId& id);
    /// What is known of the track may have changed.
    void refresh();

 signals:
    void winnerChanged();
    void failed(const QString& what, const QString& message);

 private:
    void listWinners();
    void showFacts();
    void askAndChoose();
    void choose();
    void showFinal();
    [[nodiscard]] bool isFinal() const;

    QPointer<session::StudyRuns> runs_;
    std::optional<study::Individual> winner_;
    QComboBox* list_;
    SuccessCard* success_;
    FactList* facts_;
    QPushButton* take_;
    QLabel* final_;
};

}  // namespace trapwright::pages
