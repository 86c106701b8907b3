#include "ui/charts/study_sheets.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "core/search/methods.h"
#include "core/stats/samples.h"
#include "ui/look/text.h"

namespace trapwright::charts {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(StudySheets)
};

constexpr double kPercent = 100.0;

const CurveStyle kBest{SeriesColour::first, Qt::SolidLine, Marker::circle};
const CurveStyle kMean{SeriesColour::second, Qt::DashLine, Marker::square};
const CurveStyle kAttainable{SeriesColour::neutral, Qt::DotLine, Marker::none};
const CurveStyle kCorners{SeriesColour::neutral, Qt::DashDotDotLine, Marker::none};
const CurveStyle kThird{SeriesColour::third, Qt::DashDotLine, Marker::triangle};

QString studyKey(std::size_t study) {
    return QStringLiteral("study%1").arg(study);
}

/// With two studies, what belongs to which is said everywhere.
QString withStudy(const QString& text, const std::vector<StudyCurves>& studies, std::size_t study) {
    return studies.size() < 2 ? text : QStringLiteral("%1, %2").arg(text, studies[study].name);
}

/// A value of a generation, or NaN.
using ValueOf = std::function<double(const study::GenerationSummary&)>;

/// The values of a study's generations, or of several studies the medians with the quartiles as band. Of
/// generations that one of several has alone there is nothing to tell.
void fill(Curve& curve, const StudyCurves& study, const ValueOf& valueOf) {
    for (const study::GenerationSummary& summary : study.summaries)
        if (const double value = valueOf(summary); !std::isnan(value))
            curve.points.emplace_back(summary.index, value);
    std::map<int, std::vector<double>> values;
    for (const std::vector<study::GenerationSummary>& member : study.members)
        for (const study::GenerationSummary& summary : member)
            if (const double value = valueOf(summary); !std::isnan(value))
                values[summary.index].push_back(value);
    for (const auto& [generation, all] : values) {
        if (all.size() < 2) continue;
        const stats::Quartiles quartiles = stats::calcQuartiles(all);
        curve.points.emplace_back(generation, quartiles.median);
        curve.band.push_back({quartiles.lower, quartiles.upper});
    }
    if (!study.members.empty())
        curve.bandColumns = {Text::tr("%1, lower quartile").arg(curve.column),
                             Text::tr("%1, upper quartile").arg(curve.column)};
}

/// Whether one of them stands for several.
bool hasSeveral(const std::vector<StudyCurves>& studies) {
    return std::ranges::any_of(studies, [](const StudyCurves& study) { return !study.members.empty(); });
}

/// Areas of several curves would hide each other.
void dropBand(Curve& curve) {
    curve.band.clear();
    curve.bandColumns.clear();
}

/// A curve of each study; the first of a plot has the area of several.

void addCurves(PlotSheet& plot, const std::vector<StudyCurves>& studies, const QString& key,
               const QString& name, const QString& column, CurveStyle style, const ValueOf& valueOf) {
    const bool isFirst = plot.curves.empty();
    for (std::size_t i = 0; i < studies.size(); ++i) {
        style.second = i > 0;
        Curve curve{
            withStudy(name, studies, i), withStudy(column, studies, i), {key, studyKey(i)}, style, {}};
        fill(curve, studies[i], valueOf);
        if (!isFirst) dropBand(curve);
        if (curve.points.empty() && (!studies[i].summaries.empty() || !studies[i].members.empty()))
            continue;  // a study that has no such values
        plot.curves.push_back(std::move(curve));
    }
}

/// `colour`: that of the curves, if all have the same.
void addStudies(ChartSheet& sheet, const std::vector<StudyCurves>& studies,
                SeriesColour colour = SeriesColour::neutral) {
    if (studies.size() < 2) return;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const CurveStyle style{colour, Qt::SolidLine, Marker::circle, i > 0};
        sheet.legend.push_back(
            {studyKey(i), studies[i].name,
             studies[i].members.empty()
                 ? Text::tr("The curves of the study %1.").arg(studies[i].name)
                 : Text::tr("Half of the studies lie within the area, a quarter above it."),
             style});
    }
}

