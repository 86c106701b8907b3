#include "core/stats/samples.h"

#include <QtTest>
#include <algorithm>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;

class SamplesTest : public QObject {
    Q_OBJECT

    static std::vector<double> draw(base::Random& random, int count, double shift) {
        std::vector<double> values;
        values.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            values.push_back(random.normal() + shift);
        return values;
    }

 private slots:
    void median_data() {
        QTest::addColumn<QList<double>>("values");
        QTest::addColumn<double>("median");
        QTest::newRow("one") << QList<double>{3} << 3.0;
        QTest::newRow("odd") << QList<double>{5, 1, 3} << 3.0;
        QTest::newRow("even") << QList<double>{4, 1, 3, 10} << 3.5;
        QTest::newRow("equal") << QList<double>{2, 2, 2, 2} << 2.0;
        QTest::newRow("negative") << QList<double>{-5, -1, -3} << -3.0;
    }
    void median() {
        QFETCH(QList<double>, values);
        QFETCH(double, median);
        QCOMPARE(stats::medianOf(std::vector<double>(values.begin(), values.end())), median);
    }

    void quartiles() {
        const auto quartiles = [](const std::vector<double>& values) { return stats::calcQuartiles(values); };
        QCOMPARE(quartiles({7}).lower, 7.0);
        QCOMPARE(quartiles({7}).upper, 7.0);
        QCOMPARE(quartiles({5, 1, 4, 2, 3}).lower, 2.0);
        QCOMPARE(quartiles({5, 1, 4, 2, 3}).median, 3.0);
        QCOMPARE(quartiles({5, 1, 4, 2, 3}).upper, 4.0);
        // As R's and numpy's default: 1.75, 2.5, 3.25.
        QCOMPARE(quartiles({1, 2, 3, 4}).lower, 1.75);
        QCOMPARE(quartiles({1, 2, 3, 4}).median, 2.5);
        QCOMPARE(quartiles({1, 2, 3, 4}).upper, 3.25);
    }

    void kolmogorovSmirnov_data() {
        QTest::addColumn<int>("shift");
        QTest::addColumn<int>("count");
        QTest::addColumn<double>("statistic");
        QTest::addColumn<double>("p");
        // 0 ... n-1 against the same moved up by shift - 0.5: the statistic is k / n with k = shift. For
        // equal sizes p = 2 (C(2n, n-k) - C(2n, n-2k) + ...) / C(2n, n) (Gnedenko and Korolyuk 1951).
        QTest::newRow("10, D = 0.5") << 5 << 10 << 0.5 << 2.0 * (15504.0 - 1.0) / 184756.0;
        QTest::newRow("10, D = 0.6") << 6 << 10 << 0.6 << 2.0 * 4845.0 / 184756.0;
        QTest::newRow("10, D = 0.7") << 7 << 10 << 0.7 << 2.0 * 1140.0 / 184756.0;
        QTest::newRow("10, D = 1") << 10 << 10 << 1.0 << 2.0 / 184756.0;
        QTest::newRow("5, D = 1") << 5 << 5 << 1.0 << 2.0 / 252.0;
        QTest::newRow("3, D = 1") << 3 << 3 << 1.0 << 0.1;
    }
    void kolmogorovSmirnov() {
        QFETCH(int, shift);
        QFETCH(int, count);
        QFETCH(double, statistic);
        QFETCH(double, p);
        std::vector<double> a;
        std::vector<double> b;
        for (int i = count - 1; i >= 0; --i) {
            a.push_back(i);
            b.push_back(i + shift - 0.5);
        }
        const auto test = stats::testKolmogorovSmirnov(a, b);
        QVERIFY(std::abs(test.statistic - statistic) < 1e-15);
        QVERIFY(std::abs(test.p / p - 1.0) < 1e-12);
        QCOMPARE(stats::testKolmogorovSmirnov(b, a).p, test.p);
    }

    // All orders of 4 and 3 values written out: the share that reaches a difference is its probability.
    void unequalSizesByEnumeration() {
        const std::vector<double> all = {1, 2, 3, 4, 5, 6, 7};
        std::vector<double> statistics;
        std::vector<double> ps;
        std::vector<int> owner = {0, 0, 0, 0, 1, 1, 1};
        do {
            std::vector<double> a;
            std::vector<double> b;
            for (std::size_t i = 0; i < 7; ++i)
                (owner[i] == 0 ? a : b).push_back(all[i]);
            const auto test = stats::testKolmogorovSmirnov(a, b);
            statistics.push_back(test.statistic);
            ps.push_back(test.p);
        } while (std::next_permutation(owner.begin(), owner.end()));
        QCOMPARE(statistics.size(), std::size_t{35});
        for (std::size_t i = 0; i < 35; ++i) {
            const auto reached = std::count_if(statistics.begin(), statistics.end(),
                                               [&](double d) { return d >= statistics[i] - 1e-12; });
            QVERIFY(std::abs(ps[i] - static_cast<double>(reached) / 35.0) < 1e-12);
        }
    }

    void equalSamplesDoNotDiffer() {
        const std::vector<double> a = {1, 1, 2, 5};
        const auto test = stats::testKolmogorovSmirnov(a, a);
        QCOMPARE(test.statistic, 0.0);
        QCOMPARE(test.p, 1.0);
    }

    // Under the null hypothesis p < 0.05 in at most 5 % of the tests; a shift of half a deviation is seen.
    void rejectsAtItsLevel() {
        base::Random random({2, 0, 0, 0, base::Purpose::test});
        int rejected = 0;
        int seen = 0;
        constexpr int kTests = 500;
        for (int i = 0; i < kTests; ++i) {
            const auto a = draw(random, 120, 0.0);
            if (stats::testKolmogorovSmirnov(a, draw(random, 90, 0.0)).p < 0.05) ++rejected;
            if (stats::testKolmogorovSmirnov(a, draw(random, 90, 0.5)).p < 0.05) ++seen;
        }
        QVERIFY(rejected > 10 && rejected < 0.05 * kTests + 4.0 * std::sqrt(kTests * 0.05 * 0.95));
        QVERIFY(seen > 0.75 * kTests);
    }
};

QTEST_APPLESS_MAIN(SamplesTest)
#include "samples_test.moc"
