#include "ui/pages/comparison_table.h"

#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>

#include "ui/look/text.h"
#include "ui/models/numbers.h"

namespace trapwright::pages {

namespace {

constexpr double kPercent = 100.0;

/// "96.4", or a dash.
QString quartileText(const std::optional<stats::Quartiles>& quartiles, double stats::Quartiles::*which) {
    return quartiles ? models::fixed(kPercent * (*quartiles).*which, 1) : models::percent(0, 0);
}

}  // namespace

ComparisonTable::ComparisonTable(QWidget* parent) : QWidget(parent) {
    setObjectName("evolve.comparisonTable");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
}

void ComparisonTable::show(std::span<const study::ComparedStudy> studies) {
    delete body_;
    body_ = new QWidget(this);
    grid_ = new QGridLayout(body_);
    rows_ = 0;
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(12);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(0, 1);
    layout()->addWidget(body_);
    addRow({tr("Study"), tr("Gen."), tr("Learned [%]"), tr("Fresh [%]")},
           tr("Success of each study's best track: counted while it learned, and in the fresh trials of its "
              "last selection. Where falls are forgiven, of those parts that arrive."),
           Weight::head);
    for (const study::ComparedStudy& study : studies) {
        const auto learned = study::bestRate(study);
        const auto fresh = study::selectedRate(study);
        addRow({QString::fromStdString(study.name), QLocale().toString(study.generations.size()),
                models::percent(learned), models::percent(fresh)},
               tr("%1, seed %2: %3 while learning, %4 in fresh trials")
                   .arg(QString::fromStdString(study.name))
                   .arg(study.seed)
                   .arg(models::shareText(learned), models::shareText(fresh)),
               Weight::row);
    }
    if (studies.size() < 3) return;
    const auto learned = study::spreadOf(studies, &study::bestRate);
    const auto fresh = study::spreadOf(studies, &study::selectedRate);
    const auto add = [&](const QString& name, double stats::Quartiles::*which) {
        addRow({name, {}, quartileText(learned, which), quartileText(fresh, which)},
               tr("Of these studies' shares"), Weight::sum);
    };
    add(tr("Upper quartile"), &stats::Quartiles::upper);
    add(tr("Median"), &stats::Quartiles::median);
    add(tr("Lower quartile"), &stats::Quartiles::lower);
}

void ComparisonTable::addRow(const QStringList& cells, const QString& help, Weight weight) {
    for (int column = 0; column < cells.size(); ++column) {
        auto* label = new QLabel(cells[column], body_);
        label->setObjectName(QString("compared.%1.%2").arg(rows_).arg(column));
        label->setTextFormat(Qt::PlainText);
        label->setToolTip(help);
        label->setAlignment((column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
        // A long name gives way to numbers; the tip has it whole.
        if (column == 0) label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        if (weight == Weight::head) label->setForegroundRole(QPalette::PlaceholderText);
        if (weight == Weight::sum) {
            QFont font = label->font();
            font.setBold(true);
            label->setFont(font);
        }
        grid_->addWidget(label, rows_, column);
    }
    ++rows_;
}

}  // namespace trapwright::pages
