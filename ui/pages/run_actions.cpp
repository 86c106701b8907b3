#include "ui/pages/run_actions.h"

#include <QTimer>

#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunState;

namespace {

constexpr int kEstimateDelay = 400;  // [ms] after the last change of a setting

QAction* makeAction(QObject* parent, const QString& name, const QString& icon, const QString& text,
                    const QKeySequence& key, const QString& tip) {
    auto* action = new QAction(look::icon(icon), text, parent);
    action->setObjectName(name);
    action->setShortcut(key);
    action->setToolTip(tip);
    return action;
}

}  // namespace

RunActions::RunActions(QObject* parent)
    : QObject(parent),
      estimateDelay_(new QTimer(this)),
      start_(makeAction(this, "run.start", "start", tr("&Start learning"), Qt::Key_F5,
                        tr("Continue from the last saved generation"))),
      draft_(makeAction(this, "run.draft", "draft", tr("&Draft in 10 minutes"), Qt::SHIFT | Qt::Key_F5, {})),
      corners_(makeAction(
          this, "run.corners", "corners", tr("Learn in &corners"), {},
          tr("From the next generation on, for 20 and more, three of five parts meet corners of the "
             "operating "
             "box, where every condition is at an end of its range: least friction with least stroke, say. "
             "Tracks that are good all over the box become as good there."))),
      cluster_(makeAction(this, "run.cluster", "cluster", tr("R&un on a cluster..."), {}, {})),
      pause_(makeAction(this, "run.pause", "pause", tr("&Pause"), Qt::Key_F6,
                        tr("Wait in the middle of the generation; nothing is lost"))),
      stopAfterGeneration_(makeAction(this, "run.stopAfterGeneration", "stop-after",
                                      tr("Stop after this &generation"), Qt::Key_F7,
                                      tr("Stop as soon as this generation is saved"))),
      stopNow_(makeAction(this, "run.stopNow", "stop", tr("Stop &now"), Qt::SHIFT | Qt::Key_F7,
                          tr("Stop at once; what is not complete is dropped"))) {
    connect(start_, &QAction::triggered, this, [this] {
        if (!runs_) return;
        if (runs_->state() == RunState::paused) {
            runs_->resume();
        } else {
            runs_->startLearning();
            emit started();
        }
    });
    connect(draft_, &QAction::triggered, this, &RunActions::startDraft);
    connect(corners_, &QAction::triggered, this, &RunActions::startCorners);
    estimateDelay_->setSingleShot(true);
    estimateDelay_->setInterval(kEstimateDelay);
    connect(estimateDelay_, &QTimer::timeout, this, [this] {
        if (runs_ && runs_->state() == RunState::idle) runs_->requestEstimate();
    });
    connect(pause_, &QAction::triggered, this, [this] {
        if (runs_) runs_->pause();
    });
    connect(stopAfterGeneration_, &QAction::triggered, this, [this] {
        if (runs_) runs_->stopAfterGeneration();
    });
    connect(stopNow_, &QAction::triggered, this, [this] {
        if (runs_) runs_->stopNow();
    });
    update();
}

void RunActions::setStudy(session::StudyDesign* design, session::StudyRuns* runs) {
    if (design_) design_->disconnect(this);
    if (runs_) runs_->disconnect(this);
    design_ = design;
    runs_ = runs;
    if (runs_) {
        connect(runs_, &session::StudyRuns::stateChanged, this, &RunActions::update);
        connect(design_, &session::StudyDesign::settingsChanged, this, &RunActions::update);
        connect(design_, &session::StudyDesign::partChanged, this, &RunActions::update);
        connect(runs_, &session::StudyRuns::generationSaved, this, &RunActions::update);
        connect(runs_, &session::StudyRuns::estimated, this, &RunActions::update);
    }
    update();
}

void RunActions::startDraft() {
    const auto draft = runs_ ? runs_->draft() : std::nullopt;
    if (!draft) return;
    study::Settings settings = design_->settings();
    settings.evolution = draft->evolution;
    design_->changeSettings(settings, tr("Draft in 10 minutes"));
    runs_->startLearning();
    emit started();
}

void RunActions::startCorners() {
    if (!runs_) return;
    const int next = static_cast<int>(runs_->summaries().size());
    design_->changeSettings(study::learnInCorners(design_->settings(), next), tr("Learn in corners"));
    runs_->startLearning();
    emit started();
}

void RunActions::update() {
    const RunState state = runs_ ? runs_->state() : RunState::idle;
    const bool paused = state == RunState::paused;
    const bool idle = state == RunState::idle || state == RunState::simulating;
    const auto generations = runs_ ? runs_->summaries().size() : 0;
    const bool complete =
        runs_ && generations >= static_cast<std::size_t>(design_->settings().evolution.generations);

    QString obstacle;
    if (!runs_) {
        obstacle = tr("Import a part or open a study first");
    } else if (!design_->problems().empty()) {
        obstacle = tr("Correct what is marked on the Track page first");
    } else if (idle && complete) {
        obstacle = tr("All generations are learned; raise their number to continue");
    }
    start_->setText(paused            ? tr("Re&sume learning")
                    : generations > 0 ? tr("Go on &learning")
                                      : tr("&Start learning"));
    start_->setToolTip(obstacle.isEmpty() ? tr("Continue from the last saved generation") : obstacle);
    start_->setEnabled(paused || (idle && obstacle.isEmpty()));
    cluster_->setEnabled(state == RunState::idle && obstacle.isEmpty());
    cluster_->setToolTip(
        obstacle.isEmpty() ? tr("Learn as a job of Slurm on many machines, and watch it here") : obstacle);
    const auto draft = runs_ ? runs_->draft() : std::nullopt;
    const bool timed = runs_ && runs_->estimatedSeconds() > 0.0;
    draft_->setEnabled(idle && obstacle.isEmpty() && draft.has_value());
    corners_->setEnabled(runs_ && idle && design_->problems().empty() && generations > 0 &&
                         study::canLearnInCorners(design_->settings(), static_cast<int>(generations)));
    if (!obstacle.isEmpty()) {
        draft_->setToolTip(obstacle);
    } else if (draft) {
        draft_->setToolTip(tr("About %1 on this machine: %2 generations of %3 × %4 trials")
                               .arg(look::roughDurationText(draft->seconds))
                               .arg(draft->evolution.generations)
                               .arg(draft->evolution.populationSize)
                               .arg(draft->evolution.trialsPerEvaluation));
    } else if (generations > 0) {
        draft_->setToolTip(tr("A draft is made in a study without generations"));
    } else {
        draft_->setToolTip(timed ? tr("Trials of this part take too long for a draft on this machine")
                                 : tr("Trials are being timed on this machine"));
    }
    if (state == RunState::idle && runs_ && !timed && obstacle.isEmpty()) estimateDelay_->start();
    pause_->setEnabled(state == RunState::learning);
    pause_->setToolTip(state == RunState::following
                           ? tr("A job of a cluster does not wait: stop it, and go on later")
                           : tr("Wait in the middle of the generation; nothing is lost"));
    stopAfterGeneration_->setEnabled(state == RunState::learning || state == RunState::following || paused);
    stopNow_->setEnabled(!idle && state != RunState::stopping);
}

}  // namespace trapwright::pages
