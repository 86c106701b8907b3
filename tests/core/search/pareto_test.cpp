#include "core/search/pareto.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;
using search::TwoScores;

namespace {

bool dominates(const TwoScores& a, const TwoScores& b) {
    return a[0] >= b[0] && a[1] >= b[1] && (a[0] > b[0] || a[1] > b[1]);
}

/// As the definition says: fronts are taken away one after the other.
std::vector<int> sortSlowly(const std::vector<TwoScores>& points) {
    std::vector<int> fronts(points.size(), -1);
    for (int front = 0; std::ranges::count(fronts, -1) > 0; ++front) {
        const std::vector<int> before = fronts;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (before[i] >= 0) continue;
            bool isDominated = false;
            for (std::size_t k = 0; k < points.size(); ++k)
                isDominated = isDominated || (before[k] < 0 && dominates(points[k], points[i]));
            if (!isDominated) fronts[i] = front;
        }
    }
    return fronts;
}

/// Of a coarse grid where `steps` is small, so that many are equal.
std::vector<TwoScores> drawPoints(std::uint64_t seed, int count, int steps) {
    base::Random random({.seed = seed});
    std::vector<TwoScores> points;
    points.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        points.push_back({std::floor(steps * random.uniform()), std::floor(steps * random.uniform())});
    return points;
}

}  // namespace

class ParetoTest : public QObject {
    Q_OBJECT

 private slots:
    void frontsAreAsTheirDefinitionSays_data() {
        QTest::addColumn<int>("count");
        QTest::addColumn<int>("steps");
        QTest::newRow("none") << 0 << 10;
        QTest::newRow("one") << 1 << 10;
        QTest::newRow("many equal") << 60 << 4;
        QTest::newRow("some equal") << 80 << 20;
        QTest::newRow("none equal") << 80 << 1000000;
    }
    void frontsAreAsTheirDefinitionSays() {
        QFETCH(int, count);
        QFETCH(int, steps);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const std::vector<TwoScores> points = drawPoints(seed, count, steps);
            const std::vector<int> fronts = search::sortFronts(points);
            QVERIFY(fronts == sortSlowly(points));
            // The front alone: each of its points once, from the best of the first score on.
            const std::vector<std::size_t> front = search::findFront(points);
            for (std::size_t k = 0; k < front.size(); ++k) {
                QCOMPARE(fronts[front[k]], 0);
                if (k > 0) QVERIFY(points[front[k]][0] < points[front[k - 1]][0]);
            }
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (fronts[i] > 0) continue;
                QVERIFY(std::ranges::any_of(front, [&](std::size_t k) { return points[k] == points[i]; }));
            }
            // Nobody is ranked before somebody of a better front.
            const std::vector<std::size_t> order = search::rankByFronts(points);
            QCOMPARE(order.size(), points.size());
            for (std::size_t k = 1; k < order.size(); ++k)
                QVERIFY(fronts[order[k - 1]] <= fronts[order[k]]);
            std::vector<std::size_t> sorted = order;
            std::ranges::sort(sorted);
            for (std::size_t k = 0; k < sorted.size(); ++k)
                QCOMPARE(sorted[k], k);
        }
    }

    // Within a front: the ends, then who has most room between its neighbours.
    void roomDecidesWithinAFront() {
        const std::vector<TwoScores> points = {{4.0, 8.0}, {1.0, 9.0}, {5.0, 7.0}, {9.0, 1.0}, {0.0, 0.0}};
        const std::vector<std::size_t> order = search::rankByFronts(points);
        // Index 0 has (5 - 1) + (9 - 7) = 6 of 8, index 2 (9 - 4) + (8 - 1) = 12 of 8.
        const std::vector<std::size_t> expected = {1, 3, 2, 0, 4};
        QVERIFY(order == expected);
    }
};

QTEST_APPLESS_MAIN(ParetoTest)
#include "pareto_test.moc"
