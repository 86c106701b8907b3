#include "ui/charts/study_sheets.h"

#include <QtTest>
#include <set>

#include "tests/ui/sample_records.h"
#include "ui/charts/sheet.h"

using namespace trapwright;
using charts::ChartSheet;
using charts::Curve;
using charts::LegendEntry;
using charts::PlotSheet;
using charts::StudyCurves;

namespace {

StudyCurves someStudy(const QString& name, double orientation) {
    StudyCurves curves;
    curves.name = name;
    for (int g = 0; g < 3; ++g) {
        curves.summaries.push_back(sample::summary(g, orientation));
        curves.trialsPerSecond.push_back(100.0 + g);
    }
    // Checks are done when there is time: in any order.
    curves.checks = {sample::check(2, 10, 9), sample::check(0, 5, 4)};
    curves.attainable = {{"F_C", 0.0}, {"F_D", 0.0}, {"F_O", 1.25}};
    return curves;
}

const PlotSheet& plotOf(const ChartSheet& sheet, const QString& key) {
    return *std::find_if(sheet.plots.begin(), sheet.plots.end(),
                         [&](const PlotSheet& plot) { return plot.key == key; });
}

/// What a study of someStudy() has as its best F_O in its first generation.
double bestOf(double orientation) {
    return objectives::findScore(sample::summary(0, orientation).statistics.best, "F_O")->value;
}

bool isOn(const ChartSheet& sheet, const QString& key) {
    return std::find_if(sheet.legend.begin(), sheet.legend.end(),
                        [&](const LegendEntry& entry) { return entry.key == key; })
        ->on;
}

}  // namespace

class StudySheetsTest : public QObject {
    Q_OBJECT

 private slots:
    void successHasItsBoundsAndBeginsWhereItIsKnown() {
        StudyCurves study = someStudy("a", 0.5);
        study.summaries[0].statistics.success.reset();
        study.summaries[0].statistics.topSuccess.reset();
        const ChartSheet sheet = charts::successSheet({study});
        QCOMPARE(sheet.plots.size(), std::size_t{1});
        const Curve& winner = sheet.plots[0].curves.at(0);
        QCOMPARE(winner.points, (std::vector<QPointF>{{1, 85.0}, {2, 85.0}}));
        QCOMPARE(winner.band.size(), std::size_t{2});
        QVERIFY(std::abs(winner.band[0].low - 62.107317) < 1e-5 &&
                std::abs(winner.band[0].high - 96.792906) < 1e-5);
        QCOMPARE(sheet.plots[0].curves.at(1).points, (std::vector<QPointF>{{1, 50.0}, {2, 50.0}}));
        QVERIFY(sheet.legend[0].help.contains("95 % Clopper-Pearson"));
        const QStringList lines = charts::toCsv(sheet).split('\n');
        QCOMPARE(lines[0], QString("Generation,Winner's success [%],\"Winner's success, 95 % Clopper-Pearson "
                                   "low [%]\",\"Winner's success, 95 % Clopper-Pearson high [%]\",\"Success, "
                                   "mean of top 30 % [%]\""));
        QVERIFY2(lines[1].startsWith("1,85,62.107317") && lines[1].endsWith(",50"), qPrintable(lines[1]));
    }

    void fitnessShowsItsScores() {
        const ChartSheet sheet = charts::fitnessSheet({someStudy("a", 0.5)});
        QCOMPARE(sheet.plots.size(), std::size_t{7});
        const PlotSheet& orientation = plotOf(sheet, "F_O");
        QCOMPARE(orientation.curves.size(), std::size_t{3});
        QCOMPARE(orientation.curves[0].points, (std::vector<QPointF>{{0, 0.5}, {1, 0.5}, {2, 0.5}}));
        QCOMPARE(orientation.curves[1].points.front(), QPointF(0, 0.25));
        QCOMPARE(orientation.curves[0].style.line, Qt::SolidLine);
        QCOMPARE(orientation.curves[1].style.line, Qt::DashLine);
        QCOMPARE(*orientation.curves[2].level, 1.25);
        QCOMPARE(plotOf(sheet, "F_C").curves[0].points.front(), QPointF(0, -2.0));
        QCOMPARE(plotOf(sheet, "F_D").curves[0].points.front(), QPointF(0, -0.25));
        QCOMPARE(plotOf(sheet, "F_D").yTitle, QString("Distance F<sub>D</sub> [segments]"));
        // What everybody reads is a choice; the means of these studies lack it.
        QVERIFY(!isOn(sheet, "conveying_speed") && !isOn(sheet, "disorder"));
        const PlotSheet& speed = plotOf(sheet, "conveying_speed");
        QCOMPARE(speed.curves.size(), std::size_t{1});
        QCOMPARE(speed.curves[0].points.front(), QPointF(0, 50.0));
        QCOMPARE(speed.yTitle, QString("Conveying speed [mm/s]"));
    }

