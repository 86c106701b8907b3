#include "core/study/comparison.h"

#include <QtTest>

using namespace trapwright;

namespace {

study::ComparedStudy makeStudy(std::vector<double> fitness, std::vector<int> successes) {
    study::ComparedStudy made;
    for (std::size_t g = 0; g < fitness.size(); ++g) {
        study::GenerationSummary& summary = made.generations.emplace_back();
        summary.index = static_cast<int>(g);
        summary.statistics.best.total = fitness[g];
        if (successes[g] >= 0) summary.statistics.success = stats::Count{successes[g], 10};
    }
    return made;
}

}  // namespace

class ComparisonTest : public QObject {
    Q_OBJECT

 private slots:
    // Studies of different lengths; of a generation whose winner was not simulated nothing is counted.
    void spreadsByGeneration() {
        const std::vector<study::ComparedStudy> studies = {
            makeStudy({1.0, 2.0, 3.0}, {5, 6, 7}), makeStudy({2.0, 4.0}, {7, 10}), makeStudy({3.0}, {-1})};
        const auto spreads = study::spreadByGeneration(studies);
        QCOMPARE(spreads.size(), std::size_t{3});
        QCOMPARE(spreads[0].studies, 3);
        QCOMPARE(spreads[0].fitness.lower, 1.5);
        QCOMPARE(spreads[0].fitness.median, 2.0);
        QCOMPARE(spreads[0].fitness.upper, 2.5);
        QCOMPARE(spreads[0].success->median, 0.6);
        QCOMPARE(spreads[1].studies, 2);
        QCOMPARE(spreads[1].fitness.median, 3.0);
        QCOMPARE(spreads[2].generation, 2);
        QCOMPARE(spreads[2].studies, 1);
        QCOMPARE(spreads[2].success->upper, 0.7);
        QVERIFY(!spreads[2].topSuccess);
        QVERIFY(study::spreadByGeneration({}).empty());
    }

    void ratesOfWhatCounts() {
        study::ComparedStudy study;
        QVERIFY(!study::bestRate(study) && !study::selectedRate(study));
        study.best.emplace();
        study.best->record.oriented = 0;
        QVERIFY(!study::bestRate(study));
        study.best->record.trials = 20;
        study.best->record.finished = 10;
        study.best->record.oriented = 8;
        study.selected.emplace();
        study.selected->trials = 100;
        study.selected->finished = 50;
        study.selected->oriented = 45;
        QCOMPARE(study::bestRate(study)->trials, 20);
        QCOMPARE(study::selectedRate(study)->share(), 0.45);
        study.fallsAreForgiven = true;
        QCOMPARE(study::bestRate(study)->trials, 10);
        QCOMPARE(study::selectedRate(study)->share(), 0.9);
        study.selected->finished = 0;
        QVERIFY(!study::selectedRate(study));
    }
};

QTEST_GUILESS_MAIN(ComparisonTest)
#include "comparison_test.moc"
