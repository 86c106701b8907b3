#include "ui/window/status_line.h"

#include <QEvent>
#include <QLabel>
#include <QProgressBar>
#include <algorithm>

#include "core/stats/binomial.h"
#include "core/study/selection.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::window {

using session::RunProgress;
using session::RunState;

namespace {

constexpr int kSign = 14;
constexpr double kNear = 0.05;  // difference of two shares that is called none

struct StateFace {
    QString text;
    const char* icon;
    bool active;
};

StateFace faceOf(RunState state, bool problems) {
    switch (state) {
        case RunState::idle:
            return problems ? StateFace{StatusLine::tr("Not ready to learn"), "warning", false}
                            : StateFace{StatusLine::tr("Ready"), "good", false};
        case RunState::learning:
            return {StatusLine::tr("Learning"), "start", true};
        case RunState::following:
            return {StatusLine::tr("Learning on a cluster"), "cluster", true};
        case RunState::paused:
            return {StatusLine::tr("Paused"), "pause", true};
        case RunState::stoppingAfterGeneration:
            return {StatusLine::tr("Stopping after this generation"), "stop-after", true};
        case RunState::stopping:
            return {StatusLine::tr("Stopping"), "stop", true};
        case RunState::selecting:
            return {StatusLine::tr("Simulating the best winners"), "start", true};
        case RunState::validating:
            return {StatusLine::tr("Validating"), "start", true};
        case RunState::measuring:
            return {StatusLine::tr("Measuring robustness"), "start", true};
        case RunState::streaming:
            return {StatusLine::tr("Simulating streams of parts"), "start", true};
        case RunState::mending:
            return {StatusLine::tr("Mending for the printer"), "start", true};
        case RunState::simulating:
            return {StatusLine::tr("Simulating"), "start", false};
    }
    return {};
}

/// The engine's title; one that is not there any more is called by its name.
QString engineTitle(const trial::EngineRegistry& engines, const std::string& name) {
    const trial::EngineKind* kind = engines.find(name);
    return QString::fromStdString(kind != nullptr ? kind->title : name);
}

}  // namespace

StatusLine::StatusLine(QWidget* parent)
    : QStatusBar(parent), sign_(new QLabel(this)), bar_(new QProgressBar(this)) {
    setObjectName("statusLine");
    setSizeGripEnabled(false);
    setStyleSheet(
        "QStatusBar { border-top: 1px solid palette(mid); } QStatusBar::item { border: none; }"
        "#statusSign { padding-left: 8px; } #status\\.engines { padding-right: 8px; }");
    sign_->setObjectName("statusSign");
    addWidget(sign_);
    state_ = addField("state", tr("What the study is doing"));
    bar_->setObjectName("status.progress");
    bar_->setAccessibleName(tr("Progress"));
    bar_->setTextVisible(false);
    bar_->setFixedSize(120, 8);
    addWidget(bar_);
    generation_ = addField("generation", tr("Generations learned"));
    success_ = addField("success", tr("Success of the best track so far"));
    individual_ = addField("individual", tr("Individual of the generation"));
    speed_ = addField("speed", tr("Trials per second"));
    left_ = addField("left", tr("Time left"));
    engines_ = new QLabel(this);
    engines_->setObjectName("status.engines");
    engines_->setAccessibleName(tr("Engines"));
    addPermanentWidget(engines_);
    update();
}

QLabel* StatusLine::addField(const QString& name, const QString& meaning) {
    auto* label = new QLabel(this);
    label->setObjectName("status." + name);
    label->setAccessibleName(meaning);
    label->setToolTip(meaning);
    label->setContentsMargins(0, 2, 12, 2);
    addWidget(label);
    return label;
}

void StatusLine::setRuns(const session::StudyRuns* runs) {
    if (runs_) {
        runs_->disconnect(this);
        runs_->design().disconnect(this);
    }
    runs_ = runs;
    if (runs_) {
        using session::StudyDesign;
        using session::StudyRuns;
        connect(runs_, &StudyRuns::stateChanged, this, &StatusLine::update);
        connect(runs_, &StudyRuns::progressed, this, &StatusLine::update);
        connect(&runs_->design(), &StudyDesign::settingsChanged, this, &StatusLine::update);
        connect(&runs_->design(), &StudyDesign::partChanged, this, &StatusLine::update);
        connect(runs_, &StudyRuns::generationSaved, this, &StatusLine::update);
        connect(runs_, &StudyRuns::generationSaved, this, &StatusLine::updateEngines);
        connect(runs_, &StudyRuns::generationSaved, this, &StatusLine::updateSuccess);
        connect(runs_, &StudyRuns::selectionSaved, this, &StatusLine::updateSuccess);
        connect(runs_, &StudyRuns::validationSaved, this, &StatusLine::updateSuccess);
        connect(runs_, &StudyRuns::chosenChanged, this, &StatusLine::updateSuccess);
        connect(&runs_->design(), &StudyDesign::settingsChanged, this, &StatusLine::updateEngines);
        connect(runs_, &StudyRuns::checkSaved, this, &StatusLine::updateEngines);
    }
    update();
    updateSuccess();
    updateEngines();
}

void StatusLine::changeEvent(QEvent* event) {
    QStatusBar::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) update();
}