/// Where trials in corners of the operating box begin, so that nobody takes what falls there for a loss. With
/// two studies where the first that has them begins with them.
void markCorners(ChartSheet& sheet, const std::vector<StudyCurves>& studies) {
    const auto has = std::find_if(studies.begin(), studies.end(), [](const StudyCurves& study) {
        return study.cornersFrom && !study.summaries.empty() &&
               study.summaries.back().index >= *study.cornersFrom;
    });
    if (has == studies.end()) return;
    // Between the last without and the first with them.
    for (PlotSheet& plot : sheet.plots)
        plot.mark = XMark{*has->cornersFrom - 0.5, kCorners};
    const auto study = static_cast<std::size_t>(has - studies.begin());
    sheet.legend.push_back({"cornersFrom", withStudy(Text::tr("corners from here"), studies, study),
                            Text::tr("From here on a share of the trials is in corners of the operating box, "
                                     "which are harder than the others."),
                            kCorners, true, true});
}

ChartSheet makeSheet() {
    ChartSheet sheet;
    sheet.xColumn = Text::tr("Generation");
    return sheet;
}

PlotSheet makePlot(const QString& key, const QString& yTitle, const QString& yShortTitle = {}) {
    PlotSheet plot;
    plot.key = key;
    plot.xTitle = Text::tr("Generation");
    plot.xStep = 1.0;
    plot.yTitle = yTitle;
    plot.yShortTitle = yShortTitle;
    return plot;
}

/// What the searches of these studies report, each name once.
std::vector<std::string> curveKeys(const std::vector<StudyCurves>& studies) {
    std::vector<std::string> keys;
    for (const StudyCurves& study : studies) {
        if (study.summaries.empty()) continue;
        for (const search::NamedNumber& curve : study.summaries.front().statistics.curves)
            if (std::find(keys.begin(), keys.end(), curve.key) == keys.end()) keys.push_back(curve.key);
    }
    return keys;
}

/// How an objective is called beside axes: "Distance F<sub>D</sub> [segments]", and where there is little
/// room "F<sub>D</sub> [segments]".
struct AxisNames {
    QString axis;
    QString lowAxis;
};

AxisNames axisNames(const objectives::Objective& objective) {
    const QString symbol = look::fromUtf8(objective.symbol);
    const QString unit =
        objective.unit.empty() ? QString() : QStringLiteral(" [%1]").arg(look::fromUtf8(objective.unit));
    const int low = symbol.indexOf('_');
    if (low < 0) return {look::fromUtf8(objective.name) + unit, symbol + unit};
    const QString html = QStringLiteral("%1<sub>%2</sub>").arg(symbol.left(low), symbol.mid(low + 1));
    return {look::fromUtf8(objective.name) + ' ' + html + unit, html + unit};
}

/// In people's unit; NaN where it was not measured.
double shownValue(const objectives::Fitness& fitness, const objectives::Objective& objective) {
    const objectives::Score* score = objectives::findScore(fitness, objective.key);
    return score != nullptr ? score->value * objective.shownAs : std::numeric_limits<double>::quiet_NaN();
}

/// All but success, which has a plot with its bounds.
objectives::ObjectiveList plottedObjectives(bool onlyNoisy) {
    objectives::ObjectiveList list;
    for (const objectives::Objective& objective : objectives::allObjectives())
        if (!objective.isSuccess && (objective.isNoisy || !onlyNoisy)) list.push_back(&objective);
    return list;
}

/// Whether any of these studies measures it.
bool isMeasured(const objectives::Objective& objective, const std::vector<StudyCurves>& studies) {
    return objective.applies == nullptr ||
           std::any_of(studies.begin(), studies.end(), [&](const StudyCurves& study) {
               return std::any_of(study.summaries.begin(), study.summaries.end(), [&](const auto& summary) {
                   return !std::isnan(shownValue(summary.statistics.best, objective));
               });
           });
}

/// Whether a plot of it would show anything: an objective that is exact is nothing as long as it is 0.
bool isWorthPlotting(const objectives::Objective& objective, const std::vector<StudyCurves>& studies) {
    if (objective.isNoisy) return true;
    return std::any_of(studies.begin(), studies.end(), [&](const StudyCurves& study) {
        return std::any_of(study.summaries.begin(), study.summaries.end(), [&](const auto& summary) {
            return shownValue(summary.statistics.best, objective) < 0.0 ||
                   shownValue(summary.statistics.topMean, objective) < 0.0;
        });
    });
}

