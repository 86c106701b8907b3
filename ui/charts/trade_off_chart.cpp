#include "ui/charts/trade_off_chart.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <memory>

#include "ui/look/text.h"

namespace trapwright::charts {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(TradeOffChart)
};

const CurveStyle kFront{SeriesColour::first, Qt::NoPen, Marker::circle};
const CurveStyle kBorder{SeriesColour::first, Qt::SolidLine, Marker::none};
const CurveStyle kAll{SeriesColour::neutral, Qt::NoPen, Marker::dot};
const CurveStyle kMeasured{SeriesColour::third, Qt::NoPen, Marker::square};
const CurveStyle kShown{SeriesColour::second, Qt::NoPen, Marker::diamond};

// Places in the sheet.
constexpr std::size_t kFrontCurve = 2;
constexpr std::size_t kMeasuredCurve = 3;

/// "Purity [nines]"
QString titleOf(const objectives::Objective& objective) {
    const QString unit = look::fromUtf8(objective.unit);
    return unit.isEmpty() ? look::fromUtf8(objective.name)
                          : QStringLiteral("%1 [%2]").arg(look::fromUtf8(objective.name), unit);
}

QString nameOf(const study::IndividualId& track) {
    return Text::tr("Generation %1, individual %2").arg(track.generation).arg(track.individual);
}

/// Names points by these tracks; copies share them.
std::function<QString(std::size_t)> namedBy(std::vector<study::IndividualId> tracks) {
    return [shared = std::make_shared<const std::vector<study::IndividualId>>(std::move(tracks))](
               std::size_t i) { return nameOf((*shared)[i]); };
}

QPointF placeOf(const TradeOff& tradeOff, const study::ScorePair& track) {
    return {track.first * tradeOff.across->shownAs, track.second * tradeOff.up->shownAs};
}

Curve scattered(const QString& name, const QString& key, const CurveStyle& style) {
    Curve curve;
    curve.name = name;
    curve.keys = {key};
    curve.style = style;
    curve.isScattered = true;
    return curve;
}

/// From one point of the front to the next by way of what is no better than either.
std::vector<QPointF> makeBorder(const TradeOff& tradeOff, std::vector<QPointF> front) {
    std::ranges::sort(front, {}, &QPointF::x);
    const auto worse = [](const objectives::Objective& objective, double a, double b) {
        return objective.moreIsBetter ? std::min(a, b) : std::max(a, b);
    };
    std::vector<QPointF> border;
    for (const QPointF& point : front) {
        if (!border.empty()) {
            const QPointF last = border.back();
            border.emplace_back(worse(*tradeOff.across, last.x(), point.x()),
                                worse(*tradeOff.up, last.y(), point.y()));
        }
        border.push_back(point);
    }
    return border;
}

}  // namespace

