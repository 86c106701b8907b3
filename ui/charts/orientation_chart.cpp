#include "ui/charts/orientation_chart.h"

#include <QHBoxLayout>
#include <algorithm>
#include <numeric>

#include "core/base/math.h"
#include "ui/charts/legend.h"
#include "ui/charts/plot.h"
#include "ui/charts/pose_bars.h"
#include "ui/charts/sheet_csv.h"

namespace trapwright::charts {

namespace {

constexpr double kPercent = 100.0;
constexpr int kHalfTurn = 180;         // [deg]
constexpr std::size_t kOwnColour = 6;  // poses beyond share one

double percentOf(int count, int all) {
    return all > 0 ? kPercent * count / all : 0.0;
}

int sumOf(const std::vector<int>& counts) {
    return std::accumulate(counts.begin(), counts.end(), 0);
}

/// The share of all angles that are not greater than each whole degree. [%]
std::vector<QPointF> cumulate(const std::vector<double>& angles) {
    std::vector<QPointF> points;
    if (angles.empty()) return points;
    // Beyond the largest angle there is nothing to see but for the line at 100 %.
    for (int degree = 0; degree <= kHalfTurn; ++degree) {
        const auto within = std::upper_bound(angles.begin(), angles.end(), (degree + 1e-9) * base::kDegree);
        points.emplace_back(degree, kPercent * static_cast<double>(within - angles.begin()) /
                                        static_cast<double>(angles.size()));
    }
    return points;
}

/// What is shown of each pose: its own piece, or all rare ones as one.
std::vector<double> piecesOf(const std::vector<int>& counts) {
    const int all = sumOf(counts);
    std::vector<double> pieces;
    for (std::size_t pose = 0; pose < counts.size(); ++pose) {
        const double share = percentOf(counts[pose], all);
        if (pose <= kOwnColour) {
            pieces.push_back(share);
        } else {
            pieces.back() += share;
        }
    }
    return pieces;
}

const CurveStyle kStart{SeriesColour::neutral, Qt::DashLine, Marker::square};
const CurveStyle kFinish{SeriesColour::first, Qt::SolidLine, Marker::circle};

}  // namespace

OrientationChart::OrientationChart(QWidget* parent) : ChartPanel("orientation", tr("Orientation"), parent) {
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    bars_ = new PoseBars(row);
    angles_ = new Plot(row);
    layout->addWidget(bars_, 1);
    layout->addWidget(angles_, 1);
    setBody(row);
    setEmptyText(tr("How parts lie before and after the track appears when its trials are simulated."));
    connect(angles_, &Plot::fitWanted, angles_, &Plot::fit);
    connect(angles_, &Plot::cursorMoved, angles_, &Plot::setCursor);
    applyTheme(theme());
}

void OrientationChart::setShares(study::OrientationShares shares, double tolerance) {
    shares_ = std::move(shares);
    tolerance_ = tolerance;
    update();
}

void OrientationChart::clear() {
    shares_ = {};
    update();
}

void OrientationChart::update() {
    const std::size_t pieces = std::min(shares_.startPoses.size(), kOwnColour + 1);
    const bool rest = shares_.startPoses.size() > pieces;
    std::vector<LegendEntry> entries;
    QStringList names;
    std::vector<SeriesColour> colours;
    for (std::size_t i = 0; i < pieces; ++i) {
        const bool isRest = rest && i + 1 == pieces;
        const auto colour = i < kOwnColour ? static_cast<SeriesColour>(i) : SeriesColour::neutral;
        const QString name = isRest ? tr("other poses") : tr("pose %1").arg(i + 1);
        names.append(name);
        colours.push_back(colour);
        entries.push_back(
            {QStringLiteral("pose%1").arg(i), name, {}, CurveStyle{colour, Qt::NoPen, Marker::square}});
    }
    entries.push_back({"start", tr("start"), tr("As parts are put on the lead-in."), kStart});
    entries.push_back({"finish", tr("finish"), tr("As parts pass the finish line."), kFinish});
    legend()->setEntries(entries);

    bars_->setBars(
        {{tr("start"), piecesOf(shares_.startPoses)}, {tr("finish"), piecesOf(shares_.finalPoses)}}, names,
        colours);

    PlotSheet plot;
    plot.xTitle = tr("Angle to the expected orientation [°]");
    plot.yTitle = tr("Parts within this angle [%]");
    plot.decimals = 1;
    plot.yIncluded = {0.0, kPercent};
    plot.leastWidth = kHalfTurn;
    plot.curves = {
        {tr("start"), tr("Start within [%]"), {"start"}, kStart, cumulate(shares_.startAngles)},
        {tr("finish"), tr("Finish within [%]"), {"finish"}, kFinish, cumulate(shares_.finalAngles)}};
    angles_->setSheet(plot);
    showEmpty(sumOf(shares_.startPoses) == 0);
}

QString OrientationChart::csv() const {
    QString text = tr("Pose") + u',' + tr("Start") + u',' + tr("Finish") + u'\n';
    for (std::size_t pose = 0; pose < shares_.startPoses.size(); ++pose) {
        text += QStringLiteral("%1,%2,%3\n")
                    .arg(pose + 1)
                    .arg(shares_.startPoses[pose])
                    .arg(shares_.finalPoses[pose]);
    }
    return text;
}

void OrientationChart::applyTheme(const ChartTheme& theme) {
    bars_->setTheme(theme);
    angles_->setTheme(theme);
}

}  // namespace trapwright::charts
