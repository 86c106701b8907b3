#include "core/evolution/statistics.h"

#include <QtTest>
#include <cmath>
#include <vector>

using namespace trapwright;

class StatisticsTest : public QObject {
    Q_OBJECT

 private slots:
    void top_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<int>("top");
        QTest::newRow("100") << 100 << 30;
        QTest::newRow("40") << 40 << 12;
        QTest::newRow("5") << 5 << 2;
        QTest::newRow("1") << 1 << 1;
    }
    void top() {
        QFETCH(int, count);
        QFETCH(int, top);
        std::vector<double> fitnesses;
        fitnesses.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            fitnesses.push_back((3 * i) % count);
        const auto best = evolution::findTop(fitnesses);
        QCOMPARE(best.size(), static_cast<std::size_t>(top));
        for (std::size_t k = 1; k < best.size(); ++k) {
            QVERIFY(fitnesses[best[k - 1]] > fitnesses[best[k]] ||
                    (fitnesses[best[k - 1]] == fitnesses[best[k]] && best[k - 1] < best[k]));
        }
        for (const double fitness : fitnesses) {
            if (fitness > fitnesses[best.front()]) QFAIL("not the winner");
        }
    }

    void strategyMean() {
        const std::vector<evolution::StrategyValues> values = {{0.2, 1e-4, 0.0}, {0.8, 1e-2, 0.5}};
        const auto mean = evolution::calcGeometricMean(values);
        QVERIFY(std::abs(mean.crossover - 0.4) < 1e-14);
        QVERIFY(std::abs(mean.mutation - 1e-3) < 1e-16);
        QCOMPARE(mean.smoothing, 0.0);
    }
};

QTEST_APPLESS_MAIN(StatisticsTest)
#include "statistics_test.moc"
