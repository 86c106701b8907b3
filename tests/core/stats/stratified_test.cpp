#include "core/stats/stratified.h"

#include <QtTest>
#include <cmath>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;
using stats::ArrivalStratum;
using stats::Interval;
using stats::Stratum;

namespace {

double calcBinomial(int successes, int trials, double rate) {
    return std::exp(std::lgamma(trials + 1.0) - std::lgamma(successes + 1.0) -
                    std::lgamma(trials - successes + 1.0) + successes * std::log(rate) +
                    (trials - successes) * std::log1p(-rate));
}

bool agree(const Interval& a, const Interval& b, double digits) {
    return std::abs(a.low - b.low) < digits && std::abs(a.high - b.high) < digits;
}

}  // namespace

class StratifiedTest : public QObject {
    Q_OBJECT

 private slots:
    void equalStrataArePooled_data() {
        QTest::addColumn<QList<int>>("successes");
        QTest::addColumn<int>("trials");
        QTest::newRow("one stratum") << QList<int>{81} << 263;
        QTest::newRow("one that never succeeds") << QList<int>{0} << 20;
        QTest::newRow("all succeed") << QList<int>{100, 100, 100} << 100;
        QTest::newRow("few fail") << QList<int>{98, 100, 97} << 100;
        QTest::newRow("half fail, unevenly") << QList<int>{50, 60, 40} << 100;
        QTest::newRow("two opposites") << QList<int>{10, 0} << 10;
        QTest::newRow("six of 1000") << QList<int>{1000, 990, 995, 991, 993, 993} << 1000;
    }

    /// Hoeffding (1956): then equal rates are the worst ones, and the pooled trials are binomial.
    void equalStrataArePooled() {
        QFETCH(QList<int>, successes);
        QFETCH(int, trials);
        std::vector<Stratum> strata;
        int sum = 0;
        for (const int one : successes) {
            strata.push_back({1.0 / static_cast<double>(successes.size()), {one, trials}});
            sum += one;
        }
        const int all = trials * static_cast<int>(successes.size());
        const stats::WeightedRate rate = stats::estimateWeighted(strata);
        QVERIFY(std::abs(rate.rate.value() - static_cast<double>(sum) / all) < 1e-12);
        const Interval pooled = stats::calcClopperPearson(sum, all);
        QVERIFY2(agree(rate.interval, pooled, 2e-4), qPrintable(QString("%1 %2, not %3 %4")
                                                                    .arg(rate.interval.low)
                                                                    .arg(rate.interval.high)
                                                                    .arg(pooled.low)
                                                                    .arg(pooled.high)));
    }

    /// A closed form: with no failure, failing parts may all be of the kind that weighs most per trial.
    void nothingFailed() {
        const std::vector<Stratum> strata = {{0.9, {100, 100}}, {0.08, {50, 50}}, {0.02, {10, 10}}};
        const stats::WeightedRate rate = stats::estimateWeighted(strata);
        QCOMPARE(rate.rate.value(), 1.0);
        QCOMPARE(rate.interval.high, 1.0);
        double low = 1.0;
        for (const Stratum& stratum : strata)
            low = std::min(low, 1.0 - stratum.weight * (1.0 - std::pow(0.025, 1.0 / stratum.count.trials)));
        QVERIFY(std::abs(rate.interval.low - low) < 1e-6);
    }

    void weightsCount() {
        // The bolt: one in a hundred lands on its tip, where all fail.
        const std::vector<Stratum> strata = {{90.6, {100, 100}}, {8.3, {100, 100}}, {1.1, {0, 100}}};
        const stats::WeightedRate rate = stats::estimateWeighted(strata);
        QVERIFY(std::abs(rate.rate.value() - 0.989) < 1e-12);
        QVERIFY(rate.interval.low > 0.95 && rate.interval.high < 0.999);
        const stats::WeightedRate more = stats::estimateWeighted(
            std::vector<Stratum>{{90.6, {1000, 1000}}, {8.3, {1000, 1000}}, {1.1, {0, 1000}}});
        QVERIFY(more.interval.low > rate.interval.low && more.interval.high < rate.interval.high);
        // What is never met does not matter.
        std::vector<Stratum> unmet = strata;
        unmet.push_back({0.0, {3, 100}});
        QVERIFY(agree(stats::estimateWeighted(unmet).interval, rate.interval, 1e-12));
        // Failures and successes change places.
        std::vector<Stratum> swapped = strata;
        for (Stratum& one : swapped)
            one.count.successes = one.count.trials - one.count.successes;
        const Interval mirrored = stats::estimateWeighted(swapped).interval;
        QVERIFY(agree(rate.interval, {1.0 - mirrored.high, 1.0 - mirrored.low}, 1e-9));
    }

