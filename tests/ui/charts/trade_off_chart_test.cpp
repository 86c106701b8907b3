#include "ui/charts/trade_off_chart.h"

#include <QSignalSpy>
#include <QtTest>

#include "ui/charts/plot.h"

using namespace trapwright;
using charts::Plot;
using charts::TradeOffChart;

namespace {

using Points = std::vector<QPointF>;

/// Of six tracks three are on the front; of the last there were too few trials.
charts::TradeOff someTracks() {
    charts::TradeOff tradeOff;
    tradeOff.across = objectives::findObjective("purity");
    tradeOff.up = objectives::findObjective("success");
    tradeOff.tracks = {{{0, 0}, 20, 1.0, 0.9}, {{0, 1}, 20, 0.5, 0.5},  {{1, 0}, 20, 2.0, 0.6},
                       {{1, 1}, 20, 3.0, 0.2}, {{2, 4}, 20, 1.9, 0.55}, {{2, 5}, 5, 3.0, 1.0}};
    tradeOff.front = study::findParetoFront(tradeOff.tracks, *tradeOff.across, *tradeOff.up, 20);
    tradeOff.shown = study::IndividualId{2, 4};
    return tradeOff;
}

const charts::Curve& curveOf(const charts::PlotSheet& plot, charts::Marker marker) {
    return *std::ranges::find_if(plot.curves,
                                 [&](const charts::Curve& curve) { return curve.style.marker == marker; });
}

}  // namespace

class TradeOffChartTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { qRegisterMetaType<study::IndividualId>(); }

    void theBorderIsWhatCanBeHad() {
        const charts::PlotSheet plot = charts::tradeOffSheet(someTracks()).plots[0];
        QCOMPARE(plot.xTitle, QString("Purity [nines]"));
        QCOMPARE(plot.yTitle, QString("Success [%]"));
        QVERIFY(
            (curveOf(plot, charts::Marker::circle).points == Points{{3.0, 20.0}, {2.0, 60.0}, {1.0, 90.0}}));
        // With less purity than the second as much success as it has, and no more.
        QVERIFY((curveOf(plot, charts::Marker::none).points ==
                 Points{{1.0, 90.0}, {1.0, 60.0}, {2.0, 60.0}, {2.0, 20.0}, {3.0, 20.0}}));
        QCOMPARE(curveOf(plot, charts::Marker::dot).points.size(), std::size_t{6});
        QVERIFY((curveOf(plot, charts::Marker::diamond).points == Points{{1.9, 55.0}}));
    }

    void whereLessIsBetterTheBorderTurns() {
        charts::TradeOff tradeOff = someTracks();
        tradeOff.across = objectives::findObjective("disorder");
        tradeOff.tracks = {{{0, 0}, 20, 1.0, 0.9}, {{0, 1}, 20, 0.5, 0.5}};
        tradeOff.front = study::findParetoFront(tradeOff.tracks, *tradeOff.across, *tradeOff.up, 20);
        const charts::PlotSheet plot = charts::tradeOffSheet(tradeOff).plots[0];
        QVERIFY((curveOf(plot, charts::Marker::none).points ==
                 std::vector<QPointF>{{0.5, 50.0}, {1.0, 50.0}, {1.0, 90.0}}));
    }

    void eachPointOpensItsTrack() {
        TradeOffChart chart;
        chart.resize(640, 400);
        chart.setTradeOff(someTracks());
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        Plot* plot = chart.shownPlots().front();
        QSignalSpy picked(&chart, &TradeOffChart::trackPicked);
        const auto click = [&](const QPointF& value) {
            QTest::mouseClick(plot->viewport(), Qt::LeftButton, {}, plot->toWidget(value).toPoint());
        };
        const auto last = [&] { return picked.back()[0].value<study::IndividualId>(); };
        click({2.0, 60.0});
        QCOMPARE(picked.count(), 1);
        QVERIFY((last() == study::IndividualId{1, 0}));
        QCOMPARE(plot->readOff(),
                 (QStringList{"Generation 1, individual 0", "Purity [nines]: 2.00", "Success [%]: 60.00"}));
        click({0.5, 50.0});
        QCOMPARE(picked.count(), 2);
        QVERIFY((last() == study::IndividualId{0, 1}));
        // Nothing is near.
        click({2.5, 80.0});
        QCOMPARE(picked.count(), 2);
        // The keys go along the front.
        chart.activateWindow();
        plot->setFocus();
        QVERIFY(QTest::qWaitForWindowActive(&chart));
        for (const auto key : {Qt::Key_Right, Qt::Key_Right, Qt::Key_Return})
            QTest::keyClick(plot, key);
        QCOMPARE(picked.count(), 3);
        QVERIFY((last() == study::IndividualId{1, 0}));
    }

    // What a selection measured is beside what learning counted, and opens the same track.
    void whatWasMeasuredAnewIsThereToo() {
        TradeOffChart chart;
        chart.resize(640, 400);
        QCOMPARE(charts::tradeOffSheet(someTracks()).legend.size(), std::size_t{3});
        charts::TradeOff tradeOff = someTracks();
        tradeOff.measured = {{{1, 1}, 1000, 1.2, 0.3}};
        const charts::ChartSheet sheet = charts::tradeOffSheet(tradeOff);
        QCOMPARE(sheet.legend.size(), std::size_t{4});
        QVERIFY((curveOf(sheet.plots[0], charts::Marker::square).points == Points{{1.2, 30.0}}));
        chart.setTradeOff(tradeOff);
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        Plot* plot = chart.shownPlots().front();
        QSignalSpy picked(&chart, &TradeOffChart::trackPicked);
        QTest::mouseClick(plot->viewport(), Qt::LeftButton, {}, plot->toWidget({1.2, 30.0}).toPoint());
        QCOMPARE(picked.count(), 1);
        QVERIFY((picked.back()[0].value<study::IndividualId>() == study::IndividualId{1, 1}));
        QCOMPARE(plot->readOff()[0], QString("Generation 1, individual 1, 1000 trials anew"));
        QVERIFY(chart.csv().split(u'\n')[4].endsWith("1.2,30,1000"));
    }

    void csvHasALineForEachTrack() {
        TradeOffChart chart;
        QVERIFY(chart.csv().isEmpty());
        chart.setTradeOff(someTracks());
        const QStringList lines = chart.csv().split(u'\n');
        QCOMPARE(lines.size(), 8);  // the last is empty
        QCOMPARE(lines[0], QString("Generation,Individual,Purity [nines],Success [%],Trials,On the front,"
                                   "\"Purity [nines], anew\",\"Success [%], anew\",Trials anew"));
        QCOMPARE(lines[1], QString("0,0,1,90,20,1,,,"));
        QCOMPARE(lines[6], QString("2,5,3,100,5,0,,,"));
    }
};

QTEST_MAIN(TradeOffChartTest)
#include "trade_off_chart_test.moc"