/// What is shown at first: what tracks are judged by, or else what those look at who look into the algorithm.
/// What everybody reads is a choice, and a column of the tables. Where no surface ever overlapped, a line at
/// 0 would only take room.
objectives::ObjectiveList shownAtFirst(const std::vector<StudyCurves>& studies) {
    objectives::ObjectiveList details;
    objectives::ObjectiveList summed;
    for (const objectives::Objective* objective : plottedObjectives(false)) {
        if (!isMeasured(*objective, studies) || !isWorthPlotting(*objective, studies)) continue;
        if (objective->isDetail) details.push_back(objective);
        const bool isSummed = std::ranges::any_of(studies, [&](const StudyCurves& study) {
            return std::ranges::find(study.summed, objective->key) != study.summed.end();
        });
        if (isSummed) summed.push_back(objective);
    }
    return summed.empty() ? details : summed;
}

std::optional<double> attainableOf(const StudyCurves& study, const objectives::Objective& objective) {
    for (const objectives::Score& score : study.attainable)
        if (score.key == objective.key) return score.value * objective.shownAs;
    return std::nullopt;
}

/// A line where a perfect feeder would be; none where that is the axis.
void addAttainable(PlotSheet& plot, const objectives::Objective& objective,
                   const std::vector<StudyCurves>& studies) {
    const std::optional<double> first = attainableOf(studies.front(), objective);
    // One line for all studies that share it.
    const bool shared = std::all_of(studies.begin(), studies.end(), [&](const StudyCurves& study) {
        return attainableOf(study, objective) == first;
    });
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const std::optional<double> level = attainableOf(studies[i], objective);
        if (!level || *level == 0.0 || (i > 0 && level == first)) continue;
        CurveStyle style = kAttainable;
        style.second = i > 0;
        const QString column = Text::tr("%1 best attainable [%2]")
                                   .arg(look::fromUtf8(objective.symbol), look::fromUtf8(objective.unit));
        plot.curves.push_back(
            {shared ? Text::tr("best attainable") : withStudy(Text::tr("best attainable"), studies, i),
             withStudy(column, studies, i),
             shared ? QStringList{"attainable"} : QStringList{"attainable", studyKey(i)},
             style,
             {},
             *level});
    }
}

/// What one engine made of the checked winners.
struct EngineCurve {
    QString key;
    CurveStyle style;
    study::EngineScore study::CheckRecord::*score;
};

using CheckValue = std::function<double(const study::CheckRecord&, const study::EngineScore&)>;

void addEngineCurves(PlotSheet& plot, const std::vector<StudyCurves>& studies, const QString& column,
                     const CheckValue& valueOf) {
    for (const EngineCurve& engine : {EngineCurve{"learning", kBest, &study::CheckRecord::learning},
                                      EngineCurve{"reference", kMean, &study::CheckRecord::reference}}) {
        for (std::size_t i = 0; i < studies.size(); ++i) {
            if (studies[i].checks.empty()) continue;
            const QString name = QString::fromStdString((studies[i].checks.front().*engine.score).engine);
            CurveStyle style = engine.style;
            style.second = i > 0;
            Curve curve{withStudy(name, studies, i),
                        withStudy(column.arg(name), studies, i),
                        {engine.key, studyKey(i)},
                        style,
                        {}};
            for (const study::CheckRecord& check : studies[i].checks)
                if (const double value = valueOf(check, check.*engine.score); !std::isnan(value))
                    curve.points.emplace_back(check.generation, value);
            std::sort(curve.points.begin(), curve.points.end(),
                      [](const QPointF& a, const QPointF& b) { return a.x() < b.x(); });
            plot.curves.push_back(std::move(curve));
        }
    }
}

/// The winner's 95 % interval.
void addBounds(Curve& winner, const std::vector<StudyCurves>& studies, std::size_t study) {
    winner.bandColumns = {
        withStudy(Text::tr("Winner's success, 95 % Clopper-Pearson low [%]"), studies, study),
        withStudy(Text::tr("Winner's success, 95 % Clopper-Pearson high [%]"), studies, study)};
    for (const study::GenerationSummary& summary : studies[study].summaries) {
        const auto& success = summary.statistics.success;
        if (!success || success->trials == 0) continue;
        const stats::Interval bounds = stats::calcClopperPearson(success->successes, success->trials);
        winner.band.push_back({kPercent * bounds.low, kPercent * bounds.high});
    }
}

}  // namespace

