#include "ui/pages/drive_card.h"

#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/study/settings.h"
#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

constexpr int kBarHeight = 8;
constexpr int kMarker = 6;
constexpr double kScaleEnd = 4.0;
constexpr double kLiftOff = 1.0;
// A plastic hop then lasts one whole period: sqrt(1 + pi^2). Above it parts skip periods.
constexpr double kWholePeriod = 3.297;

}  // namespace

ThrowGauge::ThrowGauge(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ThrowGauge::show(double throwNumber) {
    throwNumber_ = throwNumber;
    update();
}

QSize ThrowGauge::sizeHint() const {
    return {200, kMarker + kBarHeight + 4 + fontMetrics().height()};
}

void ThrowGauge::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto place = [&](double value) {
        return kMarker + (width() - 2.0 * kMarker) * std::clamp(value / kScaleEnd, 0.0, 1.0);
    };
    const double top = kMarker + 2.0;
    const struct Zone {
        double from, to;
        double strength;  // of the accent
        QString name;
    } zones[] = {{0.0, kLiftOff, 0.18, tr("slides")},
                 {kLiftOff, kWholePeriod, 0.55, tr("hops")},
                 {kWholePeriod, kScaleEnd, 0.85, tr("skips")}};
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    painter.setFont(small);
    for (const Zone& zone : zones) {
        QColor colour = palette().color(QPalette::Highlight);
        colour.setAlphaF(static_cast<float>(zone.strength));
        const QRectF bar(place(zone.from), top, place(zone.to) - place(zone.from) - 1.0, kBarHeight);
        painter.fillRect(bar, colour);
        painter.setPen(palette().color(QPalette::PlaceholderText));
        painter.drawText(QRectF(bar.left(), bar.bottom() + 1, bar.width(), fontMetrics().height()),
                         Qt::AlignHCenter | Qt::AlignTop | Qt::TextDontClip, zone.name);
    }
    const double x = place(throwNumber_);
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().color(QPalette::WindowText));
    const QPointF marker[] = {{x - kMarker + 1, 0.0}, {x + kMarker - 1, 0.0}, {x, top + 1}};
    painter.drawPolygon(marker, 3);
    painter.fillRect(QRectF(x - 0.75, top, 1.5, kBarHeight), palette().color(QPalette::WindowText));
}

DriveCard::DriveCard(QWidget* parent)
    : QWidget(parent), gauge_(new ThrowGauge(this)), throw_(new QLabel(this)), speed_(new QLabel(this)) {
    throw_->setObjectName("drive.throw");
    throw_->setAccessibleName(tr("Throw number"));
    throw_->setToolTip(tr("Peak vertical acceleration over gravity. Parts lift off above 1."));
    speed_->setObjectName("drive.speed");
    speed_->setAccessibleName(tr("Predicted conveying speed"));
    speed_->setToolTip(
        tr("Of a part that lies flat on a flat track; from a closed solution, not from the simulator."));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 4, 0, 0);
    layout->setSpacing(2);
    layout->addWidget(throw_);
    layout->addWidget(gauge_);
    layout->addWidget(speed_);
}

void DriveCard::show(const study::Settings& settings) {
    const trial::Vibration drive = trial::seenFromTrack(settings.simulation.drive, settings.track.shape);
    const trial::ContactParameters contact = settings.simulation.contact;
    const double gravity = settings.simulation.gravity;
    const double slope = settings.track.shape.slope;
    task_.start([this, drive, contact, gravity, slope]() -> session::NewestTask::Deliver {
        const trial::ConveyingPrediction prediction = trial::predictConveying(drive, contact, gravity, slope);
        return [this, prediction] { tell(prediction); };
    });
}

void DriveCard::tell(const trial::ConveyingPrediction& prediction) {
    const QString number = look::numberText(prediction.throwNumber);
    switch (prediction.conveyance) {
        case trial::Conveyance::sticks:
            throw_->setText(tr("Throw number %1: parts stay where they are").arg(number));
            break;
        case trial::Conveyance::slides:
            throw_->setText(tr("Throw number %1: parts slide").arg(number));
            break;
        case trial::Conveyance::hops:
            throw_->setText(tr("Throw number %1: parts hop").arg(number));
            break;
        case trial::Conveyance::slidesAway:
            throw_->setText(tr("Throw number %1: parts slide down the track").arg(number));
            break;
    }
    gauge_->show(prediction.throwNumber);
    const QString speed = look::numberText(std::abs(prediction.speed) * 1e3, 2);
    if (prediction.conveyance == trial::Conveyance::slidesAway) {
        speed_->setText(tr("Its friction does not hold a part on this slope"));
    } else if (prediction.speed < 0.0) {
        speed_->setText(tr("A flat part moves back at about %1 mm/s").arg(speed));
    } else {
        speed_->setText(tr("A flat part moves at about %1 mm/s").arg(speed));
    }
}

}  // namespace trapwright::pages