    void untriedKindsMayDoAnything() {
        const stats::WeightedRate nothing = stats::estimateWeighted(std::vector<Stratum>{{1.0, {0, 0}}});
        QVERIFY(!nothing.rate && nothing.interval.low == 0.0 && nothing.interval.high == 1.0);
        const stats::WeightedRate some =
            stats::estimateWeighted(std::vector<Stratum>{{0.9, {100, 100}}, {0.1, {0, 0}}});
        QVERIFY(!some.rate);
        QVERIFY(std::abs(some.interval.low - 0.9 * std::pow(0.025, 0.01)) < 1e-6);
        QCOMPARE(some.interval.high, 1.0);
        QVERIFY(!stats::estimateWeighted({}).rate);
    }

    void coversTheTruth_data() {
        QTest::addColumn<double>("weight");
        QTest::addColumn<int>("a");
        QTest::addColumn<int>("b");
        QTest::addColumn<double>("least");
        QTest::newRow("equal") << 0.5 << 10 << 10 << 0.95;
        QTest::newRow("unequal weights") << 0.84 << 10 << 10 << 0.949;
        QTest::newRow("most trials where most parts land") << 0.84 << 30 << 5 << 0.949;
        QTest::newRow("fewest trials where most parts land") << 0.84 << 5 << 30 << 0.935;
        QTest::newRow("a rare kind") << 0.97 << 20 << 20 << 0.935;
    }