ChartSheet successSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    PlotSheet plot = makePlot("success", Text::tr("Success [%]"));
    plot.yIncluded = {0.0, kPercent};
    plot.decimals = 1;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        CurveStyle best = kBest;
        best.second = i > 0;
        Curve curve{withStudy(Text::tr("winner"), studies, i),
                    withStudy(Text::tr("Winner's success [%]"), studies, i),
                    {"best", studyKey(i)},
                    best,
                    {}};
        fill(curve, studies[i], [](const auto& summary) {
            const auto& success = summary.statistics.success;
            return success && success->trials > 0 ? kPercent * success->share()
                                                  : std::numeric_limits<double>::quiet_NaN();
        });
        // Beside quartiles it would be one area too many.
        if (!hasSeveral(studies)) addBounds(curve, studies, i);
        CurveStyle mean = kMean;
        mean.second = i > 0;
        Curve top{withStudy(Text::tr("mean of top 30 %"), studies, i),
                  withStudy(Text::tr("Success, mean of top 30 % [%]"), studies, i),
                  {"mean", studyKey(i)},
                  mean,
                  {}};
        fill(top, studies[i], [](const auto& summary) {
            const auto& share = summary.statistics.topSuccess;
            return share ? kPercent * *share : std::numeric_limits<double>::quiet_NaN();
        });
        dropBand(top);
        plot.curves.push_back(std::move(curve));
        plot.curves.push_back(std::move(top));
    }
    sheet.plots.push_back(std::move(plot));
    const QString winner = Text::tr(
        "Parts of each generation's winner that finished in the expected orientation, of all its trials.");
    if (hasSeveral(studies)) {
        sheet.legend.push_back({"best", Text::tr("winner"), winner, kBest});
    } else {
        sheet.legend.push_back({"best", Text::tr("winner, with its 95 % bounds"),
                                winner + ' ' + Text::tr("The area is the 95 % Clopper-Pearson interval."),
                                kBest});
    }
    sheet.legend.push_back({"mean", Text::tr("mean of top 30 %"),
                            Text::tr("The mean success of the best 30 % of each generation."), kMean});
    addStudies(sheet, studies);
    markCorners(sheet, studies);
    return sheet;
}

ChartSheet fitnessSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    const objectives::ObjectiveList first = shownAtFirst(studies);
    for (const objectives::Objective* objective : plottedObjectives(false)) {
        if (!isMeasured(*objective, studies)) continue;
        const QString key = look::fromUtf8(objective->key);
        const bool on = objectives::contains(first, objective->key);
        sheet.legend.push_back(
            {key, look::fromUtf8(objective->name), look::fromUtf8(objective->help), std::nullopt, on});
        const AxisNames names = axisNames(*objective);
        const QString column = QString::fromStdString(objective->title());
        PlotSheet plot = makePlot(key, names.axis, names.lowAxis);
        plot.yIncluded = {0.0};
        plot.leastHeight = 0.1;
        addCurves(plot, studies, "best", Text::tr("best"), Text::tr("%1 best").arg(column), kBest,
                  [&](const auto& summary) { return shownValue(summary.statistics.best, *objective); });
        addCurves(plot, studies, "mean", Text::tr("mean of top 30 %"),
                  Text::tr("%1 mean of top 30 %").arg(column), kMean,
                  [&](const auto& summary) { return shownValue(summary.statistics.topMean, *objective); });
        if (!studies.empty()) addAttainable(plot, *objective, studies);
        sheet.plots.push_back(std::move(plot));
    }
    sheet.legend.push_back({"best", Text::tr("best"), Text::tr("The winner of each generation."), kBest});
    sheet.legend.push_back({"mean", Text::tr("mean of top 30 %"),
                            Text::tr("The mean of the best 30 % of each generation."), kMean});
    sheet.legend.push_back(
        {"attainable", Text::tr("attainable"),
         Text::tr(
             "What a track that turns every part to one orientation would score. With few trials a track "
             "can exceed it by chance."),
         kAttainable});
    addStudies(sheet, studies);
    markCorners(sheet, studies);
    return sheet;
}

