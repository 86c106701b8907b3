#include "ui/charts/stream_sheet.h"

#include <QCoreApplication>
#include <algorithm>

namespace trapwright::charts {

namespace {

constexpr double kPercent = 100.0;

const CurveStyle kWanted{SeriesColour::first, Qt::SolidLine, Marker::circle};
const CurveStyle kArrived{SeriesColour::second, Qt::DashLine, Marker::square};
const CurveStyle kOffered{SeriesColour::neutral, Qt::DotLine, Marker::none};
const CurveStyle kReturned{SeriesColour::third, Qt::DashDotLine, Marker::triangle};
const CurveStyle kJammed{SeriesColour::third, Qt::SolidLine, Marker::triangle};

QString tr(const char* text) {
    return QCoreApplication::translate("trapwright::charts::StreamSheet", text);
}

stats::Interval positive(const stats::Interval& bounds) {
    return {std::max(0.0, bounds.low), bounds.high};
}

PlotSheet makePlot(const QString& key, const QString& yTitle) {
    PlotSheet plot;
    plot.key = key;
    plot.xTitle = tr("Inflow [1/min]");
    plot.yTitle = yTitle;
    plot.decimals = 1;
    plot.isWhole = false;
    return plot;
}

}  // namespace

ChartSheet streamSheet(const study::Streams& streams) {
    PlotSheet rates = makePlot("rates", tr("Parts a minute"));
    rates.yIncluded = {0.0};
    Curve wanted{tr("as wanted"), tr("As wanted [1/min]"), {"wanted"}, kWanted, {}};
    wanted.bandColumns = {tr("As wanted low [1/min]"), tr("As wanted high [1/min]")};
    Curve arrived{tr("arrive"), tr("Arrive [1/min]"), {"arrived"}, kArrived, {}};
    Curve offered{tr("come"), tr("Come [1/min]"), {"offered"}, kOffered, {}};
    Curve returned{tr("come again"), tr("Come again [1/min]"), {"returned"}, kReturned, {}};
    bool anyReturns = false;
    PlotSheet shares = makePlot("shares", tr("As wanted [%]"));
    shares.yIncluded = {kPercent};
    shares.leastHeight = 4.0;
    Curve share{tr("as wanted"), tr("Share as wanted [%]"), {}, kWanted, {}};
    share.bandColumns = {tr("Share low [%]"), tr("Share high [%]")};
    PlotSheet jams = makePlot("jams", tr("Jammed [%]"));
    jams.yIncluded = {0.0, 5.0};
    Curve jammed{tr("jammed"), tr("Time jammed [%]"), {}, kJammed, {}};
    bool anyJam = false;
    for (const study::StreamResult& result : streams.results) {
        const double x = result.partsPerMinute;
        const stats::MeanEstimate rate = result.rate(&study::StreamCounts::success);
        wanted.points.emplace_back(x, rate.mean);
        wanted.band.push_back(positive(rate.interval));
        arrived.points.emplace_back(x, result.arrivals().mean);
        offered.points.emplace_back(x, x);
        returned.points.emplace_back(x, result.rate(&study::StreamCounts::returned).mean);
        anyReturns = anyReturns || result.sum().returned > 0;
        if (const auto estimate = result.successShare()) {
            share.points.emplace_back(x, kPercent * estimate->mean);
            share.band.push_back({kPercent * estimate->interval.low, kPercent * estimate->interval.high});
        }
        jammed.points.emplace_back(x, kPercent * result.jammedShare());
        anyJam = anyJam || result.sum().jams > 0;
    }
    rates.curves = {std::move(wanted), std::move(arrived), std::move(offered)};
    if (anyReturns) rates.curves.push_back(std::move(returned));
    shares.curves = {std::move(share)};
    jams.curves = {std::move(jammed)};

    ChartSheet sheet;
    sheet.xColumn = tr("Inflow [1/min]");
    sheet.legend = {
        {"wanted", tr("as wanted"),
         tr("Parts that leave the track as wanted, with 95 % bounds over the streams."), kWanted, true, true},
        {"arrived", tr("all that arrive"), tr("Parts that leave the track at its end, however they lie."),
         kArrived},
        {"offered", tr("all that come"), tr("Parts that the bowl delivers."), kOffered},
        {"jams", tr("jams"),
         tr("Time in which nobody arrives, and all on the track or two of them stand still."), std::nullopt,
         anyJam}};
    if (anyReturns)
        sheet.legend.insert(
            sheet.legend.end() - 1,
            {"returned", tr("come again"), tr("Parts that fall off where they come again."), kReturned});
    sheet.plots = {std::move(rates), std::move(shares), std::move(jams)};
    return sheet;
}

}  // namespace trapwright::charts
