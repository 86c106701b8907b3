#include "ui/pages/cluster_dialog.h"

#include <QApplication>
#include <QClipboard>
#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QStackedWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/command.h"
#include "core/base/parallel.h"
#include "ui/look/text.h"
#include "ui/look/theme.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::pages {

using session::RunState;
using session::StudyRuns;
using session::StudySession;

namespace {

constexpr int kNumberWidth = 128;  // [px]
constexpr int kWidth = 560;        // [px]
constexpr int kMostRanks = 100000;
constexpr double kShortestTurn = 0.05;  // [h]
constexpr double kLongestTurn = 10000.0;
constexpr int kTrialsPerRank = 100;  // fewer in a generation, and ranks mostly wait (help/cluster.md)

constexpr auto kRanksSetting = "cluster/processes";
constexpr auto kHoursSetting = "cluster/hours";
constexpr auto kOptionsSetting = "cluster/options";
constexpr auto kProgramSetting = "cluster/program";

/// The command line's program as nodes find it: by its name where this machine does, else beside this one.
QString findProgram() {
    const QString name = QStringLiteral("trapwright");
    const QString beside = QCoreApplication::applicationDirPath() + '/' + name;
    return !base::hasCommand(name.toStdString()) && QFile::exists(beside) ? beside : name;
}

QLabel* makeText(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setWordWrap(true);
    return label;
}

}  // namespace

ClusterDialog::ClusterDialog(StudySession& session, QWidget* parent)
    : QDialog(parent),
      session_(session),
      runs_(session.runs()),
      canSubmit_(workflow::canSubmit()),
      stack_(new QStackedWidget(this)),
      said_(makeText({}, this)) {
    setObjectName("cluster");
    setWindowTitle(tr("Run on a cluster"));
    setAttribute(Qt::WA_DeleteOnClose);
    said_->setObjectName("cluster.said");
    said_->setTextFormat(Qt::PlainText);
    said_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    said_->hide();
    stack_->addWidget(makeForm());
    stack_->addWidget(makeWritten());
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(stack_);
    column->addWidget(said_);
    setMinimumWidth(kWidth);

    connect(&runs_, &StudyRuns::estimated, this, &ClusterDialog::showForm);
    connect(&runs_, &StudyRuns::jobWritten, this, [this](const workflow::ClusterJob& job) {
        isAsked_ = false;
        if (!job.id.empty()) return accept();
        showWritten(job);
    });
    connect(&session_, &StudySession::failed, this, [this](const QString&, const QString& message) {
        if (isAsked_) tell(message, true);
    });
    connect(&runs_, &StudyRuns::stateChanged, this, [this](RunState state) {
        showForm();
        take_->setEnabled(state == RunState::idle);
        if (state != RunState::idle || !std::exchange(isAsked_, false)) return;
        const std::size_t taken = runs_.summaries().size() - known_;
        if (stack_->currentIndex() == 1 && !said_->isVisible())
            tell(taken == 0   ? tr("There is nothing new in the folder.")
                 : taken == 1 ? tr("One new generation was taken.")
                              : tr("%L1 new generations were taken.").arg(taken),
                 false);
    });
    connect(&session_, &QObject::destroyed, this, &QDialog::reject);

    // The dialog has one; a page that is out of sight must not have it.
    connect(stack_, &QStackedWidget::currentChanged, this, &ClusterDialog::setDefault);
    setDefault();
    const auto last = runs_.lastJob();
    if (!canSubmit_ && last && last->id.empty()) showWritten(*last);
}

