#include "ui/charts/orientation_chart.h"

#include <QHBoxLayout>
#include <algorithm>

#include "core/base/math.h"
#include "core/part/stable_poses.h"
#include "ui/charts/legend.h"
#include "ui/charts/plot.h"
#include "ui/charts/pose_bars.h"
#include "ui/look/text.h"

namespace trapwright::charts {

namespace {

constexpr double kPercent = 100.0;
constexpr int kHalfTurn = 180;         // [deg]
constexpr std::size_t kOwnColour = 6;  // kinds of poses beyond share one

/// A piece of the bars: alike poses, or all that have no colour of their own.
struct Piece {
    QString name;
    SeriesColour colour = SeriesColour::neutral;
    int start = 0;
    int finish = 0;
};

/// "poses 1–6", counted from 1.
QString nameOf(const study::PoseShare& share) {
    return (share.poses.size() > 1 ? OrientationChart::tr("poses %1") : OrientationChart::tr("pose %1"))
        .arg(QString::fromStdString(part::namePoses(share.poses)).replace(u'-', u'–'));
}

/// "1 2": what a spreadsheet does not take for a date.
QString spaced(const std::vector<int>& poses) {
    QStringList numbers;
    for (const int pose : poses)
        numbers.append(QString::number(pose + 1));
    return numbers.join(u' ');
}

/// The share of all angles that are not greater than each whole degree. [%]
std::vector<QPointF> cumulate(const std::vector<double>& angles) {
    std::vector<QPointF> points;
    if (angles.empty()) return points;
    for (int degree = 0; degree <= kHalfTurn; ++degree) {
        const auto within = std::upper_bound(angles.begin(), angles.end(), (degree + 1e-9) * base::kDegree);
        points.emplace_back(degree, kPercent * static_cast<double>(within - angles.begin()) /
                                        static_cast<double>(angles.size()));
    }
    return points;
}

std::vector<double> percentages(const std::vector<Piece>& pieces, int Piece::*count) {
    int all = 0;
    for (const Piece& piece : pieces)
        all += piece.*count;
    std::vector<double> shares;
    shares.reserve(pieces.size());
    for (const Piece& piece : pieces)
        shares.push_back(all > 0 ? kPercent * piece.*count / all : 0.0);
    return shares;
}

const CurveStyle kStart{SeriesColour::neutral, Qt::DashLine, Marker::square};
const CurveStyle kTolerance{SeriesColour::neutral, Qt::DotLine, Marker::none};
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
    bars_->setTheme(theme());
    angles_->setTheme(theme());
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
    std::vector<Piece> pieces;
    for (const study::PoseShare& share : shares_.poses) {
        if (pieces.size() < kOwnColour) {
            pieces.push_back(
                {nameOf(share), static_cast<SeriesColour>(pieces.size()), share.start, share.finish});
            continue;
        }
        if (pieces.size() == kOwnColour) pieces.push_back({tr("other poses")});
        pieces.back().start += share.start;
        pieces.back().finish += share.finish;
    }
    std::vector<LegendEntry> entries;
    QStringList names;
    std::vector<SeriesColour> colours;
    for (const Piece& piece : pieces) {
        names.append(piece.name);
        colours.push_back(piece.colour);
        entries.push_back({piece.name, piece.name, tr("Poses that look the same are one."),
                           CurveStyle{piece.colour, Qt::NoPen}, true, true});
    }
    entries.push_back({"start", tr("start"), tr("As parts are put on the lead-in."), kStart, true, true});
    entries.push_back({"finish", tr("finish"), tr("As parts pass the finish line."), kFinish, true, true});
    entries.push_back({"tolerance", tr("tolerance %1°").arg(tolerance_ / base::kDegree, 0, 'g', 3),
                       tr("Parts that finish within this angle count as successes."), kTolerance, true,
                       true});
    legend()->setEntries(entries);
    bars_->setBars({{tr("start"), percentages(pieces, &Piece::start)},
                    {tr("finish"), percentages(pieces, &Piece::finish)}},
                   names, colours);

    PlotSheet plot;
    plot.xTitle = tr("Angle to the expected orientation [°]");
    plot.yTitle = tr("Parts within this angle [%]");
    plot.yShortTitle = tr("Parts [%]");
    plot.decimals = 1;
    plot.yIncluded = {0.0, kPercent};
    plot.leastWidth = kHalfTurn;
    plot.mark = XMark{tolerance_ / base::kDegree, kTolerance};
    plot.curves = {
        {tr("start"), tr("Start within [%]"), {"start"}, kStart, cumulate(shares_.startAngles)},
        {tr("finish"), tr("Finish within [%]"), {"finish"}, kFinish, cumulate(shares_.finishAngles)}};
    angles_->setSheet(plot);
    showEmpty(shares_.startAngles.empty());
}

QString OrientationChart::csv() const {
    QString text =
        QStringList{tr("Stable poses"), tr("Parts at the start"), tr("Parts at the finish")}.join(u',') +
        u'\n';
    for (const study::PoseShare& share : shares_.poses)
        text += QStringLiteral("%1,%2,%3\n")
                    .arg(look::csvField(spaced(share.poses)))
                    .arg(share.start)
                    .arg(share.finish);
    return text;
}

void OrientationChart::applyTheme(const ChartTheme& theme) {
    bars_->setTheme(theme);
    angles_->setTheme(theme);
}

}  // namespace trapwright::charts