    void collisionsAreShownIfThereAreAny() {
        StudyCurves study = someStudy("a", 0.5);
        QVERIFY(isOn(charts::fitnessSheet({study}), "F_C"));
        for (study::GenerationSummary& summary : study.summaries)
            summary.statistics.best.scores[0].value = summary.statistics.topMean.scores[0].value = 0.0;
        QVERIFY(!isOn(charts::fitnessSheet({study}), "F_C"));
        QVERIFY(isOn(charts::fitnessSheet({study}), "F_O"));
    }

    // What tracks are judged by is shown at first; success has a sheet of its own.
    void whatIsSummedUpIsShownAtFirst() {
        StudyCurves study = someStudy("a", 0.5);
        study.summed = {"F_C", "sorting"};
        const ChartSheet sheet = charts::fitnessSheet({study, someStudy("b", 0.4)});
        QVERIFY(isOn(sheet, "sorting") && isOn(sheet, "F_C"));
        QVERIFY(!isOn(sheet, "F_D") && !isOn(sheet, "F_O"));
        study.summed = {"success"};
        QVERIFY(isOn(charts::fitnessSheet({study}), "F_O"));
    }

    // Where trials become harder there is a line, which nobody can switch off.
    void cornersFromAGenerationOnAreMarked() {
        StudyCurves study = someStudy("a", 0.5);
        QVERIFY(!charts::successSheet({study}).plots[0].mark);
        study.cornersFrom = 3;  // it has three, from 0
        QVERIFY(!charts::successSheet({study}).plots[0].mark);
        study.cornersFrom = 2;
        for (const ChartSheet& sheet : {charts::successSheet({study}), charts::fitnessSheet({study})}) {
            for (const PlotSheet& plot : sheet.plots)
                QCOMPARE(plot.mark.value().x, 1.5);
            QCOMPARE(sheet.legend.back().text, QString("corners from here"));
            QVERIFY(sheet.legend.back().fixed);
        }
        const ChartSheet two = charts::successSheet({someStudy("b", 0.5), study});
        QCOMPARE(two.legend.back().text, QString("corners from here, a"));
    }

    void strategyIsLogarithmic() {
        const ChartSheet sheet = charts::searchSheet({someStudy("a", 0.5)});
        QCOMPARE(sheet.plots.size(), std::size_t{1});
        QVERIFY(sheet.plots[0].yScale == charts::Scale::logarithmic);
        QCOMPARE(sheet.plots[0].curves[0].points.front(), QPointF(0, 0.8));
        QCOMPARE(sheet.plots[0].curves[1].points.front(), QPointF(0, 0.01));
        QCOMPARE(sheet.plots[0].curves[2].points.front(), QPointF(0, 0.05));
    }

    void speedIsAsLongAsItIsKnown() {
        StudyCurves study = someStudy("a", 0.5);
        study.trialsPerSecond.pop_back();
        const ChartSheet sheet = charts::speedSheet({study});
        QCOMPARE(sheet.plots[0].curves[0].points, (std::vector<QPointF>{{0, 100.0}, {1, 101.0}}));
    }

    void enginesAreComparedByGeneration() {
        const ChartSheet sheet = charts::engineSheet({someStudy("a", 0.5)});
        const PlotSheet& success = plotOf(sheet, "success");
        QCOMPARE(success.curves.size(), std::size_t{2});
        QCOMPARE(success.curves[0].name, QString("native"));
        QCOMPARE(success.curves[0].points, (std::vector<QPointF>{{0, 50.0}, {2, 100.0}}));
        QCOMPARE(success.curves[1].name, QString("simbody"));
        QCOMPARE(success.curves[1].points, (std::vector<QPointF>{{0, 40.0}, {2, 90.0}}));
        QCOMPARE(plotOf(sheet, "F_O").curves[1].points.front(), QPointF(0, 0.9));
    }

    void withoutChecksThereIsNothingToCompare() {
        StudyCurves study = someStudy("a", 0.5);
        study.checks.clear();
        for (const PlotSheet& plot : charts::engineSheet({study}).plots)
            QVERIFY(plot.curves.empty());
    }

