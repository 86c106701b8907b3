#include "ui/pages/track_choice.h"

#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/selection.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"
#include "ui/pages/fact_list.h"
#include "ui/pages/success_card.h"
#include "ui/pages/target_card.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::StudyRuns;

namespace {

constexpr int kIndividualRole = Qt::UserRole + 1;

QString nameOf(int generation, int individual) {
    return TrackChoice::tr("Generation %1, individual %2").arg(generation).arg(individual);
}

using Success = std::optional<study::TrackSuccess>;

QString sourceOf(const Success& success) {
    using Source = study::TrackSuccess::Source;
    if (success && success->source == Source::validation) return TrackChoice::tr("validation");
    if (success && success->source == Source::selection) return TrackChoice::tr("comparison");
    return TrackChoice::tr("while learning");
}

/// Why nobody should want this track; empty if there is nothing against it.
QString findObjection(const Success& success, const study::IndividualRecord& record) {
    if (success && success->count.successes == 0) {
        return TrackChoice::tr(
                   "Its success is 0 %: of %1 parts none finished in the expected orientation (%2).")
            .arg(success->count.trials)
            .arg(sourceOf(success));
    }
    if (success) return {};
    if (record.trials == 0) return TrackChoice::tr("It was never simulated: its surface crosses itself.");
    if (record.finished == 0) return TrackChoice::tr("None of %1 parts finished.").arg(record.trials);
    return {};
}

}  // namespace

