#include "ui/charts/axes.h"

#include <QtTest>

using namespace trapwright;
using charts::Range;
using charts::Tick;

namespace {

QStringList labelsOf(const std::vector<Tick>& ticks) {
    QStringList labels;
    for (const Tick& tick : ticks)
        labels.append(tick.label);
    return labels;
}

}  // namespace

class TicksTest : public QObject {
    Q_OBJECT

 private slots:
    void linearTicksAreRound_data() {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("most");
        QTest::addColumn<QStringList>("labels");
        QTest::newRow("tenths") << -0.02 << 1.02 << 6
                                << QStringList{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"};
        QTest::newRow("about nothing")
            << -1.0 << 1.0 << 5 << QStringList{"-1.0", "-0.5", "0.0", "0.5", "1.0"};
        QTest::newRow("thousands") << 0.0 << 4500.0 << 5 << QStringList{"0", "1000", "2000", "3000", "4000"};
        QTest::newRow("percent") << -4.0 << 104.0 << 6 << QStringList{"0", "20", "40", "60", "80", "100"};
        QTest::newRow("far from nothing")
            << 999.99 << 1000.01 << 3 << QStringList{"999.99", "1000.00", "1000.01"};
    }
    void linearTicksAreRound() {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, most);
        QFETCH(QStringList, labels);
        QCOMPARE(labelsOf(charts::linearTicks({low, high}, most)), labels);
    }

    void generationsAreWholeNumbers() {
        QCOMPARE(labelsOf(charts::linearTicks({3.6, 7.4}, 20, 1.0)), (QStringList{"4", "5", "6", "7"}));
        QCOMPARE(labelsOf(charts::linearTicks({-9.0, 476.0}, 6, 1.0)),
                 (QStringList{"0", "100", "200", "300", "400"}));
    }

    void ticksAreInRangeFewAndDifferent() {
        for (const double low : {-7.3, -5.93, -1.82, -0.45, 0.0, 0.92, 4.999, 1234.5}) {
            for (const double size : {1e-6, 0.013, 0.7, 1.0, 3.33, 47.0, 2e5}) {
                for (const int most : {2, 3, 5, 9}) {
                    const Range range{low, low + size};
                    const std::vector<Tick> ticks = charts::linearTicks(range, most);
                    QVERIFY(static_cast<int>(ticks.size()) <= most);
                    QStringList labels = labelsOf(ticks);
                    QCOMPARE(labels.removeDuplicates(), 0);
                    for (const Tick& tick : ticks) {
                        const double outside =
                            std::max(range.low - tick.position, tick.position - range.high);
                        QVERIFY(outside < 1e-6 * size);
                        QVERIFY(std::abs(tick.label.toDouble() - tick.position) < 1e-3 * size);
                    }
                }
            }
        }
    }

    void logarithmicTicksFollowTheDecades_data() {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("most");
        QTest::addColumn<QStringList>("labels");
        QTest::newRow("Figure 7") << 0.0004 << 1.1 << 5 << QStringList{"0.001", "0.01", "0.1", "1"};
        QTest::newRow("two decades, much room")
            << 0.0099 << 1.01 << 9 << QStringList{"0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"};
        QTest::newRow("within a decade") << 0.31 << 0.49 << 5 << QStringList{"0.35", "0.40", "0.45"};
        QTest::newRow("many decades")
            << 1e-9 << 1.0 << 5 << QStringList{"0.00000001", "0.000001", "0.0001", "0.01", "1"};
    }
    void logarithmicTicksFollowTheDecades() {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, most);
        QFETCH(QStringList, labels);
        const std::vector<Tick> ticks = charts::logarithmicTicks({std::log10(low), std::log10(high)}, most);
        QCOMPARE(labelsOf(ticks), labels);
        for (const Tick& tick : ticks)
            QVERIFY(std::abs(std::pow(10.0, tick.position) / tick.label.toDouble() - 1.0) < 1e-9);
    }

    void nothingComesOfNoRange() {
        QVERIFY(charts::linearTicks({1.0, 1.0}, 5).empty());
        QVERIFY(charts::linearTicks({0.0, std::numeric_limits<double>::quiet_NaN()}, 5).empty());
        QVERIFY(charts::logarithmicTicks({1.0, 1.0}, 5).empty());
    }
};

QTEST_GUILESS_MAIN(TicksTest)
#include "ticks_test.moc"