    void twoStudiesAreToldApart_data() {
        QTest::addColumn<charts::ChartSheet (*)(const std::vector<StudyCurves>&)>("make");
        QTest::newRow("success") << &charts::successSheet;
        QTest::newRow("fitness") << &charts::fitnessSheet;
        QTest::newRow("search") << &charts::searchSheet;
        QTest::newRow("speed") << &charts::speedSheet;
        QTest::newRow("engines") << &charts::engineSheet;
    }
    void twoStudiesAreToldApart() {
        using Maker = charts::ChartSheet (*)(const std::vector<StudyCurves>&);
        QFETCH(Maker, make);
        const std::vector<StudyCurves> one{someStudy("one", 0.5)};
        const std::vector<StudyCurves> two{someStudy("one", 0.5), someStudy("two", 0.7)};
        QCOMPARE(make(two).legend.size(), make(one).legend.size() + 2);
        for (const PlotSheet& plot : make(two).plots) {
            std::set<QString> columns;
            for (const Curve& curve : plot.curves) {
                columns.insert(curve.column);
                if (!curve.level) QCOMPARE(curve.style.second, curve.name.endsWith("two"));
            }
            QCOMPARE(columns.size(), plot.curves.size());
            // No two curves look alike.
            for (std::size_t a = 0; a < plot.curves.size(); ++a) {
                for (std::size_t b = a + 1; b < plot.curves.size(); ++b)
                    QVERIFY(!(plot.curves[a].style == plot.curves[b].style));
            }
        }
    }

    // Of generations that one has alone there is no median.
    void severalStudiesAreTheirMedianBetweenTheirQuartiles() {
        std::vector<StudyCurves> studies{someStudy("one", 0.5), {}};
        studies[1].name = "median of 3 studies";
        for (const double orientation : {0.1, 0.2, 0.6})
            studies[1].members.push_back(someStudy("", orientation).summaries);
        studies[1].members[0].push_back(sample::summary(3, 0.1));
        const ChartSheet sheet = charts::fitnessSheet(studies);
        const PlotSheet& plot = plotOf(sheet, "F_O");
        const auto median = std::find_if(plot.curves.begin(), plot.curves.end(), [](const Curve& curve) {
            return curve.name == "best, median of 3 studies";
        });
        QVERIFY(median != plot.curves.end() && median->style.second);
        QCOMPARE(median->points.size(), std::size_t{3});
        QCOMPARE(median->band.size(), std::size_t{3});
        QCOMPARE(median->points[0], QPointF(0.0, bestOf(0.2)));
        QCOMPARE(median->band[0].low, (bestOf(0.1) + bestOf(0.2)) / 2.0);
        QCOMPARE(median->band[0].high, (bestOf(0.2) + bestOf(0.6)) / 2.0);
        QVERIFY(median->bandColumns[0].endsWith("lower quartile"));
        // One area in a plot.
        for (const Curve& curve : plot.curves)
            QCOMPARE(!curve.band.empty(), &curve == &*median);
        const ChartSheet success = charts::successSheet(studies);
        QVERIFY(success.plots[0].curves.at(0).band.empty());
        QVERIFY(success.plots[0].curves.at(2).bandColumns[0].endsWith("lower quartile"));
        QCOMPARE(success.legend[0].text, QString("winner"));
        QCOMPARE(charts::speedSheet(studies).plots[0].curves.size(), std::size_t{2});
    }

    void sharedAttainableScoreIsOneLine() {
        std::vector<StudyCurves> studies{someStudy("one", 0.5), someStudy("two", 0.7)};
        QCOMPARE(plotOf(charts::fitnessSheet(studies), "F_O").curves.size(), std::size_t{5});
        studies[1].attainable = {{"F_O", 1.4}};
        QCOMPARE(plotOf(charts::fitnessSheet(studies), "F_O").curves.size(), std::size_t{6});
    }

    void csvHasALineForEachGeneration() {
        StudyCurves later = someStudy("b, c", 0.7);
        later.summaries.push_back(sample::summary(3, 0.1));
        const QStringList lines =
            charts::toCsv(charts::searchSheet({someStudy("a", 0.5), later})).split('\n');
        QCOMPARE(lines.size(), 6);
        QCOMPARE(lines[0],
                 QString("Generation,\"p_x, a\",\"p_x, b, c\",\"p_dm, a\",\"p_dm, b, c\",\"p_s, a\",\"p_s, "
                         "b, c\""));
        QCOMPARE(lines[1], QString("0,0.8,0.8,0.01,0.01,0.05,0.05"));
        QCOMPARE(lines[4], QString("3,,0.8,,0.01,,0.05"));
    }

    void csvOfALevelHasItEverywhere() {
        const QStringList lines = charts::toCsv(charts::fitnessSheet({someStudy("a", 0.5)})).split('\n');
        const qsizetype column = lines[0].split(',').indexOf("F_O best attainable [√rad]");
        QVERIFY(column > 0);
        for (int line = 1; line <= 3; ++line)
            QCOMPARE(lines[line].split(',')[column], QString("1.25"));
    }

    void nothingIsShownOfNoStudy() {
        for (const auto make :
             {&charts::fitnessSheet, &charts::searchSheet, &charts::speedSheet, &charts::engineSheet}) {
            for (const PlotSheet& plot : make({}).plots)
                QVERIFY(plot.curves.empty());
        }
    }
};

QTEST_GUILESS_MAIN(StudySheetsTest)
#include "study_sheets_test.moc"
