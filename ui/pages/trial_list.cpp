#include "ui/pages/trial_list.h"

#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStackedLayout>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/look/theme.h"
#include "ui/look/whole_headers.h"
#include "ui/models/verdict_look.h"

namespace trapwright::pages {

using models::TrialModel;

namespace {

constexpr int kMostGhosts = 30;
constexpr int kNarrow = 240;

}  // namespace

TrialList::TrialList()
    : source_(new QComboBox(this)),
      pose_(new QComboBox(this)),
      table_(new QTableView(this)),
      empty_(new QLabel),
      stack_(new QStackedLayout),
      ghosts_(new QSpinBox(this)),
      origin_(new QLabel(this)),
      busy_(new QWidget(this)),
      busyText_(new QLabel(busy_)),
      bar_(new QProgressBar(busy_)) {
    setObjectName("review.trials");
    setMinimumWidth(kNarrow);
    source_->setObjectName("trials.source");
    source_->setAccessibleName(tr("Trials"));
    source_->setToolTip(tr("Which of the simulated trials are listed"));
    connect(source_, &QComboBox::activated, this, &TrialList::sourceChosen);
    pose_->setObjectName("trials.pose");
    pose_->setAccessibleName(tr("Start pose"));
    pose_->setToolTip(tr("In which of the poses that look the same the parts began"));
    pose_->hide();
    connect(pose_, &QComboBox::activated, this, &TrialList::applyPose);

    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setMargin(16);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    makeTable();
    stack_->addWidget(empty_);
    stack_->addWidget(table_);

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 8, 8, 8);
    column->setSpacing(6);
    column->addWidget(source_);
    column->addWidget(pose_);
    column->addWidget(makeChips());
    column->addLayout(stack_, 1);
    column->addWidget(makeFoot());
    showCounts(0);
}

void TrialList::makeTable() {
    table_->setObjectName("trials.table");
    table_->setAccessibleName(tr("Simulated trials"));
    filter_.setSourceModel(&model_);
    table_->setModel(&filter_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setSortingEnabled(true);
    table_->sortByColumn(TrialModel::Trial, Qt::AscendingOrder);
    table_->setShowGrid(false);
    table_->setWordWrap(false);
    table_->setTabKeyNavigation(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 8);
    table_->horizontalHeader()->setHighlightSections(false);
    look::keepHeadersWhole(*table_->horizontalHeader());
    table_->setColumnHidden(TrialModel::Pose, true);
    table_->viewport()->installEventFilter(this);
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
        if (!restoring_) emit chosenChanged();
    });
    connect(table_, &QTableView::activated, this, &TrialList::playWanted);
}

QWidget* TrialList::makeChips() {
    auto* chips = new QWidget(this);
    auto* grid = new QGridLayout(chips);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(4);
    int place = 0;
    for (const trial::Verdict verdict : models::kVerdicts) {
        auto* chip = new QToolButton(chips);
        chip->setObjectName("trials.chip" + QString::number(static_cast<int>(verdict)));
        chip->setIcon(models::verdictIcon(verdict));
        look::drawAsButton(*chip);
        chip->setCheckable(true);
        chip->setChecked(true);
        chip->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        connect(chip, &QToolButton::clicked, this, &TrialList::applyChips);
        chips_.insert(static_cast<int>(verdict), chip);
        grid->addWidget(chip, place / 2, place % 2);
        ++place;
    }
    return chips;
}

