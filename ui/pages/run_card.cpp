#include "ui/pages/run_card.h"

#include <QAccessible>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <QtMath>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/study/selection.h"
#include "core/study/standstill.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/pages/run_actions.h"
#include "ui/pages/success_card.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunProgress;
using session::RunState;

RunCard::RunCard(RunActions& run, QWidget* parent)
    : QWidget(parent),
      success_(new SuccessCard("evolve", this)),
      title_(new QLabel(this)),
      detail_(new QLabel(this)),
      standstill_(new QLabel(this)),
      corners_(makeButton(run.corners(), "evolve.corners")),
      cluster_(makeButton(run.cluster(), "evolve.cluster")),
      remade_(new QLabel(this)),
      speed_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      draft_(new QWidget(this)),
      draftTime_(new QLabel(draft_)),
      run_(run),
      hasQueue_(workflow::canSubmit()) {
    setObjectName("evolve.card");
    title_->setObjectName("evolve.state");
    QFont font = title_->font();
    font.setPointSizeF(font.pointSizeF() * 1.3);
    font.setBold(true);
    title_->setFont(font);
    title_->setAccessibleName(tr("What the study is doing"));
    detail_->setObjectName("evolve.detail");
    detail_->setWordWrap(true);
    standstill_->setObjectName("evolve.standstill");
    standstill_->setWordWrap(true);
    standstill_->setToolTip(tr(
        "The mean of the top 30 %, over eight generations, has not risen by more than noise. Where success "
        "is high the track is as good as this search makes it: simulate the best winners again. Where it is "
        "not, look on the Review page at how parts end, or try another kind of trap on the Track page."));
    remade_->setObjectName("evolve.remade");
    remade_->setWordWrap(true);
    remade_->setForegroundRole(QPalette::PlaceholderText);
    remade_->setToolTip(tr(
        "The engine failed in these trials or lost the part, so the reference engine made them again; what "
        "that could not finish either counts as stuck. The log names them."));
    speed_->setObjectName("evolve.speed");
    speed_->setForegroundRole(QPalette::PlaceholderText);
    connect(detail_, &QLabel::linkActivated, this, &RunCard::settingsWanted);
    bar_->setObjectName("evolve.progress");
    bar_->setAccessibleName(tr("Progress of the whole run"));
    bar_->setTextVisible(false);
    bar_->setFixedHeight(8);

    draftTime_->setObjectName("evolve.draftTime");
    draftTime_->setWordWrap(true);
    draftTime_->setForegroundRole(QPalette::PlaceholderText);
    auto* draft = new QVBoxLayout(draft_);
    draft->setContentsMargins(0, 0, 0, 6);
    draft->setSpacing(2);
    draft->addWidget(makeButton(run.draft(), "evolve.draft"));
    draft->addWidget(draftTime_);
    connect(run.draft(), &QAction::changed, this, &RunCard::showDraft);
    connect(run.cluster(), &QAction::changed, this, &RunCard::showCluster);
    connect(run.corners(), &QAction::changed, this, &RunCard::showStandstill);

    auto* buttons = new QGridLayout;
    buttons->setSpacing(6);
    buttons->addWidget(makeButton(run.start(), "evolve.start"), 0, 0);
    buttons->addWidget(makeButton(run.pause(), "evolve.pause"), 0, 1);
    buttons->addWidget(makeButton(run.stopAfterGeneration(), "evolve.stopAfterGeneration"), 1, 0);
    buttons->addWidget(makeButton(run.stopNow(), "evolve.stopNow"), 1, 1);
    buttons->addWidget(cluster_, 2, 0, 1, 2);
    buttons->setColumnStretch(0, 3);
    buttons->setColumnStretch(1, 2);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addWidget(success_);
    layout->addWidget(title_);
    layout->addWidget(detail_);
    layout->addWidget(standstill_);
    layout->addWidget(corners_);
    layout->addWidget(remade_);
    layout->addWidget(bar_);
    layout->addWidget(speed_);
    layout->addSpacing(4);
    layout->addWidget(draft_);
    layout->addLayout(buttons);
    showDraft();
    update();
}

QToolButton* RunCard::makeButton(QAction* action, const QString& name) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setObjectName(name);
    look::drawAsButton(*button);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setMinimumHeight(32);
    return button;
}

void RunCard::setRuns(const session::StudyRuns* runs) {
    if (runs_) {
        runs_->disconnect(this);
        runs_->design().disconnect(this);
    }
    runs_ = runs;
    if (runs_) {
        using session::StudyDesign;
        using session::StudyRuns;
        connect(runs_, &StudyRuns::stateChanged, this, &RunCard::announce);
        connect(runs_, &StudyRuns::progressed, this, &RunCard::update);
        connect(runs_, &StudyRuns::estimated, this, &RunCard::update);
        connect(&runs_->design(), &StudyDesign::settingsChanged, this, &RunCard::update);
        connect(&runs_->design(), &StudyDesign::partChanged, this, &RunCard::update);
        connect(runs_, &StudyRuns::generationSaved, this, &RunCard::update);
    }
    update();
}

