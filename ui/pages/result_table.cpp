#include "ui/pages/result_table.h"

#include <QAbstractItemModel>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMouseEvent>
#include <QScrollBar>
#include <QStackedLayout>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/file.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"
#include "ui/look/whole_headers.h"
#include "ui/models/csv.h"
#include "ui/models/roles.h"

namespace trapwright::pages {

namespace {

bool isLink(const QModelIndex& index, const QSet<int>& columns) {
    return columns.contains(index.column()) && index.data(models::ValueRole).toInt() > 0;
}

class LinkDelegate : public QStyledItemDelegate {
 public:
    LinkDelegate(const QSet<int>& columns, QObject* parent)
        : QStyledItemDelegate(parent), columns_(columns) {}

 protected:
    void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
        QStyledItemDelegate::initStyleOption(option, index);
        if (!isLink(index, columns_)) return;
        option->font.setUnderline(true);
        option->palette.setColor(QPalette::Text, option->palette.color(QPalette::Link));
    }

 private:
    const QSet<int> columns_;
};

/// Shows a hand over links.
class LinkTable : public QTableView {
 public:
    QSet<int> columns;

 protected:
    void mouseMoveEvent(QMouseEvent* event) override {
        const bool link = isLink(indexAt(event->position().toPoint()), columns);
        viewport()->setCursor(link ? Qt::PointingHandCursor : Qt::ArrowCursor);
        QTableView::mouseMoveEvent(event);
    }
};

}  // namespace

ResultTable::ResultTable(const QString& name, const QString& title, QAbstractItemModel& model)
    : model_(model),
      text_(new QLabel(this)),
      empty_(new QLabel),
      head_(new QHBoxLayout),
      view_(new LinkTable),
      foot_(new LinkTable),
      stack_(new QStackedLayout) {
    setObjectName(name);
    setAccessibleName(title);
    text_->setObjectName(name + ".head");
    text_->setForegroundRole(QPalette::PlaceholderText);
    // It must not widen the window's middle.
    text_->setWordWrap(true);
    text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setMargin(16);
    empty_->setForegroundRole(QPalette::PlaceholderText);

    setUpView(*view_, name + ".table");
    setUpView(*foot_, name + ".totals");
    foot_->horizontalHeader()->hide();
    foot_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    foot_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    foot_->setFrameShape(QFrame::NoFrame);
    connect(view_->horizontalHeader(), &QHeaderView::sectionResized, this,
            [this](int column, int, int width) { foot_->setColumnWidth(column, width); });
    connect(view_->horizontalScrollBar(), &QScrollBar::valueChanged, foot_->horizontalScrollBar(),
            &QScrollBar::setValue);
    look::keepHeadersWhole(*view_->horizontalHeader());

    auto* save = new QToolButton(this);
    save->setObjectName(name + ".save");
    save->setIcon(look::icon("save-as"));
    save->setAutoRaise(true);
    save->setToolTip(tr("Save the table as CSV"));
    save->setAccessibleName(save->toolTip());
    connect(save, &QToolButton::clicked, this, &ResultTable::askAndSave);
    head_->setContentsMargins(8, 4, 8, 0);
    head_->addWidget(text_, 1);
    head_->addWidget(save);
    stack_->addWidget(empty_);
    auto* filled = new QWidget;
    auto* tables = new QVBoxLayout(filled);
    tables->setContentsMargins(0, 0, 0, 0);
    tables->setSpacing(0);
    tables->addWidget(view_, 1);
    tables->addWidget(foot_);
    stack_->addWidget(filled);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addLayout(head_);
    column->addLayout(stack_, 1);
    connect(&model_, &QAbstractItemModel::modelReset, this, &ResultTable::showEmpty);
    showEmpty();
}

void ResultTable::setUpView(QTableView& view, const QString& name) {
    view.setObjectName(name);
    view.setAccessibleName(accessibleName());
    view.setModel(&model_);
    view.setMouseTracking(true);
    view.setSelectionMode(QAbstractItemView::SingleSelection);
    view.setShowGrid(false);
    view.setWordWrap(false);
    view.setTabKeyNavigation(false);
    view.setIconSize({12, 12});
    view.verticalHeader()->hide();
    view.verticalHeader()->setDefaultSectionSize(view.fontMetrics().height() + 8);
    view.horizontalHeader()->setHighlightSections(false);
    connect(&view, &QTableView::clicked, this, &ResultTable::cellChosen);
    connect(&view, &QTableView::activated, this, &ResultTable::cellChosen);
}

void ResultTable::setPinned(int rows) {
    pinned_ = rows;
    arrange();
}

/// Every row is in one of the two views, and the columns are as wide in both.
void ResultTable::arrange() {
    const int rows = model_.rowCount();
    const int pinned = std::min(pinned_, rows);
    for (int row = 0; row < rows; ++row) {
        view_->setRowHidden(row, row >= rows - pinned);
        foot_->setRowHidden(row, row < rows - pinned);
    }
    foot_->setVisible(pinned > 0);
    foot_->setFixedHeight(foot_->verticalHeader()->length());
    view_->resizeColumnsToContents();
    if (pinned == 0) return;
    foot_->resizeColumnsToContents();
    for (int column = 0; column < model_.columnCount(); ++column) {
        const int width = std::max(view_->columnWidth(column), foot_->columnWidth(column));
        view_->setColumnWidth(column, width);
        foot_->setColumnWidth(column, width);
    }
}

void ResultTable::setHead(const QString& text, const QString& details) {
    text_->setText(text);
    text_->setToolTip(details);
    text_->setAccessibleDescription(details);
}

void ResultTable::setEmptyText(const QString& text) {
    empty_->setText(text);
}

void ResultTable::setLinkColumns(const QSet<int>& columns) {
    for (QTableView* view : {view_, foot_}) {
        static_cast<LinkTable*>(view)->columns = columns;
        view->setItemDelegate(new LinkDelegate(columns, view));
    }
}

void ResultTable::showEmpty() {
    const bool empty = model_.rowCount() == 0;
    stack_->setCurrentIndex(empty ? 0 : 1);
    arrange();
    findChild<QToolButton*>(objectName() + ".save")->setEnabled(!empty);
}

void ResultTable::askAndSave() {
    look::askForNewFile(
        this,
        {"table", tr("Save the table"), tr("Save"), tr("CSV (*.csv)"), "csv", objectName().section('.', -1)},
        [this](const std::filesystem::path& file) {
            const base::Status status = base::writeFile(file, models::toCsv(model_).toStdString());
            if (!status)
                emit failed(tr("The table cannot be saved"), QString::fromStdString(status.error().message));
        });
}

}  // namespace trapwright::pages
