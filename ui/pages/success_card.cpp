#include "ui/pages/success_card.h"

#include <QGridLayout>
#include <QLabel>

#include "ui/models/numbers.h"

namespace trapwright::pages {

namespace {

constexpr double kNumberSize = 2.4;  // of the font's

}  // namespace

SuccessCard::SuccessCard(const QString& name, QWidget* parent)
    : QWidget(parent), number_(new QLabel(this)), bounds_(new QLabel(this)), source_(new QLabel(this)) {
    number_->setObjectName(name + ".success");
    bounds_->setObjectName(name + ".successBounds");
    source_->setObjectName(name + ".successSource");
    QFont large = font();
    large.setPointSizeF(large.pointSizeF() * kNumberSize);
    large.setBold(true);
    number_->setFont(large);
    source_->setForegroundRole(QPalette::PlaceholderText);
    source_->setWordWrap(true);
    auto* layout = new QGridLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setHorizontalSpacing(12);
    layout->setVerticalSpacing(0);
    layout->addWidget(number_, 0, 0, 2, 1);
    layout->addWidget(bounds_, 0, 1, Qt::AlignBottom);
    layout->addWidget(source_, 1, 1, Qt::AlignTop);
    layout->setColumnStretch(1, 1);
}

void SuccessCard::show(const std::optional<stats::Count>& success, const QString& source) {
    number_->setText(success ? tr("%1 %").arg(models::percent(success)) : models::percent(success));
    bounds_->setText(success ? tr("success, 95 %: %1 %").arg(models::boundsText(success))
                             : tr("success not known"));
    tell(models::successHelp(success), source);
}

void SuccessCard::showCorrect(const std::optional<stats::Count>& correct, const QString& source) {
    show(correct, source);
    bounds_->setText(correct ? tr("correct, 95 %: %1 %").arg(models::boundsText(correct))
                             : tr("no part arrives"));
    number_->setAccessibleName(tr("Correct %1").arg(number_->text()));
}

void SuccessCard::showCorrect(const stats::WeightedRate& correct, const QString& source) {
    const QString bounds = models::boundsText(correct.interval, 1);
    number_->setText(tr("%1 %").arg(models::percent(correct.rate)));
    bounds_->setText(tr("correct, 95 %: %1 %").arg(bounds));
    tell(tr("Of the parts that arrive, those in the expected orientation: what falls off comes again"),
         source);
    number_->setAccessibleName(tr("Correct %1").arg(number_->text()));
}

void SuccessCard::showWeighted(const stats::WeightedRate& weighted, const QString& source) {
    const QString bounds = models::boundsText(weighted.interval, 1);
    number_->setText(tr("%1 %").arg(models::percent(weighted.rate)));
    bounds_->setText(tr("success, 95 %: %1 %").arg(bounds));
    tell(tr("The rate of each pose counts as often as parts land in it; 95 % interval of the weighted sum %1 "
            "% (one "
            "pose: Clopper-Pearson)")
             .arg(bounds),
         source);
}

void SuccessCard::tell(const QString& help, const QString& source) {
    source_->setText(source);
    setToolTip(help);
    number_->setAccessibleName(tr("Success %1").arg(number_->text()));
    number_->setAccessibleDescription(QStringLiteral("%1. %2").arg(help, source));
}

}  // namespace trapwright::pages
