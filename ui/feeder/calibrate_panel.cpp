#include "ui/feeder/calibrate_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/feeder/drive_link.h"
#include "ui/look/whole_headers.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"

namespace trapwright::feeder {

using calibration::Estimate;
using calibration::Method;
using session::StudyDesign;
using session::StudyFeeder;
using session::StudyRuns;

namespace {

constexpr std::size_t kTimeField = 2;

QLabel* makeText(const QString& name, QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setObjectName(name);
    label->setWordWrap(true);
    return label;
}

}  // namespace

CalibratePanel::CalibratePanel(DriveLink& link, QWidget* parent)
    : QWidget(parent), link_(link), methods_(methodTexts()), list_(new QComboBox(this)) {
    setObjectName("calibrate");
    setAccessibleName(tr("Calibrate"));
    list_->setObjectName("calibrate.method");
    list_->setAccessibleName(tr("What is measured"));
    for (const MethodText& method : methods_)
        list_->addItem(method.title);

    auto* contents = new QWidget(this);
    auto* row = new QHBoxLayout(contents);
    row->setContentsMargins(8, 8, 8, 8);
    row->setSpacing(16);
    row->addWidget(makeReadings(), 3);
    row->addWidget(makeResult(), 2);
    auto* scroll = new QScrollArea(this);
    scroll->setWidget(contents);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setFocusPolicy(Qt::NoFocus);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(scroll);

    connect(list_, &QComboBox::currentIndexChanged, this, &CalibratePanel::showMethod);
    connect(&link_, &DriveLink::targetChanged, this, [this] {
        if (method().method == Method::conveyingSpeed) showMethod();
        showChanges();
    });
    showMethod();
}

QWidget* CalibratePanel::makeReadings() {
    auto* box = new QWidget(this);
    how_ = makeText("calibrate.how", box);
    add_ = new QPushButton(tr("Add"), box);
    add_->setObjectName("calibrate.add");
    add_->setAccessibleName(tr("Add the reading"));
    watchButton_ = new QPushButton(box);
    watchButton_->setObjectName("calibrate.watch");
    auto* row = new QGridLayout;
    row->setHorizontalSpacing(6);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        titles_[i] = new QLabel(box);
        fields_[i] = new QDoubleSpinBox(box);
        fields_[i]->setObjectName(QString("calibrate.field.%1").arg(i + 1));
        fields_[i]->setAlignment(Qt::AlignRight);
        row->addWidget(titles_[i], 0, static_cast<int>(i));
        row->addWidget(fields_[i], 1, static_cast<int>(i));
    }
    row->addWidget(watchButton_, 1, 3);
    row->addWidget(add_, 1, 4);
    row->setColumnStretch(5, 1);
    table_ = new QTreeWidget(box);
    table_->setObjectName("calibrate.readings");
    table_->setAccessibleName(tr("Readings"));
    table_->setRootIsDecorated(false);
    table_->setUniformRowHeights(true);
    table_->setMinimumHeight(60);
    look::keepHeadersWhole(*table_->header());
    remove_ = new QPushButton(tr("Remove"), box);
    remove_->setObjectName("calibrate.remove");
    remove_->setToolTip(tr("Removes the reading that is selected, or the last one"));
    auto* lower = new QHBoxLayout;
    lower->addWidget(table_, 1);
    lower->addWidget(remove_, 0, Qt::AlignTop);
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(list_, 0, Qt::AlignLeft);
    column->addWidget(how_);
    column->addLayout(row);
    column->addLayout(lower, 1);
    connect(add_, &QPushButton::clicked, this, &CalibratePanel::addReading);
    connect(remove_, &QPushButton::clicked, this, &CalibratePanel::removeReading);
    connect(watchButton_, &QPushButton::clicked, this, &CalibratePanel::toggleWatch);
    return box;
}

