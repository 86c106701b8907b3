#include "ui/feeder/drive_match.h"

#include <QCoreApplication>
#include <QEvent>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/feeder/drive_link.h"
#include "ui/feeder/drive_texts.h"
#include "ui/look/icon.h"
#include "ui/look/theme.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"

namespace trapwright::feeder {

using calibration::Deviation;
using calibration::DriveComparison;
using calibration::StrokeSource;
using session::StudyDesign;
using session::StudyFeeder;

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(DriveMatch)
};

constexpr double kMillimetre = 1e3;
constexpr double kPercent = 100.0;
constexpr int kSign = 16;
const QString kNothing = QStringLiteral("–");

QString strokeText(double metres) {
    return Texts::tr("%1 mm").arg(QLocale().toString(kMillimetre * metres, 'f', 2));
}

QString frequencyText(double hertz) {
    return Texts::tr("%1 Hz").arg(QLocale().toString(hertz, 'f', 1));
}

/// "25 % less"
QString moreOrLess(const Deviation& deviation) {
    const QString percent = QLocale().toString(kPercent * std::abs(deviation.share()), 'f', 0);
    return deviation.share() > 0.0 ? Texts::tr("%1 % more").arg(percent)
                                   : Texts::tr("%1 % less").arg(percent);
}

QString differenceCell(const std::optional<Deviation>& deviation) {
    if (!deviation) return kNothing;
    const double percent = kPercent * deviation->share();
    if (std::abs(percent) < 0.5) return Texts::tr("same");
    return QString("%1%2 %").arg(percent > 0.0 ? "+" : "−", QLocale().toString(std::abs(percent), 'f', 0));
}

}  // namespace

QString differenceText(const DriveComparison& comparison) {
    QStringList sentences;
    if (comparison.halfStroke && comparison.halfStroke->large()) {
        const Deviation& stroke = *comparison.halfStroke;
        sentences << Texts::tr("The drive makes a half-stroke of %1; the study simulated %2 (%3).")
                         .arg(strokeText(stroke.drive), strokeText(stroke.simulated), moreOrLess(stroke));
    }
    if (comparison.frequency && comparison.frequency->large()) {
        const Deviation& frequency = *comparison.frequency;
        sentences << Texts::tr("The drive vibrates at %1; the study simulated %2 (%3).")
                         .arg(frequencyText(frequency.drive), frequencyText(frequency.simulated),
                              moreOrLess(frequency));
    }
    return sentences.join(' ');
}

QString strokeSourceText(StrokeSource source) {
    switch (source) {
        case StrokeSource::unknown:
            return Texts::tr(
                "The half-stroke of this drive is not known: it does not measure it, and it has not "
                "been calibrated. Measure it under Calibrate, Conveying speed.");
        case StrokeSource::otherFrequency:
            return Texts::tr(
                "The half-stroke of this drive is not known at this frequency: it was calibrated at "
                "another one. Measure it again under Calibrate, Conveying speed.");
        case StrokeSource::measured:
            return Texts::tr("Half-stroke measured by the drive");
        case StrokeSource::calibrated:
            return Texts::tr("Half-stroke by calibration");
        case StrokeSource::profile:
            return Texts::tr("Half-stroke by the drive's profile");
    }
    return {};
}

DriveMatch::DriveMatch(DriveLink& link, QWidget* parent)
    : QWidget(parent), link_(link), source_(new QLabel(this)), warning_(new QFrame(this)) {
    setObjectName("feeder.match");
    source_->setObjectName("feeder.match.source");
    source_->setWordWrap(true);
    source_->setForegroundRole(QPalette::PlaceholderText);
    makeWarning();
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addWidget(warning_);
    column->addWidget(makeNumbers());
    column->addWidget(source_);
    for (const auto signal :
         {&DriveLink::linkChanged, &DriveLink::polled, &DriveLink::stateChanged, &DriveLink::targetChanged})
        connect(&link_, signal, this, &DriveMatch::refresh);
    refresh();
}

QWidget* DriveMatch::makeNumbers() {
    auto* box = new QWidget(this);
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(2);
    grid->setHorizontalSpacing(10);
    const auto add = [&](const QString& text, int row, int column) {
        auto* label = new QLabel(text, box);
        label->setForegroundRole(QPalette::PlaceholderText);
        label->setAlignment(column == 0 ? Qt::AlignLeft : Qt::AlignRight);
        grid->addWidget(label, row, column);
    };
    const QString heads[] = {tr("Drive"), tr("Simulated"), tr("Difference")};
    for (int column = 0; column < 3; ++column)
        add(heads[column], 0, column + 1);
    const std::pair<QString, QString> rows[] = {{"halfStroke", tr("Half-stroke")},
                                                {"frequency", tr("Frequency")}};
    const QString cells[] = {"drive", "simulated", "difference"};
    for (int row = 0; row < 2; ++row) {
        add(rows[row].second, row + 1, 0);
        for (int column = 0; column < 3; ++column) {
            auto* cell = new QLabel(box);
            cell->setObjectName(QString("feeder.match.%1.%2").arg(rows[row].first, cells[column]));
            cell->setAccessibleName(QString("%1, %2").arg(rows[row].second, heads[column]));
            cell->setAlignment(Qt::AlignRight);
            grid->addWidget(cell, row + 1, column + 1);
            numbers_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = cell;
        }
    }
    grid->setColumnStretch(0, 1);
    return box;
}

