#include "ui/feeder/guide_actions.h"

#include "ui/feeder/drive_link.h"
#include "ui/feeder/trial_guide.h"
#include "ui/look/icon.h"
#include "ui/models/verdict_look.h"

namespace trapwright::feeder {

GuideActions::GuideActions(TrialGuide& guide, DriveLink& link, QObject* parent)
    : QObject(parent),
      guide_(guide),
      link_(link),
      start_(make("feeder.trial.start", "start", tr("Start the trial"), Qt::Key_Space,
                  tr("The part lies as shown: let the drive run and take the time"))) {
    addOutcome(trial::Verdict::success, "success", tr("Success"), Qt::Key_S,
               tr("The part is at the end in the right orientation"));
    addOutcome(trial::Verdict::wrongOrientation, "wrong", tr("Wrong orientation"), Qt::Key_1,
               tr("The part is at the end in another orientation"));
    addOutcome(trial::Verdict::stuck, "stuck", tr("Stuck"), Qt::Key_2, tr("The part does not move on"));
    addOutcome(trial::Verdict::fellOff, "fell", tr("Fell off"), Qt::Key_3, tr("The part fell off the track"));
    undo_ = make("feeder.trial.undo", "undo", tr("Take the last trial back"), Qt::Key_U,
                 tr("Takes the last outcome back, or the start of the trial that runs"));
    note_ = make("feeder.trial.note", "note", tr("Note"), Qt::Key_N,
                 tr("A remark on the trial that runs, or else on the last one"));
    pause_ = make("feeder.trial.pause", "pause", tr("Pause"), Qt::Key_P,
                  tr("Stops the drive; continue when you like, even days later"));
    stop_ = make("feeder.stop", "stop", tr("Stop the drive"), Qt::Key_Escape,
                 tr("Set-point zero and enable off, at once, on every page. By software: no emergency stop"));
    start_->setIconText(tr("Start"));
    outcomes_[1]->setIconText(tr("Wrong"));
    undo_->setIconText(tr("Undo"));
    stop_->setIconText(tr("Stop"));
    connect(start_, &QAction::triggered, &guide_, &TrialGuide::start);
    connect(undo_, &QAction::triggered, &guide_, &TrialGuide::undo);
    connect(pause_, &QAction::triggered, &guide_, &TrialGuide::pause);
    connect(stop_, &QAction::triggered, &link_, &DriveLink::stop);
    connect(&guide_, &TrialGuide::changed, this, &GuideActions::update);
    connect(&link_, &DriveLink::linkChanged, this, &GuideActions::update);
    update();
}

QList<QAction*> GuideActions::all() const {
    QList<QAction*> all = {start_};
    for (QAction* outcome : outcomes_)
        all << outcome;
    return all << undo_ << note_ << pause_ << stop_;
}

QAction* GuideActions::make(const QString& name, const QString& icon, const QString& text,
                            const QKeySequence& key, const QString& tip) {
    auto* action = new QAction(icon.isEmpty() ? QIcon() : look::icon(icon), text, this);
    action->setObjectName(name);
    action->setShortcut(key);
    action->setAutoRepeat(false);
    action->setToolTip(QString("%1 (%2)").arg(tip, key.toString(QKeySequence::NativeText)));
    return action;
}

void GuideActions::addOutcome(trial::Verdict outcome, const QString& name, const QString& text, Qt::Key key,
                              const QString& tip) {
    QAction* action = make("feeder.trial." + name, {}, text, key, tip);
    action->setIcon(models::verdictIcon(outcome));
    connect(action, &QAction::triggered, &guide_, [this, outcome] { guide_.finish(outcome); });
    outcomes_.push_back(action);
}

void GuideActions::update() {
    const Stage stage = guide_.stage();
    const bool running = stage == Stage::running;
    // Also while a trial runs, and does nothing then: Space must not press what has the focus.
    start_->setEnabled(stage == Stage::placing || stage == Stage::paused || running);
    start_->setText(stage == Stage::paused && guide_.made() > 0 ? tr("Go on") : tr("Start the trial"));
    for (QAction* outcome : outcomes_)
        outcome->setEnabled(running);
    undo_->setEnabled(running || guide_.made() > 0);
    undo_->setText(running ? tr("Take the start back") : tr("Take the last trial back"));
    note_->setEnabled(running || guide_.made() > 0);
    pause_->setEnabled(running || stage == Stage::placing);
    stop_->setEnabled(link_.linked());
}

}  // namespace trapwright::feeder
