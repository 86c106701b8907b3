#include "ui/pages/event_log.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QScrollBar>
#include <QStackedLayout>
#include <QTime>
#include <QTreeWidget>

#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/look/whole_headers.h"
#include "ui/models/numbers.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::RunState;
using session::StudyRuns;

namespace {

enum Columns { Time, What };

constexpr int kMost = 5000;  // lines
constexpr int kSign = 14;
constexpr int kKindRole = Qt::UserRole;

}  // namespace

EventLog::EventLog(QWidget* parent)
    : QWidget(parent), list_(new QTreeWidget(this)), stack_(new QStackedLayout(this)) {
    setObjectName("log");
    list_->setObjectName("log.list");
    list_->setAccessibleName(tr("What happened"));
    list_->setColumnCount(2);
    list_->setIconSize({kSign, kSign});
    list_->setHeaderLabels({tr("Time"), tr("What happened")});
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    list_->header()->setStretchLastSection(true);
    look::keepHeadersWhole(*list_->header());
    list_->header()->setSectionResizeMode(Time, QHeaderView::ResizeToContents);
    auto* empty = new QLabel(
        tr("What happens to the study is listed here: generations, checks, stops, failures."), this);
    empty->setAlignment(Qt::AlignCenter);
    empty->setWordWrap(true);
    empty->setForegroundRole(QPalette::PlaceholderText);
    stack_->addWidget(empty);
    stack_->addWidget(list_);

    auto* copy = new QAction(look::icon("save-as"), tr("Copy lines"), list_);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    copy->setShortcutVisibleInContextMenu(false);
    connect(copy, &QAction::triggered, this, [this] {
        QString text;
        for (int i = 0; i < list_->topLevelItemCount(); ++i) {
            const QTreeWidgetItem* item = list_->topLevelItem(i);
            if (item->isSelected()) text += item->text(Time) + '\t' + item->text(What) + '\n';
        }
        QApplication::clipboard()->setText(text);
    });
    list_->addAction(copy);
    list_->setContextMenuPolicy(Qt::ActionsContextMenu);
    colour();
}

void EventLog::setRuns(const StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    list_->clear();
    stack_->setCurrentIndex(0);
    if (!runs_) return;
    last_ = runs_->state();
    remade_ = runs_->remadeTrials().size();
    connect(runs_, &StudyRuns::stateChanged, this, &EventLog::tellState);
    connect(runs_, &StudyRuns::progressed, this, &EventLog::tellRemade);
    connect(runs_, &StudyRuns::jobChanged, this, &EventLog::tellJob);
    connect(runs_, &StudyRuns::generationSaved, this, &EventLog::tellGeneration);
    connect(runs_, &StudyRuns::checkSaved, this, &EventLog::tellCheck);
    connect(runs_, &StudyRuns::selectionSaved, this, [this] { add(Kind::good, tr("Selection saved")); });
    connect(runs_, &StudyRuns::validationSaved, this, [this] { add(Kind::good, tr("Validation saved")); });
    const auto known = runs_->summaries().size();
    if (known > 0) add(Kind::info, tr("Opened, generations saved: %1").arg(known));
}

void EventLog::tellFailure(const QString& what, const QString& message) {
    add(Kind::error, what + ". " + message);
}

void EventLog::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) colour();
}

void EventLog::add(Kind kind, const QString& text) {
    const QScrollBar* bar = list_->verticalScrollBar();
    const bool atEnd = bar->value() == bar->maximum();
    auto* item = new QTreeWidgetItem({QLocale().toString(QTime::currentTime(), "hh:mm:ss"), text});
    item->setData(What, kKindRole, static_cast<unsigned>(kind));
    item->setIcon(What, signs_[static_cast<std::size_t>(kind)]);
    item->setToolTip(What, text);
    if (list_->topLevelItemCount() >= kMost) delete list_->takeTopLevelItem(0);
    list_->addTopLevelItem(item);
    stack_->setCurrentIndex(1);
    if (atEnd) list_->scrollToBottom();
}