QWidget* TrialList::makeFoot() {
    auto* foot = new QWidget(this);
    ghosts_->setObjectName("trials.ghosts");
    ghosts_->setRange(0, kMostGhosts);
    ghosts_->setAccessibleName(tr("Ghosts"));
    ghosts_->setToolTip(
        tr("How many of the next trials of the list are shown at once, in the colours of how they end"));
    connect(ghosts_, &QSpinBox::valueChanged, this, &TrialList::chosenChanged);
    auto* label = new QLabel(tr("Next trials as &ghosts"), foot);
    label->setBuddy(ghosts_);
    auto* row = new QHBoxLayout;
    row->addWidget(label, 1);
    row->addWidget(ghosts_);

    auto* stop = new QPushButton(tr("Stop"), busy_);
    stop->setObjectName("trials.stop");
    connect(stop, &QPushButton::clicked, this, &TrialList::stopWanted);
    bar_->setTextVisible(false);
    bar_->setFixedHeight(6);
    auto* line = new QHBoxLayout;
    line->addWidget(busyText_, 1);
    line->addWidget(stop);
    auto* busy = new QVBoxLayout(busy_);
    busy->setContentsMargins(0, 0, 0, 0);
    busy->setSpacing(4);
    busy->addLayout(line);
    busy->addWidget(bar_);

    origin_->setObjectName("trials.origin");
    origin_->setWordWrap(true);
    origin_->setForegroundRole(QPalette::PlaceholderText);
    origin_->hide();

    auto* column = new QVBoxLayout(foot);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(origin_);
    column->addLayout(row);
    column->addWidget(busy_);
    return foot;
}

void TrialList::setSources(const std::vector<TrialSource>& sources, int current) {
    const QSignalBlocker blocker(source_);
    source_->clear();
    for (const TrialSource& source : sources)
        source_->addItem(tr("%1 (%2)").arg(source.name, QLocale().toString(source.count)));
    source_->setVisible(!sources.empty());
    source_->setCurrentIndex(current);
    const bool isThere = current >= 0 && current < static_cast<int>(sources.size());
    const TrialSource shown = isThere ? sources[static_cast<std::size_t>(current)] : TrialSource();
    // A slice has trials of all poses, which are not alike.
    listPoses(isThere && !shown.slice ? shown.request.poses : std::vector<int>());
    if (shown.slice) table_->setColumnHidden(TrialModel::Pose, false);
}

void TrialList::listPoses(const std::vector<int>& poses) {
    const bool several = poses.size() > 1;
    std::vector<int> listed;
    for (int i = 1; i < pose_->count(); ++i)
        listed.push_back(pose_->itemData(i).toInt());
    pose_->setVisible(several);
    table_->setColumnHidden(TrialModel::Pose, !several);
    if (several && listed == poses) return;
    pose_->clear();
    if (several) {
        pose_->addItem(tr("All %1 alike poses").arg(poses.size()));
        for (const int pose : poses)
            pose_->addItem(tr("Pose %1").arg(pose + 1), pose);
    }
    applyPose();
}

void TrialList::setPose(std::optional<int> pose) {
    pose_->setCurrentIndex(pose ? std::max(0, pose_->findData(*pose)) : 0);
    applyPose();
}

void TrialList::applyPose() {
    const QVariant pose = pose_->currentData();
    filter_.setPose(pose.isValid() ? std::optional(pose.toInt()) : std::nullopt);
    if (ghosts_->value() > 0) emit chosenChanged();
}

void TrialList::setEmptyText(const QString& text) {
    empty_->setText(text);
}

void TrialList::setOrigin(const QString& text) {
    origin_->setText(text);
    origin_->setVisible(!text.isEmpty());
}

