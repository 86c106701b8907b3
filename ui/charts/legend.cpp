#include "ui/charts/legend.h"

#include <QPainter>
#include <QStyleOptionFocusRect>
#include <QStylePainter>

#include <algorithm>
#include <cmath>

#include "ui/charts/curve_style.h"
#include "ui/charts/flow_layout.h"

namespace trapwright::charts {

namespace {

constexpr int kMargin = 3;
constexpr int kGap = 5;
constexpr int kLineSample = 26;
constexpr int kSquareSample = 12;
constexpr double kFaint = 0.35;

constexpr QSize kSampleSize{28, 12};
constexpr int kSpacing = 2;  // between entries on the screen
constexpr int kPaintedGap = 6;
constexpr int kEntryGap = 16;

bool sameItems(const std::vector<LegendEntry>& a, const std::vector<LegendEntry>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LegendEntry& x, const LegendEntry& y) {
        return x.key == y.key && x.text == y.text && x.help == y.help && x.sample == y.sample &&
               x.fixed == y.fixed;
    });
}

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

Legend::Legend(QWidget* parent) : QWidget(parent) {
    setLayout(new FlowLayout(nullptr, kSpacing));
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Minimum);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

void Legend::setEntries(const std::vector<LegendEntry>& entries) {
    const bool same = sameItems(entries, entries_);
    entries_ = entries;
    if (!same) rebuild();
    refresh();
}

void Legend::setTheme(const ChartTheme& theme) {
    theme_ = theme;
    refresh();
}

bool Legend::isOn(const QString& key) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const LegendEntry& entry) { return entry.key == key; });
    return found == entries_.end() || isOn(*found);
}

bool Legend::isOn(const LegendEntry& entry) const {
    return chosen_.value(entry.key, entry.on);
}

void Legend::setOn(const QString& key, bool on) {
    chosen_[key] = on;
    refresh();
    emit switched();
}

int Legend::paint(QPainter& painter, const QRect& rect) const {
    painter.save();
    painter.setFont(font());
    const QFontMetrics metrics(font());
    const int lineHeight = std::max(metrics.height(), kSampleSize.height()) + 4;
    int x = rect.left();
    int y = rect.top();
    for (const LegendEntry& entry : entries_) {
        // What chooses a plot is named at the plot's axis already.
        if (!entry.sample || !isOn(entry)) continue;
        const int sampleWidth = entry.sample->line == Qt::NoPen ? kSampleSize.height() : kSampleSize.width();
        const int width = sampleWidth + kPaintedGap + metrics.horizontalAdvance(entry.text);
        if (x > rect.left() && x + width > rect.right()) {
            x = rect.left();
            y += lineHeight;
        }
        const QRectF sample(x, y + (lineHeight - kSampleSize.height()) / 2.0, sampleWidth,
                            kSampleSize.height());
        paintSample(painter, sample, *entry.sample, theme_);
        painter.setPen(theme_.text);
        painter.drawText(QRectF(x + sampleWidth + kPaintedGap, y, width, lineHeight),
                         Qt::AlignVCenter | Qt::TextDontClip, entry.text);
        x += width + kEntryGap;
    }
    painter.restore();
    return x == rect.left() ? 0 : y + lineHeight - rect.top();
}

void Legend::rebuild() {
    qDeleteAll(items_);
    items_.clear();
    for (const LegendEntry& entry : entries_) {
        auto* item = new LegendItem(entry, this);
        const QString key = entry.key;
        connect(item, &LegendItem::clicked, this, [this, key](bool on) { setOn(key, on); });
        layout()->addWidget(item);
        items_.push_back(item);
    }
    updateGeometry();
}

void Legend::refresh() {
    for (std::size_t i = 0; i < items_.size(); ++i) {
        items_[i]->setChecked(isOn(entries_[i]));
        items_[i]->setTheme(theme_);
    }
}

}  // namespace trapwright::charts
