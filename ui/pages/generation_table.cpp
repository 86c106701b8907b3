#include "ui/pages/generation_table.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

#include "core/study/track_design.h"
#include "ui/pages/details_button.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::pages {

using session::StudyRuns;

GenerationTable::GenerationTable(QWidget* parent)
    : QWidget(parent),
      table_(
          new RecordTable("generations", tr("Generations"),
                          tr("Each generation gets a row as soon as it is complete. Start learning with F5."),
                          model_, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(table_);
    table_->setHead(makeHead());
    table_->sortBy(models::GenerationModel::Generation, Qt::DescendingOrder);
    connect(table_, &RecordTable::picked, this,
            [this](int row) { emit picked(model_.rows()[static_cast<std::size_t>(row)].summary.index); });
    connect(table_, &RecordTable::failed, this, &GenerationTable::failed);
}

QWidget* GenerationTable::makeHead() {
    auto* head = new QWidget(this);
    auto* text = new QLabel(tr("The winner of each generation"), head);
    text->setForegroundRole(QPalette::PlaceholderText);
    auto* layout = new QHBoxLayout(head);
    layout->setContentsMargins(12, 4, 12, 4);
    layout->setSpacing(8);
    layout->addWidget(text, 1);
    layout->addWidget(new DetailsButton(table_->view(), models::GenerationModel::firstDetail(), head));
    head->hide();
    connect(&model_, &QAbstractItemModel::modelReset, head,
            [this, head] { head->setVisible(model_.rowCount() > 0); });
    connect(&model_, &QAbstractItemModel::rowsInserted, head, [head] { head->show(); });
    return head;
}

void GenerationTable::setRuns(const StudyRuns* runs) {
    if (runs_) runs_->disconnect(this);
    runs_ = runs;
    if (!runs_) return model_.setGenerations({}, {}, {});
    model_.setGenerations(runs_->summaries(), runs_->checks(),
                          study::describeSearch(runs_->design().settings().evolution));
    connect(runs_, &StudyRuns::generationSaved, this, [this] { model_.append(runs_->summaries().back()); });
    connect(runs_, &StudyRuns::checkSaved, this, [this] { model_.setCheck(runs_->checks().back()); });
}

void GenerationTable::setCurrent(int generation) {
    const bool known = generation >= 0 && generation < model_.rowCount();
    table_->setCurrentRow(known ? generation : -1);
}

}  // namespace trapwright::pages