QWidget* ClusterDialog::makeForm() {
    auto* page = new QWidget(stack_);
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(12);
    column->addWidget(makeText(
        canSubmit_
            ? tr("Learning goes on as a job of Slurm, and what it learns comes into this study while it "
                 "does. You may close the window meanwhile: when the study is opened again, the job is "
                 "followed.")
            : tr("There is no sbatch on this machine. A folder is written with all that the job needs: copy "
                 "it to the cluster, queue the job there, and take home what it has learned."),
        page));

    const QSettings settings;
    ranks_ = new QSpinBox(page);
    ranks_->setObjectName("cluster.ranks");
    ranks_->setRange(1, kMostRanks);
    ranks_->setGroupSeparatorShown(true);
    ranks_->setValue(settings.value(kRanksSetting, workflow::JobPlan().ranks).toInt());
    ranks_->setToolTip(
        tr("Processes of the job, each on a processor of its own, on as many machines as that needs"));
    hours_ = new QDoubleSpinBox(page);
    hours_->setObjectName("cluster.hours");
    hours_->setRange(kShortestTurn, kLongestTurn);
    hours_->setDecimals(2);
    hours_->setSuffix(tr(" h"));
    hours_->setValue(settings.value(kHoursSetting, workflow::JobPlan().hours).toDouble());
    hours_->setToolTip(
        tr("Before this time is over the job finishes its generation, queues itself again and goes on"));
    options_ = new QLineEdit(settings.value(kOptionsSetting).toString(), page);
    options_->setObjectName("cluster.options");
    options_->setPlaceholderText("--partition=long --account=feeders");
    options_->setToolTip(tr("What your site wants to know of a job, as options of sbatch"));
    program_ = new QLineEdit(settings.value(kProgramSetting, findProgram()).toString(), page);
    program_->setObjectName("cluster.program");
    program_->setToolTip(tr("The command trapwright, as the cluster's machines find it"));
    auto* form = new QFormLayout;
    form->setLabelAlignment(Qt::AlignLeft);
    form->setHorizontalSpacing(16);
    for (QWidget* number : {static_cast<QWidget*>(ranks_), static_cast<QWidget*>(hours_)})
        number->setFixedWidth(kNumberWidth);
    form->addRow(tr("Processors"), ranks_);
    form->addRow(tr("Time of one turn"), hours_);
    form->addRow(tr("Options for sbatch"), options_);
    form->addRow(tr("Program on the cluster"), program_);
    column->addLayout(form);
    time_ = makeText({}, page);
    time_->setObjectName("cluster.time");
    time_->setForegroundRole(QPalette::PlaceholderText);
    column->addWidget(time_);
    column->addStretch(1);
    connect(ranks_, &QSpinBox::valueChanged, this, &ClusterDialog::showForm);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, page);
    submit_ = buttons->addButton(canSubmit_ ? tr("Submit the job") : tr("Write the job"),
                                 QDialogButtonBox::AcceptRole);
    submit_->setObjectName("cluster.submit");
    connect(buttons, &QDialogButtonBox::accepted, this, &ClusterDialog::submit);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    column->addWidget(buttons);
    showForm();
    return page;
}

QWidget* ClusterDialog::makeWritten() {
    auto* page = new QWidget(stack_);
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(12);
    folder_ = makeText({}, page);
    folder_->setObjectName("cluster.folder");
    folder_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(folder_);
    column->addWidget(makeText(tr("1. Copy the folder to the cluster.\n2. Queue the job there:"), page));
    command_ = new QLineEdit(page);
    command_->setObjectName("cluster.command");
    command_->setReadOnly(true);
    command_->setAccessibleName(tr("Command that queues the job"));
    auto* copy = new QPushButton(tr("Copy"), page);
    copy->setObjectName("cluster.copy");
    copy->setAccessibleName(tr("Copy the command"));
    connect(copy, &QPushButton::clicked, this,
            [this] { QApplication::clipboard()->setText(command_->text()); });
    auto* row = new QHBoxLayout;
    row->addWidget(command_, 1);
    row->addWidget(copy);
    column->addLayout(row);
    column->addWidget(
        makeText(tr("3. Copy the folder back to its place whenever you like, also while the job "
                    "goes on, and take what it has learned."),
                 page));
    column->addStretch(1);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, page);
    auto* open = buttons->addButton(tr("Open the folder"), QDialogButtonBox::ActionRole);
    open->setObjectName("cluster.open");
    connect(open, &QPushButton::clicked, this, [this] {
        QDesktopServices::openUrl(QUrl::fromLocalFile(QFile::decodeName(job_.folder.c_str())));
    });
    auto* another = buttons->addButton(tr("Write another"), QDialogButtonBox::ActionRole);
    another->setObjectName("cluster.another");
    connect(another, &QPushButton::clicked, this, [this] {
        said_->hide();
        showForm();
        stack_->setCurrentIndex(0);
    });
    take_ = buttons->addButton(tr("Take what it learned"), QDialogButtonBox::AcceptRole);
    take_->setObjectName("cluster.take");
    connect(buttons, &QDialogButtonBox::accepted, this, &ClusterDialog::take);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    column->addWidget(buttons);
    return page;
}

