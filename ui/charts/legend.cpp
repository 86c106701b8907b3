#include "ui/charts/legend.h"

#include <QPainter>
#include <algorithm>

#include "ui/charts/curve_style.h"
#include "ui/charts/flow_layout.h"
#include "ui/charts/legend_item.h"

namespace trapwright::charts {

namespace {

constexpr QSize kSampleSize{28, 12};
constexpr int kSpacing = 2;  // between entries on the screen
constexpr int kGap = 6;
constexpr int kEntryGap = 16;

bool sameItems(const std::vector<LegendEntry>& a, const std::vector<LegendEntry>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LegendEntry& x, const LegendEntry& y) {
        return x.key == y.key && x.text == y.text && x.help == y.help && x.sample == y.sample &&
               x.fixed == y.fixed;
    });
}

}  // namespace

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
        const int width = sampleWidth + kGap + metrics.horizontalAdvance(entry.text);
        if (x > rect.left() && x + width > rect.right()) {
            x = rect.left();
            y += lineHeight;
        }
        const QRectF sample(x, y + (lineHeight - kSampleSize.height()) / 2.0, sampleWidth,
                            kSampleSize.height());
        paintSample(painter, sample, *entry.sample, theme_);
        painter.setPen(theme_.text);
        painter.drawText(QRectF(x + sampleWidth + kGap, y, width, lineHeight),
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
