#include "ui/pages/mend_card.h"

#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/workflow/judging.h"
#include "ui/look/text.h"
#include "ui/models/numbers.h"
#include "ui/pages/job_progress.h"
#include "ui/session/print_build.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunState;
using session::StudyRuns;

namespace {

constexpr double kSquareMillimetre = 1e-6;  // [m^2]

/// "generation 90, individual 3"
QString nameOf(const study::IndividualId& id) {
    return MendCard::tr("generation %1, individual %2").arg(id.generation).arg(id.individual);
}

/// "99.6 %, in corners 98.1 %"
QString successOf(const study::SelectionEntry& entry) {
    QString all = models::successWord(stats::Count{entry.oriented, entry.trials});
    if (entry.corners.trials == 0) return all;
    return MendCard::tr("%1, in corners %2").arg(all, models::successWord(entry.corners));
}

}  // namespace

MendCard::MendCard(QWidget* parent)
    : QWidget(parent),
      mend_(new QPushButton(tr("&Mend for printing"), this)),
      cost_(new QLabel(this)),
      progress_(new JobProgress("print.mend", this)),
      told_(new QLabel(this)) {
    mend_->setObjectName("print.mend");
    connect(mend_, &QPushButton::clicked, this, &MendCard::start);
    cost_->setObjectName("print.mend.cost");
    cost_->setForegroundRole(QPalette::PlaceholderText);
    told_->setObjectName("print.mend.result");
    told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    for (QLabel* label : {cost_, told_})
        label->setWordWrap(true);

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(mend_);
    column->addWidget(cost_);
    column->addWidget(progress_);
    column->addWidget(told_);
    update();
}

void MendCard::setRuns(StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    progress_->setRuns(runs);
    result_.clear();
    if (runs_) {
        connect(runs_, &StudyRuns::stateChanged, this, &MendCard::update);
        connect(runs_, &StudyRuns::mended, this, &MendCard::tell);
    }
    clear();
}

void MendCard::show(const study::Individual& track, const session::PrintedTrack& printed,
                    const geometry::PrintLimits& limits) {
    track_ = track;
    limits_ = limits;
    // What is printed around the track can have mended it: walls, wider rims.
    unprintable_ = printed.report.isPrintable() ? 0.0 : printed.learnedFlaws.total();
    update();
}

void MendCard::clear() {
    track_.reset();
    unprintable_ = 0.0;
    update();
}

void MendCard::start() {
    if (!runs_ || !track_) return;
    study::MendingPlan plan;
    plan.limits = limits_;
    result_.clear();
    runs_->startMending(*track_, plan);
}

void MendCard::update() {
    const RunState state = runs_ ? runs_->state() : RunState::idle;
    const bool mending = state == RunState::mending;
    const bool needed = runs_ && track_ && unprintable_ > 0.0 && !mending;
    mend_->setVisible(needed);
    cost_->setVisible(needed);
    told_->setVisible(!mending && !result_.isEmpty());
    told_->setText(result_);
    setVisible(needed || mending || !result_.isEmpty());
    if (!needed) return;
    const bool free = state == RunState::idle || state == RunState::simulating;
    const study::MendingPlan plan;
    mend_->setEnabled(free);
    mend_->setToolTip(free ? tr("Moves the track's points a little, many times anew, until nothing of it is "
                                "too thin, sharp or "
                                "overhanging, and compares the best with it")
                           : tr("Wait until the study has ended what it does, or stop it"));
    const std::int64_t trials = workflow::countMendingTrials(runs_->design().settings(), plan);
    QString cost =
        tr("%1 mm² of the learned track cannot be printed. %2 variants of it, the best %3 compared with "
           "it: %4 trials")
            .arg(look::numberText(unprintable_ / kSquareMillimetre))
            .arg(plan.variants)
            .arg(plan.compared)
            .arg(QLocale().toString(qlonglong(trials)));
    if (const double seconds = runs_->secondsFor(trials); seconds > 0.0)
        cost += tr(", about %1").arg(look::roughDurationText(seconds));
    cost_->setText(cost);
}

void MendCard::tell(const workflow::MendingReport& report) {
    const auto find = [&](const auto& isMeant) {
        return std::ranges::find_if(report.selection.entries, isMeant);
    };
    const auto best =
        find([&](const study::SelectionEntry& entry) { return isSameIndividual(entry, report.best); });
    const auto before = find([&](const study::SelectionEntry& entry) {
        return isSameIndividual(entry, *report.generation.mendedFrom);
    });
    result_ = tr("Mended; %1 variants can be printed, and the best is shown: %2, success %3. Before, %4: %5.")
                  .arg(report.generation.individuals.size())
                  .arg(nameOf(report.best), successOf(*best), nameOf(*before), successOf(*before));
    update();
}

}  // namespace trapwright::pages
