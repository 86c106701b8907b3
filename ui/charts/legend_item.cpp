#include "ui/charts/legend_item.h"

#include <QPainter>
#include <QStyleOptionFocusRect>
#include <QStylePainter>
#include <algorithm>
#include <cmath>

#include "ui/charts/curve_style.h"

namespace trapwright::charts {

namespace {

constexpr int kMargin = 3;
constexpr int kGap = 5;
constexpr int kLineSample = 26;
constexpr int kSquareSample = 12;
constexpr double kFaint = 0.35;

}  // namespace

LegendItem::LegendItem(const LegendEntry& entry, QWidget* parent) : QAbstractButton(parent), entry_(entry) {
    setObjectName("legend." + entry.key);
    setText(entry.text);
    setAccessibleName(entry.text);
    setAccessibleDescription(entry.help);
    setToolTip(entry.help);
    setCheckable(!entry.fixed);
    setFocusPolicy(entry.fixed ? Qt::NoFocus : Qt::TabFocus);
    setAttribute(Qt::WA_Hover);
    if (!entry.fixed) setCursor(Qt::PointingHandCursor);
}

void LegendItem::setTheme(const ChartTheme& theme) {
    theme_ = theme;
    update();
}

int LegendItem::sampleWidth() const {
    return !entry_.sample || entry_.sample->line == Qt::NoPen ? kSquareSample : kLineSample;
}

QSize LegendItem::sizeHint() const {
    const QFontMetrics metrics(font());
    return {2 * kMargin + sampleWidth() + kGap + metrics.horizontalAdvance(text()),
            kMargin + std::max(metrics.height(), kSquareSample)};
}

void LegendItem::paintBox(QPainter& painter) const {
    const QRectF box(kMargin + 0.5, std::floor((height() - kSquareSample) / 2.0) + 0.5, kSquareSample - 1,
                     kSquareSample - 1);
    painter.setPen(QPen(theme_.faintText, 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(box, 2.0, 2.0);
    if (!isChecked()) return;
    painter.setPen(QPen(theme_.text, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF{box.topLeft() + QPointF(2.5, 5.5), box.topLeft() + QPointF(4.8, 8.0),
                                   box.topLeft() + QPointF(8.7, 3.0)});
}

void LegendItem::paintEvent(QPaintEvent*) {
    QStylePainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (!entry_.fixed && underMouse()) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(theme_.box);
        painter.drawRoundedRect(rect(), 3.0, 3.0);
    }
    const bool off = isCheckable() && !isChecked();
    if (entry_.sample) {
        painter.setOpacity(off ? kFaint : 1.0);
        paintSample(painter, QRectF(kMargin, 0, sampleWidth(), height()), *entry_.sample, theme_);
    } else {
        paintBox(painter);
    }
    painter.setOpacity(off && entry_.sample ? 2.0 * kFaint : 1.0);
    painter.setPen(theme_.text);
    QFont textFont = font();
    textFont.setStrikeOut(off && entry_.sample);
    painter.setFont(textFont);
    painter.drawText(rect().adjusted(kMargin + sampleWidth() + kGap, 0, 0, 0),
                     Qt::AlignVCenter | Qt::AlignLeft, text());
    if (hasFocus()) {
        QStyleOptionFocusRect focus;
        focus.initFrom(this);
        painter.drawPrimitive(QStyle::PE_FrameFocusRect, focus);
    }
}

}  // namespace trapwright::charts