void TrialList::setTrials(std::vector<models::TrialRow> rows, int wanted) {
    const std::vector<int> before = chosen();
    const bool sized = model_.rowCount() > 0;
    restoring_ = true;
    model_.setTrials(std::move(rows));
    stack_->setCurrentIndex(model_.rowCount() == 0 ? 0 : 1);
    if (!sized && model_.rowCount() > 0) sizeColumns();
    if (!before.empty() && model_.rowOf(before.front()) >= 0) {
        // The ghosts that only follow are found again by themselves.
        const QModelIndex current =
            filter_.mapFromSource(model_.index(model_.rowOf(before.front()), TrialModel::Trial));
        table_->selectionModel()->setCurrentIndex(
            current, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    }
    restoring_ = false;
    showCounts(wanted);
    if (chosen() != before) emit chosenChanged();
}

bool TrialList::eventFilter(QObject* watched, QEvent* event) {
    // After the table has taken its new size.
    if (event->type() == QEvent::Resize)
        QMetaObject::invokeMethod(this, &TrialList::fitColumns, Qt::QueuedConnection);
    return QWidget::eventFilter(watched, event);
}

void TrialList::sizeColumns() {
    QHeaderView& header = *table_->horizontalHeader();
    header.setSectionResizeMode(TrialModel::Verdict, QHeaderView::Interactive);
    table_->setColumnHidden(TrialModel::Distance, false);
    table_->resizeColumnsToContents();
    columnsNeed_ = header.length();
    header.setSectionResizeMode(TrialModel::Verdict, QHeaderView::Stretch);
    fitColumns();
}

/// The last column is there where it has room: reading sideways costs more than it tells.
void TrialList::fitColumns() {
    table_->setColumnHidden(TrialModel::Distance, columnsNeed_ > table_->viewport()->width());
}

void TrialList::showCounts(int wanted) {
    for (const trial::Verdict verdict : models::kVerdicts) {
        const QString count = QLocale().toString(model_.count(verdict));
        const QString text = tr("%1 %2").arg(count, models::verdictText(verdict));
        QToolButton& chip = *chips_[static_cast<int>(verdict)];
        chip.setText(tr("%1 %2").arg(count, models::verdictWord(verdict)));
        chip.setAccessibleName(text);
        chip.setToolTip(tr("%1: list them").arg(text));
    }
    const int done = model_.rowCount();
    busy_->setVisible(done < wanted);
    busyText_->setText(tr("Simulating: %1 of %2").arg(QLocale().toString(done), QLocale().toString(wanted)));
    bar_->setRange(0, wanted);
    bar_->setValue(done);
}

void TrialList::setVerdicts(const std::set<trial::Verdict>& verdicts) {
    for (const trial::Verdict verdict : models::kVerdicts)
        chips_[static_cast<int>(verdict)]->setChecked(verdicts.contains(verdict));
    applyChips();
}

void TrialList::applyChips() {
    std::set<trial::Verdict> verdicts;
    for (const trial::Verdict verdict : models::kVerdicts)
        if (chips_[static_cast<int>(verdict)]->isChecked()) verdicts.insert(verdict);
    filter_.setVerdicts(std::move(verdicts));
    if (ghosts_->value() > 0) emit chosenChanged();
}

void TrialList::select(int trial) {
    const QModelIndex index = filter_.mapFromSource(model_.index(model_.rowOf(trial), TrialModel::Trial));
    table_->selectionModel()->setCurrentIndex(
        index, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    table_->scrollTo(index);
}

std::optional<int> TrialList::firstShown() const {
    if (filter_.rowCount() == 0) return std::nullopt;
    return filter_.index(0, 0).data(models::TrialRole).toInt();
}

std::vector<int> TrialList::chosen() const {
    const QItemSelectionModel& selection = *table_->selectionModel();
    const QModelIndex current = selection.currentIndex();
    std::vector<int> trials;
    const auto add = [&](const QModelIndex& index) {
        const int trial = index.data(models::TrialRole).toInt();
        if (std::find(trials.begin(), trials.end(), trial) == trials.end()) trials.push_back(trial);
    };
    if (!current.isValid() || !selection.isRowSelected(current.row(), {})) return trials;
    add(current);
    for (const QModelIndex& index : selection.selectedRows())
        if (trials.size() <= kMostGhosts) add(index);
    for (int i = 1; i <= ghosts_->value() && current.row() + i < filter_.rowCount(); ++i)
        add(filter_.index(current.row() + i, 0));
    return trials;
}

}  // namespace trapwright::pages
