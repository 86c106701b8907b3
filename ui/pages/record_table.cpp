#include "ui/pages/record_table.h"

#include <QAction>
#include <QHeaderView>
#include <QLabel>
#include <QScopedValueRollback>
#include <QSortFilterProxyModel>
#include <QStackedLayout>
#include <QTableView>
#include <QVBoxLayout>

#include "core/base/file.h"
#include "ui/look/file_dialog.h"
#include "ui/look/whole_headers.h"
#include "ui/models/csv.h"
#include "ui/models/roles.h"

namespace trapwright::pages {

namespace {

constexpr int kCellPadding = 8;

}  // namespace

RecordTable::RecordTable(const QString& name, const QString& title, const QString& emptyText,
                         QAbstractItemModel& model, QWidget* parent)
    : QWidget(parent),
      title_(title),
      model_(model),
      sorted_(new QSortFilterProxyModel(this)),
      view_(new QTableView(this)),
      column_(new QVBoxLayout(this)),
      stack_(new QStackedLayout) {
    setObjectName(name);
    sorted_->setSourceModel(&model_);
    sorted_->setSortRole(models::ValueRole);
    view_->setObjectName(name + ".table");
    view_->setAccessibleName(title);
    view_->setModel(sorted_);
    view_->setSortingEnabled(true);
    view_->setSelectionBehavior(QAbstractItemView::SelectRows);
    view_->setSelectionMode(QAbstractItemView::SingleSelection);
    view_->setAlternatingRowColors(true);
    view_->setShowGrid(false);
    view_->setFrameShape(QFrame::NoFrame);
    view_->setWordWrap(false);
    view_->setTabKeyNavigation(false);
    view_->verticalHeader()->hide();
    view_->verticalHeader()->setDefaultSectionSize(view_->fontMetrics().height() + kCellPadding);
    view_->horizontalHeader()->setHighlightSections(false);
    look::keepHeadersWhole(*view_->horizontalHeader());
    view_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    auto* empty = new QLabel(emptyText, this);
    empty->setAlignment(Qt::AlignCenter);
    empty->setWordWrap(true);
    empty->setForegroundRole(QPalette::PlaceholderText);
    empty->setContentsMargins(24, 0, 24, 0);
    stack_->addWidget(empty);
    stack_->addWidget(view_);
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(0);
    column_->addLayout(stack_, 1);

    auto* save = new QAction(tr("Save table as CSV..."), view_);
    save->setObjectName(name + ".saveCsv");
    save->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_E));
    // Only in the table, so no menu shows the key.
    save->setShortcutContext(Qt::WidgetShortcut);
    save->setShortcutVisibleInContextMenu(false);
    connect(save, &QAction::triggered, this, &RecordTable::askAndSaveCsv);
    view_->addAction(save);
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);

    connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                if (!setting_ && index.isValid()) emit picked(sorted_->mapToSource(index).row());
            });
    // A row that is current already can be picked as well.
    connect(view_, &QTableView::clicked, this,
            [this](const QModelIndex& index) { emit picked(sorted_->mapToSource(index).row()); });
    connect(&model_, &QAbstractItemModel::modelReset, this, &RecordTable::updateEmpty);
    connect(&model_, &QAbstractItemModel::rowsInserted, this, &RecordTable::updateEmpty);
}

void RecordTable::sortBy(int column, Qt::SortOrder order) {
    view_->sortByColumn(column, order);
}

void RecordTable::setCurrentRow(int row) {
    const QScopedValueRollback<bool> setting(setting_, true);
    if (row < 0) {
        view_->clearSelection();
        view_->selectionModel()->clearCurrentIndex();
        return;
    }
    const int column = std::max(view_->currentIndex().column(), 0);
    view_->setCurrentIndex(sorted_->mapFromSource(model_.index(row, column)));
}

void RecordTable::setHead(QWidget* head) {
    column_->insertWidget(0, head);
}

base::Status RecordTable::saveCsv(const std::filesystem::path& path) const {
    return base::writeFile(path, models::toCsv(*sorted_).toStdString());
}

void RecordTable::askAndSaveCsv() {
    const look::FileQuestion question{"table",    tr("Save the table of %1").arg(title_),
                                      tr("Save"), tr("Tables (*.csv)"),
                                      "csv",      objectName()};
    look::askForNewFile(this, question, [this](const std::filesystem::path& path) {
        const base::Status saved = saveCsv(path);
        if (!saved)
            emit failed(tr("The table could not be saved"), QString::fromStdString(saved.error().message));
    });
}

void RecordTable::updateEmpty() {
    const bool first = stack_->currentIndex() == 0 && model_.rowCount() > 0;
    stack_->setCurrentIndex(model_.rowCount() > 0 ? 1 : 0);
    if (first) view_->resizeColumnsToContents();
}

}  // namespace trapwright::pages
