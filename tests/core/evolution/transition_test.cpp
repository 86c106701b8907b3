#include "core/evolution/transition.h"

#include <QtTest>
#include <array>
#include <cmath>
#include <vector>

#include "core/evolution/gray.h"
#include "core/evolution/operators.h"
#include "core/evolution/population.h"

using namespace trapwright;
using evolution::Bits;
using evolution::Chromosome;
using evolution::TransitionParameters;

namespace {

constexpr evolution::ChromosomeLayout kLayout{40, 5};

base::Random makeRandom(std::uint64_t seed) {
    return base::Random({seed, 0, 0, 0, base::Purpose::test});
}

Bits keep(const Bits& points, double /*probability*/, base::Random& /*random*/) {
    return points;
}

Bits encodeStrategy(double crossover, double mutation, double smoothing) {
    return evolution::encodeGray(std::array{crossover, mutation, smoothing}, evolution::kStrategyBits);
}

double countDifferent(const Bits& a, const Bits& b) {
    double count = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i] ? 1.0 : 0.0;
    return count;
}

}  // namespace

class TransitionTest : public QObject {
    Q_OBJECT

 private slots:
    void geometricMean_data() {
        QTest::addColumn<QList<double>>("values");
        QTest::addColumn<double>("mean");
        QTest::newRow("one") << QList<double>{0.3} << 0.3;
        QTest::newRow("two") << QList<double>{0.2, 0.8} << 0.4;
        QTest::newRow("three") << QList<double>{1.0, 0.1, 0.01} << 0.1;
        QTest::newRow("zero") << QList<double>{0.0, 0.9} << 0.0;
        QTest::newRow("tiny ones do not underflow") << QList<double>(100, 1e-5) << 1e-5;
    }
    void geometricMean() {
        QFETCH(QList<double>, values);
        QFETCH(double, mean);
        const double got = evolution::combineGeometricMean(std::vector<double>(values.begin(), values.end()));
        QVERIFY(std::abs(got - mean) <= 1e-13 * mean);
    }

    void boundsTakeEffect() {
        const TransitionParameters parameters{0.002, 0.3, 0.0005};
        const auto values = evolution::limitStrategy({0.9, 1e-5, 0.8}, parameters);
        QCOMPARE(values, (evolution::StrategyValues{0.9, 0.0005, 0.8 * 0.3}));
        const auto inside = evolution::limitStrategy({0.9, 0.1, 0.2}, parameters);
        QCOMPARE(inside, (evolution::StrategyValues{0.9, 0.1, 0.2 * 0.3}));
        // The paper's own choices bound nothing.
        QCOMPARE(evolution::limitStrategy({1.0, 0.0, 1.0}, {0.002, 1.0, 0.0}),
                 (evolution::StrategyValues{1.0, 0.0, 1.0}));
    }

    // Without crossover, mutation and smoothing the child is parent 2.
    void nothingHappensAtZero() {
        base::Random random = makeRandom(1);
        auto parent1 = evolution::createRandomChromosome(kLayout, random);
        auto parent2 = evolution::createRandomChromosome(kLayout, random);
        parent1.strategy = encodeStrategy(0.0, 0.0, 0.4);
        parent2.strategy = encodeStrategy(0.0, 0.0, 0.7);
        const auto child = evolution::transition(parent1, parent2, {0.0, 1.0, 0.0}, keep, random);
        QCOMPARE(child, parent2);
    }

    // Algorithm 2, line by line, on a stream of the same key.
    void isAlgorithm2() {
        const TransitionParameters parameters{0.003, 1.0, 0.0};
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            base::Random setup = makeRandom(seed + 100);
            const auto p1 = evolution::createRandomChromosome(kLayout, setup);
            const auto p2 = evolution::createRandomChromosome(kLayout, setup);
            double smoothed = -1.0;
            const auto smooth = [&](const Bits& points, double probability, base::Random& random) {
                smoothed = probability;
                return evolution::mutateBinaryUniform(points, probability, random);
            };
            base::Random stream = makeRandom(seed);
            const auto child = evolution::transition(p1, p2, parameters, smooth, stream);

            base::Random random = makeRandom(seed);
            const auto v1 = evolution::decodeGray(p1.strategy, 20);
            const auto v2 = evolution::decodeGray(p2.strategy, 20);
            const double px = std::sqrt(v1[0] * v2[0]);
            const double pdm = std::sqrt(v1[1] * v2[1]);
            Bits gene3 = evolution::crossStateBased(p1.strategy, p2.strategy, px, random);
            gene3 = evolution::mutateBinaryUniform(gene3, pdm + 0.003, random);
            QCOMPARE(child.strategy, gene3);
            const auto v = evolution::decodeGray(gene3, 20);
            Bits gene2 = evolution::crossStateBased(p1.lengths, p2.lengths, v[0], random);
            gene2 = evolution::mutateBinaryUniform(gene2, v[1] + 0.003, random);
            QCOMPARE(child.lengths, gene2);
            Bits gene1 = evolution::crossStateBased(p1.points, p2.points, v[0], random);
            gene1 = evolution::mutatePoints(gene1, 10, v[1] + 0.003, random);
            gene1 = evolution::mutateBinaryUniform(gene1, v[2], random);
            QCOMPARE(child.points, gene1);
            QCOMPARE(smoothed, v[2]);
        }
    }

    // Of equal parents only mutation tells the child: its rate is the floor and the static rate together.
    void floorAndStaticRateAdd() {
        Chromosome parent;
        parent.points = Bits(800, 0);
        parent.lengths = Bits(100000, 0);
        parent.strategy = encodeStrategy(0.5, 0.0, 0.0);
        double strategyChanges = 0.0;
        double lengthChanges = 0.0;
        base::Random random = makeRandom(3);
        constexpr int kRuns = 40;
        int counted = 0;
        for (int run = 0; run < kRuns; ++run) {
            const auto child = evolution::transition(parent, parent, {0.01, 1.0, 0.02}, keep, random);
            const double changes = countDifferent(child.strategy, parent.strategy);
            strategyChanges += changes;
            // Where gene 3 has not changed, the child's own rate is known.
            if (changes == 0.0) {
                ++counted;
                lengthChanges += countDifferent(child.lengths, parent.lengths);
            }
        }
        QVERIFY(std::abs(strategyChanges - kRuns * 60 * 0.015) < 4.0 * std::sqrt(kRuns * 60 * 0.015));
        QVERIFY(counted > 5);
        QVERIFY(std::abs(lengthChanges / counted / 1e5 - 0.015) < 4.0 * std::sqrt(0.015 / 1e5 / counted));
    }

    void smoothingLimitReachesTheSmoother() {
        base::Random random = makeRandom(4);
        auto parent = evolution::createRandomChromosome(kLayout, random);
        parent.strategy = encodeStrategy(0.0, 0.0, 1.0);
        double smoothed = -1.0;
        const auto smooth = [&](const Bits& points, double probability, base::Random&) {
            smoothed = probability;
            return points;
        };
        const auto child = evolution::transition(parent, parent, {0.0, 0.3, 0.0}, smooth, random);
        QCOMPARE(smoothed, 0.3);
        // The gene itself is not bounded.
        QCOMPARE(evolution::decodeStrategy(child.strategy).smoothing, 1.0);
    }
};

QTEST_APPLESS_MAIN(TransitionTest)
#include "transition_test.moc"