    /// Every outcome of two strata, weighed exactly, over a grid of true rates.
    void coversTheTruth() {
        QFETCH(double, weight);
        QFETCH(int, a);
        QFETCH(int, b);
        QFETCH(double, least);
        std::vector<Interval> intervals;
        for (int x = 0; x <= a; ++x)
            for (int y = 0; y <= b; ++y)
                intervals.push_back(
                    stats::estimateWeighted(std::vector<Stratum>{{weight, {x, a}}, {1.0 - weight, {y, b}}})
                        .interval);
        double worst = 1.0;
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i <= 41; ++i) {
            for (int j = 0; j <= 36; ++j) {
                const double p = 0.01 + 0.0241 * i;
                const double q = 0.01 + 0.0273 * j;
                const double truth = weight * p + (1.0 - weight) * q;
                double covered = 0.0;
                for (int x = 0; x <= a; ++x) {
                    for (int y = 0; y <= b; ++y) {
                        const Interval& one = intervals[static_cast<std::size_t>(x) * (b + 1) + y];
                        if (one.low <= truth + 1e-9 && truth <= one.high + 1e-9)
                            covered += calcBinomial(x, a, p) * calcBinomial(y, b, q);
                    }
                }
                worst = std::min(worst, covered);
                sum += covered;
                ++count;
            }
        }
        QVERIFY2(worst >= least, qPrintable(QString::number(worst)));
        QVERIFY2(sum / count > 0.96 && sum / count < 0.99, qPrintable(QString::number(sum / count)));
    }

    /// The same by chance, for a bolt's three kinds with 100 trials each.
    void coversTheTruthOfThree() {
        const std::vector<double> weights = {0.906, 0.083, 0.011};
        const std::vector<double> rates = {0.985, 0.9, 0.3};
        const double truth = 0.906 * 0.985 + 0.083 * 0.9 + 0.011 * 0.3;
        base::Random random({.seed = 5, .purpose = base::Purpose::validation});
        constexpr int kStudies = 2000;
        int covered = 0;
        double width = 0.0;
        for (int study = 0; study < kStudies; ++study) {
            std::vector<Stratum> strata;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                int successes = 0;
                for (int trial = 0; trial < 100; ++trial)
                    successes += random.uniform() < rates[i] ? 1 : 0;
                strata.push_back({weights[i], {successes, 100}});
            }
            const Interval interval = stats::estimateWeighted(strata).interval;
            covered += interval.low <= truth && truth <= interval.high ? 1 : 0;
            width += interval.high - interval.low;
        }
        // 95 % less three standard deviations of 2000 draws.
        QVERIFY2(covered >= 0.935 * kStudies, qPrintable(QString::number(covered)));
        QVERIFY2(width / kStudies < 0.07, qPrintable(QString::number(width / kStudies)));
    }

    void correctOnesOfOneKindAreClopperAndPearsons() {
        const stats::WeightedRate rate =
            stats::estimateCorrect(std::vector<ArrivalStratum>{{0.7, 1000, 400, 380}});
        QCOMPARE(rate.rate.value(), 0.95);
        QVERIFY(agree(rate.interval, stats::calcClopperPearson(380, 400), 1e-9));
        const stats::WeightedRate all =
            stats::estimateCorrect(std::vector<ArrivalStratum>{{1.0, 1000, 400, 400}});
        QVERIFY(agree(all.interval, stats::calcClopperPearson(400, 400), 1e-9));
    }

    void correctOnesOfAMixture() {
        // Of a hundred parts 80 are of a kind of which half arrive, nine of ten right; of 20 all arrive
        // wrong.
        const stats::WeightedRate rate =
            stats::estimateCorrect(std::vector<ArrivalStratum>{{0.8, 100, 50, 45}, {0.2, 500, 500, 0}});
        QVERIFY(std::abs(rate.rate.value() - 0.36 / 0.6) < 1e-12);
        QVERIFY(rate.interval.low > 0.45 && rate.interval.high < 0.75);
    }

    void correctOnesAreNotKnown() {
        QVERIFY(!stats::estimateCorrect({}).rate);
        QVERIFY(!stats::estimateCorrect(std::vector<ArrivalStratum>{{1.0, 100, 0, 0}}).rate);
        // A kind that is met was never tried; one that is not does not matter.
        QVERIFY(!stats::estimateCorrect(std::vector<ArrivalStratum>{{0.5, 10, 5, 5}, {0.5, 0, 0, 0}}).rate);
        QVERIFY(stats::estimateCorrect(std::vector<ArrivalStratum>{{0.5, 10, 5, 5}, {0.0, 0, 0, 0}}).rate);
    }

    void correctOnesAreWithinTheirBounds_data() {
        QTest::addColumn<double>("right");
        QTest::newRow("nearly all") << 0.98;
        QTest::newRow("three of four") << 0.75;
    }

    /// By chance, three kinds with 150 trials each, of which some arrive.
    void correctOnesAreWithinTheirBounds() {
        QFETCH(double, right);
        const std::vector<double> weights = {0.6, 0.3, 0.1};
        const std::vector<double> arrive = {0.4, 0.8, 0.1};
        const std::vector<double> rates = {right, right - 0.1, 0.5};
        double arrived = 0.0;
        double correct = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            arrived += weights[i] * arrive[i];
            correct += weights[i] * arrive[i] * rates[i];
        }
        base::Random random({.seed = 6, .purpose = base::Purpose::validation});
        constexpr int kStudies = 3000;
        int covered = 0;
        double width = 0.0;
        for (int study = 0; study < kStudies; ++study) {
            std::vector<ArrivalStratum> strata;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                ArrivalStratum& kind = strata.emplace_back(ArrivalStratum{weights[i], 150, 0, 0});
                for (int trial = 0; trial < kind.trials; ++trial) {
                    if (random.uniform() >= arrive[i]) continue;
                    ++kind.arrived;
                    kind.right += random.uniform() < rates[i] ? 1 : 0;
                }
            }
            const Interval interval = stats::estimateCorrect(strata).interval;
            covered += interval.low <= correct / arrived && correct / arrived <= interval.high ? 1 : 0;
            width += interval.high - interval.low;
        }
        QVERIFY2(covered >= 0.94 * kStudies, qPrintable(QString::number(covered)));
        QVERIFY2(width / kStudies < 0.2, qPrintable(QString::number(width / kStudies)));
    }
};

QTEST_APPLESS_MAIN(StratifiedTest)
#include "stratified_test.moc"
