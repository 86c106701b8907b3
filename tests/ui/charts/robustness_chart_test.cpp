#include "ui/charts/robustness_chart.h"

#include <QScrollArea>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "ui/charts/pair_map.h"
#include "ui/charts/plot.h"

using namespace trapwright;
using trial::Condition;

namespace {

study::PlaceResult resultAt(std::optional<trial::BoxPlace> place, int success) {
    study::PlaceResult result;
    result.trials = {place, 0, 200};
    result.tally.success = success;
    result.tally.wrongOrientation = 200 - success;
    result.speed = 0.02;
    return result;
}

trial::BoxPlace placeAt(double friction, double halfStroke) {
    trial::BoxPlace place = trial::kMiddle;
    place[static_cast<std::size_t>(Condition::friction)] = friction;
    place[static_cast<std::size_t>(Condition::halfStroke)] = halfStroke;
    return place;
}

study::Settings someSettings() {
    study::Settings settings;
    settings.simulation.contact = {0.5, 0.5, 0.2};
    settings.simulation.drive.halfStroke = 0.8e-3;
    settings.box = {trial::BoxDistribution::uniform, 0.2, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0};
    return settings;
}

study::Robustness someRobustness() {
    study::Robustness robustness;
    robustness.nominal = resultAt(trial::kMiddle, 198);
    robustness.overBox = resultAt(std::nullopt, 180);
    for (const Condition condition : {Condition::friction, Condition::halfStroke}) {
        study::ConditionSweep sweep{condition, {}};
        for (int i = 0; i < 3; ++i) {
            const double share = 0.5 * i;
            sweep.points.push_back(resultAt(
                condition == Condition::friction ? placeAt(share, 0.5) : placeAt(0.5, share), 140 + 25 * i));
        }
        robustness.sweeps.push_back(sweep);
    }
    robustness.corners = {resultAt(placeAt(0.0, 1.0), 100)};
    study::PairMap map{Condition::friction, Condition::halfStroke, 2, {}};
    for (const double stroke : {0.0, 1.0}) {
        for (const double friction : {0.0, 1.0})
            map.places.push_back(
                resultAt(placeAt(friction, stroke), 200 - 40 * static_cast<int>(map.places.size())));
    }
    robustness.worstPair = map;
    return robustness;
}

}  // namespace

class RobustnessChartTest : public QObject {
    Q_OBJECT

 private slots:
    void curvesAreReadOffWhereTheyHavePoints() {
        charts::RobustnessChart chart;
        chart.resize(900, 300);
        chart.setRobustness(someSettings(), someRobustness());
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        auto* plot = chart.findChild<charts::Plot*>("robustness.success.friction");
        QVERIFY(plot != nullptr);
        QTest::mouseMove(plot->viewport(), plot->toWidget({0.34, 90.0}).toPoint());
        QTRY_COMPARE(plot->readOff(), (QStringList{"Friction 0.3", "success: 70.0 (63.1 … 76.3)"}));
        auto* stroke = chart.findChild<charts::Plot*>("robustness.success.half_stroke_mm");
        QVERIFY(stroke != nullptr);
        QCOMPARE(stroke->sheet().xTitle, QString("Half-stroke [mm]"));
        QVERIFY(std::abs(stroke->sheet().mark->x - 0.8) < 1e-9);
        // One axis for all, so that they can be compared.
        QCOMPARE(stroke->yRange(), plot->yRange());
        // Speed only for those who ask.
        auto* speed = chart.findChild<charts::Plot*>("robustness.speed.friction");
        QVERIFY(speed != nullptr && !speed->isVisible());
        // What is hidden takes no room.
        QVERIFY2(chart.minimumSizeHint().width() < 600,
                 qPrintable(QString::number(chart.minimumSizeHint().width())));
    }

