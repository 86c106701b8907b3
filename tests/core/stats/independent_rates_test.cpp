#include "core/stats/rates.h"

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace trapwright;
using stats::RatePair;

namespace {

double choose(int n, int k) {
    return std::round(std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0)));
}

/// The probability of a table if both rates are `rate`.
double tableProbability(const RatePair& t, double rate) {
    const int successes = t.a.successes + t.b.successes;
    const int failures = t.a.trials + t.b.trials - successes;
    return choose(t.a.trials, t.a.successes) * choose(t.b.trials, t.b.successes) * std::pow(rate, successes) *
           std::pow(1.0 - rate, failures);
}

std::vector<RatePair> allTables(int a, int b) {
    std::vector<RatePair> tables;
    for (int x = 0; x <= a; ++x)
        for (int y = 0; y <= b; ++y)
            tables.push_back({{x, a}, {y, b}});
    return tables;
}

/// Fisher's test by its definition: every table of the same successes in all.
double fisherByDefinition(const RatePair& t) {
    const int successes = t.a.successes + t.b.successes;
    const double own = choose(t.a.trials, t.a.successes) * choose(t.b.trials, t.b.successes);
    double sum = 0.0;
    for (int x = 0; x <= t.a.trials; ++x) {
        if (successes - x < 0 || successes - x > t.b.trials) continue;
        const double ways = choose(t.a.trials, x) * choose(t.b.trials, successes - x);
        if (ways <= own * (1.0 + 1e-7)) sum += ways;
    }
    return sum / choose(t.a.trials + t.b.trials, successes);
}

/// Boschloo's test by its definition, the rate on a fine grid: a hair less than the true maximum.
double boschlooByDefinition(const RatePair& t) {
    const double own = fisherByDefinition(t);
    std::vector<RatePair> rejected;
    for (const RatePair& other : allTables(t.a.trials, t.b.trials))
        if (fisherByDefinition(other) <= own * (1.0 + 1e-7)) rejected.push_back(other);
    double greatest = 0.0;
    for (int i = 1; i < 2000; ++i) {
        double sum = 0.0;
        for (const RatePair& other : rejected)
            sum += tableProbability(other, i / 2000.0);
        greatest = std::max(greatest, sum);
    }
    return greatest;
}

}  // namespace

class IndependentRatesTest : public QObject {
    Q_OBJECT

 private slots:
    void fisher_data() {
        QTest::addColumn<int>("a");
        QTest::addColumn<int>("ofA");
        QTest::addColumn<int>("b");
        QTest::addColumn<int>("ofB");
        QTest::addColumn<double>("p");
        // As published, to the digits given there: Fisher's tea taster and twins (fisher.test of R); Perondi
        // et al. (2004) and Ritland et al. (2007) in Fagerland, Lydersen and Laake, Statistical Analysis of
        // Contingency Tables, chapter 4.
        QTest::newRow("tea") << 3 << 4 << 1 << 4 << 0.4857;
        QTest::newRow("twins") << 2 << 17 << 10 << 13 << 0.0005;
        QTest::newRow("Perondi") << 7 << 34 << 1 << 34 << 0.0544;
        QTest::newRow("Ritland") << 0 << 16 << 15 << 72 << 0.0629;
        QTest::newRow("no trials") << 0 << 0 << 3 << 9 << 1.0;
        QTest::newRow("all alike") << 600 << 600 << 6000 << 6000 << 1.0;
    }
    void fisher() {
        QFETCH(int, a);
        QFETCH(int, ofA);
        QFETCH(int, b);
        QFETCH(int, ofB);
        QFETCH(double, p);
        const double found = stats::testFisher({{a, ofA}, {b, ofB}});
        QVERIFY2(std::abs(found - p) < 5.1e-5, qPrintable(QString::number(found, 'g', 10)));
        QVERIFY(std::abs(stats::testFisher({{b, ofB}, {a, ofA}}) - found) < 1e-12);
        QVERIFY(std::abs(stats::testFisher({{ofA - a, ofA}, {ofB - b, ofB}}) - found) < 1e-12);
    }

