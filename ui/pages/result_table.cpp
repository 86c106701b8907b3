#include "ui/pages/result_table.h"

#include <QAbstractItemModel>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMouseEvent>
#include <QStackedLayout>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

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

    view_->setObjectName(name + ".table");
    view_->setAccessibleName(title);
    view_->setModel(&model_);
    view_->setMouseTracking(true);
    view_->setSelectionMode(QAbstractItemView::SingleSelection);
    view_->setShowGrid(false);
    view_->setWordWrap(false);
    view_->setTabKeyNavigation(false);
    view_->verticalHeader()->hide();
    view_->verticalHeader()->setDefaultSectionSize(view_->fontMetrics().height() + 8);
    view_->horizontalHeader()->setHighlightSections(false);
    look::keepHeadersWhole(*view_->horizontalHeader());
    connect(view_, &QTableView::clicked, this, &ResultTable::cellChosen);
    connect(view_, &QTableView::activated, this, &ResultTable::cellChosen);

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
    stack_->addWidget(view_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addLayout(head_);
    column->addLayout(stack_, 1);
    connect(&model_, &QAbstractItemModel::modelReset, this, &ResultTable::showEmpty);
    showEmpty();
}

void ResultTable::setHead(const QString& text) {
    text_->setText(text);
}

void ResultTable::setEmptyText(const QString& text) {
    empty_->setText(text);
}

void ResultTable::setLinkColumns(const QSet<int>& columns) {
    static_cast<LinkTable*>(view_)->columns = columns;
    view_->setItemDelegate(new LinkDelegate(columns, view_));
}

void ResultTable::showEmpty() {
    const bool empty = model_.rowCount() == 0;
    stack_->setCurrentIndex(empty ? 0 : 1);
    if (!empty) view_->resizeColumnsToContents();
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
