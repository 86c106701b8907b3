#pragma once

#include <QAbstractButton>
#include <QMap>
#include <QWidget>

#include <vector>

#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

namespace trapwright::charts {

/// An entry of a legend: a sample of its curves and its name, both faint while it is off; what chooses a plot
/// has a check box for a sample.
class LegendItem : public QAbstractButton {
    Q_OBJECT
 public:
    LegendItem(const LegendEntry& entry, QWidget* parent);

    void setTheme(const ChartTheme& theme);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    [[nodiscard]] int sampleWidth() const;
    void paintBox(QPainter& painter) const;

    LegendEntry entry_;
    ChartTheme theme_;
};

class LegendItem;

/// The entries of a chart that switch what they stand for on and off. What the user switched stays
/// so when the entries are set again.
class Legend : public QWidget {
    Q_OBJECT
 public:
    explicit Legend(QWidget* parent);

    void setEntries(const std::vector<LegendEntry>& entries);
    void setTheme(const ChartTheme& theme);

    /// True for keys that are no entry.
    [[nodiscard]] bool isOn(const QString& key) const;
    /// As the user would: remembered.
    void setOn(const QString& key, bool on);

    /// Draws the entries that are on, in lines from the top of the rectangle; returns the height that they
    /// take.
    int paint(QPainter& painter, const QRect& rect) const;

 signals:
    void switched();

 private:
    [[nodiscard]] bool isOn(const LegendEntry& entry) const;
    void rebuild();
    void refresh();

    std::vector<LegendEntry> entries_;
    std::vector<LegendItem*> items_;  // slot i for entry i
    QMap<QString, bool> chosen_;
    ChartTheme theme_;
};

}  // namespace trapwright::charts
