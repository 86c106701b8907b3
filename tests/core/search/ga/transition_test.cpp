#include "core/search/ga/transition.h"

#include <QtTest>
#include <array>
#include <cmath>
#include <vector>

#include "core/search/ga/genes.h"
#include "core/search/ga/operators.h"
#include "core/search/ga/population.h"
#include "tests/core/search/ga/chromosomes.h"

using namespace trapwright;
namespace ga = trapwright::search::ga;
using ga::Bits;
using ga::Chromosome;
using ga::TransitionParameters;
using sample::countDifferent, sample::keep, sample::kLayout;

namespace {

base::Random makeRandom(std::uint64_t seed) {
    return base::Random({seed, 0, 0, 0, base::Purpose::test});
}

/// Points and numbers of 10 bits, or of fewer where there are not as many.
ga::ChromosomeLayout layoutOf(const Chromosome& chromosome) {
    return {std::vector<int>(chromosome.points.size() / 10, 10),
            std::vector<int>(chromosome.singles.size() / 10, 10)};
}

Bits encodeStrategy(double crossover, double mutation, double smoothing) {
    return ga::encodeGray(std::array{crossover, mutation, smoothing}, ga::kStrategyBits);
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
        const double got = ga::combineGeometricMean(std::vector<double>(values.begin(), values.end()));
        QVERIFY(std::abs(got - mean) <= 1e-13 * mean);
    }

    void boundsTakeEffect() {
        const TransitionParameters parameters{0.002, 0.3, 0.0005};
        const auto values = ga::limitStrategy(ga::sameForGenes(0.9, 1e-5, 0.8), parameters);
        QCOMPARE(values, ga::sameForGenes(0.9, 0.0005, 0.8 * 0.3));
        const auto inside = ga::limitStrategy(ga::sameForGenes(0.9, 0.1, 0.2), parameters);
        QCOMPARE(inside, ga::sameForGenes(0.9, 0.1, 0.2 * 0.3));
        // The paper's own choices bound nothing.
        QCOMPARE(ga::limitStrategy(ga::sameForGenes(1.0, 0.0, 1.0), {0.002, 1.0, 0.0}),
                 ga::sameForGenes(1.0, 0.0, 1.0));
    }

    // Without crossover, mutation and smoothing the child is parent 2.
    void nothingHappensAtZero() {
        base::Random random = makeRandom(1);
        auto parent1 = ga::createRandomChromosome(kLayout, random);
        auto parent2 = ga::createRandomChromosome(kLayout, random);
        parent1.strategy = encodeStrategy(0.0, 0.0, 0.4);
        parent2.strategy = encodeStrategy(0.0, 0.0, 0.7);
        const auto child = ga::transition(parent1, parent2, layoutOf(parent1), {0.0, 1.0, 0.0}, keep, random);
        QCOMPARE(child, parent2);
    }

    // Lines 14 to 20: gene 3 is crossed by the parents' mean, sqrt(1 x 0) = 0, so that it is parent 2's;
    // genes 1 and 2 then follow the child's own p_x, not a parent's.
    void strategyComesFirst() {
        base::Random random = makeRandom(5);
        Chromosome zeros{Bits(800, 0), Bits(50000, 0), encodeStrategy(1.0, 0.0, 0.0)};
        Chromosome ones{Bits(800, 1), Bits(50000, 1), encodeStrategy(0.0, 0.0, 0.0)};
        auto child = ga::transition(zeros, ones, layoutOf(zeros), {0.0, 1.0, 0.0}, keep, random);
        QCOMPARE(child, ones);
        // The same with a child that takes each bit of its lengths from either parent.
        std::swap(zeros.strategy, ones.strategy);
        child = ga::transition(zeros, ones, layoutOf(zeros), {0.0, 1.0, 0.0}, keep, random);
        QCOMPARE(child.strategy, ones.strategy);
        const double share = countDifferent(child.singles, ones.singles) / 50000.0;
        QVERIFY2(std::abs(share - 0.5) < 4.0 * 0.5 / std::sqrt(50000.0), QByteArray::number(share));
    }

