#include "core/search/ga/population.h"

#include <QtTest>
#include <vector>

#include "core/search/ga/operators.h"
#include "core/search/ranking.h"
#include "tests/core/search/ga/chromosomes.h"

using namespace trapwright;
namespace ga = trapwright::search::ga;
using ga::Bits;
using sample::countDifferent, sample::keep, sample::kLayout;

class PopulationTest : public QObject {
    Q_OBJECT

 private slots:
    void populationIsRandomButRepeatable() {
        const auto population = ga::createPopulation(kLayout, 50, 9);
        QCOMPARE(population.size(), std::size_t{50});
        QVERIFY(population == ga::createPopulation(kLayout, 50, 9));
        QVERIFY(!(population == ga::createPopulation(kLayout, 50, 10)));
        double ones = 0.0;
        for (const auto& individual : population) {
            QCOMPARE(individual.points.size(), std::size_t{800});
            QCOMPARE(individual.singles.size(), std::size_t{50});
            QCOMPARE(individual.strategy.size(), std::size_t{60});
            ones += countDifferent(individual.points, Bits(800, 0));
        }
        QVERIFY(std::abs(ones / 40000.0 - 0.5) < 4.0 * 0.5 / 200.0);
        // An individual does not depend on how many there are.
        QVERIFY(ga::createPopulation(kLayout, 3, 9)[2] == population[2]);
    }

    void childrenHaveTheirOwnStreams() {
        const auto parents = ga::createPopulation(kLayout, 30, 5);
        std::vector<double> fitnesses(30);
        for (std::size_t i = 0; i < 30; ++i)
            fitnesses[i] = -static_cast<double>(i);
        const auto children = ga::nextGeneration(parents, fitnesses, kLayout, {}, keep, 5, 1);
        QCOMPARE(children.size(), parents.size());
        QVERIFY(children == ga::nextGeneration(parents, fitnesses, kLayout, {}, keep, 5, 1));
        QVERIFY(!(children == ga::nextGeneration(parents, fitnesses, kLayout, {}, keep, 5, 2)));
        QVERIFY(!(children == ga::nextGeneration(parents, fitnesses, kLayout, {}, keep, 6, 1)));
        for (std::size_t i = 1; i < children.size(); ++i)
            QVERIFY(!(children[i] == children[0]));
        // Child 7 can be made alone.
        base::Random selection({5, 1, 7, 0, base::Purpose::selection});
        const auto a = ga::selectByTournament(fitnesses, 6, selection);
        const auto b = ga::selectByTournament(fitnesses, 6, selection);
        base::Random random({5, 1, 7, 0, base::Purpose::transition});
        QVERIFY(children[7] == ga::transition(parents[a], parents[b], kLayout, {}, keep, random));
    }

    void strategyMean() {
        const std::vector<ga::StrategyValues> values = {{0.2, 1e-4, 0.0}, {0.8, 1e-2, 0.5}};
        const auto mean = ga::calcGeometricMean(values);
        QVERIFY(std::abs(mean.crossover - 0.4) < 1e-14);
        QVERIFY(std::abs(mean.mutation - 1e-3) < 1e-16);
        QCOMPARE(mean.smoothing, 0.0);
    }

    // The whole algorithm on a problem that is easy to state: as many ones as can be in gene 1.
    void learns() {
        auto population = ga::createPopulation(kLayout, 60, 12);
        std::vector<double> fitnesses;
        double best = 0.0;
        for (std::uint32_t generation = 1; generation <= 120; ++generation) {
            fitnesses.clear();
            for (const auto& individual : population)
                fitnesses.push_back(countDifferent(individual.points, Bits(800, 0)));
            best = fitnesses[search::findTop(fitnesses).front()];
            population = ga::nextGeneration(population, fitnesses, kLayout, {6, {0.0005, 0.3, 0.0}}, keep, 12,
                                            generation);
        }
        QVERIFY2(best > 700.0, qPrintable(QString::number(best)));
    }
};

QTEST_APPLESS_MAIN(PopulationTest)
#include "population_test.moc"
