#include "ui/charts/legend.h"

#include <QPainter>
#include <QToolButton>
#include <algorithm>

#include "ui/charts/curve_style.h"
#include "ui/charts/flow_layout.h"

namespace trapwright::charts {

namespace {

constexpr QSize kSampleSize{28, 12};
constexpr int kGap = 6;
constexpr int kEntryGap = 16;

bool sameButtons(const std::vector<LegendEntry>& a, const std::vector<LegendEntry>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LegendEntry& x, const LegendEntry& y) {
        return x.key == y.key && x.text == y.text && x.help == y.help && x.sample == y.sample;
    });
}

}  // namespace

Legend::Legend(QWidget* parent) : QWidget(parent) {
    setLayout(new FlowLayout(nullptr, 2));
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Minimum);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

void Legend::setEntries(const std::vector<LegendEntry>& entries) {
    const bool same = sameButtons(entries, entries_);
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
    qDeleteAll(buttons_);
    buttons_.clear();
    for (const LegendEntry& entry : entries_) {
        auto* button = new QToolButton(this);
        button->setObjectName("legend." + entry.key);
        button->setText(entry.text);
        button->setAccessibleName(entry.text);
        button->setToolTip(entry.help);
        button->setAccessibleDescription(entry.help);
        button->setCheckable(true);
        button->setAutoRaise(entry.sample.has_value());
        button->setToolButtonStyle(entry.sample ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonTextOnly);
        button->setIconSize(entry.sample && entry.sample->line == Qt::NoPen
                                ? QSize(kSampleSize.height(), kSampleSize.height())
                                : kSampleSize);
        const QString key = entry.key;
        connect(button, &QToolButton::clicked, this, [this, key](bool on) { setOn(key, on); });
        layout()->addWidget(button);
        buttons_.push_back(button);
    }
    updateGeometry();
}

void Legend::refresh() {
    for (std::size_t i = 0; i < buttons_.size(); ++i) {
        buttons_[i]->setChecked(isOn(entries_[i]));
        if (entries_[i].sample) buttons_[i]->setIcon(sampleIcon(*entries_[i].sample, theme_));
    }
}

}  // namespace trapwright::charts
