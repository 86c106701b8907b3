#include "ui/feeder/report_charts.h"

#include <QCoreApplication>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/stats/binomial.h"
#include "ui/look/theme.h"
#include "ui/models/numbers.h"

namespace trapwright::feeder {

namespace {

struct Texts {
    Q_DECLARE_TR_FUNCTIONS(ReportCharts)
};

constexpr double kPercent = 100.0;
constexpr double kInch = 150.0;  // [pixels]
constexpr int kTicks = 5;
const QColor kGrid(0xd5, 0xd9, 0xdd);
const QColor kAxis(0x55, 0x5b, 0x61);

/// A frame with a percent scale from `low` to 100, painted into.
class Frame {
 public:
    Frame(QSize pixels, double low) : image_(pixels, QImage::Format_RGB32), low_(low) {
        image_.fill(Qt::white);
        image_.setDotsPerMeterX(static_cast<int>(kInch / 0.0254));
        image_.setDotsPerMeterY(static_cast<int>(kInch / 0.0254));
        painter_.begin(&image_);
        painter_.setRenderHint(QPainter::Antialiasing);
        QFont font = painter_.font();
        font.setPixelSize(static_cast<int>(8.5 / 72.0 * kInch));
        painter_.setFont(font);
        const QFontMetricsF metrics(font, &image_);
        line_ = metrics.height();
        const double left = metrics.horizontalAdvance("100 %") + 10.0;
        area_ = QRectF(left, 2.1 * line_, pixels.width() - left - 24.0, pixels.height() - 5.0 * line_);
        drawScale();
    }

    QPainter& painter() { return painter_; }
    [[nodiscard]] const QRectF& area() const { return area_; }
    [[nodiscard]] double lineHeight() const { return line_; }
    [[nodiscard]] double y(double share) const {
        return area_.bottom() - (kPercent * share - low_) / (kPercent - low_) * area_.height();
    }
    void label(double x, const QString& text) {
        painter_.setPen(Qt::black);
        painter_.drawText(QRectF(x - 100, area_.bottom() + 4, 200, line_), Qt::AlignHCenter, text);
    }
    void titleOfX(const QString& text) {
        painter_.setPen(kAxis);
        painter_.drawText(QRectF(area_.left(), area_.bottom() + 4 + 1.4 * line_, area_.width(), line_),
                          Qt::AlignHCenter, text);
    }
    QImage finish() {
        painter_.end();
        return image_;
    }

 private:
    void drawScale() {
        for (int i = 0; i <= kTicks; ++i) {
            const double value = low_ + i * (kPercent - low_) / kTicks;
            const double at = y(value / kPercent);
            painter_.setPen(QPen(kGrid, 1.0));
            painter_.drawLine(QPointF(area_.left(), at), QPointF(area_.right(), at));
            painter_.setPen(Qt::black);
            painter_.drawText(QRectF(0, at - line_ / 2, area_.left() - 6, line_),
                              Qt::AlignRight | Qt::AlignVCenter, QString("%1 %").arg(value));
        }
        painter_.setPen(QPen(kAxis, 1.5));
        painter_.drawLine(area_.bottomLeft(), area_.bottomRight());
        painter_.drawLine(area_.bottomLeft(), area_.topLeft());
    }