void DriveMatch::makeWarning() {
    warning_->setObjectName("feeder.match.warning");
    warning_->setAccessibleName(tr("Drive and study differ"));
    sign_ = new QLabel(warning_);
    text_ = new QLabel(warning_);
    text_->setObjectName("feeder.match.text");
    text_->setWordWrap(true);
    set_ = new QPushButton(warning_);
    set_->setObjectName("feeder.match.set");
    auto* dismiss = new QPushButton(tr("Dismiss"), warning_);
    dismiss->setObjectName("feeder.match.dismiss");
    dismiss->setToolTip(
        tr("Until the set-point, the drive or the study is another. The report tells the "
           "difference all the same"));
    connect(set_, &QPushButton::clicked, this, &DriveMatch::takeSetPoint);
    connect(dismiss, &QPushButton::clicked, this, [this] {
        dismissed_ = now();
        refresh();
    });
    auto* buttons = new QHBoxLayout;
    buttons->addStretch(1);
    buttons->addWidget(set_);
    buttons->addWidget(dismiss);
    auto* grid = new QGridLayout(warning_);
    grid->setContentsMargins(8, 8, 8, 8);
    grid->addWidget(sign_, 0, 0, Qt::AlignTop);
    grid->addWidget(text_, 0, 1);
    grid->addLayout(buttons, 1, 0, 1, 2);
    grid->setColumnStretch(1, 1);
}

void DriveMatch::setFeeder(const StudyFeeder* feeder) {
    if (feeder_) {
        feeder_->disconnect(this);
        feeder_->design().disconnect(this);
    }
    feeder_ = feeder;
    dismissed_ = {};
    if (feeder_) {
        connect(&feeder_->design(), &StudyDesign::settingsChanged, this, &DriveMatch::refresh);
        connect(feeder_, &StudyFeeder::calibrationAdded, this, &DriveMatch::refresh);
    }
    refresh();
}

void DriveMatch::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) refresh();
}

DriveMatch::Seen DriveMatch::now() const {
    if (!feeder_) return {};
    const trial::Vibration& simulated = feeder_->design().settings().simulation.drive;
    return {QString::fromStdString(link_.profile().title), link_.target(), simulated.halfStroke,
            simulated.frequency};
}

void DriveMatch::takeSetPoint() {
    link_.setTarget(setPoint_);
}

void DriveMatch::refresh() {
    const bool shown = feeder_ && link_.linked() && link_.snapshot().connected && link_.target() > 0.0;
    setVisible(shown);
    if (!shown) return;
    const calibration::DriveSetting setting = link_.setting();
    const DriveComparison comparison = link_.comparison();
    const trial::Vibration& simulated = feeder_->design().settings().simulation.drive;
    numbers_[0][0]->setText(setting.halfStroke ? strokeText(*setting.halfStroke) : kNothing);
    numbers_[0][1]->setText(strokeText(simulated.halfStroke));
    numbers_[0][2]->setText(differenceCell(comparison.halfStroke));
    numbers_[1][0]->setText(setting.frequency ? frequencyText(*setting.frequency) : kNothing);
    numbers_[1][1]->setText(frequencyText(simulated.frequency));
    numbers_[1][2]->setText(differenceCell(comparison.frequency));
    QString source = strokeSourceText(setting.source);
    if (!setting.frequency) source += ' ' + tr("The drive does not tell its frequency.");
    source_->setText(source);
    showWarning(comparison, setting);
}

void DriveMatch::showWarning(const DriveComparison& comparison, const calibration::DriveSetting& setting) {
    warning_->setVisible(comparison.differs() && dismissed_ != now());
    if (warning_->isHidden()) return;
    const QColor colour = look::toneColour(look::Tone::warning, palette());
    const QString style =
        QString("#feeder\\.match\\.warning { border: 2px solid %1; border-radius: 6px; }").arg(colour.name());
    if (style != warning_->styleSheet()) {
        warning_->setStyleSheet(style);
        sign_->setPixmap(look::signPixmap("warning", colour, kSign, devicePixelRatioF()));
    }
    const double simulated = feeder_->design().settings().simulation.drive.halfStroke;
    const double highest = feeder_->design().settings().feeder.highestSetPoint;
    const bool stroke = comparison.halfStroke && comparison.halfStroke->large();
    const auto wanted = stroke ? setting.setPointFor(simulated) : std::nullopt;
    const bool settable = wanted && link_.profile().hasSetPoint() && *wanted <= highest;
    QString text =
        differenceText(comparison) + ' ' + tr("Parts will not move as they did in the simulation.");
    if (stroke && wanted && link_.profile().hasSetPoint() && !settable) {
        text += ' ' + tr("%1 would need a set-point of %2; the limit of this study is %3.")
                          .arg(strokeText(simulated), shareText(wanted), shareText(highest));
    }
    if (!settable) text += ' ' + tr("Learn or validate again with the drive's values.");
    text_->setText(text);
    set_->setVisible(settable);
    if (!settable) return;
    setPoint_ = *wanted;
    set_->setText(tr("Set %1").arg(shareText(wanted)));
    set_->setToolTip(tr("The set-point at which the half-stroke is %1").arg(strokeText(simulated)));
}

}  // namespace trapwright::feeder
