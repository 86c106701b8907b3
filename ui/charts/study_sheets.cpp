#include "ui/charts/study_sheets.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/search/methods.h"

namespace trapwright::charts {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(StudySheets)
};

constexpr double kPercent = 100.0;

const CurveStyle kBest{SeriesColour::first, Qt::SolidLine, Marker::circle};
const CurveStyle kMean{SeriesColour::second, Qt::DashLine, Marker::square};
const CurveStyle kAttainable{SeriesColour::neutral, Qt::DotLine, Marker::none};
const CurveStyle kThird{SeriesColour::third, Qt::DashDotLine, Marker::triangle};

QString studyKey(std::size_t study) {
    return QStringLiteral("study%1").arg(study);
}

/// With two studies, what belongs to which is said everywhere.
QString withStudy(const QString& text, const std::vector<StudyCurves>& studies, std::size_t study) {
    return studies.size() < 2 ? text : QStringLiteral("%1, %2").arg(text, studies[study].name);
}

/// A curve of each study: a value of each generation, or NaN.
using ValueOf = std::function<double(const study::GenerationSummary&)>;

void addCurves(PlotSheet& plot, const std::vector<StudyCurves>& studies, const QString& key,
               const QString& name, const QString& column, CurveStyle style, const ValueOf& valueOf) {
    for (std::size_t i = 0; i < studies.size(); ++i) {
        style.second = i > 0;
        Curve curve{
            withStudy(name, studies, i), withStudy(column, studies, i), {key, studyKey(i)}, style, {}};
        for (const study::GenerationSummary& summary : studies[i].summaries) {
            const double value = valueOf(summary);
            if (!std::isnan(value)) curve.points.emplace_back(summary.index, value);
        }
        if (curve.points.empty() && !studies[i].summaries.empty())
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
        sheet.legend.push_back({studyKey(i), studies[i].name,
                                Text::tr("The curves of the study %1.").arg(studies[i].name), style});
    }
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

/// One of the three scores of the fitness.
struct Score {
    QString key;
    QString choice;
    QString axis;
    QString lowAxis;
    QString column;
    QString help;
    double trial::Fitness::*value;
};

std::vector<Score> scores() {
    return {{"F_C", Text::tr("Collisions"), Text::tr("Collisions F<sub>C</sub> [triangles]"),
             Text::tr("F<sub>C</sub> [triangles]"), Text::tr("F_C [triangles]"),
             Text::tr("Minus the number of the surface's triangles that overlap. 0 is best."),
             &trial::Fitness::collision},
            {"F_D", Text::tr("Distance"), Text::tr("Distance F<sub>D</sub> [segments]"),
             Text::tr("F<sub>D</sub> [segments]"), Text::tr("F_D [segments]"),
             Text::tr("Minus the distance that parts stay short of the finish, on average. 0 is best."),
             &trial::Fitness::distance},
            {"F_O", Text::tr("Orientation"), Text::tr("Orientation F<sub>O</sub> [√rad]"),
             Text::tr("F<sub>O</sub> [√rad]"), Text::tr("F_O [√rad]"),
             Text::tr("How much more alike the parts lie at the end than at the start. Higher is better."),
             &trial::Fitness::orientation}};
}

bool everOverlaps(const std::vector<StudyCurves>& studies) {
    return std::any_of(studies.begin(), studies.end(), [](const StudyCurves& study) {
        return std::any_of(study.summaries.begin(), study.summaries.end(), [](const auto& summary) {
            return std::min(summary.statistics.best.collision, summary.statistics.topMean.collision) < 0.0;
        });
    });
}

void addAttainable(PlotSheet& plot, const std::vector<StudyCurves>& studies) {
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const double level = studies[i].bestAttainableOrientation;
        if (i > 0 && level == studies.front().bestAttainableOrientation) continue;
        CurveStyle style = kAttainable;
        style.second = i > 0;
        // One line for all studies that share it.
        const bool shared = std::all_of(studies.begin(), studies.end(), [&](const StudyCurves& study) {
            return study.bestAttainableOrientation == level;
        });
        plot.curves.push_back(
            {shared ? Text::tr("best attainable") : withStudy(Text::tr("best attainable"), studies, i),
             withStudy(Text::tr("F_O best attainable [√rad]"), studies, i),
             shared ? QStringList{"attainable"} : QStringList{"attainable", studyKey(i)},
             style,
             {},
             level});
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
                curve.points.emplace_back(check.generation, valueOf(check, check.*engine.score));
            std::sort(curve.points.begin(), curve.points.end(),
                      [](const QPointF& a, const QPointF& b) { return a.x() < b.x(); });
            plot.curves.push_back(std::move(curve));
        }
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
        curve.bandColumns = {
            withStudy(Text::tr("Winner's success, 95 % Clopper-Pearson low [%]"), studies, i),
            withStudy(Text::tr("Winner's success, 95 % Clopper-Pearson high [%]"), studies, i)};
        CurveStyle mean = kMean;
        mean.second = i > 0;
        Curve top{withStudy(Text::tr("mean of top 30 %"), studies, i),
                  withStudy(Text::tr("Success, mean of top 30 % [%]"), studies, i),
                  {"mean", studyKey(i)},
                  mean,
                  {}};
        for (const study::GenerationSummary& summary : studies[i].summaries) {
            if (const auto& success = summary.statistics.success) {
                const stats::Interval bounds = stats::calcClopperPearson(success->successes, success->trials);
                curve.points.emplace_back(summary.index, kPercent * success->share());
                curve.band.push_back({kPercent * bounds.low, kPercent * bounds.high});
            }
            if (const auto& share = summary.statistics.topSuccess)
                top.points.emplace_back(summary.index, kPercent * *share);
        }
        plot.curves.push_back(std::move(curve));
        plot.curves.push_back(std::move(top));
    }
    sheet.plots.push_back(std::move(plot));
    sheet.legend.push_back(
        {"best", Text::tr("winner, with its 95 % bounds"),
         Text::tr("Parts of each generation's winner that finished in the expected orientation, of all its "
                  "trials. The area is the 95 % Clopper-Pearson interval."),
         kBest});
    sheet.legend.push_back({"mean", Text::tr("mean of top 30 %"),
                            Text::tr("The mean success of the best 30 % of each generation."), kMean});
    addStudies(sheet, studies);
    return sheet;
}