TrackChoice::TrackChoice(QWidget* parent)
    : QWidget(parent),
      list_(new QComboBox(this)),
      success_(new SuccessCard("review", this)),
      facts_(new FactList(this)),
      take_(new QPushButton(tr("Make it the final track"), this)),
      final_(new QLabel(this)) {
    list_->setObjectName("review.track");
    list_->setAccessibleName(tr("Track"));
    list_->setToolTip(tr("The track that is looked at: the winner of any generation"));
    list_->setMaxVisibleItems(20);
    connect(list_, &QComboBox::activated, this, [this](int index) {
        setWinner({list_->itemData(index).toInt(), list_->itemData(index, kIndividualRole).toInt()});
    });
    take_->setObjectName("review.makeFinal");
    take_->setToolTip(tr("Go on with this track when it is exported"));
    connect(take_, &QPushButton::clicked, this, &TrackChoice::askAndChoose);
    final_->setObjectName("review.final");
    final_->setWordWrap(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(list_);
    column->addWidget(success_);
    column->addWidget(facts_);
    column->addWidget(final_);
    column->addWidget(take_);
}

void TrackChoice::setRuns(StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    winner_.reset();
    if (runs_) {
        connect(runs_, &StudyRuns::chosenChanged, this, &TrackChoice::showFinal);
        winner_ = runs_->chosen();
    }
    listWinners();
    showFacts();
    emit winnerChanged();
}

void TrackChoice::setWinner(const study::IndividualId& id) {
    if (!runs_ || (winner_ && isSameIndividual(*winner_, id))) return;
    const auto winner = runs_->loadIndividual(id);
    if (!winner) {
        emit failed(tr("The track cannot be shown"), QString::fromStdString(winner.error().message));
        return;
    }
    winner_ = *winner;
    listWinners();
    showFacts();
    emit winnerChanged();
}

void TrackChoice::refresh() {
    if (runs_ && !winner_) {
        winner_ = runs_->chosen();
        if (winner_) emit winnerChanged();
    }
    listWinners();
    showFacts();
}

void TrackChoice::listWinners() {
    const QSignalBlocker blocker(list_);
    list_->clear();
    if (!runs_) return;
    const auto add = [this](const study::Individual& winner) {
        const Success success = runs_->findSuccess(winner);
        std::optional<double> rate;
        if (success) rate = success->rate;
        list_->addItem(
            tr("%1: %2").arg(nameOf(winner.generation, winner.individual), models::successWord(rate)),
            winner.generation);
        list_->setItemData(list_->count() - 1, winner.individual, kIndividualRole);
    };
    const std::vector<study::Individual>& winners = runs_->winners();
    std::for_each(winners.rbegin(), winners.rend(), add);
    if (!winner_) return list_->setCurrentIndex(-1);
    const auto shown = std::find_if(winners.rbegin(), winners.rend(), [this](const study::Individual& one) {
        return isSameIndividual(one, *winner_);
    });
    // One of a selection need not be its generation's winner.
    if (shown == winners.rend()) add(*winner_);
    list_->setCurrentIndex(static_cast<int>(shown - winners.rbegin()));
}

void TrackChoice::showFacts() {
    list_->setVisible(winner_.has_value());
    success_->setVisible(winner_.has_value());
    showFinal();
    if (!winner_) return facts_->show({});
    const study::IndividualRecord& record = winner_->record;
    const session::StudyDesign& design = runs_->design();
    Facts facts = {{tr("Wanted"), wantedText(design.settings().target, *design.part())},
                   {tr("While learning"), models::shareText(record.success())},
                   {tr("Finished"), tr("%1 of %2").arg(record.finished).arg(record.trials)}};
    if (const auto from = runs_->mendedFrom(winner_->generation))
        facts.emplace_back(tr("Mended from"), nameOf(from->generation, from->individual).toLower());
    const study::SelectionEntry* compared = nullptr;
    for (const study::SelectionRecord& selection : runs_->selections())
        for (const study::SelectionEntry& entry : selection.entries)
            if (isSameIndividual(entry, *winner_)) compared = &entry;
    if (compared != nullptr)
        facts.emplace_back(tr("Comparison"),
                           models::shareText(stats::Count{compared->oriented, compared->trials}));
    const Success success = runs_->findSuccess(*winner_);
    const bool isValidated = success && success->source == study::TrackSuccess::Source::validation;
    if (success && success->ofArriving) {
        success_->showCorrect({success->rate, success->calcInterval()},
                              tr("%1, of the %2 % of parts that arrive")
                                  .arg(sourceOf(success), models::percent(std::optional(success->arriving))));
    } else if (isValidated) {
        success_->showWeighted({success->rate, success->calcInterval()},
                               tr("validation, weighted by how often parts land so"));
    } else {
        success_->show(success ? std::optional(success->count) : std::nullopt,
                       success ? tr("%1 of %2 parts, %3")
                                     .arg(success->count.successes)
                                     .arg(success->count.trials)
                                     .arg(sourceOf(success))
                               : sourceOf(success));
    }
    if (isValidated) facts.emplace_back(tr("All trials alike"), models::shareText(success->count));
    facts_->show(facts);
}

void TrackChoice::askAndChoose() {
    if (!runs_ || !winner_) return;
    const QString objection = findObjection(runs_->findSuccess(*winner_), winner_->record);
    if (objection.isEmpty()) return choose();
    auto* box = new QMessageBox(QMessageBox::Warning, tr("Trapwright"),
                                tr("Make the track of %1 the final one?")
                                    .arg(nameOf(winner_->generation, winner_->individual).toLower()),
                                QMessageBox::NoButton, this);
    box->setObjectName("dialog.badTrack");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setInformativeText(objection);
    QPushButton* take = box->addButton(tr("Make it final all the same"), QMessageBox::AcceptRole);
    take->setObjectName("answer.makeFinal");
    QPushButton* leave = box->addButton(tr("Choose another track"), QMessageBox::RejectRole);
    leave->setObjectName("answer.chooseAnother");
    box->setDefaultButton(leave);
    box->setEscapeButton(leave);
    connect(take, &QPushButton::clicked, this, &TrackChoice::choose);
    box->open();
}

void TrackChoice::choose() {
    if (runs_ && winner_) runs_->choose(*winner_);
}

bool TrackChoice::isFinal() const {
    const auto chosen = runs_ ? runs_->chosen() : std::nullopt;
    return chosen && winner_ && isSameIndividual(*chosen, *winner_);
}

void TrackChoice::showFinal() {
    take_->setVisible(winner_.has_value() && !isFinal());
    if (!winner_) return final_->setText(tr("No track has been learned yet."));
    const auto chosen = runs_ ? runs_->chosen() : std::nullopt;
    if (!chosen) return final_->clear();
    final_->setText(isFinal() ? tr("<b>This is the final track.</b> It is the one that is exported.")
                              : tr("Final track: %1").arg(nameOf(chosen->generation, chosen->individual)));
}

}  // namespace trapwright::pages
