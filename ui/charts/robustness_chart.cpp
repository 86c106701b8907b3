#include "ui/charts/robustness_chart.h"

#include <QHBoxLayout>
#include <QScrollArea>
#include <algorithm>
#include <cmath>

#include "core/stats/binomial.h"
#include "core/study/operating_box.h"
#include "core/trial/conditions.h"
#include "ui/charts/legend.h"
#include "ui/charts/pair_map.h"
#include "ui/charts/plot.h"
#include "ui/look/text.h"

namespace trapwright::charts {

namespace {

using study::PlaceResult;
using trial::Condition;

constexpr double kPercent = 100.0;
constexpr double kMillimetres = 1e3;
constexpr double kLeastHeight = 4.0;  // of the success plots [%]
constexpr int kLeastPlot = 152;       // for its title; more than fit are scrolled to [px]
constexpr int kLeastMap = 170;

const CurveStyle kSuccess{SeriesColour::first, Qt::SolidLine, Marker::circle};
const CurveStyle kSpeed{SeriesColour::third, Qt::SolidLine, Marker::square};
const CurveStyle kAsSet{SeriesColour::neutral, Qt::DotLine, Marker::none};

const trial::ConditionText& textOf(Condition condition) {
    return trial::conditionTexts()[static_cast<std::size_t>(condition)];
}

/// "Half-stroke [mm]".
QString titleOf(Condition condition) {
    const trial::ConditionText& text = textOf(condition);
    const QString unit = text.unit == "deg" ? QStringLiteral("°") : look::fromUtf8(text.unit);
    return unit.isEmpty() ? look::fromUtf8(text.name)
                          : QStringLiteral("%1 [%2]").arg(look::fromUtf8(text.name), unit);
}

double shareOf(const PlaceResult& result) {
    return kPercent * result.tally.success / std::max(result.tally.trials(), 1);
}

stats::Interval boundsOf(const PlaceResult& result) {
    const stats::Interval bounds = stats::calcClopperPearson(result.tally.success, result.tally.trials());
    return {kPercent * bounds.low, kPercent * bounds.high};
}

}  // namespace

RobustnessChart::RobustnessChart(QWidget* parent)
    : ChartPanel("robustness", tr("Robustness"), parent),
      scroll_(new QScrollArea),
      row_(new QWidget),
      map_(new PairMap(row_)) {
    layout_ = new QHBoxLayout(row_);
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(4);
    layout_->addWidget(map_, 2);
    // Many side by side must not widen the window.
    scroll_->setWidget(row_);
    scroll_->setWidgetResizable(true);
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll_->viewport()->setAutoFillBackground(false);
    row_->setAutoFillBackground(false);
    setBody(scroll_, row_);
    map_->setMinimumWidth(kLeastMap);
    map_->setTheme(theme());
    connect(legend(), &Legend::switched, this, &RobustnessChart::updateShown);
    connect(map_, &PairMap::picked, this, [this](int cell) {
        emit picked(robustness_->worstPair->places[static_cast<std::size_t>(cell)].trials);
    });
}

void RobustnessChart::setRobustness(const study::Settings& settings, study::Robustness robustness) {
    clear();
    settings_ = settings;
    robustness_ = std::move(robustness);
    std::vector<LegendEntry> entries = {
        {"success", tr("success"), tr("With its 95 % bounds as an area."), kSuccess, true, true},
        {"asSet", tr("as set"), tr("What the study's settings say."), kAsSet, true, true},
        {"speed", tr("speed"), tr("Mean speed along the track of the parts that finish."), std::nullopt,
         false}};
    if (robustness_->worstPair)
        entries.push_back({"map", tr("worst two together"),
                           tr("Success over the two conditions that are worst together; all else as set."),
                           std::nullopt, true});
    legend()->setEntries(entries);
    addSweeps(false);
    addSweeps(true);
    showMap();
    showEmpty(false);
    updateShown();
}

void RobustnessChart::clear() {
    for (const Sweep& sweep : sweeps_)
        delete sweep.plot;
    sweeps_.clear();
    robustness_.reset();
    showEmpty(true);
}

double RobustnessChart::valueAt(const PlaceResult& result, Condition condition) const {
    const double share = (*result.trials.place)[static_cast<std::size_t>(condition)];
    return study::conditionAt(settings_.simulation, settings_.box, condition, share) *
           textOf(condition).shownAs;
}

void RobustnessChart::addSweeps(bool isSpeed) {
    // All have the same axis: the condition that harms most is seen at once.
    std::vector<double> included = isSpeed ? std::vector<double>{0.0} : std::vector<double>{kPercent};
    for (const study::ConditionSweep& sweep : robustness_->sweeps)
        for (const PlaceResult& point : sweep.points)
            included.push_back(isSpeed ? point.speed * kMillimetres : boundsOf(point).low);
    for (std::size_t i = 0; i < robustness_->sweeps.size(); ++i) {
        const study::ConditionSweep& sweep = robustness_->sweeps[i];
        PlotSheet sheet;
        sheet.key = isSpeed ? "speed" : "success";
        sheet.xTitle = titleOf(sweep.condition);
        const QString axis = isSpeed ? tr("Speed [mm/s]") : tr("Success [%]");
        // All have the same; once is enough where there is little room.
        if (i == 0) sheet.yTitle = axis;
        sheet.decimals = 1;
        sheet.isWhole = false;
        sheet.leastWidth = 0.0;
        sheet.leastHeight = isSpeed ? 1.0 : kLeastHeight;
        sheet.yIncluded = included;
        sheet.mark = XMark{valueAt(robustness_->nominal, sweep.condition), kAsSet};
        Curve curve{isSpeed ? tr("speed") : tr("success"), axis, {}, isSpeed ? kSpeed : kSuccess, {}};
        for (const PlaceResult& point : sweep.points) {
            curve.points.emplace_back(valueAt(point, sweep.condition),
                                      isSpeed ? point.speed * kMillimetres : shareOf(point));
            if (!isSpeed) curve.band.push_back(boundsOf(point));
        }
        sheet.curves.push_back(std::move(curve));
        auto* plot = new Plot(row_);
        plot->setObjectName(QString("robustness.%1.%2")
                                .arg(sheet.key, QString::fromUtf8(textOf(sweep.condition).key.data())));
        plot->setMinimumWidth(kLeastPlot);
        // Until updateShown() has decided it takes no room.
        plot->hide();
        plot->setTheme(theme());
        plot->setSheet(sheet);
        plot->setAccessibleName(tr("%1 over %2").arg(axis, sheet.xTitle));
        connect(plot, &Plot::fitWanted, plot, &Plot::fit);
        connect(plot, &Plot::cursorMoved, plot, &Plot::setCursor);
        const Sweep made{plot, isSpeed, i};
        connect(plot, &Plot::picked, this, [this, made](double x) { pick(made, x); });
        layout_->insertWidget(layout_->indexOf(map_), plot, 1);
        sweeps_.push_back(made);
    }
}

void RobustnessChart::pick(const Sweep& sweep, double x) {
    const study::ConditionSweep& picked = robustness_->sweeps[sweep.condition];
    const auto nearest = std::min_element(
        picked.points.begin(), picked.points.end(), [&](const PlaceResult& a, const PlaceResult& b) {
            return std::abs(valueAt(a, picked.condition) - x) < std::abs(valueAt(b, picked.condition) - x);
        });
    emit this->picked(nearest->trials);
}

void RobustnessChart::showMap() {
    if (!robustness_->worstPair) return;
    const study::PairMap& pair = *robustness_->worstPair;
    const auto axisOf = [&](Condition condition, std::size_t stride) {
        MapAxis axis{titleOf(condition), {}};
        for (int i = 0; i < pair.points; ++i)
            axis.labels.append(
                QString::number(valueAt(pair.places[static_cast<std::size_t>(i) * stride], condition) + 0.0,
                                'f', textOf(condition).decimals));
        return axis;
    };
    std::vector<double> shares;
    QStringList help;
    for (const PlaceResult& place : pair.places) {
        shares.push_back(shareOf(place));
        const stats::Interval bounds = boundsOf(place);
        help.append(tr("%1: %2 % of %3 (%4 … %5)")
                        .arg(look::fromUtf8(study::describePlace(settings_, *place.trials.place)))
                        .arg(shares.back(), 0, 'f', 1)
                        .arg(place.tally.trials())
                        .arg(bounds.low, 0, 'f', 1)
                        .arg(bounds.high, 0, 'f', 1));
    }
    map_->setCells(axisOf(pair.across, 1), axisOf(pair.up, static_cast<std::size_t>(pair.points)),
                   std::move(shares), std::move(help));
}

void RobustnessChart::updateShown() {
    if (!robustness_) return;
    for (const Sweep& sweep : sweeps_)
        sweep.plot->setVisible(!sweep.isSpeed || legend()->isOn("speed"));
    map_->setVisible(robustness_->worstPair.has_value() && legend()->isOn("map"));
}

QString RobustnessChart::csv() const {
    if (!robustness_) return {};
    QStringList titles = {tr("Measured")};
    for (const study::ConditionSweep& sweep : robustness_->sweeps)
        titles << titleOf(sweep.condition);
    titles << tr("Trials") << tr("Success") << tr("Success [%]") << tr("Success low [%]")
           << tr("Success high [%]") << tr("Wrong orientation") << tr("Stuck") << tr("Fell off")
           << tr("Speed [mm/s]");
    QString text;
    const auto addLine = [&](const QStringList& fields) {
        QStringList quoted;
        for (const QString& field : fields)
            quoted << look::csvField(field);
        text += quoted.join(u',') + u'\n';
    };
    addLine(titles);
    const auto add = [&](const QString& what, const PlaceResult& result) {
        QStringList fields = {what};
        for (const study::ConditionSweep& sweep : robustness_->sweeps)
            fields << (result.trials.place ? look::csvNumber(valueAt(result, sweep.condition)) : QString());
        const trial::Tally& tally = result.tally;
        const stats::Interval bounds = boundsOf(result);
        fields << QString::number(tally.trials()) << QString::number(tally.success)
               << look::csvNumber(shareOf(result)) << look::csvNumber(bounds.low)
               << look::csvNumber(bounds.high) << QString::number(tally.wrongOrientation)
               << QString::number(tally.stuck) << QString::number(tally.fellOff)
               << look::csvNumber(result.speed * kMillimetres);
        addLine(fields);
    };
    add(tr("as set"), robustness_->nominal);
    add(tr("over the box"), robustness_->overBox);
    for (const study::ConditionSweep& sweep : robustness_->sweeps)
        for (const PlaceResult& point : sweep.points)
            add(look::fromUtf8(textOf(sweep.condition).name), point);
    for (const PlaceResult& corner : robustness_->corners)
        add(tr("worst corner"), corner);
    if (robustness_->worstPair)
        for (const PlaceResult& place : robustness_->worstPair->places)
            add(tr("map"), place);
    return text;
}

void RobustnessChart::applyTheme(const ChartTheme& theme) {
    for (const Sweep& sweep : sweeps_)
        sweep.plot->setTheme(theme);
    map_->setTheme(theme);
}

}  // namespace trapwright::charts