void EventLog::colour() {
    const std::pair<const char*, QColor> signs[] = {
        {"info", palette().color(QPalette::PlaceholderText)},
        {"good", look::toneColour(look::Tone::good, palette())},
        {"warning", look::toneColour(look::Tone::warning, palette())},
        {"error", look::toneColour(look::Tone::bad, palette())}};
    for (std::size_t i = 0; i < std::size(signs); ++i)
        signs_[i] = look::signPixmap(signs[i].first, signs[i].second, kSign, devicePixelRatioF());
    for (int i = 0; i < list_->topLevelItemCount(); ++i) {
        QTreeWidgetItem* item = list_->topLevelItem(i);
        item->setIcon(What, signs_[item->data(What, kKindRole).toUInt()]);
    }
}

void EventLog::tellRemade() {
    const std::vector<trial::RemadeTrial> trials = runs_->remadeTrials();
    if (trials.size() < remade_) remade_ = 0;  // a new run
    for (; remade_ < trials.size(); ++remade_)
        add(Kind::warning, tr("Made again with the reference engine: %1")
                               .arg(QString::fromStdString(trial::describe(trials[remade_]))));
}

void EventLog::tellState(RunState state) {
    tellRemade();
    const RunState before = std::exchange(last_, state);
    const QString next = QString::number(runs_->summaries().size());
    switch (state) {
        case RunState::learning:
            add(Kind::info, before == RunState::paused ? tr("Learning continued")
                                                       : tr("Learning began at generation %1").arg(next));
            break;
        case RunState::following:
            add(Kind::info, tr("Learning on a cluster, from generation %1").arg(next));
            break;
        case RunState::paused:
            add(Kind::warning, tr("Paused"));
            break;
        case RunState::stoppingAfterGeneration:
            add(Kind::info, tr("Will stop after this generation"));
            break;
        case RunState::stopping:
            add(Kind::info, tr("Stopping at once"));
            break;
        case RunState::selecting:
            add(Kind::info, tr("The best winners are simulated again"));
            break;
        case RunState::validating:
            add(Kind::info, tr("Validation began"));
            break;
        case RunState::measuring:
            add(Kind::info, tr("Measurement of robustness began"));
            break;
        case RunState::streaming:
            add(Kind::info, tr("Streams of parts are simulated"));
            break;
        case RunState::mending:
            add(Kind::info, tr("Mending of a track for the printer began"));
            break;
        case RunState::simulating:
            break;
        case RunState::idle:
            if (before == RunState::simulating) break;
            add(Kind::info, tr("Ended, generations saved: %1").arg(next));
            break;
    }
}

void EventLog::tellJob(const session::FollowedJob& job) {
    using workflow::JobState;
    if (job.id.empty()) return;
    const QString id = QString::fromStdString(job.id);
    switch (job.status.state) {
        case JobState::waiting:
            return add(
                Kind::info,
                job.status.reason.empty()
                    ? tr("Job %1 waits in the queue").arg(id)
                    : tr("Job %1 waits in the queue: %2").arg(id, QString::fromStdString(job.status.reason)));
        case JobState::running:
            return add(Kind::good, tr("Job %1 runs").arg(id));
        case JobState::over:
            return add(Kind::info, tr("Job %1 is over").arg(id));
        case JobState::unknown:
            return add(Kind::warning, tr("The batch system does not answer; job %1 may go on").arg(id));
    }
}

void EventLog::tellGeneration(int generation) {
    const study::GenerationSummary& summary = runs_->summaries().back();
    if (summary.mendedFrom) {
        add(Kind::good,
            tr("Generation %1 saved: variants of generation %2, individual %3 that can be printed, in %4")
                .arg(generation)
                .arg(summary.mendedFrom->generation)
                .arg(summary.mendedFrom->individual)
                .arg(look::durationText(summary.seconds)));
        return;
    }
    add(Kind::good, tr("Generation %1 saved: success of its winner %2, F %3, in %4")
                        .arg(generation)
                        .arg(models::shareText(summary.statistics.success),
                             QLocale().toString(summary.statistics.best.total, 'f', 3),
                             look::durationText(summary.seconds)));
}

void EventLog::tellCheck(int generation) {
    const study::CheckRecord& check = runs_->checks().back();
    const auto share = [&](const study::EngineScore& score) {
        return tr("%1 %2 of %3")
            .arg(QString::fromStdString(score.engine))
            .arg(score.oriented)
            .arg(check.trials);
    };
    add(Kind::good, tr("Winner of generation %1 checked: success %2, %3 parts")
                        .arg(generation)
                        .arg(share(check.learning), share(check.reference)));
}

}  // namespace trapwright::pages
