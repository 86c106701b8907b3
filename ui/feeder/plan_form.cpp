#include "ui/feeder/plan_form.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRandomGenerator>
#include <QSettings>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/pose_weights.h"
#include "ui/feeder/plan_cards.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

namespace trapwright::feeder {

using session::StudyRuns;

namespace {

constexpr auto kOperatorSetting = "feeder/operator";
constexpr auto kNoteSetting = "feeder/track";
constexpr int kRepetitions = 100;  // as in the paper
constexpr int kMostRepetitions = 10000;
constexpr int kIndividualRole = Qt::UserRole + 1;

}  // namespace

PlanForm::PlanForm(QWidget* parent)
    : QWidget(parent),
      track_(new QComboBox(this)),
      cards_(new PlanCards(this)),
      repetitions_(new QSpinBox(this)),
      order_(new QComboBox(this)),
      operator_(new QLineEdit(this)),
      note_(new QLineEdit(this)),
      total_(new QLabel(this)),
      begin_(new QPushButton(tr("Begin"), this)) {
    const auto name = [](QWidget* widget, const QString& object, const QString& title, const QString& tip) {
        widget->setObjectName(object);
        widget->setAccessibleName(title);
        widget->setToolTip(tip);
    };
    name(track_, "plan.track", tr("Track"), tr("The track that was printed"));
    name(repetitions_, "plan.repetitions", tr("Trials per pose"), tr("The paper made 100"));
    name(order_, "plan.order", tr("Order"),
         tr("Shuffled, a drift of the feeder affects all poses alike; pose after pose is simpler to do"));
    name(operator_, "plan.operator", tr("Operator"), tr("Is named in the report"));
    name(note_, "plan.note", tr("Printed"), tr("Printer, material, finish; is named in the report"));
    total_->setObjectName("plan.total");
    total_->setForegroundRole(QPalette::PlaceholderText);
    begin_->setObjectName("plan.begin");
    begin_->setDefault(true);
    track_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    track_->setMaxVisibleItems(20);
    repetitions_->setRange(1, kMostRepetitions);
    repetitions_->setValue(kRepetitions);
    order_->addItems({tr("Pose after pose"), tr("Shuffled")});
    operator_->setPlaceholderText(tr("Name"));
    note_->setPlaceholderText(tr("Printer, material, finish"));

    auto* form = new QFormLayout;
    form->setRowWrapPolicy(QFormLayout::WrapLongRows);
    form->addRow(tr("Track"), track_);
    form->addRow(tr("Trials per pose"), repetitions_);
    form->addRow(tr("Order"), order_);
    form->addRow(tr("Operator"), operator_);
    form->addRow(tr("Printed"), note_);
    auto* cancel = new QPushButton(tr("Cancel"), this);
    cancel->setObjectName("plan.cancel");
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(total_, 1);
    buttons->addWidget(cancel);
    buttons->addWidget(begin_);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addLayout(form);
    column->addLayout(buttons);
    column->addWidget(cards_);
    column->addStretch(1);
    connect(repetitions_, &QSpinBox::valueChanged, this, &PlanForm::showTotal);
    connect(cards_, &PlanCards::choiceChanged, this, &PlanForm::showTotal);
    connect(cancel, &QPushButton::clicked, this, &PlanForm::cancelled);
    connect(begin_, &QPushButton::clicked, this, &PlanForm::begin);
}

void PlanForm::setRuns(const StudyRuns* runs) {
    runs_ = runs;
    reset();
}

void PlanForm::reset() {
    if (runs_ && runs_->design().part()) {
        cards_->setPart(runs_->design().part(),
                        study::weighPoseGroups(*runs_->design().part(), runs_->design().settings()));
    } else {
        cards_->setPart(nullptr, {});
    }
    cards_->showChoice();
    operator_->setText(QSettings().value(kOperatorSetting).toString());
    note_->setText(QSettings().value(kNoteSetting).toString());
    listTracks();
}

void PlanForm::listTracks() {
    const QVariant generation = track_->currentData();
    const QVariant individual = track_->currentData(kIndividualRole);
    const bool first = track_->currentIndex() <= 0;
    track_->clear();
    if (!runs_) return showTotal();
    const auto add = [this](const study::Individual& winner, const QString& text) {
        track_->addItem(text.arg(winner.generation).arg(winner.individual), winner.generation);
        track_->setItemData(track_->count() - 1, winner.individual, kIndividualRole);
    };
    if (const auto final = runs_->chosen()) add(*final, tr("Final: generation %1, individual %2"));
    const std::vector<study::Individual>& winners = runs_->winners();
    std::for_each(winners.rbegin(), winners.rend(),
                  [&](const study::Individual& winner) { add(winner, tr("Generation %1, individual %2")); });
    // What was picked stays picked.
    for (int i = 0; !first && i < track_->count(); ++i) {
        if (track_->itemData(i) == generation && track_->itemData(i, kIndividualRole) == individual)
            track_->setCurrentIndex(i);
    }
    begin_->setToolTip(winners.empty() ? tr("Learn a track first") : QString());
    showTotal();
}

void PlanForm::showTotal() {
    const int total = static_cast<int>(cards_->chosen().size()) * repetitions_->value();
    total_->setText(tr("%1 trials").arg(total));
    begin_->setEnabled(total > 0 && track_->count() > 0);
}

void PlanForm::begin() {
    study::PhysicalValidation validation;
    validation.plan.poses = cards_->chosen();
    validation.plan.repetitions = repetitions_->value();
    validation.plan.shuffled = order_->currentIndex() == 1;
    validation.plan.seed = QRandomGenerator::global()->generate();
    validation.generation = track_->currentData().toInt();
    validation.individual = track_->currentData(kIndividualRole).toInt();
    validation.operatorName = operator_->text().trimmed().toStdString();
    validation.track = note_->text().trimmed().toStdString();
    QSettings settings;
    settings.setValue(kOperatorSetting, operator_->text().trimmed());
    settings.setValue(kNoteSetting, note_->text().trimmed());
    emit wanted(validation);
}

}  // namespace trapwright::feeder
