#include "ui/charts/curve_chart.h"

#include <QHBoxLayout>
#include <algorithm>

#include "ui/charts/legend.h"
#include "ui/charts/plot.h"
#include "ui/charts/sheet.h"

namespace trapwright::charts {

namespace {

constexpr double kZoomStep = 1.25;

}  // namespace

CurveChart::CurveChart(const QString& name, const QString& title, QWidget* parent)
    : ChartPanel(name, title, parent), row_(new QWidget), layout_(new QHBoxLayout(row_)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(4);
    setBody(row_);
    connect(legend(), &Legend::switched, this, &CurveChart::updateShown);
    addActions();
}

void CurveChart::setSheet(ChartSheet sheet) {
    sheet_ = std::move(sheet);
    legend()->setEntries(sheet_.legend);
    while (plots_.size() > sheet_.plots.size()) {
        delete plots_.back();
        plots_.pop_back();
    }
    while (plots_.size() < sheet_.plots.size()) {
        auto* plot = new Plot(row_);
        plot->setTheme(theme());
        linkPlot(plot);
        layout_->addWidget(plot, 1);
        plots_.push_back(plot);
    }
    for (std::size_t i = 0; i < plots_.size(); ++i)
        plots_[i]->setSheet(sheet_.plots[i]);
    const bool empty = std::all_of(sheet_.plots.begin(), sheet_.plots.end(), [](const PlotSheet& plot) {
        return std::all_of(plot.curves.begin(), plot.curves.end(),
                           [](const Curve& curve) { return curve.points.empty(); });
    });
    showEmpty(empty);
    updateShown();
}

QString CurveChart::csv() const {
    return toCsv(sheet_);
}

void CurveChart::setShown(const QString& key, bool shown) {
    legend()->setOn(key, shown);
}

void CurveChart::fit() {
    for (Plot* plot : plots_)
        plot->fit();
}

void CurveChart::zoom(double factor) {
    const std::vector<Plot*> shown = shownPlots();
    if (!shown.empty()) shown.front()->zoom(factor);
}

void CurveChart::setCursor(std::optional<double> x) {
    cursor_ = x;
    for (Plot* plot : plots_)
        plot->setCursor(x);
}

std::vector<Plot*> CurveChart::shownPlots() const {
    std::vector<Plot*> shown;
    for (Plot* plot : plots_)
        if (plot->isVisibleTo(row_)) shown.push_back(plot);
    return shown;
}

void CurveChart::applyTheme(const ChartTheme& theme) {
    for (Plot* plot : plots_)
        plot->setTheme(theme);
}

void CurveChart::addActions() {
    const auto add = [this](const QString& text, const QList<QKeySequence>& keys, auto act) {
        auto* action = new QAction(text, this);
        action->setShortcuts(keys);
        // Only in the chart, so no menu shows the key.
        action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        action->setShortcutVisibleInContextMenu(false);
        connect(action, &QAction::triggered, this, act);
        addAction(action);
        return action;
    };
    QAction* fitAction = add(tr("Show all"), {Qt::Key_Home}, [this] { fit(); });
    fitAction->setToolTip(tr("Show everything and follow new generations (double click)"));
    setFitAction(fitAction);
    add(tr("Zoom in"), {Qt::Key_Plus, Qt::Key_Equal}, [this] { zoom(1.0 / kZoomStep); });
    add(tr("Zoom out"), {Qt::Key_Minus}, [this] { zoom(kZoomStep); });
    add(tr("Cursor to the left"), {Qt::Key_Left}, [this] { stepCursor(-1); });
    add(tr("Cursor to the right"), {Qt::Key_Right}, [this] { stepCursor(1); });
    add(tr("Pick the generation at the cursor"), {Qt::Key_Return, Qt::Key_Enter}, [this] {
        if (cursor_) emit picked(static_cast<int>(*cursor_));
        for (Plot* plot : shownPlots())
            plot->pickPoint();
    });
}

void CurveChart::updateShown() {
    bool any = false;
    for (std::size_t i = 0; i < plots_.size(); ++i) {
        const PlotSheet& plot = sheet_.plots[i];
        std::vector<bool> shown;
        for (const Curve& curve : plot.curves) {
            shown.push_back(std::all_of(curve.keys.begin(), curve.keys.end(),
                                        [&](const QString& key) { return legend()->isOn(key); }));
        }
        plots_[i]->setShown(std::move(shown));
        plots_[i]->setVisible(legend()->isOn(plot.key));
        any = any || legend()->isOn(plot.key);
    }
    // The last plot cannot be switched off: there would be nothing to look at.
    if (!any && !plots_.empty()) legend()->setOn(sheet_.plots.front().key, true);
}

void CurveChart::stepCursor(int step) {
    if (!plots_.empty() && plots_.front()->sheet().byPoint) return plots_.front()->stepPoint(step);
    double low = 0.0;
    double high = -1.0;
    for (const PlotSheet& plot : sheet_.plots) {
        for (const Curve& curve : plot.curves) {
            if (curve.points.empty()) continue;
            low = std::min(low, curve.points.front().x());
            high = std::max(high, curve.points.back().x());
        }
    }
    if (high < low) return;
    // From nowhere to the newest generation.
    setCursor(cursor_ ? std::clamp(*cursor_ + step, low, high) : high);
}

void CurveChart::linkPlot(Plot* plot) {
    connect(plot, &Plot::xRangeChanged, this, [this, plot] {
        for (Plot* other : plots_)
            if (other != plot) other->setXRange(plot->xRange());
    });
    connect(plot, &Plot::fitWanted, this, &CurveChart::fit);
    connect(plot, &Plot::cursorMoved, this, &CurveChart::setCursor);
    connect(plot, &Plot::pointPicked, this, &CurveChart::pointPicked);
    connect(plot, &Plot::picked, this, [this](double x) { emit picked(static_cast<int>(x)); });
}

}  // namespace trapwright::charts