    QImage image_;
    QPainter painter_;
    QRectF area_;
    double line_ = 0.0;
    double low_;
};

/// Below the lowest bound, so that rates near 100 % are told apart; with round ticks above it. [%]
double scaleLow(double lowest) {
    double low = 0.0;
    for (const double one : {50.0, 75.0, 90.0, 95.0})
        if (one < kPercent * lowest) low = one;
    return low;
}

/// A rate with its bounds: a round mark for simulated, a square one for real.
void drawRate(Frame& frame, double x, const study::SuccessCount& count, bool real) {
    if (!count.rate) return;
    QPainter& painter = frame.painter();
    const QColor colour = real ? look::kVermillion : look::kBlue;
    const double rate = *count.rate;
    painter.setPen(QPen(colour, 3.0));
    painter.drawLine(QPointF(x, frame.y(count.bounds.low)), QPointF(x, frame.y(count.bounds.high)));
    for (const double end : {count.bounds.low, count.bounds.high})
        painter.drawLine(QPointF(x - 7, frame.y(end)), QPointF(x + 7, frame.y(end)));
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    const QRectF mark(x - 7, frame.y(rate) - 7, 14, 14);
    if (real) {
        painter.drawRect(mark);
    } else {
        painter.drawEllipse(mark);
    }
}

void drawLegend(Frame& frame, const QString& feeder) {
    QPainter& painter = frame.painter();
    const double line = frame.lineHeight();
    double x = frame.area().left();
    for (const bool real : {false, true}) {
        const QRectF mark(x, line * 0.25, 14, 14);
        painter.setPen(Qt::NoPen);
        painter.setBrush(real ? look::kVermillion : look::kBlue);
        if (real) {
            painter.drawRect(mark);
        } else {
            painter.drawEllipse(mark);
        }
        painter.setPen(Qt::black);
        const QString text = real ? feeder : Texts::tr("Simulated");
        painter.drawText(QPointF(x + 22, line * 0.25 + 13), text);
        x += 50 + painter.fontMetrics().horizontalAdvance(text);
    }
}

}  // namespace

QImage successChart(const study::PhysicalTable& table, const QString& feeder, QSize pixels) {
    std::vector<study::PhysicalRow> rows = table.rows;
    rows.push_back(table.weighted);
    rows.push_back(table.total);
    double lowest = 1.0;
    for (const study::PhysicalRow& row : rows)
        for (const study::SuccessCount* side : {&row.simulated, &row.physical})
            if (side->tally.trials() > 0) lowest = std::min(lowest, side->bounds.low);
    Frame frame(pixels, scaleLow(lowest));
    const double step = frame.area().width() / static_cast<double>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double x = frame.area().left() + (static_cast<double>(i) + 0.5) * step;
        drawRate(frame, x - 0.13 * step, rows[i].simulated, false);
        drawRate(frame, x + 0.13 * step, rows[i].physical, true);
        frame.label(x, rows[i].weighted        ? Texts::tr("weighted")
                       : rows[i].poses.empty() ? Texts::tr("all alike")
                                               : models::poseNumbers(rows[i].poses));
    }
    frame.titleOfX(Texts::tr("Start pose"));
    drawLegend(frame, feeder);
    return frame.finish();
}

QImage courseChart(const study::PhysicalValidation& validation, QSize pixels) {
    const std::size_t count = validation.trials.size();
    std::vector<stats::Interval> bounds;
    std::vector<double> rates;
    int good = 0;
    for (std::size_t i = 0; i < count; ++i) {
        good += validation.trials[i].outcome == trial::Verdict::success ? 1 : 0;
        bounds.push_back(stats::calcClopperPearson(good, static_cast<int>(i) + 1));
        rates.push_back(static_cast<double>(good) / static_cast<double>(i + 1));
    }
    // The first few trials tell little and would take all of the scale.
    double lowest = 1.0;
    for (std::size_t i = count / 4; i < count; ++i)
        lowest = std::min(lowest, bounds[i].low);
    Frame frame(pixels, scaleLow(lowest));
    QPainter& painter = frame.painter();
    const auto x = [&](std::size_t i) {
        return frame.area().left() + frame.area().width() * static_cast<double>(i + 1) /
                                         static_cast<double>(std::max<std::size_t>(count, 1));
    };
    painter.setClipRect(frame.area().adjusted(0, -2, 4, 2));
    QPolygonF band;
    QPolygonF line;
    for (std::size_t i = 0; i < count; ++i) {
        band << QPointF(x(i), frame.y(bounds[i].high));
        line << QPointF(x(i), frame.y(rates[i]));
    }
    for (std::size_t i = count; i-- > 0;)
        band << QPointF(x(i), frame.y(bounds[i].low));
    QColor light = look::kVermillion;
    light.setAlphaF(0.18F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(light);
    painter.drawPolygon(band);
    painter.setPen(QPen(look::kVermillion, 3.0));
    painter.drawPolyline(line);
    painter.setClipping(false);
    painter.setPen(QPen(Qt::black, 2.0));
    for (std::size_t i = 0; i < count; ++i) {
        if (validation.trials[i].outcome == trial::Verdict::success) continue;
        painter.drawLine(QPointF(x(i), frame.area().bottom()), QPointF(x(i), frame.area().bottom() - 12));
    }
    constexpr std::size_t kLabels = 6;
    const std::size_t step = std::max<std::size_t>((count + kLabels - 1) / kLabels, 1);
    for (std::size_t i = step; i <= count; i += step)
        frame.label(x(i - 1), QString::number(i));
    frame.titleOfX(Texts::tr("Trial"));
    return frame.finish();
}

}  // namespace trapwright::feeder