void RunCard::announce() {
    update();
    title_->setAccessibleDescription(detail_->text());
    QAccessibleEvent alert(title_, QAccessible::Alert);
    QAccessible::updateAccessibility(&alert);
}

void RunCard::update() {
    const RunState state = runs_ ? runs_->state() : RunState::idle;
    const bool idle = state == RunState::idle || state == RunState::simulating;
    showCluster();
    draft_->setVisible(idle && runs_ && runs_->summaries().empty() && runs_->design().problems().empty());
    bar_->setVisible(!idle);
    speed_->setVisible(!idle);
    showSuccess();
    showStandstill();
    showRemade();
    if (!runs_) return;
    if (idle) {
        showIdle();
    } else {
        showRun(state);
    }
}

void RunCard::showSuccess() {
    const study::Individual* best = runs_ ? runs_->bestWinner() : nullptr;
    success_->setVisible(best != nullptr);
    if (best == nullptr) return;
    const auto success = best->record.success();
    const QString generation = tr("best so far: generation %1").arg(best->generation);
    if (success && study::forgivesFalls(runs_->design().settings().evolution)) {
        const int finished = best->record.finished;
        const double arriving = 100.0 * finished / success->trials;
        success_->showCorrect(best->record.correct(), tr("%1 of %2 parts that arrive, %3 % of those fed, %4")
                                                          .arg(success->successes)
                                                          .arg(finished)
                                                          .arg(arriving, 0, 'f', 0)
                                                          .arg(generation));
        return;
    }
    if (!success) {
        success_->show(success, generation);
        return;
    }
    const double inCorners =
        study::cornerShareIn(runs_->design().settings().evolution, best->generation) * success->trials;
    QString parts = tr("%1 of %2 parts").arg(success->successes).arg(success->trials);
    if (inCorners >= 1.0) parts += tr(", %1 of them in corners of the box").arg(qFloor(inCorners));
    success_->show(success, tr("%1, %2").arg(parts, generation));
}

void RunCard::showStandstill() {
    const std::optional<int> since = runs_ ? study::findStandstill(runs_->summaries()) : std::nullopt;
    standstill_->setVisible(since.has_value());
    // What there is to do next, once this search has done what it can.
    const bool isDone = runs_ && (since || static_cast<int>(runs_->summaries().size()) >=
                                               runs_->design().settings().evolution.generations);
    corners_->setVisible(isDone && run_.corners()->isEnabled());
    if (since) standstill_->setText(tr("Nothing was gained since generation %1.").arg(*since));
}

void RunCard::showRemade() {
    const std::vector<trial::RemadeTrial> trials =
        runs_ ? runs_->remadeTrials() : std::vector<trial::RemadeTrial>();
    remade_->setVisible(!trials.empty());
    const auto stuck = std::ranges::count(trials, true, &trial::RemadeTrial::isStuck);
    QString text = tr("Trials made again with the reference engine: %L1").arg(trials.size());
    if (stuck > 0) text += tr(", %L1 of them count as stuck").arg(stuck);
    remade_->setText(text + '.');
}

QString RunCard::workText() const {
    const study::EvolutionSettings& evolution = runs_->design().settings().evolution;
    const int left = evolution.generations - static_cast<int>(runs_->summaries().size());
    const QString what =
        left == 1 ? tr("1 generation of %1 × %2 trials") : tr("%3 generations of %1 × %2 trials");
    const QString each = what.arg(evolution.populationSize).arg(evolution.trialsPerEvaluation);
    return left == 1 ? each : each.arg(left);
}

/// What the action tells when it is pointed at.
void RunCard::showDraft() {
    draftTime_->setText(run_.draft()->toolTip() + '.');
}

/// Where there is a queue; elsewhere it is in the menu, for few.
void RunCard::showCluster() {
    cluster_->setVisible(hasQueue_ && run_.cluster()->isEnabled());
}

void RunCard::showIdle() {
    const int known = static_cast<int>(runs_->summaries().size());
    const int wanted = runs_->design().settings().evolution.generations;
    if (!runs_->design().problems().empty()) {
        title_->setText(tr("Not ready to learn"));
        detail_->setText(tr("Correct what is marked on the <a href=\"track\">Track page</a> first."));
        return;
    }
    if (known >= wanted) {
        title_->setText(wanted == 1 ? tr("Its one generation is learned")
                                    : tr("All %1 generations learned").arg(wanted));
        detail_->setText(tr("Raise their number below to continue."));
        return;
    }
    title_->setText(known == 0 ? tr("Ready to learn")
                               : tr("%1 of %2 generations learned").arg(known).arg(wanted));
    const double seconds = runs_->estimatedSeconds();
    const QString work = workText();
    if (seconds <= 0.0) {
        detail_->setText(known == 0 ? tr("%1 in all. How long that takes here is being measured.").arg(work)
                                    : tr("%1 left.").arg(work));
    } else {
        detail_->setText(
            tr("About <b>%1</b> on this machine for %2.").arg(look::roughDurationText(seconds), work));
    }
}