ChartSheet fitnessSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    const bool overlaps = everOverlaps(studies);
    for (const Score& score : scores()) {
        // Where no surface ever overlapped, a line at 0 would only take room.
        const bool on = score.key != "F_C" || overlaps;
        sheet.legend.push_back({score.key, score.choice, score.help, std::nullopt, on});
        PlotSheet plot = makePlot(score.key, score.axis, score.lowAxis);
        plot.yIncluded = {0.0};
        plot.leastHeight = 0.1;
        addCurves(plot, studies, "best", Text::tr("best"), Text::tr("%1 best").arg(score.column), kBest,
                  [&](const auto& summary) { return summary.statistics.best.*score.value; });
        addCurves(plot, studies, "mean", Text::tr("mean of top 30 %"),
                  Text::tr("%1 mean of top 30 %").arg(score.column), kMean,
                  [&](const auto& summary) { return summary.statistics.topMean.*score.value; });
        if (score.key == "F_O") addAttainable(plot, studies);
        sheet.plots.push_back(std::move(plot));
    }
    sheet.legend.push_back({"best", Text::tr("best"), Text::tr("The winner of each generation."), kBest});
    sheet.legend.push_back({"mean", Text::tr("mean of top 30 %"),
                            Text::tr("The mean of the best 30 % of each generation."), kMean});
    sheet.legend.push_back(
        {"attainable", Text::tr("attainable"),
         Text::tr("The F_O of a track that turns every part to one orientation. With few trials a track can "
                  "exceed it by chance."),
         kAttainable});
    addStudies(sheet, studies);
    return sheet;
}

ChartSheet searchSheet(const std::vector<StudyCurves>& studies) {
    ChartSheet sheet = makeSheet();
    const std::array styles{kBest, kMean, kThird};
    std::size_t count = 0;
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
        const CurveStyle style = styles[count++ % styles.size()];
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
         Text::tr("Parts of each winner that finished in the expected orientation, in its check.")},
        {"F_O", Text::tr("Orientation"), Text::tr("The winner's F_O on these trials."), {}, false},
        {"F_D", Text::tr("Distance"), Text::tr("The winner's F_D on these trials."), {}, false}};

    PlotSheet success = makePlot("success", Text::tr("Winner's success [%]"), Text::tr("Success [%]"));
    success.yIncluded = {0.0, kPercent};
    success.decimals = 1;
    addEngineCurves(success, studies, Text::tr("Success by %1 [%]"),
                    [](const auto& check, const auto& score) {
                        return check.trials > 0 ? kPercent * score.oriented / check.trials : 0.0;
                    });
    PlotSheet orientation =
        makePlot("F_O", Text::tr("Winner's F<sub>O</sub> [√rad]"), Text::tr("F<sub>O</sub> [√rad]"));
    orientation.yIncluded = {0.0};
    orientation.leastHeight = 0.1;
    addEngineCurves(orientation, studies, Text::tr("F_O by %1 [√rad]"),
                    [](const auto&, const auto& score) { return score.fitness.orientation; });
    PlotSheet distance =
        makePlot("F_D", Text::tr("Winner's F<sub>D</sub> [segments]"), Text::tr("F<sub>D</sub> [segments]"));
    distance.yIncluded = {0.0};
    distance.leastHeight = 0.1;
    addEngineCurves(distance, studies, Text::tr("F_D by %1 [segments]"),
                    [](const auto&, const auto& score) { return score.fitness.distance; });
    sheet.plots = {std::move(success), std::move(orientation), std::move(distance)};

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