void StatusLine::update() {
    const RunState runState = runs_ ? runs_->state() : RunState::idle;
    const bool problems = runs_ && !runs_->design().problems().empty();
    StateFace face = faceOf(runState, problems);
    const auto job = runs_ ? runs_->progress().job : std::nullopt;
    if (job && !job->id.empty() && job->status.state == workflow::JobState::waiting)
        face.text = tr("Waiting for a cluster");
    for (QWidget* widget : std::initializer_list<QWidget*>{sign_, state_})
        widget->setVisible(runs_ != nullptr);
    for (QWidget* widget : std::initializer_list<QWidget*>{bar_, individual_, speed_, left_})
        widget->setVisible(face.active);
    generation_->setVisible(runs_ && !runs_->summaries().empty());
    if (!runs_) return;

    const QColor colour = problems      ? look::toneColour(look::Tone::warning, QPalette())
                          : face.active ? QPalette().color(QPalette::Highlight)
                                        : look::toneColour(look::Tone::good, QPalette());
    sign_->setPixmap(look::signPixmap(face.icon, colour, kSign, devicePixelRatioF()));
    state_->setText(face.text);

    const int known = static_cast<int>(runs_->summaries().size());
    const int generations = std::max(known, runs_->design().settings().evolution.generations);
    generation_->setText(tr("%1 of %2 generations").arg(known).arg(generations));
    if (!face.active) return;

    const RunProgress progress = runs_->progress();
    if (progress.generations > 0) {
        generation_->setVisible(true);
        generation_->setText(tr("%1 of %2 generations").arg(progress.generation).arg(progress.generations));
    }
    individual_->setText(tr("individual %1 of %2").arg(progress.individualsDone).arg(progress.individuals));
    individual_->setVisible(progress.individuals > 0 && !progress.isPlanning);
    speed_->setText(tr("%L1 trials/s").arg(qRound(progress.trialsPerSecond)));
    speed_->setVisible(progress.trialsPerSecond > 0);
    left_->setText(tr("%1 left").arg(look::durationText(progress.secondsLeft)));
    left_->setVisible(progress.secondsLeft > 0);
    const double done = progress.trials > 0 ? double(progress.trialsDone) / double(progress.trials) : 0.0;
    const double whole = progress.generations > 0 && !progress.isPlanning
                             ? (progress.generation + done) / progress.generations
                             : done;
    constexpr int kSteps = 1000;
    bar_->setMaximum(kSteps);
    bar_->setValue(qRound(std::clamp(whole, 0.0, 1.0) * kSteps));
}

/// Of the final track: until one is chosen that is the best winner.
void StatusLine::updateSuccess() {
    const study::Individual* best = runs_ ? runs_->bestWinner() : nullptr;
    const auto chosen = runs_ ? runs_->chosen() : std::nullopt;
    const study::Individual* shown = chosen ? &*chosen : best;
    const auto success = shown != nullptr ? runs_->findSuccess(*shown) : std::nullopt;
    success_->setVisible(success.has_value());
    if (!success) return;
    const bool other =
        best != nullptr && (shown->generation != best->generation || shown->individual != best->individual);
    if (success->ofArriving) {
        success_->setText((other ? tr("final track: correct %1") : tr("correct %1"))
                              .arg(models::successWord(std::optional(success->rate))));
        success_->setToolTip(
            tr("Generation %1: %L2 of the %L3 parts that arrive are right, of %L4 that were fed.")
                .arg(shown->generation)
                .arg(success->count.successes)
                .arg(success->finished)
                .arg(success->count.trials));
        return;
    }
    success_->setText((other ? tr("final track: success %1") : tr("success %1"))
                          .arg(models::successWord(std::optional(success->rate))));
    success_->setToolTip(
        (success->source == study::TrackSuccess::Source::validation
             ? tr("Generation %1: success of its validation, weighted by how often parts land "
                  "in each pose. %L2 of all %L3 parts finished in the expected orientation.")
             : tr("Generation %1: %L2 of %L3 parts finished in the expected orientation."))
            .arg(shown->generation)
            .arg(success->count.successes)
            .arg(success->count.trials));
}

void StatusLine::updateEngines() {
    engines_->clear();
    engines_->setToolTip({});
    if (!runs_) return;
    if (runs_->checks().empty()) {
        // Only this engine has its winners checked.
        const auto* reference =
            runs_->design().engines().referenceFor(runs_->design().settings().simulation.engine);
        if (reference == nullptr || runs_->summaries().empty()) return;
        const QString title = QString::fromStdString(reference->title);
        engines_->setText(tr("%1: not checked yet").arg(title));
        engines_->setToolTip(
            tr("Each generation's winner is simulated again by %1, the reference, in the background")
                .arg(title));
        return;
    }
    const study::CheckRecord& check = runs_->checks().back();
    if (check.trials <= 0) return;
    const int learned = check.learning.oriented;
    const int checked = check.reference.oriented;
    const stats::Interval bounds = stats::calcClopperPearson(checked, check.trials);
    const double share = static_cast<double>(learned) / check.trials;
    const bool alike = share >= bounds.low && share <= bounds.high;
    const bool near = std::abs(learned - checked) <= kNear * check.trials;
    const QString text = !alike ? tr("%1 differs: %2 % and %3 %")
                         : near ? tr("%1 agrees: %2 % and %3 %")
                                : tr("%1: %2 % and %3 %, too few trials to tell");
    engines_->setText(text.arg(engineTitle(runs_->design().engines(), check.reference.engine),
                               models::percent(learned, check.trials),
                               models::percent(checked, check.trials)));
    engines_->setToolTip(
        tr("Success on the same %1 trials of generation %2's winner: %3 in the "
           "engine that learns (%4), %5 in %6. They differ if the first share is outside the 95 % "
           "interval (Clopper-Pearson) of the second; they agree if it is inside and within 5 points.")
            .arg(check.trials)
            .arg(check.generation)
            .arg(learned)
            .arg(engineTitle(runs_->design().engines(), check.learning.engine))
            .arg(checked)
            .arg(engineTitle(runs_->design().engines(), check.reference.engine)));
}

}  // namespace trapwright::window