void ClusterDialog::setDefault() {
    (stack_->currentIndex() == 0 ? submit_ : take_)->setDefault(true);
}

void ClusterDialog::showForm() {
    const study::EvolutionSettings& evolution = runs_.design().settings().evolution;
    const int ranks = ranks_->value();
    const std::int64_t trials =
        static_cast<std::int64_t>(evolution.populationSize) * evolution.trialsPerEvaluation;
    const int left = evolution.generations - static_cast<int>(runs_.summaries().size());
    const unsigned threads = runs_.threads() == 0 ? base::availableThreads() : runs_.threads();
    const double seconds =
        std::max(runs_.estimatedSeconds(), runs_.secondsFor(left * trials)) * threads / ranks;
    const bool isResting = runs_.state() == RunState::idle || runs_.state() == RunState::simulating;
    submit_->setEnabled(isResting && left > 0);
    if (left <= 0) return time_->setText(tr("All generations are learned. Raise their number first."));
    QStringList text;
    if (seconds > 0.0)
        text << tr("%1 at best with processors like these, for %L2 generations of %L3 trials.")
                    .arg(look::roughDurationText(seconds))
                    .arg(left)
                    .arg(trials);
    const std::int64_t most = std::max<std::int64_t>(trials / kTrialsPerRank, 1);
    if (ranks > most)
        text
            << tr("A generation has %L1 trials: more than %L2 processors mostly wait.").arg(trials).arg(most);
    text << tr("The job works on a copy, in %1 beside the study.")
                .arg(look::toText(workflow::findNextFolder(session_.path()).filename()));
    time_->setText(text.join('\n'));
}

workflow::JobPlan ClusterDialog::plan() const {
    workflow::JobPlan plan;
    plan.ranks = ranks_->value();
    plan.hours = hours_->value();
    for (const QString& option : QProcess::splitCommand(options_->text()))
        plan.options.push_back(option.toStdString());
    const QString program = program_->text().trimmed();
    if (!program.isEmpty()) plan.program = program.toStdString();
    return plan;
}

void ClusterDialog::submit() {
    QSettings settings;
    settings.setValue(kRanksSetting, ranks_->value());
    settings.setValue(kHoursSetting, hours_->value());
    settings.setValue(kOptionsSetting, options_->text());
    if (program_->text().trimmed() != findProgram()) {
        settings.setValue(kProgramSetting, program_->text().trimmed());
    } else {
        settings.remove(kProgramSetting);
    }
    said_->hide();
    isAsked_ = true;
    known_ = runs_.summaries().size();
    runs_.startJob(plan());
}

void ClusterDialog::take() {
    said_->hide();
    isAsked_ = true;
    known_ = runs_.summaries().size();
    runs_.followJob(job_);
}

void ClusterDialog::showWritten(const workflow::ClusterJob& job) {
    job_ = job;
    folder_->setText(tr("The job is written: <b>%1</b>").arg(look::pathText(job.folder).toHtmlEscaped()));
    command_->setText(QString::fromStdString(workflow::submitCommand(job)));
    stack_->setCurrentIndex(1);
}

void ClusterDialog::tell(const QString& message, bool isBad) {
    said_->setText(message);
    look::colourText(*said_, isBad ? look::Tone::bad : look::Tone::good);
    said_->show();
}

}  // namespace trapwright::pages
