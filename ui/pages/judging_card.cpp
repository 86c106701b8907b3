#include "ui/pages/judging_card.h"

#include <QAction>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/part/stable_poses.h"
#include "core/study/robustness.h"
#include "core/study/selection.h"
#include "core/study/stream.h"
#include "ui/look/text.h"
#include "ui/pages/job_progress.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunState;
using session::StudyDesign;
using session::StudyRuns;

namespace {

QLabel* makeSentence(QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

}  // namespace

JudgingCard::JudgingCard(QWidget* parent)
    : QWidget(parent),
      compare_(new QAction(tr("&Compare the best winners"), this)),
      validate_(new QAction(tr("&Validate this track"), this)),
      robustness_(new QAction(tr("Measure its &robustness"), this)),
      allRobustness_(new QAction(tr("Measure &all compared"), this)),
      stream_(new QAction(tr("Send a &stream of parts"), this)),
      oneStream_(new QAction(this)),
      compareText_(makeSentence(this)),
      validateText_(makeSentence(this)),
      robustnessText_(makeSentence(this)),
      allRobustnessText_(makeSentence(this)),
      streamText_(makeSentence(this)),
      progress_(new JobProgress("review", this)) {
    compare_->setObjectName("review.compare");
    compare_->setShortcut(Qt::Key_F8);
    connect(compare_, &QAction::triggered, this, [this] { runs_->startSelection(); });
    validate_->setObjectName("review.validate");
    validate_->setShortcut(Qt::Key_F9);
    connect(validate_, &QAction::triggered, this, [this] { runs_->startValidation(*winner_); });

    robustness_->setObjectName("review.robustness");
    robustnessText_->setObjectName("review.robustness.cost");
    allRobustnessText_->setObjectName("review.robustness.all.cost");
    robustness_->setShortcut(Qt::CTRL | Qt::Key_F9);
    connect(robustness_, &QAction::triggered, this, [this] { runs_->startRobustness({*winner_}); });
    allRobustness_->setObjectName("review.robustness.all");
    connect(allRobustness_, &QAction::triggered, this, &JudgingCard::measureAll);

    stream_->setObjectName("review.stream");
    streamText_->setObjectName("review.stream.cost");
    stream_->setShortcut(Qt::SHIFT | Qt::Key_F9);
    connect(stream_, &QAction::triggered, this, [this] {
        const auto inflows = study::defaultInflows();
        runs_->startStreams(*winner_, {inflows.begin(), inflows.end()});
    });
    oneStream_->setObjectName("review.stream.one");
    connect(oneStream_, &QAction::triggered, this,
            [this] { runs_->startStreams(*winner_, {runs_->design().settings().stream.partsPerMinute}); });

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(progress_);
    column->addWidget(makeButton(compare_));
    column->addWidget(compareText_);
    column->addSpacing(6);
    column->addWidget(makeButton(validate_));
    column->addWidget(validateText_);
    column->addSpacing(6);
    column->addWidget(makeButton(robustness_));
    column->addWidget(robustnessText_);
    column->addSpacing(6);
    column->addWidget(makeButton(allRobustness_));
    column->addWidget(allRobustnessText_);
    column->addSpacing(6);
    column->addWidget(makeButton(stream_));
    column->addWidget(streamText_);
    column->addWidget(makeButton(oneStream_));
    update();
}

QPushButton* JudgingCard::makeButton(QAction* action) {
    auto* button = new QPushButton(action->text(), this);
    button->setObjectName(action->objectName() + ".button");
    connect(button, &QPushButton::clicked, action, &QAction::trigger);
    const auto follow = [button, action] {
        button->setText(action->text());
        button->setEnabled(action->isEnabled());
        button->setToolTip(action->toolTip());
    };
    connect(action, &QAction::changed, button, follow);
    follow();
    return button;
}

void JudgingCard::setRuns(StudyRuns* runs) {
    if (runs_) {
        runs_->disconnect(this);
        runs_->design().disconnect(this);
    }
    runs_ = runs;
    progress_->setRuns(runs);
    if (runs_) {
        connect(runs_, &StudyRuns::stateChanged, this, &JudgingCard::update);
        connect(&runs_->design(), &StudyDesign::settingsChanged, this, &JudgingCard::update);
        connect(runs_, &StudyRuns::generationSaved, this, &JudgingCard::update);
        connect(runs_, &StudyRuns::robustnessMeasured, this, &JudgingCard::update);
    }
    update();
}

void JudgingCard::setWinner(const std::optional<study::Individual>& winner) {
    winner_ = winner;
    update();
}

void JudgingCard::update() {
    const RunState state = runs_ ? runs_->state() : RunState::idle;
    const bool judging = session::isJudging(state);
    QString obstacle;
    if (!runs_ || runs_->winners().empty()) {
        obstacle = tr("Learn a track first");
    } else if (state != RunState::idle && state != RunState::simulating) {
        obstacle = judging ? tr("Wait for the end of what is being simulated, or stop it")
                           : tr("Wait until the study has learned, or stop it");
    }
    compare_->setEnabled(obstacle.isEmpty());
    validate_->setEnabled(obstacle.isEmpty() && winner_.has_value());
    compare_->setToolTip(obstacle.isEmpty() ? tr("Simulate the highest winners many times each and rank them")
                                            : obstacle);
    validate_->setToolTip(obstacle.isEmpty() ? tr("Simulate parts that start in each stable pose")
                                             : obstacle);
    showRobustness(obstacle);
    showStream(obstacle);
    if (!runs_) return;
    const study::ValidationSettings& settings = runs_->design().settings().validation;
    const QLocale locale;
    const auto winners =
        std::min<std::size_t>(static_cast<std::size_t>(settings.selectionWinners), runs_->winners().size());
    const int inCorners = study::countCornerTrials(runs_->design().settings());
    const QString trialsOfEach = locale.toString(settings.selectionTrials);
    const QString tracks = winners == 1 ? tr("1 track, %1 trials").arg(trialsOfEach)
                                        : tr("%1 tracks, %2 trials each").arg(winners).arg(trialsOfEach);
    compareText_->setText(inCorners > 0 ? tr("%1 and %2 in corners").arg(tracks, locale.toString(inCorners))
                                        : tracks);
    const std::size_t poses = runs_->design().part()->stablePoses.size();
    const std::size_t groups = part::findPoseGroups(*runs_->design().part()).size();
    const QString trials = locale.toString(settings.trialsPerPose);
    validateText_->setText(
        groups == poses
            ? tr("%1 stable poses, %2 trials each").arg(poses).arg(trials)
            : tr("%1 stable poses, %2 that differ, %3 trials each").arg(poses).arg(groups).arg(trials));
}

void JudgingCard::showRobustness(const QString& obstacle) {
    QString reason = obstacle;
    QString text;
    // By the engine that learns.
    const auto costOf = [this](std::int64_t trials) {
        QString cost = tr("%1 trials").arg(QLocale().toString(qlonglong(trials)));
        if (const double seconds = runs_->secondsFor(trials); seconds > 0.0)
            cost += tr(", about %1").arg(look::roughDurationText(seconds));
        return cost;
    };
    std::int64_t each = 0;
    std::int64_t unmeasured = 0;
    if (runs_) {
        each = study::countRobustnessTrials(runs_->design().settings(), study::RobustnessPlan());
        unmeasured = static_cast<std::int64_t>(runs_->listUnmeasured().size());
        text = tr("All over the operating box: %1").arg(costOf(each));
        if (each == 0) {
            text = tr("The operating box has no room: set on the Track page what is not known exactly.");
            if (reason.isEmpty()) reason = text;
        }
    }
    robustness_->setEnabled(reason.isEmpty() && winner_.has_value());
    robustness_->setToolTip(reason.isEmpty()
                                ? tr("Simulate this track with other friction, restitution, stroke and size")
                                : reason);
    robustnessText_->setText(text);
    QString left;
    if (each > 0 && unmeasured > 0)
        left = tr("%1: %2").arg(unmeasured == 1 ? tr("1 track left") : tr("%1 tracks left").arg(unmeasured),
                                costOf(each * unmeasured));
    allRobustnessText_->setText(left);
    allRobustnessText_->setVisible(!left.isEmpty());
    if (reason.isEmpty() && runs_->selections().empty()) reason = tr("Compare the best winners first");
    if (reason.isEmpty() && unmeasured == 0) reason = tr("All tracks of the comparison are measured");
    allRobustness_->setEnabled(reason.isEmpty());
    allRobustness_->setToolTip(
        reason.isEmpty()
            ? tr("Find the worst corner of each track of the comparison that was not measured yet")
            : reason);
}

void JudgingCard::showStream(const QString& obstacle) {
    QString reason = obstacle;
    QString reasonOfOne = obstacle;
    if (runs_) {
        const study::Settings& settings = runs_->design().settings();
        const auto findProblem = [&](double inflow) {
            const auto problems = study::findStreamProblems(settings, inflow);
            return problems.empty() ? QString() : QString::fromStdString(problems.front());
        };
        const auto inflows = study::defaultInflows();
        double parts = 0.0;
        for (const double inflow : inflows) {
            parts +=
                inflow / 60.0 * (settings.stream.warmUp + settings.stream.duration) * settings.stream.streams;
            if (reason.isEmpty()) reason = findProblem(inflow);
        }
        streamText_->setText(tr("%1 to %2 parts a minute: %3 parts")
                                 .arg(inflows.front())
                                 .arg(inflows.back())
                                 .arg(QLocale().toString(static_cast<int>(parts))));
        const double inflow = settings.stream.partsPerMinute;
        if (reasonOfOne.isEmpty()) reasonOfOne = findProblem(inflow);
        oneStream_->setText(tr("Only %1 parts a &minute").arg(QLocale().toString(inflow, 'g', 6)));
    } else {
        streamText_->clear();
        oneStream_->setText(tr("Only the study's parts a &minute"));
    }
    stream_->setEnabled(reason.isEmpty() && winner_.has_value());
    stream_->setToolTip(
        reason.isEmpty() ? tr("Simulate parts that follow each other, push and jam: how many a minute leave "
                              "the track as wanted")
                         : reason);
    oneStream_->setEnabled(reasonOfOne.isEmpty() && winner_.has_value());
    oneStream_->setToolTip(
        reasonOfOne.isEmpty()
            ? tr("Simulate streams of the inflow that is set on the Track page, and of no other")
            : reasonOfOne);
}

void JudgingCard::measureAll() {
    std::vector<study::Individual> tracks;
    for (const study::IndividualId& id : runs_->listUnmeasured()) {
        auto track = runs_->loadIndividual(id);
        if (!track) {
            emit failed(tr("The tracks' robustness cannot be measured"),
                        QString::fromStdString(track.error().message));
            return;
        }
        tracks.push_back(std::move(*track));
    }
    runs_->startRobustness(tracks);
}

}  // namespace trapwright::pages
