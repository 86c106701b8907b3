#include "ui/pages/fact_list.h"

#include <QGridLayout>
#include <QLabel>

namespace trapwright::pages {

FactList::FactList(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(12);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(1, 1);
}

void FactList::show(const Facts& facts) {
    while (rows_.size() < facts.size())
        addRow();
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        const auto [name, value] = rows_[row];
        const bool used = row < facts.size();
        name->setVisible(used);
        value->setVisible(used);
        if (!used) continue;
        name->setText(facts[row].first);
        value->setText(facts[row].second);
        value->setAccessibleName(facts[row].first + ": " + facts[row].second);
    }
}

void FactList::addRow() {
    const int row = static_cast<int>(rows_.size());
    auto* name = new QLabel(this);
    name->setForegroundRole(QPalette::PlaceholderText);
    auto* value = new QLabel(this);
    value->setTextFormat(Qt::PlainText);
    value->setAlignment(Qt::AlignRight);
    value->setWordWrap(true);
    value->setTextInteractionFlags(Qt::TextSelectableByMouse);
    grid_->addWidget(name, row, 0, Qt::AlignTop);
    grid_->addWidget(value, row, 1);
    rows_.emplace_back(name, value);
}

}  // namespace trapwright::pages
