#include "ui/charts/orientation_chart.h"

#include <QtTest>

#include "core/base/math.h"
#include "ui/charts/plot.h"
#include "ui/charts/pose_bars.h"

using namespace trapwright;

namespace {

study::OrientationShares someShares() {
    study::OrientationShares shares;
    shares.poses = {{{0, 3}, 50, 60}, {{1}, 30, 15}, {{2}, 20, 0}};
    for (int i = 0; i < 100; ++i)
        shares.startAngles.push_back(1.8 * i * base::kDegree);
    for (int i = 0; i < 75; ++i)
        shares.finishAngles.push_back(i < 60 ? 2.0 * base::kDegree : 90.0 * base::kDegree);
    return shares;
}

}  // namespace

class OrientationChartTest : public QObject {
    Q_OBJECT

 private slots:
    void sharesAreReadOff() {
        charts::OrientationChart chart;
        chart.resize(640, 300);
        chart.setShares(someShares(), 25.0 * base::kDegree);
        chart.show();
        QVERIFY(QTest::qWaitForWindowExposed(&chart));
        auto* plot = chart.findChild<charts::Plot*>();
        plot->setCursor(25.0);
        // 14 of 100 begin within 25 degrees (0, 1.8 ... 23.4), 60 of 75 end there.
        QCOMPARE(plot->readOff().mid(1), (QStringList{"start: 14.0", "finish: 80.0"}));
        const QString spoken = chart.findChild<charts::PoseBars*>()->accessibleDescription();
        QVERIFY(spoken.contains("start, poses 1, 4: 50.0 %"));
        QVERIFY(spoken.contains("finish, pose 2: 20.0 %"));
    }

    void csvListsThePoses() {
        charts::OrientationChart chart;
        chart.setShares(someShares(), 0.4);
        QCOMPARE(chart.csv(),
                 QString("Stable poses,Parts at the start,Parts at the finish\n1 4,50,60\n2,30,15\n"
                         "3,20,0\n"));
    }

    void rarePosesShareAPiece() {
        study::OrientationShares shares = someShares();
        shares.poses.clear();
        for (int pose = 0; pose < 12; ++pose)
            shares.poses.push_back({{pose}, 10, 0});
        charts::OrientationChart chart;
        chart.setShares(shares, 0.4);
        const QString spoken = chart.findChild<charts::PoseBars*>()->accessibleDescription();
        QVERIFY(spoken.contains("start, other poses: 50.0 %"));
        QVERIFY(!spoken.contains("pose 7:"));
    }

    void withoutTrialsItSaysWhatToExpect() {
        charts::OrientationChart chart;
        QVERIFY(!chart.saveCsvAction()->isEnabled());
        chart.setShares(someShares(), 0.4);
        QVERIFY(chart.saveCsvAction()->isEnabled());
        chart.clear();
        QVERIFY(!chart.saveCsvAction()->isEnabled());
    }
};

QTEST_MAIN(OrientationChartTest)
#include "orientation_chart_test.moc"