    // Algorithm 1: the state is redrawn before each bit with probability p_x, so that bit k (from 1) is
    // parent 1's with (1 - (1 - p_x)^k) / 2: with 1/2 these are 1/4, 3/8, 7/16, 15/32.
    void lengthsAreCrossedBitByBit() {
        const Bits strategy = encodeStrategy(0.5, 0.0, 0.0);
        const Chromosome zeros{Bits(800, 0), Bits(4, 0), strategy};
        const Chromosome ones{Bits(800, 1), Bits(4, 1), strategy};
        constexpr std::array kExpected = {0.25, 0.375, 0.4375, 0.46875};
        constexpr int kRuns = 20000;
        std::array<int, 4> fromFirst{};
        base::Random random = makeRandom(6);
        for (int run = 0; run < kRuns; ++run) {
            const auto child = ga::transition(zeros, ones, layoutOf(zeros), {0.0, 1.0, 0.0}, keep, random);
            for (std::size_t k = 0; k < 4; ++k)
                fromFirst[k] += child.singles[k] == 0 ? 1 : 0;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const double share = static_cast<double>(fromFirst[k]) / kRuns;
            QVERIFY2(std::abs(share - kExpected[k]) < 4.0 * 0.5 / std::sqrt(kRuns),
                     QByteArray::number(share));
        }
    }

    // Lines 15 and 19: p_dm of 0.04 and 0.09 gives sqrt(0.0036) = 0.06, with p_sm = 0.02 each bit of gene 3
    // is drawn anew with 0.08, so 60 x 0.04 = 2.4 of them change. The p_x of 0 keeps parent 2's.
    void ratesOfMutationAddUp() {
        Chromosome parent1{Bits(20, 0), Bits(10, 0), encodeStrategy(0.0, 0.04, 0.0)};
        Chromosome parent2{Bits(20, 0), Bits(10, 0), encodeStrategy(0.0, 0.09, 0.0)};
        constexpr int kRuns = 4000;
        double changed = 0.0;
        base::Random random = makeRandom(7);
        for (int run = 0; run < kRuns; ++run)
            changed += countDifferent(
                ga::transition(parent1, parent2, layoutOf(parent1), {0.02, 1.0, 0.0}, keep, random).strategy,
                parent2.strategy);
        const double mean = changed / kRuns;
        QVERIFY2(std::abs(mean - 2.4) < 4.0 * std::sqrt(2.4 * 0.96 / kRuns), QByteArray::number(mean));
    }

    // Lines 24, 27 and 28. A floor of p_dm of 1 has every bit of the lengths drawn anew, so that half of them
    // change (BUM), and b = 10 times one bit of each value of a point: 1 - 0.9^10 = 0.651 are hit, 0.326
    // change (2DPM). Smoothing comes last, with the child's p_s, and what it gives is gene 1.
    void eachGeneHasItsMutation() {
        const Chromosome parent{Bits(40000, 0), Bits(40000, 0), encodeStrategy(0.0, 0.0, 0.25)};
        Bits mutated;
        double probability = -1.0;
        const Bits smoothed(40000, 1);
        const auto smooth = [&](Chromosome child, double p, base::Random& /*random*/) {
            mutated = std::exchange(child.points, smoothed);
            probability = p;
            return child;
        };
        base::Random random = makeRandom(9);
        const auto child = ga::transition(parent, parent, layoutOf(parent), {0.0, 1.0, 1.0}, smooth, random);
        const double lengths = countDifferent(child.singles, parent.singles) / 40000.0;
        const double points = countDifferent(mutated, parent.points) / 40000.0;
        QVERIFY2(std::abs(lengths - 0.5) < 4.0 * 0.5 / 200.0, QByteArray::number(lengths));
        QVERIFY2(std::abs(points - 0.3257) < 4.0 * 0.47 / 200.0, QByteArray::number(points));
        QCOMPARE(child.points, smoothed);
        QCOMPARE(probability, ga::decodeStrategy(child.strategy).smoothing);
    }

    // Of equal parents only mutation tells the child: its rate is the floor and the static rate together.
    void floorAndStaticRateAdd() {
        Chromosome parent;
        parent.points = Bits(800, 0);
        parent.singles = Bits(100000, 0);
        parent.strategy = encodeStrategy(0.5, 0.0, 0.0);
        double strategyChanges = 0.0;
        double lengthChanges = 0.0;
        base::Random random = makeRandom(3);
        constexpr int kRuns = 40;
        int counted = 0;
        for (int run = 0; run < kRuns; ++run) {
            const auto child =
                ga::transition(parent, parent, layoutOf(parent), {0.01, 1.0, 0.02}, keep, random);
            const double changes = countDifferent(child.strategy, parent.strategy);
            strategyChanges += changes;
            // Where gene 3 has not changed, the child's own rate is known.
            if (changes == 0.0) {
                ++counted;
                lengthChanges += countDifferent(child.singles, parent.singles);
            }
        }
        QVERIFY(std::abs(strategyChanges - kRuns * 60 * 0.015) < 4.0 * std::sqrt(kRuns * 60 * 0.015));
        QVERIFY(counted > 5);
        QVERIFY(std::abs(lengthChanges / counted / 1e5 - 0.015) < 4.0 * std::sqrt(0.015 / 1e5 / counted));
    }

