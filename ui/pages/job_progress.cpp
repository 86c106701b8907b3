#include "ui/pages/job_progress.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/text.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunState;
using session::StudyRuns;

namespace {

QString nameOf(RunState state) {
    switch (state) {
        case RunState::selecting:
            return JobProgress::tr("Comparing");
        case RunState::validating:
            return JobProgress::tr("Validating");
        case RunState::mending:
            return JobProgress::tr("Mending");
        default:
            return JobProgress::tr("Measuring");
    }
}

}  // namespace

JobProgress::JobProgress(const QString& name, QWidget* parent)
    : QWidget(parent), text_(new QLabel(this)), bar_(new QProgressBar(this)) {
    text_->setObjectName(name + ".progress");
    text_->setWordWrap(true);
    bar_->setTextVisible(false);
    bar_->setFixedHeight(6);
    auto* stop = new QPushButton(tr("Stop"), this);
    stop->setObjectName(name + ".stop");
    connect(stop, &QPushButton::clicked, this, [this] {
        if (runs_) runs_->stopNow();
    });
    auto* row = new QHBoxLayout;
    row->addWidget(text_, 1);
    row->addWidget(stop);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 4);
    column->setSpacing(4);
    column->addLayout(row);
    column->addWidget(bar_);
    hide();
}

void JobProgress::setRuns(StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    if (runs_) {
        connect(runs_, &StudyRuns::stateChanged, this, &JobProgress::update);
        connect(runs_, &StudyRuns::progressed, this, &JobProgress::update);
    }
    update();
}

void JobProgress::update() {
    const RunState state = runs_ ? runs_->state() : RunState::idle;
    setVisible(session::isJudging(state));
    if (!session::isJudging(state)) return;
    const session::RunProgress progress = runs_->progress();
    const QLocale locale;
    QString text = nameOf(state);
    // While a track is being mended nothing is simulated yet.
    if (progress.trials > 0 && (progress.trialsDone > 0 || state != RunState::mending)) {
        text = (state == RunState::streaming ? tr("%1: %2 of %3 streams") : tr("%1: %2 of %3 trials"))
                   .arg(text, locale.toString(static_cast<qlonglong>(progress.trialsDone)),
                        locale.toString(static_cast<qlonglong>(progress.trials)));
    }
    if (progress.secondsLeft > 0.0) text += tr(", %1 left").arg(look::durationText(progress.secondsLeft));
    text_->setText(text);
    bar_->setRange(0, static_cast<int>(progress.trials));
    bar_->setValue(static_cast<int>(progress.trialsDone));
}

}  // namespace trapwright::pages