ChartSheet searchSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    const std::array styles{kBest, kMean, kThird};
    std::map<QString, std::size_t> counts;  // of the curves of each axis
    for (const std::string& key : curveKeys(studies)) {
        const search::NumberInfo* known = search::findCurve(key);
        const search::NumberInfo info = known != nullptr ? *known : search::NumberInfo{key, key, {}, key};
        const QString axis = QString::fromStdString(info.axis);
        auto plot = std::find_if(sheet.plots.begin(), sheet.plots.end(),
                                 [&](const PlotSheet& other) { return other.yTitle == axis; });
        if (plot == sheet.plots.end()) {
            PlotSheet made =
                makePlot(QStringLiteral("search%1").arg(sheet.plots.size()), axis, axis.section(',', 0, 0));
            made.yScale = info.logarithmic ? Scale::logarithmic : Scale::linear;
            made.decimals = info.decimals;
            if (info.logarithmic) made.yIncluded = {1.0};
            made.leastHeight = info.logarithmic ? 1.0 : 0.1;
            plot = sheet.plots.insert(sheet.plots.end(), std::move(made));
        }
        const CurveStyle style = styles[counts[axis]++ % styles.size()];
        const QString name = QString::fromStdString(info.name);
        sheet.legend.push_back({QString::fromStdString(key), name, QString::fromStdString(info.help), style});
        addCurves(*plot, studies, QString::fromStdString(key), name, QString::fromStdString(key), style,
                  [&](const auto& summary) {
                      return search::findNumber(summary.statistics.curves, key)
                          .value_or(std::numeric_limits<double>::quiet_NaN());
                  });
    }
    if (sheet.plots.empty()) sheet.plots.push_back(makePlot("search0", {}));
    addStudies(sheet, studies);
    return sheet;
}

ChartSheet speedSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    PlotSheet plot = makePlot("speed", Text::tr("Simulated trials [1/s]"), Text::tr("Trials [1/s]"));
    plot.yIncluded = {0.0};
    plot.decimals = 0;
    plot.leastHeight = 10.0;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const StudyCurves& study = studies[i];
        CurveStyle style = kBest;
        style.second = i > 0;
        Curve curve{withStudy(Text::tr("trials per second"), studies, i),
                    withStudy(Text::tr("Trials per second"), studies, i),
                    {studyKey(i)},
                    style,
                    {}};
        if (!study.members.empty())
            fill(curve, study, [](const auto& summary) { return summary.trialsPerSecond(); });
        const std::size_t known = std::min(study.trialsPerSecond.size(), study.summaries.size());
        for (std::size_t g = 0; g < known; ++g) {
            if (!std::isnan(study.trialsPerSecond[g]))
                curve.points.emplace_back(study.summaries[g].index, study.trialsPerSecond[g]);
        }
        plot.curves.push_back(std::move(curve));
    }
    sheet.plots.push_back(std::move(plot));
    addStudies(sheet, studies, kBest.colour);
    return sheet;
}

ChartSheet engineSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    sheet.legend = {
        {"success", Text::tr("Success"),
         Text::tr("Parts of each winner that finished in the expected orientation, in its check.")}};
    PlotSheet success = makePlot("success", Text::tr("Winner's success [%]"), Text::tr("Success [%]"));
    success.yIncluded = {0.0, kPercent};
    success.decimals = 1;
    addEngineCurves(success, studies, Text::tr("Success by %1 [%]"),
                    [](const auto& check, const auto& score) {
                        return check.trials > 0 ? kPercent * score.oriented / check.trials : 0.0;
                    });
    sheet.plots.push_back(std::move(success));
    for (const objectives::Objective* objective : plottedObjectives(true)) {
        if (!isMeasured(*objective, studies)) continue;
        const QString key = look::fromUtf8(objective->key);
        const AxisNames names = axisNames(*objective);
        sheet.legend.push_back(
            {key,
             look::fromUtf8(objective->name),
             Text::tr("The same of the winner on these trials: %1").arg(look::fromUtf8(objective->help)),
             {},
             false});
        PlotSheet plot = makePlot(key, Text::tr("Winner's %1").arg(names.lowAxis), names.lowAxis);
        plot.yIncluded = {0.0};
        plot.leastHeight = 0.1;
        addEngineCurves(
            plot, studies,
            Text::tr("%1 by %2 [%3]")
                .arg(look::fromUtf8(objective->symbol), "%1", look::fromUtf8(objective->unit)),
            [&](const auto&, const auto& score) { return shownValue(score.fitness, *objective); });
        sheet.plots.push_back(std::move(plot));
    }

    const auto checked = std::find_if(studies.begin(), studies.end(),
                                      [](const StudyCurves& study) { return !study.checks.empty(); });
    if (checked != studies.end()) {
        const study::CheckRecord& check = checked->checks.front();
        sheet.legend.push_back({"learning", QString::fromStdString(check.learning.engine),
                                Text::tr("The engine that learned."), kBest});
        sheet.legend.push_back({"reference", QString::fromStdString(check.reference.engine),
                                Text::tr("The reference engine, on the same trials."), kMean});
    }
    addStudies(sheet, studies);
    return sheet;
}

}  // namespace trapwright::charts