    // Rates of every gene (paper, section 9): the order of the values is p_x, p_dm and p_s of the points, p_x
    // and p_dm of the numbers, p_x and p_dm of the strategy values themselves.
    void eachGeneHasItsOwnRates() {
        const auto genes = [](const std::array<double, 7>& values) {
            const Bits strategy = ga::encodeGray(values, ga::kStrategyBits);
            return std::pair(Chromosome{Bits(20000, 0), Bits(20000, 0), strategy},
                             Chromosome{Bits(20000, 1), Bits(20000, 1), strategy});
        };
        const auto differing = [&](const std::array<double, 7>& values) {
            const auto [zeros, ones] = genes(values);
            base::Random random = makeRandom(21);
            const auto child = ga::transition(zeros, ones, layoutOf(zeros), {0.0, 1.0, 0.0}, keep, random);
            return std::array{countDifferent(child.points, ones.points) / 20000.0,
                              countDifferent(child.singles, ones.singles) / 20000.0,
                              countDifferent(child.strategy, ones.strategy)};
        };
        using Shares = std::array<double, 3>;
        QVERIFY(differing({0, 0, 0, 0, 0, 0, 0}) == (Shares{0.0, 0.0, 0.0}));
        // Crossover: half of the bits are of the other parent, in the one gene alone.
        const auto isHalf = [](double share) { return std::abs(share - 0.5) < 0.02; };
        const Shares points = differing({1, 0, 0, 0, 0, 0, 0});
        QVERIFY(isHalf(points[0]) && points[1] == 0.0);
        const Shares singles = differing({0, 0, 0, 1, 0, 0, 0});
        QVERIFY(singles[0] == 0.0 && isHalf(singles[1]));
        // Mutation, too.
        QVERIFY(differing({0, 1, 0, 0, 0, 0, 0})[1] == 0.0 && differing({0, 1, 0, 0, 0, 0, 0})[0] > 0.3);
        QVERIFY(differing({0, 0, 0, 0, 1, 0, 0})[0] == 0.0 && isHalf(differing({0, 0, 0, 0, 1, 0, 0})[1]));
        QCOMPARE(differing({0, 1, 0, 0, 1, 0, 0})[2], 0.0);
        // All bits of gene 3 are drawn anew, half of 140 change.
        const double strategy = differing({0, 0, 0, 0, 0, 0, 1})[2];
        QVERIFY2(std::abs(strategy - 70.0) < 4.0 * std::sqrt(35.0), QByteArray::number(strategy));
        const ga::StrategyValues read = ga::decodeStrategy(
            ga::encodeGray(std::array{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, ga::kStrategyBits));
        const ga::StrategyValues expected{{0.1, 0.2}, {0.4, 0.5}, {0.6, 0.7}, 0.3};
        for (const auto gene :
             {&ga::StrategyValues::points, &ga::StrategyValues::singles, &ga::StrategyValues::strategy}) {
            QVERIFY(std::abs((read.*gene).crossover - (expected.*gene).crossover) < 1e-6);
            QVERIFY(std::abs((read.*gene).mutation - (expected.*gene).mutation) < 1e-6);
        }
        QVERIFY(std::abs(read.smoothing - expected.smoothing) < 1e-6);
        const auto limited = ga::limitStrategy(expected, {0.0, 0.5, 0.6});
        QCOMPARE(limited, (ga::StrategyValues{{0.1, 0.6}, {0.4, 0.6}, {0.6, 0.7}, 0.15}));
    }

    void smoothingLimitReachesTheSmoother() {
        base::Random random = makeRandom(4);
        auto parent = ga::createRandomChromosome(kLayout, random);
        parent.strategy = encodeStrategy(0.0, 0.0, 1.0);
        double smoothed = -1.0;
        const auto smooth = [&](Chromosome child, double probability, base::Random&) {
            smoothed = probability;
            return child;
        };
        const auto child = ga::transition(parent, parent, layoutOf(parent), {0.0, 0.3, 0.0}, smooth, random);
        QCOMPARE(smoothed, 0.3);
        // The gene itself is not bounded.
        QCOMPARE(ga::decodeStrategy(child.strategy).smoothing, 1.0);
    }
};

QTEST_APPLESS_MAIN(TransitionTest)
#include "transition_test.moc"
