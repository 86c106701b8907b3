#include "core/search/ga/population.h"

#include <QtTest>
#include <cmath>
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

    // From nearly level to rough, and as often mutating rarely as often: both even in their logarithms.
    void gradedPopulationIsGraded() {
        search::DesignSpace space;
        for (int k = 0; k < 40; ++k) {
            space.dimensions.push_back({"y", "", 0.0, 1.0, 10, true, false});
            space.dimensions.push_back({"z", "", 0.0, 1.0, 10, true, true});
        }
        space.dimensions.push_back({"length", "", 0.0, 1.0, 10});
        const ga::ChromosomeLayout layout = ga::layOut(space, ga::StrategyScope::individual);
        const auto before = ga::createPopulation(layout, 400, 4);
        auto population = before;
        ga::gradePopulation(population, space, 4);
        int flat = 0;
        int rare = 0;
        for (std::size_t i = 0; i < population.size(); ++i) {
            QVERIFY(ga::fits(population[i], layout));
            QVERIFY(population[i].singles == before[i].singles);
            const search::Design old = ga::decodeDesign(before[i], space);
            const search::Design design = ga::decodeDesign(population[i], space);
            double relief = 0.0;
            double whole = 0.0;
            for (std::size_t k = 0; k + 1 < design.size(); k += 2) {
                QCOMPARE(design[k], old[k]);
                QVERIFY((design[k + 1] - 0.5) * (old[k + 1] - 0.5) >= 0.0);
                relief += std::abs(design[k + 1] - 0.5);
                whole += std::abs(old[k + 1] - 0.5);
            }
            // Ten bits tell no less than half a thousandth.
            QVERIFY(relief / whole > 0.9 * ga::kLeastRelief && relief / whole <= 1.0);
            if (relief / whole < std::sqrt(ga::kLeastRelief)) ++flat;
            const ga::StrategyValues strategy = ga::decodeStrategy(population[i].strategy);
            const ga::StrategyValues strategyBefore = ga::decodeStrategy(before[i].strategy);
            QCOMPARE(strategy.points.crossover, strategyBefore.points.crossover);
            QCOMPARE(strategy.smoothing, strategyBefore.smoothing);
            QVERIFY(strategy.points.mutation > 0.99 * ga::kLeastFirstMutation &&
                    strategy.points.mutation <= 1.0);
            if (strategy.points.mutation < std::sqrt(ga::kLeastFirstMutation)) ++rare;
        }
        // Half of each, within four deviations.
        QVERIFY2(std::abs(flat - 200) < 40 && std::abs(rare - 200) < 40,
                 qPrintable(QString("%1 %2").arg(flat).arg(rare)));
        // An individual does not depend on how many there are.
        std::vector<ga::Chromosome> three(before.begin(), before.begin() + 3);
        ga::gradePopulation(three, space, 4);
        QVERIFY(three[2] == population[2]);
    }

    // By gene there are three mutation rates to be graded, each by itself.
    void everyMutationRateIsGraded() {
        search::DesignSpace space;
        space.dimensions.resize(4);
        const ga::ChromosomeLayout layout = ga::layOut(space, ga::StrategyScope::gene);
        auto population = ga::createPopulation(layout, 400, 4);
        for (const ga::Chromosome& each : population) {
            QVERIFY(ga::fits(each, layout));
            QVERIFY(!ga::fits(each, ga::layOut(space, ga::StrategyScope::individual)));
        }
        ga::gradePopulation(population, space, 4);
        std::array<int, 3> rare{};
        int alike = 0;
        for (const ga::Chromosome& each : population) {
            const ga::StrategyValues values = ga::decodeStrategy(each.strategy);
            const std::array rates = {values.points.mutation, values.singles.mutation,
                                      values.strategy.mutation};
            for (std::size_t gene = 0; gene < rates.size(); ++gene) {
                QVERIFY(rates[gene] > 0.99 * ga::kLeastFirstMutation);
                if (rates[gene] < std::sqrt(ga::kLeastFirstMutation)) ++rare[gene];
            }
            if (rates[0] == rates[1] || rates[1] == rates[2]) ++alike;
        }
        QVERIFY2(alike < 8, QByteArray::number(alike));
        for (const int count : rare)
            QVERIFY2(std::abs(count - 200) < 40, QByteArray::number(count));
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
        const std::vector<ga::StrategyValues> values = {ga::sameForGenes(0.2, 1e-4, 0.0),
                                                        ga::sameForGenes(0.8, 1e-2, 0.5)};
        const auto mean = ga::calcGeometricMean(values);
        QVERIFY(std::abs(mean.points.crossover - 0.4) < 1e-14);
        QVERIFY(std::abs(mean.points.mutation - 1e-3) < 1e-16);
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