    // Penicillin and rabbits, Agresti (1990), pages 231-237: 0.040 by R's mantelhaen.test(exact = TRUE).
    void fisherOverStrata() {
        const std::vector<RatePair> rabbits = {
            {{0, 6}, {0, 5}}, {{3, 6}, {0, 6}}, {{6, 6}, {2, 6}}, {{5, 6}, {6, 6}}, {{2, 2}, {5, 5}}};
        const double p = stats::testFisher(rabbits);
        QVERIFY2(std::abs(p - 0.040) < 5e-4, qPrintable(QString::number(p)));
        const RatePair single{{7, 34}, {1, 34}};
        QCOMPARE(stats::testFisher(std::vector{single}), stats::testFisher(single));
        // Each rate differs between the strata but not within them: pooled they would seem to.
        const std::vector<RatePair> mixed = {{{450, 500}, {45, 50}}, {{5, 50}, {50, 500}}};
        QVERIFY(stats::testFisher(mixed) > 0.9);
        QVERIFY(stats::testFisher({{455, 550}, {95, 550}}) < 1e-6);
    }

    // exact.test of R's package Exact, as in SciPy's tests: one-sided 0.03410916 for 7 of 15 against 12 of 15
    // (Mehta and Senchaudhuri 2003). With groups of one size the other side is its mirror image.
    void boschlooAsPublished() {
        QVERIFY(std::abs(stats::testFisher({{7, 15}, {12, 15}}) - 2 * 0.06406797) < 1e-7);
        QVERIFY(std::abs(stats::testBoschloo({{7, 15}, {12, 15}}) - 2 * 0.03410916) < 1e-7);
    }

    void testsByDefinition() {
        for (const auto& [a, b] : {std::pair(1, 1), {3, 5}, {10, 9}, {12, 4}, {20, 6}}) {
            for (const RatePair& table : allTables(a, b)) {
                const double fisher = stats::testFisher(table);
                QVERIFY(std::abs(fisher - fisherByDefinition(table)) < 1e-9);
                const double boschloo = stats::testBoschloo(table);
                QVERIFY(boschloo <= fisher);
                if (table.a.successes % 3 != 0) continue;  // the definition is slow
                const double expected = std::min(fisher, boschlooByDefinition(table));
                QVERIFY2(boschloo >= expected - 1e-9 && boschloo < expected + 1e-4 * expected,
                         qPrintable(QString("%1 / %2, %3 / %4: %5 for %6")
                                        .arg(table.a.successes)
                                        .arg(a)
                                        .arg(table.b.successes)
                                        .arg(b)
                                        .arg(boschloo)
                                        .arg(expected)));
            }
        }
    }

    // Whatever the common rate, no more than the level is rejected where there is no difference.
    void boschlooKeepsItsLevel() {
        std::vector<RatePair> rejected;
        for (const RatePair& table : allTables(40, 10))
            if (stats::testBoschloo(table) <= 0.05) rejected.push_back(table);
        QVERIFY(!rejected.empty());
        double greatest = 0.0;
        for (int i = 1; i < 400; ++i) {
            double wrong = 0.0;
            for (const RatePair& table : rejected)
                wrong += tableProbability(table, i / 400.0);
            greatest = std::max(greatest, wrong);
        }
        QVERIFY2(greatest <= 0.05 + 1e-12 && greatest > 0.03, qPrintable(QString::number(greatest)));
    }

    // The paper's Tables 2 and 3, totals.
    void paper() {
        const double cuboid = stats::testFisher({{5962, 6000}, {600, 600}});
        const double cone = stats::testFisher({{3874, 4000}, {394, 400}});
        QVERIFY(cuboid < 0.05 && cone > 0.05);
        const double sharper = stats::testBoschloo({{5962, 6000}, {600, 600}});
        QVERIFY(sharper > 0.0 && sharper <= cuboid);
    }
};

QTEST_APPLESS_MAIN(IndependentRatesTest)
#include "independent_rates_test.moc"
