#include "ui/charts/axes.h"

#include <QtTest>
#include <limits>

using namespace trapwright;
using charts::Extent;
using charts::Range;

class ViewRangeTest : public QObject {
    Q_OBJECT

 private slots:
    void extentLeavesOutWhatIsNotFinite() {
        Extent extent;
        QVERIFY(!extent.range(1.0, 0.0));
        extent.add(std::numeric_limits<double>::quiet_NaN());
        extent.add(-std::numeric_limits<double>::infinity());
        QVERIFY(!extent.range(1.0, 0.0));
        extent.add(2.0);
        extent.add(6.0);
        QCOMPARE(*extent.range(0.0, 0.0), (Range{2.0, 6.0}));
        QCOMPARE(*extent.range(0.0, 0.25), (Range{1.0, 7.0}));
        QCOMPARE(*extent.range(10.0, 0.0), (Range{-1.0, 9.0}));
    }

    void zoomKeepsTheAnchorInPlace() {
        const Range limits{0.0, 100.0};
        const Range range{20.0, 60.0};
        for (const double anchor : {20.0, 30.0, 47.0, 60.0}) {
            const Range zoomed = charts::zoomRange(range, anchor, 0.5, limits, 1.0);
            QCOMPARE(zoomed.size(), 20.0);
            QVERIFY(std::abs((anchor - zoomed.low) / zoomed.size() - (anchor - range.low) / range.size()) <
                    1e-12);
        }
    }

    void zoomStaysWithinItsLimits() {
        const Range limits{0.0, 100.0};
        QCOMPARE(charts::zoomRange({20.0, 60.0}, 30.0, 10.0, limits, 1.0), limits);
        QCOMPARE(charts::zoomRange({20.0, 60.0}, 30.0, 1e-9, limits, 4.0).size(), 4.0);
        const Range atEdge = charts::zoomRange({0.0, 40.0}, 40.0, 2.0, limits, 1.0);
        QCOMPARE(atEdge, (Range{0.0, 80.0}));
    }

    void shiftStopsAtTheLimits() {
        const Range limits{0.0, 100.0};
        QCOMPARE(charts::shiftRange({20.0, 60.0}, 10.0, limits), (Range{30.0, 70.0}));
        QCOMPARE(charts::shiftRange({20.0, 60.0}, 1000.0, limits), (Range{60.0, 100.0}));
        QCOMPARE(charts::shiftRange({20.0, 60.0}, -1000.0, limits), (Range{0.0, 40.0}));
        QCOMPARE(charts::shiftRange({-50.0, 250.0}, 1.0, limits), limits);
    }
};

QTEST_GUILESS_MAIN(ViewRangeTest)
#include "view_range_test.moc"