ChartSheet tradeOffSheet(const TradeOff& tradeOff) {
    PlotSheet plot;
    plot.key = "tradeOff";
    plot.xTitle = titleOf(*tradeOff.across);
    plot.yTitle = titleOf(*tradeOff.up);
    if (!tradeOff.up->unit.empty())
        plot.yShortTitle = QStringLiteral("[%1]").arg(look::fromUtf8(tradeOff.up->unit));
    plot.decimals = std::max(tradeOff.across->decimals, tradeOff.up->decimals);
    plot.isWhole = false;
    plot.byPoint = true;
    plot.leastWidth = plot.leastHeight = std::pow(10.0, 1 - plot.decimals);

    Curve front = scattered(Text::tr("Pareto front"), "front", kFront);
    std::vector<study::IndividualId> onFront;
    for (const std::size_t i : tradeOff.front) {
        front.points.push_back(placeOf(tradeOff, tradeOff.tracks[i]));
        onFront.push_back(tradeOff.tracks[i]);
    }
    front.pointName = namedBy(std::move(onFront));
    Curve border;
    border.name = front.name;
    border.keys = {"front"};
    border.style = kBorder;
    border.points = makeBorder(tradeOff, front.points);
    Curve all = scattered(Text::tr("all tracks"), "all", kAll);
    Curve shown = scattered(Text::tr("in the scene"), "shown", kShown);
    for (const study::ScorePair& track : tradeOff.tracks) {
        all.points.push_back(placeOf(tradeOff, track));
        if (tradeOff.shown && study::isSameIndividual(track, *tradeOff.shown))
            shown.points.push_back(all.points.back());
    }
    all.pointName = namedBy({tradeOff.tracks.begin(), tradeOff.tracks.end()});
    Curve measured = scattered(Text::tr("measured anew"), "measured", kMeasured);
    for (const study::ScorePair& track : tradeOff.measured)
        measured.points.push_back(placeOf(tradeOff, track));
    measured.pointName = [anew = tradeOff.measured](std::size_t i) {
        return Text::tr("%1, %2 trials anew").arg(nameOf(anew[i])).arg(anew[i].trials);
    };
    // Painted one over the other, what matters last.
    plot.curves = {std::move(all), std::move(border), std::move(front), std::move(measured),
                   std::move(shown)};

    ChartSheet sheet;
    sheet.xColumn = plot.xTitle;
    sheet.legend = {
        {"front", Text::tr("Pareto front"),
         Text::tr("Tracks for which no other does better in both ways, of those with all their trials. A "
                  "click shows one."),
         kFront},
        {"all", Text::tr("all tracks"), Text::tr("Every track that was simulated while learning."), kAll},
        {"shown", Text::tr("in the scene"), Text::tr("The track that the scene shows."), kShown}};
    if (!tradeOff.measured.empty()) {
        sheet.legend.insert(sheet.legend.end() - 1,
                            {"measured", Text::tr("measured anew"),
                             Text::tr("The same tracks by the many fresh trials of the last selection, which "
                                      "no luck of learning is in. A click shows one."),
                             kMeasured});
    }
    sheet.plots = {std::move(plot)};
    return sheet;
}

TradeOffChart::TradeOffChart(QWidget* parent) : CurveChart("tradeOff", tr("Trade-off"), parent) {
    setEmptyText(
        tr("How two objectives trade against each other is not known before a track was simulated. "
           "Learn, and every track becomes a point."));
    connect(this, &CurveChart::pointPicked, this, [this](std::size_t curve, std::size_t index) {
        if (curve == kMeasuredCurve) {
            emit trackPicked(tradeOff_.measured[index]);
            return;
        }
        const std::size_t track = curve == kFrontCurve ? tradeOff_.front[index] : index;
        emit trackPicked(tradeOff_.tracks[track]);
    });
}

void TradeOffChart::setTradeOff(TradeOff tradeOff) {
    tradeOff_ = std::move(tradeOff);
    setSheet(tradeOff_.across != nullptr ? tradeOffSheet(tradeOff_) : ChartSheet());
}

QString TradeOffChart::csv() const {
    if (tradeOff_.across == nullptr) return {};
    QStringList lines{QStringList{
        tr("Generation"), tr("Individual"), titleOf(*tradeOff_.across), titleOf(*tradeOff_.up), tr("Trials"),
        tr("On the front"), look::csvField(tr("%1, anew").arg(titleOf(*tradeOff_.across))),
        look::csvField(tr("%1, anew").arg(titleOf(*tradeOff_.up))), tr("Trials anew")}
                          .join(u',')};
    for (std::size_t i = 0; i < tradeOff_.tracks.size(); ++i) {
        const study::ScorePair& track = tradeOff_.tracks[i];
        const QPointF place = placeOf(tradeOff_, track);
        const bool isOnFront = std::ranges::find(tradeOff_.front, i) != tradeOff_.front.end();
        QStringList fields{QString::number(track.generation), QString::number(track.individual),
                           look::csvNumber(place.x()),        look::csvNumber(place.y()),
                           QString::number(track.trials),     QString::number(isOnFront ? 1 : 0)};
        const auto anew = std::ranges::find_if(tradeOff_.measured, [&](const study::ScorePair& other) {
            return study::isSameIndividual(track, other);
        });
        if (anew == tradeOff_.measured.end()) {
            fields << QString() << QString() << QString();
        } else {
            const QPointF fresh = placeOf(tradeOff_, *anew);
            fields << look::csvNumber(fresh.x()) << look::csvNumber(fresh.y())
                   << QString::number(anew->trials);
        }
        lines.append(fields.join(u','));
    }
    return lines.join(u'\n') + u'\n';
}

}  // namespace trapwright::charts
