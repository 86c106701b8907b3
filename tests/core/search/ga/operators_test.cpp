#include "core/search/ga/operators.h"

#include <QtTest>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

using namespace trapwright;
namespace ga = trapwright::search::ga;
using ga::Bits;

namespace {

base::Random makeRandom(std::uint64_t seed) {
    return base::Random({seed, 0, 0, 0, base::Purpose::test});
}

// Whether a count of successes of independent trials is within 4 standard deviations of its expectation.
bool isBinomial(double successes, double trials, double probability) {
    const double deviation = std::sqrt(trials * probability * (1.0 - probability));
    return std::abs(successes - trials * probability) <= 4.0 * deviation + 1e-9;
}

double countOnes(const Bits& bits) {
    return std::accumulate(bits.begin(), bits.end(), 0.0);
}

}  // namespace

class OperatorsTest : public QObject {
    Q_OBJECT

 private slots:
    // The best of s draws from ranks 0 ... n-1 (highest fitness last) is below k with probability (k / n)^s.
    void tournament_data() {
        QTest::addColumn<int>("size");
        for (const int size : {1, 2, 6})
            QTest::addRow("s = %d", size) << size;
    }
    void tournament() {
        QFETCH(int, size);
        constexpr int kCount = 20;
        constexpr int kDraws = 20000;
        // A fitness that is not in the order of the indices.
        std::vector<double> fitnesses(kCount);
        for (int i = 0; i < kCount; ++i)
            fitnesses[static_cast<std::size_t>(i)] = (7 * i) % kCount;
        base::Random random = makeRandom(1);
        std::vector<int> wins(kCount, 0);
        for (int i = 0; i < kDraws; ++i) {
            ++wins[static_cast<std::size_t>(fitnesses[ga::selectByTournament(fitnesses, size, random)])];
        }
        for (int k = 0; k < kCount; ++k) {
            const double n = kCount;
            const double expected = std::pow((k + 1) / n, size) - std::pow(k / n, size);
            QVERIFY(isBinomial(wins[static_cast<std::size_t>(k)], kDraws, expected));
        }
    }

    void tournamentFavoursNoPlaceAmongEquals() {
        const std::vector<double> fitnesses(5, -1.0);
        base::Random random = makeRandom(2);
        std::array<int, 5> wins{};
        for (int i = 0; i < 10000; ++i)
            ++wins[ga::selectByTournament(fitnesses, 6, random)];
        for (const int count : wins)
            QVERIFY(isBinomial(count, 10000, 0.2));
    }

    void crossoverAtItsEnds() {
        const Bits zeros(10000, 0);
        const Bits ones(10000, 1);
        base::Random random = makeRandom(3);
        QCOMPARE(ga::crossStateBased(zeros, ones, 0.0, random), ones);
        const Bits mixed = ga::crossStateBased(zeros, ones, 1.0, random);
        QVERIFY(isBinomial(countOnes(mixed), 10000, 0.5));
    }

    // Bit i is parent 2's with probability 1/2 + (1 - p)^(i+1) / 2; neighbours share a parent with 1 - p / 2.
    void crossover_data() {
        QTest::addColumn<double>("rate");
        for (const double rate : {0.02, 0.2, 0.7, 1.0})
            QTest::addRow("p_x = %g", rate) << rate;
    }
    void crossover() {
        QFETCH(double, rate);
        constexpr std::size_t kBits = 60;
        constexpr int kRuns = 8000;
        const Bits zeros(kBits, 0);
        const Bits ones(kBits, 1);
        base::Random random = makeRandom(4);
        std::array<int, kBits> fromSecond{};
        std::array<int, kBits> likeBefore{};
        for (int run = 0; run < kRuns; ++run) {
            const Bits child = ga::crossStateBased(zeros, ones, rate, random);
            for (std::size_t i = 0; i < kBits; ++i) {
                fromSecond[i] += child[i];
                if (i > 0 && child[i] == child[i - 1]) ++likeBefore[i];
            }
        }
        for (std::size_t i = 0; i < kBits; ++i) {
            const double second = 0.5 + 0.5 * std::pow(1.0 - rate, static_cast<double>(i + 1));
            QVERIFY(isBinomial(fromSecond[i], kRuns, second));
            if (i > 0) QVERIFY(isBinomial(likeBefore[i], kRuns, 1.0 - 0.5 * rate));
        }
    }