QWidget* CalibratePanel::makeResult() {
    auto* box = new QWidget(this);
    result_ = makeText("calibrate.result", box);
    QFont large = result_->font();
    large.setPointSizeF(large.pointSizeF() * 1.3);
    large.setBold(true);
    result_->setFont(large);
    detail_ = makeText("calibrate.detail", box);
    detail_->setForegroundRole(QPalette::PlaceholderText);
    keep_ = new QPushButton(tr("Keep this measurement"), box);
    keep_->setObjectName("calibrate.keep");
    keep_->setToolTip(tr("Saves the readings and their result in the study; changes no setting"));
    changes_ = makeText("calibrate.changes", box);
    apply_ = new QPushButton(box);
    apply_->setObjectName("calibrate.apply");
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(result_);
    column->addWidget(detail_);
    column->addWidget(keep_, 0, Qt::AlignLeft);
    column->addWidget(changes_);
    column->addWidget(apply_, 0, Qt::AlignLeft);
    column->addStretch(1);
    connect(keep_, &QPushButton::clicked, this, &CalibratePanel::keep);
    connect(apply_, &QPushButton::clicked, this, &CalibratePanel::applyWanted);
    return box;
}

void CalibratePanel::setFeeder(StudyFeeder* feeder) {
    if (feeder_) {
        feeder_->disconnect(this);
        feeder_->design().disconnect(this);
        feeder_->runs().disconnect(this);
    }
    feeder_ = feeder;
    readings_.clear();
    speeds_.reset();
    if (feeder_) {
        connect(feeder_, &StudyFeeder::calibrationAdded, this, &CalibratePanel::showChanges);
        connect(&feeder_->design(), &StudyDesign::settingsChanged, this, &CalibratePanel::showChanges);
        connect(&feeder_->runs(), &StudyRuns::stateChanged, this, &CalibratePanel::showChanges);
        connect(feeder_, &StudyFeeder::speedTableReady, this, [this](const calibration::SpeedTable& table) {
            speeds_ = table;
            showResult();
        });
    }
    showMethod();
    showChanges();
}

void CalibratePanel::carry(const study::Settings& settings) {
    carried_ = Carried{feeder_->design().settings(), settings};
}

std::optional<study::Settings> CalibratePanel::takeCarried() {
    const std::optional<Carried> carried = std::exchange(carried_, std::nullopt);
    if (!carried || !feeder_ || !(feeder_->design().settings() == carried->from)) return std::nullopt;
    return carried->to;
}

const MethodText& CalibratePanel::method() const {
    return methods_[static_cast<std::size_t>(std::max(list_->currentIndex(), 0))];
}

calibration::Readings& CalibratePanel::readings() {
    const Method now = method().method;
    return readings_.try_emplace(now, calibration::emptyReadings(now)).first->second;
}

void CalibratePanel::showMethod() {
    const MethodText& now = method();
    how_->setText(now.how);
    QStringList headings;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const bool used = i < now.fields.size();
        titles_[i]->setVisible(used);
        fields_[i]->setVisible(used);
        if (!used) continue;
        const ReadingField& field = now.fields[i];
        titles_[i]->setText(field.title);
        titles_[i]->setBuddy(fields_[i]);
        fields_[i]->setAccessibleName(field.title);
        fields_[i]->setDecimals(field.decimals);
        fields_[i]->setRange(0.0, field.high);
        fields_[i]->setSuffix(' ' + field.unit);
        headings << QString("%1 [%2]").arg(field.title, field.unit);
    }
    const bool speed = now.method == Method::conveyingSpeed;
    watchButton_->setVisible(speed);
    watchButton_->setText(watch_.isValid() ? tr("Stop the watch") : tr("Start the watch"));
    if (speed && link_.linked()) fields_[0]->setValue(link_.target() * now.fields[0].factor);
    if (speed && feeder_ && !speeds_) feeder_->requestSpeedTable();
    table_->setHeaderLabels(headings);
    table_->setColumnCount(static_cast<int>(headings.size()));
    showReadings();
}

void CalibratePanel::showReadings() {
    const MethodText& now = method();
    table_->clear();
    for (const std::vector<double>& numbers : calibration::numbersOf(readings())) {
        QStringList texts;
        for (std::size_t i = 0; i < now.fields.size(); ++i)
            texts << QLocale().toString(now.fields[i].factor * numbers[i], 'f', now.fields[i].decimals);
        table_->addTopLevelItem(new QTreeWidgetItem(texts));
    }
    table_->scrollToBottom();
    remove_->setEnabled(calibration::countReadings(readings()) > 0);
    showResult();
}

