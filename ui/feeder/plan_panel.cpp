#include "ui/feeder/plan_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDateTime>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "core/study/physical_table.h"
#include "core/study/pose_weights.h"
#include "ui/feeder/drive_link.h"
#include "ui/feeder/expected_pose.h"
#include "ui/feeder/plan_cards.h"
#include "ui/feeder/plan_form.h"
#include "ui/feeder/trial_guide.h"
#include "ui/look/icon.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"

namespace trapwright::feeder {

using session::StudyDesign;
using session::StudyFeeder;
using session::StudyRuns;

namespace {

constexpr int kExpectedHeight = 220;  // of the picture of a success, with its words
constexpr auto kRestSetting = "feeder/restBetween";

QString dateText(const std::string& utc) {
    const QDateTime time = QDateTime::fromString(QString::fromStdString(utc), Qt::ISODate);
    return QLocale().toString(time.toLocalTime().date(), QLocale::ShortFormat);
}

QScrollArea* scrolled(QWidget* widget) {
    auto* area = new QScrollArea;
    area->setWidget(widget);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    return area;
}

QString inHtml(const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
}

}  // namespace

PlanPanel::PlanPanel(TrialGuide& guide, DriveLink& link, QWidget* parent)
    : QWidget(parent), guide_(guide), stack_(new QStackedWidget(this)) {
    setObjectName("plan");
    setAccessibleName(tr("Plan"));
    stack_->addWidget(scrolled(makeOverview()));
    auto* formPage = new QWidget;
    form_ = new PlanForm(formPage);
    auto* formColumn = new QVBoxLayout(formPage);
    formColumn->setContentsMargins(8, 8, 8, 8);
    formColumn->addWidget(form_);
    stack_->addWidget(scrolled(formPage));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(stack_);

    connect(form_, &PlanForm::cancelled, this, [this] { showForm(false); });
    connect(form_, &PlanForm::wanted, this, [this, &link](study::PhysicalValidation validation) {
        if (link.linked()) validation.drive = link.profile().title;
        guide_.begin(validation);
        showForm(false);
    });
    connect(&guide_, &TrialGuide::chosen, this, &PlanPanel::listValidations);
    connect(&guide_, &TrialGuide::changed, this, &PlanPanel::showProgress);
}

QWidget* PlanPanel::makeOverview() {
    auto* page = new QWidget;
    list_ = new QComboBox(page);
    list_->setObjectName("plan.list");
    list_->setAccessibleName(tr("Validation"));
    list_->setToolTip(tr("The validation that is continued"));
    list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    auto* add = new QPushButton(look::icon("add"), tr("New validation..."), page);
    add->setObjectName("plan.new");
    facts_ = new QLabel(page);
    facts_->setObjectName("plan.facts");
    facts_->setWordWrap(true);
    facts_->setForegroundRole(QPalette::PlaceholderText);
    cards_ = new PlanCards(page);
    expected_ = new ExpectedPose("plan.expected", page);
    expected_->setMinimumHeight(kExpectedHeight);
    auto* rest = new QCheckBox(tr("Rest while parts are placed"), page);
    rest->setObjectName("plan.restBetween");
    rest->setToolTip(tr("The drive stops after each trial and starts with the next one"));
    connect(rest, &QCheckBox::toggled, this, [this](bool on) {
        guide_.setRestBetween(on);
        QSettings().setValue(kRestSetting, on);
    });
    rest->setChecked(QSettings().value(kRestSetting, false).toBool());
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(8, 8, 8, 8);
    column->setSpacing(8);
    column->addWidget(list_);
    column->addWidget(facts_);
    column->addWidget(cards_);
    column->addWidget(expected_);
    column->addWidget(rest);
    column->addWidget(add);
    column->addStretch(1);
    connect(list_, &QComboBox::activated, this,
            [this](int index) { guide_.choose(list_->itemData(index).toInt()); });
    connect(add, &QPushButton::clicked, this, [this] { showForm(true); });
    return page;
}

void PlanPanel::setFeeder(const StudyFeeder* feeder) {
    if (feeder_) feeder_->design().disconnect(this);
    feeder_ = feeder;
    if (feeder_) {
        connect(&feeder_->design(), &StudyDesign::partChanged, form_, &PlanForm::reset);
        connect(&feeder_->design(), &StudyDesign::partChanged, this, &PlanPanel::refresh);
        connect(&feeder_->design(), &StudyDesign::settingsChanged, this, &PlanPanel::refresh);
        connect(&feeder_->runs(), &StudyRuns::chosenChanged, form_, &PlanForm::listTracks);
        connect(&feeder_->runs(), &StudyRuns::generationSaved, form_, &PlanForm::listTracks);
    }
    form_->setRuns(feeder != nullptr ? &feeder->runs() : nullptr);
    refresh();
    showForm(false);
}

void PlanPanel::refresh() {
    if (feeder_ && feeder_->design().part()) {
        cards_->setPart(feeder_->design().part(),
                        study::weighPoseGroups(*feeder_->design().part(), feeder_->design().settings()));
    } else {
        cards_->setPart(nullptr, {});
    }
    listValidations();
    showProgress();
}

void PlanPanel::listValidations() {
    const QSignalBlocker blocker(list_);
    list_->clear();
    if (feeder_) {
        const auto& all = feeder_->physicalValidations();
        std::for_each(all.rbegin(), all.rend(), [this](const study::PhysicalValidation& one) {
            list_->addItem(tr("Validation %1, %2").arg(one.number + 1).arg(dateText(one.started)),
                           one.number);
        });
    }
    list_->setVisible(list_->count() > 0);
    if (const study::PhysicalValidation* now = guide_.validation())
        list_->setCurrentIndex(list_->findData(now->number));
    showProgress();
}

void PlanPanel::showProgress() {
    const study::PhysicalValidation* now = guide_.validation();
    // While a study is closed, the guide still has its validation.
    const bool shown = now != nullptr && feeder_ != nullptr;
    cards_->setVisible(shown);
    expected_->setVisible(shown);
    if (!shown) {
        return facts_->setText(
            feeder_ && feeder_->runs().winners().empty()
                ? tr("Learn a track, print it, mount it: then it can be validated here.")
                : tr("The printed track is validated on the real feeder: the part is placed in each stable "
                     "pose many times (poses that look the same are one), and how each trial ends is "
                     "counted. Plan that first."));
    }
    const QString who = inHtml(now->operatorName);
    const QString track = tr("generation %1, individual %2").arg(now->generation).arg(now->individual);
    QString text = tr("Track: %1").arg(track);
    if (!now->track.empty()) text += "<br>" + inHtml(now->track);
    if (!who.isEmpty()) text += "<br>" + tr("Operator: %1").arg(who);
    text += "<br>" + tr("%1 of %2 trials, %3")
                         .arg(guide_.made())
                         .arg(guide_.total())
                         .arg(now->plan.shuffled ? tr("shuffled") : tr("pose after pose"));
    facts_->setText(text);

    std::vector<PoseProgress> progress;
    const study::PhysicalTable table = study::comparePhysical(
        nullptr, *now, study::weighPoseGroups(*feeder_->design().part(), feeder_->design().settings()));
    for (const study::PhysicalRow& row : table.rows)
        progress.push_back(
            {row.poses.front(), row.physical.tally.trials(), row.planned, row.physical.tally.failures()});
    cards_->showProgress(progress, guide_.pose());
}

void PlanPanel::showForm(bool form) {
    if (form) form_->reset();
    stack_->setCurrentIndex(form ? 1 : 0);
}

}  // namespace trapwright::feeder