    void childrenHaveOnlyTheirParentsBits() {
        base::Random random = makeRandom(5);
        Bits a(500);
        Bits b(500);
        for (std::size_t i = 0; i < 500; ++i) {
            a[i] = random.boolean() ? 1 : 0;
            b[i] = i % 3 == 0 ? a[i] : 1 - a[i];
        }
        const Bits child = ga::crossStateBased(a, b, 0.1, random);
        for (std::size_t i = 0; i < 500; i += 3)
            QCOMPARE(child[i], a[i]);
    }

    // Half of the replaced bits change.
    void binaryUniform_data() {
        QTest::addColumn<double>("rate");
        for (const double rate : {0.0, 0.002, 0.1, 0.5, 1.0, 1.3})
            QTest::addRow("p_m = %g", rate) << rate;
    }
    void binaryUniform() {
        QFETCH(double, rate);
        base::Random random = makeRandom(6);
        for (const std::uint8_t value : {0, 1}) {
            const Bits mutated = ga::mutateBinaryUniform(Bits(100000, value), rate, random);
            const double changed = value == 0 ? countOnes(mutated) : 100000.0 - countOnes(mutated);
            QVERIFY(isBinomial(changed, 100000.0, 0.5 * std::min(rate, 1.0)));
        }
    }

    // Each of b attempts reaches a given bit with probability p / b: it changes with (1 - (1 - p / b)^b) / 2.
    void points_data() {
        QTest::addColumn<double>("rate");
        for (const double rate : {0.0, 0.01, 0.3, 1.0})
            QTest::addRow("p_m = %g", rate) << rate;
    }
    void points() {
        QFETCH(double, rate);
        constexpr int kPoints = 20000;
        base::Random random = makeRandom(7);
        const Bits mutated =
            ga::mutatePoints(Bits(kPoints * 20, 0), std::vector<int>(2 * kPoints, 10), rate, random);
        std::array<double, 20> changed{};
        double likeness = 0.0;
        for (std::size_t i = 0; i < mutated.size(); ++i)
            changed[i % 20] += mutated[i];
        const double expected = 0.5 * (1.0 - std::pow(1.0 - rate / 10.0, 10));
        for (const double count : changed)
            QVERIFY(isBinomial(count, kPoints, expected));
        // Both values of a point mutate in the same attempts: points without any attempt keep both.
        for (std::size_t point = 0; point < kPoints; ++point) {
            bool first = false;
            bool second = false;
            for (std::size_t k = 0; k < 10; ++k) {
                first = first || mutated[20 * point + k] != 0;
                second = second || mutated[20 * point + 10 + k] != 0;
            }
            likeness += first == second ? 1.0 : 0.0;
        }
        if (rate == 0.01) {
            // P(any attempt) = q; given one, each value changes with 1/2, independently: alike in 1 - q / 2,
            // but for the rare second attempt.
            const double q = 1.0 - std::pow(0.99, 10);
            QVERIFY(std::abs(likeness / kPoints - (1.0 - 0.5 * q)) < 0.008);
        }
    }

    void sameStreamSameBits() {
        base::Random first = makeRandom(8);
        base::Random second = makeRandom(8);
        const Bits bits(400, 1);
        QCOMPARE(ga::mutatePoints(bits, std::vector<int>(40, 10), 0.3, first),
                 ga::mutatePoints(bits, std::vector<int>(40, 10), 0.3, second));
        QCOMPARE(ga::mutateBinaryUniform(bits, 0.3, first), ga::mutateBinaryUniform(bits, 0.3, second));
    }
};

QTEST_APPLESS_MAIN(OperatorsTest)
#include "operators_test.moc"
