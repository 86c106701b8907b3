#include "core/search/ranking.h"

#include <QtTest>
#include <vector>

using namespace trapwright;

class RankingTest : public QObject {
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
        const auto best = search::findTop(fitnesses);
        QCOMPARE(best.size(), static_cast<std::size_t>(top));
        for (std::size_t k = 1; k < best.size(); ++k) {
            QVERIFY(fitnesses[best[k - 1]] > fitnesses[best[k]] ||
                    (fitnesses[best[k - 1]] == fitnesses[best[k]] && best[k - 1] < best[k]));
        }
        for (const double fitness : fitnesses) {
            if (fitness > fitnesses[best.front()]) QFAIL("not the winner");
        }
    }
};

QTEST_APPLESS_MAIN(RankingTest)
#include "ranking_test.moc"
