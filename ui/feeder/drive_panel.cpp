#include "ui/feeder/drive_panel.h"

#include <QDoubleSpinBox>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <cmath>

#include "ui/feeder/connection_card.h"
#include "ui/feeder/drive_link.h"
#include "ui/feeder/drive_match.h"
#include "ui/feeder/drive_texts.h"
#include "ui/look/folding_group.h"
#include "ui/look/theme.h"
#include "ui/session/study_design.h"

namespace trapwright::feeder {

using drive::State;
using session::StudyDesign;

namespace {

constexpr double kPercent = 100.0;
constexpr double kMillimetre = 1e3;
constexpr int kSliderSteps = 1000;  // of full
enum Readings { Told, ReadBack, Acceleration, HalfStroke, Frequency, Current };

QDoubleSpinBox* makePercent(const QString& name, const QString& title, const QString& help, double low,
                            double high, const QString& unit, QWidget* parent) {
    auto* field = new QDoubleSpinBox(parent);
    field->setObjectName(name);
    field->setAccessibleName(title);
    field->setToolTip(help);
    field->setRange(low, high);
    field->setDecimals(1);
    field->setSuffix(' ' + unit);
    field->setKeyboardTracking(false);
    field->setAlignment(Qt::AlignRight);
    return field;
}

}  // namespace

DrivePanel::DrivePanel(DriveLink& link, QWidget* parent)
    : QWidget(parent),
      link_(link),
      connection_(new ConnectionCard(link, this)),
      match_(new DriveMatch(link, this)),
      state_(new QLabel(this)),
      motion_(new QWidget(this)) {
    state_->setObjectName("feeder.state");
    state_->setAccessibleName(tr("State of the drive"));
    QFont large = state_->font();
    large.setPointSizeF(large.pointSizeF() * 1.3);
    large.setBold(true);
    state_->setFont(large);

    auto* motion = new QVBoxLayout(motion_);
    motion->setContentsMargins(0, 0, 0, 0);
    motion->setSpacing(8);
    motion->addWidget(makeFault());
    motion->addWidget(makeSetPoint());
    motion->addWidget(match_);
    motion->addWidget(makeReadings());

    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(state_);
    column->addWidget(motion_);
    auto* connection = new look::FoldingGroup("feeder.connection", tr("Connection"), false, this);
    connection->body()->addWidget(connection_);
    column->addWidget(connection);
    auto* limits = new look::FoldingGroup("feeder.limits", tr("Limits of this study"), false, this);
    limits->body()->addWidget(makeLimits());
    column->addWidget(limits);

    connect(connection_, &ConnectionCard::failed, this, &DrivePanel::failed);
    connect(&link_, &DriveLink::failed, this, &DrivePanel::failed);
    connect(&link_, &DriveLink::linkChanged, this, [this] {
        showSettings();
        showSnapshot();
    });
    connect(&link_, &DriveLink::polled, this, &DrivePanel::showSnapshot);
    connect(&link_, &DriveLink::stateChanged, this, &DrivePanel::showSnapshot);
    connect(&link_, &DriveLink::targetChanged, this, &DrivePanel::showTarget);
    showSnapshot();
    showTarget();
}

QWidget* DrivePanel::makeSetPoint() {
    auto* box = new QWidget(this);
    setPointRow_ = new QWidget(box);
    slider_ = new QSlider(Qt::Horizontal, setPointRow_);
    slider_->setObjectName("feeder.setPoint.slider");
    slider_->setAccessibleName(tr("Set-point"));
    slider_->setPageStep(kSliderSteps / 20);
    setPoint_ =
        makePercent("feeder.setPoint", tr("Set-point"),
                    tr("Where the drive goes when it is started, as a share of full"), 0, kPercent, "%", box);
    start_ = new QPushButton(tr("Start the drive"), box);
    start_->setObjectName("feeder.start");
    refusal_ = new QLabel(box);
    refusal_->setObjectName("feeder.refusal");
    refusal_->setWordWrap(true);
    auto* row = new QGridLayout(setPointRow_);
    row->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(tr("Set-point"), setPointRow_);
    label->setBuddy(setPoint_);
    row->addWidget(label, 0, 0);
    row->addWidget(setPoint_, 0, 1, Qt::AlignRight);
    row->addWidget(slider_, 1, 0, 1, 2);
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(setPointRow_);
    column->addWidget(start_);
    column->addWidget(refusal_);
    connect(slider_, &QSlider::valueChanged, this,
            [this](int value) { link_.setTarget(static_cast<double>(value) / kSliderSteps); });
    connect(setPoint_, &QDoubleSpinBox::valueChanged, this,
            [this](double value) { link_.setTarget(value / kPercent); });
    connect(setPoint_, &QDoubleSpinBox::editingFinished, this, [this] {
        // Also told when the focus leaves.
        if (setPoint_->hasFocus()) emit setPointGiven();
    });
    connect(start_, &QPushButton::clicked, &link_, &DriveLink::start);
    return box;
}

QWidget* DrivePanel::makeReadings() {
    auto* box = new QWidget(this);
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(2);
    grid->setColumnStretch(1, 1);
    const std::pair<QString, QString> names[] = {{"told", tr("Set-point")},
                                                 {"readBack", tr("Read back")},
                                                 {"acceleration", tr("Acceleration, peak")},
                                                 {"halfStroke", tr("Half-stroke")},
                                                 {"frequency", tr("Frequency")},
                                                 {"current", tr("Current")}};
    for (std::size_t i = 0; i < readings_.size(); ++i) {
        auto* name = new QLabel(names[i].second, box);
        name->setForegroundRole(QPalette::PlaceholderText);
        readings_[i] = new QLabel(box);
        readings_[i]->setObjectName("feeder.reading." + names[i].first);
        readings_[i]->setAccessibleName(names[i].second);
        readings_[i]->setAlignment(Qt::AlignRight);
        grid->addWidget(name, static_cast<int>(i), 0);
        grid->addWidget(readings_[i], static_cast<int>(i), 1);
    }
    return box;
}

QWidget* DrivePanel::makeFault() {
    fault_ = new QFrame(this);
    fault_->setObjectName("feeder.fault");
    faultText_ = new QLabel(fault_);
    faultText_->setObjectName("feeder.fault.text");
    faultText_->setWordWrap(true);
    acknowledge_ = new QPushButton(tr("Acknowledge"), fault_);
    acknowledge_->setObjectName("feeder.acknowledge");
    acknowledge_->setToolTip(tr("The drive may be started again once the fault is gone and it rests"));
    connect(acknowledge_, &QPushButton::clicked, &link_, &DriveLink::acknowledge);
    auto* column = new QVBoxLayout(fault_);
    column->addWidget(faultText_);
    column->addWidget(acknowledge_, 0, Qt::AlignRight);
    return fault_;
}

QWidget* DrivePanel::makeLimits() {
    auto* box = new QWidget(this);
    highest_ = makePercent("feeder.highest", tr("Highest set-point"),
                           tr("The set-point never goes above this share of full"), 1, kPercent, "%", box);
    ramp_ = makePercent("feeder.ramp", tr("Ramp"),
                        tr("How quickly the set-point changes while it runs; a stop is immediate"), 5, 1000,
                        tr("%/s"), box);
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->addWidget(new QLabel(tr("Highest set-point"), box), 0, 0);
    grid->addWidget(highest_, 0, 1, Qt::AlignRight);
    grid->addWidget(new QLabel(tr("Ramp"), box), 1, 0);
    grid->addWidget(ramp_, 1, 1, Qt::AlignRight);
    for (QDoubleSpinBox* field : {highest_, ramp_})
        connect(field, &QDoubleSpinBox::valueChanged, this, &DrivePanel::changeLimits);
    return box;
}

void DrivePanel::setStudy(StudyDesign* design, const session::StudyFeeder* feeder) {
    if (design_) design_->disconnect(this);
    design_ = design;
    match_->setFeeder(feeder);
    setEnabled(design_ != nullptr);
    if (!design_) return;
    connect(design_, &StudyDesign::settingsChanged, this, &DrivePanel::showSettings);
    showSettings();
}

void DrivePanel::refresh() {
    connection_->readProfiles();
}

void DrivePanel::changeLimits() {
    if (!design_) return;
    study::Settings settings = design_->settings();
    settings.feeder.highestSetPoint = highest_->value() / kPercent;
    settings.feeder.rampPerSecond = ramp_->value() / kPercent;
    design_->changeSettings(settings, tr("Limits of the drive"));
}

void DrivePanel::showSettings() {
    if (!design_) return;
    const study::FeederSettings& settings = design_->settings().feeder;
    {
        const QSignalBlocker one(highest_);
        const QSignalBlocker two(ramp_);
        highest_->setValue(kPercent * settings.highestSetPoint);
        ramp_->setValue(kPercent * settings.rampPerSecond);
    }
    setPointRow_->setVisible(!link_.linked() || link_.profile().hasSetPoint());
    showTarget();
}

void DrivePanel::showTarget() {
    const double highest = design_ ? design_->settings().feeder.highestSetPoint : 1.0;
    const QSignalBlocker one(slider_);
    const QSignalBlocker two(setPoint_);
    slider_->setRange(0, static_cast<int>(std::lround(kSliderSteps * highest)));
    slider_->setValue(static_cast<int>(std::lround(kSliderSteps * link_.target())));
    slider_->setToolTip(tr("Up to %1, the limit of this study").arg(shareText(highest)));
    setPoint_->setMaximum(kPercent * highest);
    setPoint_->setValue(kPercent * link_.target());
    showSnapshot();
}

void DrivePanel::showSnapshot() {
    const drive::Snapshot& now = link_.snapshot();
    const bool waiting = link_.linked() && now.state == State::disconnected;
    state_->setText(!now.warning.empty() ? tr("May still be moving")
                    : waiting            ? tr("Connecting...")
                                         : stateText(now.state));
    motion_->setVisible(link_.linked());
    start_->setEnabled(now.state == State::idle && link_.target() > 0.0);
    start_->setToolTip(now.state != State::idle ? tr("The drive must be connected and at rest")
                       : link_.target() > 0.0   ? tr("Ramps up to the set-point")
                                                : tr("Choose a set-point first"));
    refusal_->setText(asSentence(QString::fromStdString(now.refusal)));
    refusal_->setVisible(!now.refusal.empty());

    const drive::Reading& reading = now.reading;
    readings_[Told]->setText(shareText(now.connected ? std::optional(now.command.setPoint) : std::nullopt));
    readings_[ReadBack]->setText(shareText(reading.setPoint));
    readings_[Acceleration]->setText(readingText(reading.acceleration, 1.0, tr("m/s²")));
    readings_[HalfStroke]->setText(readingText(reading.halfStroke, kMillimetre, tr("mm")));
    readings_[Frequency]->setText(readingText(reading.frequency, 1.0, tr("Hz")));
    readings_[Current]->setText(shareText(reading.current));

    const bool faulted = !now.fault.empty() || !now.warning.empty();
    fault_->setVisible(faulted);
    if (!faulted) return;
    acknowledge_->setVisible(now.state == State::faulted);
    const QColor colour = look::toneColour(look::Tone::bad, palette());
    const QString style =
        QString("#feeder\\.fault { border: 2px solid %1; border-radius: 6px; }").arg(colour.name());
    if (style != fault_->styleSheet()) fault_->setStyleSheet(style);
    // What to do comes before how it came about.
    QStringList sentences;
    for (const std::string& text : {now.warning, now.fault}) {
        if (!text.empty()) sentences << asSentence(QString::fromStdString(text));
    }
    faultText_->setText(sentences.join(' '));
}

}  // namespace trapwright::feeder
