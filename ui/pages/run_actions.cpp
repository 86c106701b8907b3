#include "ui/pages/run_actions.h"

#include "ui/look/icon.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::RunState;

namespace {

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
      start_(makeAction(this, "run.start", "start", tr("&Start learning"), Qt::Key_F5,
                        tr("Continue from the last saved generation"))),
      pause_(makeAction(this, "run.pause", "pause", tr("&Pause"), Qt::Key_F6,
                        tr("Wait in the middle of the generation; nothing is lost"))),
      stopAfterGeneration_(makeAction(this, "run.stopAfterGeneration", "stop-after",
                                      tr("Stop after this &generation"), Qt::Key_F7,
                                      tr("Stop as soon as this generation is saved"))),
      stopNow_(makeAction(this, "run.stopNow", "stop", tr("Stop &now"), Qt::SHIFT | Qt::Key_F7,
                          tr("Stop at once; what is not complete is dropped"))) {
    connect(start_, &QAction::triggered, this, [this] {
        if (!session_) return;
        if (session_->state() == RunState::paused) {
            session_->resume();
        } else {
            session_->startLearning();
        }
    });
    connect(pause_, &QAction::triggered, this, [this] {
        if (session_) session_->pause();
    });
    connect(stopAfterGeneration_, &QAction::triggered, this, [this] {
        if (session_) session_->stopAfterGeneration();
    });
    connect(stopNow_, &QAction::triggered, this, [this] {
        if (session_) session_->stopNow();
    });
    update();
}

void RunActions::setSession(session::StudySession* session) {
    if (session_) session_->disconnect(this);
    session_ = session;
    if (session_) {
        connect(session_, &session::StudySession::stateChanged, this, &RunActions::update);
        connect(session_, &session::StudySession::settingsChanged, this, &RunActions::update);
        connect(session_, &session::StudySession::partChanged, this, &RunActions::update);
        connect(session_, &session::StudySession::generationSaved, this, &RunActions::update);
    }
    update();
}

void RunActions::update() {
    const RunState state = session_ ? session_->state() : RunState::idle;
    const bool paused = state == RunState::paused;
    const bool idle = state == RunState::idle || state == RunState::simulating;
    const auto generations = session_ ? session_->summaries().size() : 0;
    const bool complete =
        session_ && generations >= static_cast<std::size_t>(session_->settings().evolution.generations);

    QString obstacle;
    if (!session_) {
        obstacle = tr("Import a part or open a study first");
    } else if (!session_->problems().empty()) {
        obstacle = tr("Correct what is marked on the Track page first");
    } else if (idle && complete) {
        obstacle = tr("All generations are learned; raise their number to continue");
    }
    start_->setText(paused            ? tr("Re&sume learning")
                    : generations > 0 ? tr("Go on &learning")
                                      : tr("&Start learning"));
    start_->setToolTip(obstacle.isEmpty() ? tr("Continue from the last saved generation") : obstacle);
    start_->setEnabled(paused || (idle && obstacle.isEmpty()));
    pause_->setEnabled(state == RunState::learning);
    stopAfterGeneration_->setEnabled(state == RunState::learning || paused);
    stopNow_->setEnabled(!idle && state != RunState::stopping);
}

}  // namespace trapwright::pages