    void aPointAndACellArePicked() {
        charts::RobustnessChart chart;
        chart.resize(900, 300);
        const study::Robustness robustness = someRobustness();
        chart.setRobustness(someSettings(), robustness);
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        std::vector<study::PlaceTrials> picked;
        connect(&chart, &charts::RobustnessChart::picked,
                [&](const study::PlaceTrials& trials) { picked.push_back(trials); });
        auto* plot = chart.findChild<charts::Plot*>("robustness.success.friction");
        const QPoint point = plot->toWidget({0.7, 95.0}).toPoint();
        QTest::mouseMove(plot->viewport(), point);
        QTest::mouseClick(plot->viewport(), Qt::LeftButton, {}, point);
        QTRY_COMPARE(picked.size(), std::size_t{1});
        QVERIFY(picked[0] == robustness.sweeps[0].points[2].trials);
        auto* map = chart.findChild<charts::PairMap*>();
        QTest::mouseClick(map->viewport(), Qt::LeftButton, {}, map->cellRect(1).center().toPoint());
        QTRY_COMPARE(picked.size(), std::size_t{2});
        // The second cell from below, left to right: friction high, stroke low.
        QVERIFY(picked[1] == robustness.worstPair->places[1].trials);
        QVERIFY(map->cellRect(1).left() > map->cellRect(0).left());
        QVERIFY(map->cellRect(2).bottom() < map->cellRect(0).bottom());
        QVERIFY(map->accessibleDescription().contains(
            "Friction 0.70, half-stroke 0.720 mm: 80.0 % of 200 (73.8 … 85.3)"));
    }

    void csvHasEveryPlace() {
        charts::RobustnessChart chart;
        chart.setRobustness(someSettings(), someRobustness());
        const QStringList lines = chart.csv().split('\n', Qt::SkipEmptyParts);
        // As set, over the box, 2 x 3 points, one corner, 2 x 2 cells.
        QCOMPARE(lines.size(), 1 + 2 + 6 + 1 + 4);
        QVERIFY(lines[0].startsWith("Measured,Friction,Half-stroke [mm],Trials,Success,"));
        QVERIFY2(lines[2].startsWith("over the box,,,200,180,90,"), qPrintable(lines[2]));
        QVERIFY(lines[9].startsWith("worst corner,0.3,0.88,200,100,50,"));
    }

    void picturesShowTheMap() {
        charts::RobustnessChart chart;
        chart.setRobustness(someSettings(), someRobustness());
        const QTemporaryDir folder;
        QVERIFY(chart.savePicture(folder.filePath("r.svg").toStdString()).ok());
        QFile svg(folder.filePath("r.svg"));
        QVERIFY(svg.open(QIODevice::ReadOnly));
        const QByteArray text = svg.readAll();
        QVERIFY(text.contains(">40.0</text>") || text.contains(">40</text>"));
    }

    void withoutAMeasurementItIsEmpty() {
        charts::RobustnessChart chart;
        QVERIFY(!chart.saveCsvAction()->isEnabled());
        QCOMPARE(chart.csv(), QString());
        chart.setRobustness(someSettings(), someRobustness());
        QVERIFY(chart.saveCsvAction()->isEnabled());
        study::Robustness one = someRobustness();
        one.worstPair.reset();
        chart.setRobustness(someSettings(), one);
        QVERIFY(chart.findChild<charts::PairMap*>()->isHidden());
        chart.clear();
        QVERIFY(!chart.saveCsvAction()->isEnabled());
        QVERIFY(chart.findChild<charts::Plot*>() == nullptr);
    }

    // In a panel that is too narrow for all of them they scroll; a picture has all.
    void picturesHoldWhatScrolls() {
        charts::RobustnessChart chart;
        chart.setRobustness(someSettings(), someRobustness());
        chart.resize(300, 260);
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        QCOMPARE(chart.width(), 300);
        const QTemporaryDir folder;
        const QString file = folder.filePath("robustness.png");
        QVERIFY(chart.savePicture(file.toStdString()).ok());
        const QSize shown = chart.findChild<QScrollArea*>()->widget()->size();
        QVERIFY(shown.width() > 300);
        const QImage picture(file);
        // As wide as all of it, at whole pixels per point.
        QVERIFY(picture.width() >= shown.width() && picture.width() % shown.width() == 0);
    }
};

QTEST_MAIN(RobustnessChartTest)
#include "robustness_chart_test.moc"