void RunCard::showRun(RunState state) {
    const RunProgress progress = runs_->progress();
    const bool checking = progress.generations > 0 && progress.generation >= progress.generations;
    const double done = progress.trials > 0
                            ? static_cast<double>(progress.trialsDone) / static_cast<double>(progress.trials)
                            : 0.0;
    double whole = done;
    QString detail;
    if (state == RunState::following || progress.job) return showJob(progress);
    if (checking) {
        detail = tr("All generations are saved. The last winners are checked in the reference engine.");
    } else if (progress.isPlanning) {
        detail = tr("Traps are tried one by one: %L1 of about %L2 trials")
                     .arg(progress.trialsDone)
                     .arg(progress.trials);
        if (progress.wantedUnturned)
            detail +=
                ". " +
                tr("%1 % of the parts come to them as wanted.").arg(qRound(100.0 * *progress.wantedUnturned));
    } else if (progress.generations > 0) {
        whole = (progress.generation + done) / progress.generations;
        detail = tr("Generation %1 of %2, individual %3 of %4")
                     .arg(progress.generation + 1)
                     .arg(progress.generations)
                     .arg(progress.individualsDone)
                     .arg(progress.individuals);
    } else if (progress.trials > 0) {
        detail = tr("%L1 of %L2 trials").arg(progress.trialsDone).arg(progress.trials);
    }
    switch (state) {
        case RunState::paused:
            title_->setText(tr("Paused"));
            break;
        case RunState::stoppingAfterGeneration:
            title_->setText(tr("Stopping after this generation"));
            break;
        case RunState::stopping:
            title_->setText(tr("Stopping"));
            break;
        case RunState::selecting:
            title_->setText(tr("Simulating the best winners"));
            break;
        case RunState::validating:
            title_->setText(tr("Validating"));
            break;
        case RunState::measuring:
            title_->setText(tr("Measuring robustness"));
            break;
        case RunState::streaming:
            title_->setText(tr("Simulating streams of parts"));
            break;
        case RunState::mending:
            title_->setText(tr("Mending for the printer"));
            break;
        default:
            title_->setText(checking              ? tr("Checking winners")
                            : progress.isPlanning ? tr("Planning")
                                                  : tr("Learning"));
            break;
    }
    detail_->setText(detail);
    QStringList facts;
    if (progress.trialsPerSecond > 0) facts << tr("%L1 trials/s").arg(qRound(progress.trialsPerSecond));
    if (progress.secondsLeft > 0) facts << tr("%1 left").arg(look::durationText(progress.secondsLeft));
    // As high without text, so that nothing below moves.
    speed_->setText(facts.isEmpty() ? QString(" ") : facts.join(", "));
    constexpr int kSteps = 1000;
    bar_->setMaximum(kSteps);
    bar_->setValue(qRound(std::clamp(whole, 0.0, 1.0) * kSteps));
}

void RunCard::showJob(const RunProgress& progress) {
    using workflow::JobState;
    bar_->setMaximum(progress.generations);
    bar_->setValue(std::min(progress.generation, progress.generations));
    if (!progress.job) {
        title_->setText(tr("Writing the job"));
        detail_->setText(tr("A copy of the study, and what the cluster's queue says to it."));
        speed_->setText(" ");
        return;
    }
    const bool isQueued = !progress.job->id.empty();
    const QString job = tr("Job %1").arg(QString::fromStdString(progress.job->id));
    QString title = tr("Learning on a cluster");
    QString detail =
        tr("%1: %2 of %3 generations").arg(job).arg(progress.generation).arg(progress.generations);
    if (!isQueued) {
        title = tr("Taking what was learned");
        detail = tr("%1 of %2 generations").arg(progress.generation).arg(progress.generations);
    } else if (runs_->state() == RunState::stoppingAfterGeneration) {
        title = tr("Stopping after this generation");
    } else if (runs_->state() == RunState::stopping) {
        title = tr("Stopping");
    } else if (progress.job->status.state == JobState::waiting) {
        title = tr("Waiting in the cluster's queue");
        if (!progress.job->status.reason.empty())
            detail += tr(" (the queue says: %1)").arg(QString::fromStdString(progress.job->status.reason));
    } else if (progress.job->status.state == JobState::unknown) {
        title = tr("The cluster does not answer");
        detail += ". " + tr("It is asked again every few seconds; the job may go on meanwhile.");
    }
    if (isQueued) detail += ".\n" + tr("You may close the window: the job goes on, and is followed again.");
    title_->setText(title);
    detail_->setText(detail);
    QStringList facts;
    if (progress.trialsPerSecond > 0) facts << tr("%L1 trials/s").arg(qRound(progress.trialsPerSecond));
    if (progress.secondsLeft > 0) facts << tr("%1 left").arg(look::durationText(progress.secondsLeft));
    speed_->setText(facts.isEmpty() ? QString(" ") : facts.join(", "));
}

}  // namespace trapwright::pages
