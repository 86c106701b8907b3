#include "core/stats/binomial.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;

class BinomialTest : public QObject {
    Q_OBJECT

 private slots:
    // Where one of many fails, no table says that none did.
    void decimalsOfPercent() {
        QCOMPARE(stats::countPercentDecimals(1.0), 1);
        QCOMPARE(stats::countPercentDecimals(0.0), 1);
        QCOMPARE(stats::countPercentDecimals(0.5), 1);
        QCOMPARE(stats::countPercentDecimals(0.9994), 1);
        QCOMPARE(stats::countPercentDecimals(0.9996), 2);
        QCOMPARE(stats::countPercentDecimals(0.0004), 2);
        QCOMPARE(stats::countPercentDecimals(0.99997), 3);
        QCOMPARE(stats::countPercentDecimals(1.0 - 1e-9), 3);
    }

    void clopperPearson_data() {
        QTest::addColumn<int>("successes");
        QTest::addColumn<int>("trials");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        // Newcombe (1998), Table I, method 5; 0 of 10 and 10 of 10 are 1 - 0.025^(1/10).
        QTest::newRow("81 of 263") << 81 << 263 << 0.2527 << 0.3676;
        QTest::newRow("15 of 148") << 15 << 148 << 0.0578 << 0.1617;
        QTest::newRow("0 of 20") << 0 << 20 << 0.0 << 0.1684;
        QTest::newRow("1 of 29") << 1 << 29 << 0.0009 << 0.1776;
        QTest::newRow("600 of 600") << 600 << 600 << 0.9939 << 1.0;  // 0.025^(1/600)
        QTest::newRow("0 of 10") << 0 << 10 << 0.0 << 0.3085;
        QTest::newRow("10 of 10") << 10 << 10 << 0.6915 << 1.0;
        QTest::newRow("5 of 10") << 5 << 10 << 0.1871 << 0.8129;
    }
    void clopperPearson() {
        QFETCH(int, successes);
        QFETCH(int, trials);
        QFETCH(double, low);
        QFETCH(double, high);
        const auto interval = stats::calcClopperPearson(successes, trials);
        QVERIFY(std::abs(interval.low - low) < 5.1e-5);
        QVERIFY(std::abs(interval.high - high) < 5.1e-5);
    }

    // Clopper and Pearson's ends are where the binomial tails are alpha / 2.
    void clopperPearsonTails() {
        const int trials = 30;
        for (int successes = 1; successes < trials; ++successes) {
            const auto interval = stats::calcClopperPearson(successes, trials, 0.9);
            double above = 0.0;
            double below = 0.0;
            for (int k = 0; k <= trials; ++k) {
                const double ways = std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) -
                                             std::lgamma(trials - k + 1.0));
                if (k >= successes)
                    above += ways * std::pow(interval.low, k) * std::pow(1.0 - interval.low, trials - k);
                if (k <= successes)
                    below += ways * std::pow(interval.high, k) * std::pow(1.0 - interval.high, trials - k);
            }
            QVERIFY(std::abs(above - 0.05) < 1e-9);
            QVERIFY(std::abs(below - 0.05) < 1e-9);
        }
    }

    void mirrored() {
        for (int k = 0; k <= 25; ++k) {
            const auto interval = stats::calcClopperPearson(k, 25);
            const auto other = stats::calcClopperPearson(25 - k, 25);
            QVERIFY(std::abs(interval.low - (1.0 - other.high)) < 1e-12);
            QVERIFY(interval.low >= 0.0 && interval.low <= k / 25.0 && interval.high >= k / 25.0 &&
                    interval.high <= 1.0);
            const auto wider = stats::calcClopperPearson(k, 25, 0.99);
            QVERIFY(wider.low <= interval.low && wider.high >= interval.high);
        }
    }

    void nothingKnown() {
        const auto interval = stats::calcClopperPearson(0, 0);
        QCOMPARE(interval.low, 0.0);
        QCOMPARE(interval.high, 1.0);
    }
};

QTEST_APPLESS_MAIN(BinomialTest)
#include "binomial_test.moc"
