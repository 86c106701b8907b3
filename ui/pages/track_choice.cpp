#include "ui/pages/track_choice.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/validation.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"
#include "ui/pages/fact_list.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::StudySession;

namespace {

constexpr int kIndividualRole = Qt::UserRole + 1;

bool isSame(const study::Winner& a, const study::Winner& b) {
    return a.generation == b.generation && a.individual == b.individual;
}

QString nameOf(int generation, int individual) {
    return TrackChoice::tr("Generation %1, individual %2").arg(generation).arg(individual);
}

QString shareText(int good, int trials) {
    return TrackChoice::tr("%1 % (%2)")
        .arg(models::percent(good, trials),
             models::boundsText(stats::calcClopperPearson(good, trials), trials));
}

}  // namespace

TrackChoice::TrackChoice(QWidget* parent)
    : QWidget(parent),
      list_(new QComboBox(this)),
      facts_(new FactList(this)),
      take_(new QPushButton(tr("Make it the final track"), this)),
      final_(new QLabel(this)) {
    list_->setObjectName("review.track");
    list_->setAccessibleName(tr("Track"));
    list_->setToolTip(tr("The track that is looked at: the winner of any generation"));
    list_->setMaxVisibleItems(20);
    connect(list_, &QComboBox::activated, this, [this](int index) {
        setWinner(list_->itemData(index).toInt(), list_->itemData(index, kIndividualRole).toInt());
    });
    take_->setObjectName("review.makeFinal");
    take_->setToolTip(tr("Go on with this track when it is exported"));
    connect(take_, &QPushButton::clicked, this, [this] {
        if (session_ && winner_) session_->choose(*winner_);
    });
    final_->setObjectName("review.final");
    final_->setWordWrap(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(list_);
    column->addWidget(facts_);
    column->addWidget(final_);
    column->addWidget(take_);
}

void TrackChoice::setSession(StudySession* session) {
    if (session_) session_->disconnect(this);
    session_ = session;
    winner_.reset();
    if (session_) {
        connect(session_, &StudySession::chosenChanged, this, &TrackChoice::showFinal);
        winner_ = session_->chosen();
    }
    listWinners();
    showFacts();
    emit winnerChanged();
}

void TrackChoice::setWinner(int generation, int individual) {
    if (!session_ || (winner_ && winner_->generation == generation && winner_->individual == individual))
        return;
    const auto winner = session_->loadWinner(generation, individual);
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
    if (session_ && !winner_) {
        winner_ = session_->chosen();
        if (winner_) emit winnerChanged();
    }
    listWinners();
    showFacts();
}

void TrackChoice::listWinners() {
    const QSignalBlocker blocker(list_);
    list_->clear();
    if (!session_) return;
    const auto add = [this](const study::Winner& winner) {
        list_->addItem(nameOf(winner.generation, winner.individual), winner.generation);
        list_->setItemData(list_->count() - 1, winner.individual, kIndividualRole);
        if (winner_ && isSame(winner, *winner_)) list_->setCurrentIndex(list_->count() - 1);
    };
    list_->setCurrentIndex(-1);
    const std::vector<study::Winner>& winners = session_->winners();
    std::for_each(winners.rbegin(), winners.rend(), add);
    if (winner_ && list_->currentText() != nameOf(winner_->generation, winner_->individual)) add(*winner_);
}

void TrackChoice::showFacts() {
    list_->setVisible(winner_.has_value());
    showFinal();
    if (!winner_) return facts_->show({});
    const study::IndividualRecord& record = winner_->record;
    Facts facts = {{tr("Fitness"), models::fixed(record.fitness.total(), 3)},
                   {tr("While learning"), tr("%1 of %2 finished").arg(record.finished).arg(record.trials)}};
    const study::SelectionEntry* compared = nullptr;
    for (const study::SelectionRecord& selection : session_->selections())
        for (const study::SelectionEntry& entry : selection.entries)
            if (entry.generation == winner_->generation && entry.individual == winner_->individual)
                compared = &entry;
    if (compared != nullptr)
        facts.emplace_back(tr("Comparison"), shareText(compared->oriented, compared->trials));
    const study::ValidationRecord* validated = nullptr;
    for (const study::ValidationRecord& validation : session_->validations())
        if (validation.generation == winner_->generation && validation.individual == winner_->individual)
            validated = &validation;
    if (validated != nullptr) {
        const study::ValidationRow total = study::calcTotal(*validated);
        facts.emplace_back(tr("Validation"), shareText(total.trials - total.failures, total.trials));
    }
    facts_->show(facts);
}

bool TrackChoice::isFinal() const {
    const auto chosen = session_ ? session_->chosen() : std::nullopt;
    return chosen && winner_ && isSame(*chosen, *winner_);
}

void TrackChoice::showFinal() {
    take_->setVisible(winner_.has_value() && !isFinal());
    if (!winner_) return final_->setText(tr("No track has been learned yet."));
    const auto chosen = session_ ? session_->chosen() : std::nullopt;
    if (!chosen) return final_->clear();
    final_->setText(isFinal() ? tr("<b>This is the final track.</b> It is the one that is exported.")
                              : tr("Final track: %1").arg(nameOf(chosen->generation, chosen->individual)));
}

}  // namespace trapwright::pages
