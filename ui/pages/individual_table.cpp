#include "ui/pages/individual_table.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "core/study/track_design.h"
#include "ui/pages/details_button.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::StudyRuns;

IndividualTable::IndividualTable(QWidget* parent)
    : QWidget(parent),
      table_(new RecordTable(
          "individuals", tr("Individuals"),
          tr("The individuals of a generation are listed when it is complete. Start learning with F5."),
          model_, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(table_);
    table_->setHead(makeHead());
    table_->sortBy(models::IndividualModel::Success, Qt::DescendingOrder);
    connect(table_, &RecordTable::picked, this, [this](int row) {
        const models::IndividualRow& picked = model_.rows()[static_cast<std::size_t>(row)];
        individual_ = picked.individual;
        emit this->picked(picked);
    });
    connect(table_, &RecordTable::failed, this, &IndividualTable::failed);
}

QWidget* IndividualTable::makeHead() {
    auto* head = new QWidget(this);
    spin_ = new QSpinBox(head);
    spin_->setObjectName("individuals.generation");
    spin_->setAccessibleName(tr("Generation"));
    spin_->setKeyboardTracking(false);
    auto* label = new QLabel(tr("&Generation"), head);
    label->setBuddy(spin_);
    count_ = new QLabel(head);
    count_->setForegroundRole(QPalette::PlaceholderText);
    auto* layout = new QHBoxLayout(head);
    layout->setContentsMargins(12, 4, 12, 4);
    layout->setSpacing(8);
    layout->addWidget(label);
    layout->addWidget(spin_);
    layout->addWidget(count_, 1);
    layout->addWidget(new DetailsButton(table_->view(), models::IndividualModel::firstDetail(), head));
    connect(spin_, &QSpinBox::valueChanged, this, &IndividualTable::generationPicked);
    head->hide();
    return head;
}

void IndividualTable::setRuns(const StudyRuns* runs) {
    runs_ = runs;
    loaded_ = -1;
    setCurrent(-1, -1);
}

void IndividualTable::setCurrent(int generation, int individual) {
    generation_ = generation;
    individual_ = individual;
    if (isVisible()) load();
}

void IndividualTable::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    load();
}

void IndividualTable::load() {
    spin_->parentWidget()->setVisible(generation_ >= 0);
    if (!runs_ || generation_ < 0) {
        loaded_ = -1;
        return model_.clear();
    }
    const QSignalBlocker quiet(spin_);
    spin_->setRange(0, static_cast<int>(runs_->summaries().size()) - 1);
    spin_->setValue(generation_);
    if (loaded_ != generation_) {
        const auto record = runs_->loadGeneration(generation_);
        if (!record) {
            loaded_ = -1;
            model_.clear();
            emit failed(tr("The individuals could not be read"),
                        QString::fromStdString(record.error().message));
            return;
        }
        loaded_ = generation_;
        model_.setGeneration(*record, study::describeSearch(runs_->design().settings().evolution));
        count_->setText(
            tr("%1 individuals, %L2 trials").arg(model_.rowCount()).arg(study::summarize(*record).trials));
    }
    table_->setCurrentRow(individual_);
}

}  // namespace trapwright::pages
