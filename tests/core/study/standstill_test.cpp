#include "core/study/standstill.h"

#include <QtTest>
#include <cmath>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;

namespace {

/// Of generations whose top 30 % have these means, with noise.
std::vector<study::GenerationSummary> makeSummaries(const std::vector<double>& means, double noise,
                                                    std::uint64_t seed = 1) {
    base::Random random({.seed = seed, .purpose = base::Purpose::validation});
    std::vector<study::GenerationSummary> summaries;
    for (const double mean : means) {
        study::GenerationSummary& summary = summaries.emplace_back();
        summary.index = static_cast<int>(summaries.size()) - 1;
        summary.statistics.topMean.total = mean + noise * (2.0 * random.uniform() - 1.0);
    }
    return summaries;
}

/// Rises by one in so many generations, then stays.
std::vector<double> rise(int rising, int generations) {
    std::vector<double> means;
    means.reserve(static_cast<std::size_t>(generations));
    for (int i = 0; i < generations; ++i)
        means.push_back(std::min(1.0, static_cast<double>(i) / rising));
    return means;
}

}  // namespace

class StandstillTest : public QObject {
    Q_OBJECT

 private slots:
    void fewGenerationsDoNotTell() {
        QVERIFY(!study::findStandstill({}));
        QVERIFY(!study::findStandstill(makeSummaries(std::vector<double>(15, 1.0), 0.0)));
    }

    void whatStaysTheSameStandsStillFromItsFirstGeneration() {
        QCOMPARE(study::findStandstill(makeSummaries(std::vector<double>(16, 1.0), 0.0)), 0);
        QCOMPARE(study::findStandstill(makeSummaries(std::vector<double>(60, 1.0), 0.0)), 0);
    }

    void whatRisesDoesNot() {
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            QVERIFY(!study::findStandstill(makeSummaries(rise(60, 60), 0.05, seed)));
    }

    // By exchanges from a plan: a rise in the first generations is no scatter that hides it.
    void whatRoseAtFirstDoesNotStandStillSinceThen() {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const auto since = study::findStandstill(makeSummaries(rise(8, 17), 0.05, seed));
            QVERIFY(!since || *since > 0);
        }
    }

    void whatRoseStandsStillSinceThen() {
        // Noise is taken for a gain once in eighty times.
        int told = 0;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const auto since = study::findStandstill(makeSummaries(rise(20, 60), 0.05, seed));
            if (since && *since >= 12 && *since <= 40) ++told;
        }
        QVERIFY2(told >= 90, qPrintable(QString::number(told)));
    }

    void gainsThatAreSmallAreGains() {
        // A fifth of the whole in the last ten generations, after a standstill.
        std::vector<double> means = rise(20, 50);
        for (int i = 0; i < 16; ++i)
            means.push_back(1.0 + 0.0125 * i);
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            QVERIFY(!study::findStandstill(makeSummaries(means, 0.05, seed)));
    }

    void whatFallsStandsStill() {
        std::vector<double> means = rise(20, 40);
        for (int i = 0; i < 20; ++i)
            means.push_back(0.9);
        QVERIFY(study::findStandstill(makeSummaries(means, 0.02)).has_value());
    }
};

QTEST_APPLESS_MAIN(StandstillTest)
#include "standstill_test.moc"