std::optional<base::Result<Estimate>> CalibratePanel::estimate() {
    switch (method().method) {
        case Method::tiltUntilSliding:
        case Method::tiltWhileSliding:
            return calibration::estimateFriction(std::get<std::vector<calibration::Tilt>>(readings()));
        case Method::bounceHeight:
            return calibration::estimateRestitutionFromHeights(
                std::get<std::vector<calibration::BounceHeights>>(readings()));
        case Method::bounceTime:
            return calibration::estimateRestitutionFromTimes(
                std::get<std::vector<calibration::BounceTimes>>(readings()));
        case Method::conveyingSpeed: {
            if (!speeds_) return std::nullopt;
            const auto strokes = calibration::estimateHalfStroke(
                std::get<std::vector<calibration::TimedRun>>(readings()), *speeds_);
            if (!strokes) return base::Result<Estimate>(strokes.error());
            return base::Result<Estimate>(strokes->fullHalfStroke);
        }
    }
    return std::nullopt;
}

void CalibratePanel::showResult() {
    const MethodText& now = method();
    const auto found = estimate();
    keep_->setEnabled(feeder_ && found && found->ok());
    result_->setText(now.result);
    const std::size_t count = calibration::countReadings(readings());
    if (count == 0) {
        detail_->setText(tr("No readings yet."));
    } else if (!found) {
        detail_->setText(tr("How quickly the part is conveyed is being simulated..."));
    } else if (!found->ok()) {
        detail_->setText(QString::fromStdString(found->error().message));
    } else {
        result_->setText(QString("%1: %2").arg(now.result, estimateText(**found, now.factor, now.unit)));
        detail_->setText(tr("Mean of %1 readings, with its 95 % interval").arg(count));
    }
}

void CalibratePanel::showChanges() {
    const auto changes =
        feeder_ ? feeder_->calibrationChanges(link_.target()) : std::vector<calibration::Change>();
    const bool locked = feeder_ && feeder_->design().locked();
    QString text;
    for (const calibration::Change& change : changes)
        text += (text.isEmpty() ? "" : "<br>") + changeText(change).toHtmlEscaped();
    if (changes.empty()) {
        text = feeder_ && !feeder_->calibrations().empty()
                   ? tr("The settings are those measured.")
                   : tr("A measurement that is kept can be applied to the settings.");
    } else if (locked) {
        text +=
            "<br>" + tr("The tracks of this study were learned with its settings: a new study takes these.");
    }
    changes_->setText(text);
    apply_->setVisible(!changes.empty());
    apply_->setText(locked ? tr("Apply in a new study") : tr("Apply"));
    apply_->setToolTip(locked ? tr("A new study with the same part, these settings and no generations")
                              : tr("Changes the settings; it can be undone"));
}

void CalibratePanel::addReading() {
    const MethodText& now = method();
    std::vector<double> numbers;
    for (std::size_t i = 0; i < now.fields.size(); ++i)
        numbers.push_back(fields_[i]->value() / now.fields[i].factor);
    calibration::addReading(readings(), numbers);
    fields_[now.fields.size() - 1]->setFocus();
    fields_[now.fields.size() - 1]->selectAll();
    showReadings();
}

void CalibratePanel::removeReading() {
    const std::size_t count = calibration::countReadings(readings());
    if (count == 0) return;
    const int row = table_->indexOfTopLevelItem(table_->currentItem());
    calibration::removeReading(readings(), row < 0 ? count - 1 : static_cast<std::size_t>(row));
    showReadings();
}

void CalibratePanel::toggleWatch() {
    if (watch_.isValid()) {
        fields_[kTimeField]->setValue(1e-3 * static_cast<double>(watch_.elapsed()));
        watch_.invalidate();
    } else {
        watch_.start();
    }
    watchButton_->setText(watch_.isValid() ? tr("Stop the watch") : tr("Start the watch"));
}

void CalibratePanel::keep() {
    const auto found = estimate();
    if (!feeder_ || !found || !found->ok()) return;
    calibration::Calibration calibration;
    calibration.method = method().method;
    calibration.readings = readings();
    calibration.result = **found;
    if (calibration.method == Method::conveyingSpeed)
        calibration.frequency = feeder_->design().settings().simulation.drive.frequency;
    calibration.operatorName = QSettings().value("feeder/operator").toString().toStdString();
    readings() = calibration::emptyReadings(method().method);
    feeder_->addCalibration(std::move(calibration));
    showReadings();
}

}  // namespace trapwright::feeder
