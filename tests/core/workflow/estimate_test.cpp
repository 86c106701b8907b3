#include "core/workflow/estimate.h"

#include <QtTest>
#include <cmath>
#include <limits>

#include "core/study/field_text.h"
#include "core/study/planning.h"
#include "core/study/settings.h"
#include "tests/core/workflow/workflow_fixture.h"

using namespace trapwright;

namespace {

std::optional<study::EvolutionSettings> makeDraft(const study::EvolutionSettings& full,
                                                  double secondsPerTrial) {
    return workflow::fitEvolution(full, workflow::kDraftLearningTime, {secondsPerTrial, 0.0, 0});
}

}  // namespace

class EstimateTest : public QObject {
    Q_OBJECT

 private slots:
    // Ten minutes, whatever a trial costs; more of everything where it costs less.
    void aDraftFitsIntoItsTime_data() {
        QTest::addColumn<double>("secondsPerTrial");
        QTest::addColumn<int>("population");  // 0: there is no draft
        QTest::newRow("a fast machine") << 1e-4 << 100;
        QTest::newRow("the cuboid on two cores") << 2.07e-3 << 80;
        QTest::newRow("a part of many pieces") << 17.5e-3 << 30;
        QTest::newRow("a slow one") << 0.1 << 20;
        QTest::newRow("too slow") << 0.2 << 0;
        QTest::newRow("not known") << 0.0 << 0;
    }
    void aDraftFitsIntoItsTime() {
        QFETCH(double, secondsPerTrial);
        QFETCH(int, population);
        const study::EvolutionSettings full;
        const auto draft = makeDraft(full, secondsPerTrial);
        QCOMPARE(draft.has_value(), population > 0);
        if (!draft) return;
        QCOMPARE(draft->populationSize, population);
        const double time = workflow::learningTime(*draft, draft->generations, {secondsPerTrial, 0.0, 0});
        QVERIFY(time > 0.0 && time <= workflow::kDraftLearningTime && time < workflow::kDraftTime);
        QVERIFY(draft->generations >= 10 && draft->generations <= full.generations);
        QVERIFY(draft->trialsPerEvaluation <= full.trialsPerEvaluation);
        // Nothing else changed, and a draft of a draft is itself.
        study::EvolutionSettings same = *draft;
        same.populationSize = full.populationSize;
        same.trialsPerEvaluation = full.trialsPerEvaluation;
        same.generations = full.generations;
        QVERIFY(same == full);
        QVERIFY(makeDraft(*draft, secondsPerTrial) == draft);
        QVERIFY(workflow::fullEvolution(*draft) == full);
    }

    void aDraftIsNoMoreThanWhatWasSet() {
        study::EvolutionSettings small;
        small.populationSize = 12;
        small.trialsPerEvaluation = 10;
        small.generations = 5;
        small.tournamentSize = 3;
        QVERIFY(makeDraft(small, 1e-3) == small);
    }

    // Of a race two of 32 run to its end, and of the others few get far.
    void aRaceTakesAsLongAsItsTrials() {
        study::EvolutionSettings race;
        race.populationSize = 32;
        race.trialsPerEvaluation = 1920;
        race.racingTrials = 60;
        race.racingShare = 2.0 / 32.0;
        study::EvolutionSettings all = race;
        all.racingTrials = 0;
        const workflow::TrialCost cost{1e-3, 0.0, 0};
        QVERIFY(std::abs(workflow::learningTime(all, 1, cost) - 1e-3 * 32 * 1920) < 1e-9);
        const double raced = workflow::learningTime(race, 1, cost);
        // Everybody has the first trials, two have all.
        QVERIFY(raced > 1e-3 * (30 * 60 + 2 * 1920));
        QVERIFY(raced < 0.2 * workflow::learningTime(all, 1, cost));
        // Settings are told of as wrong only after they were estimated.
        for (const int wrong : {-1, 0, std::numeric_limits<int>::max()}) {
            race.populationSize = wrong;
            QVERIFY(workflow::learningTime(race, 1, cost) >= 0.0);
        }
    }

    // Before its first generation, and only then.
    void aPlanTakesTime() {
        study::EvolutionSettings graded;
        study::EvolutionSettings planned = graded;
        planned.firstGeneration = search::ga::FirstGeneration::planned;
        QCOMPARE(study::estimatePlanningTrials(graded, 9), std::int64_t{0});
        const workflow::TrialCost cost{1e-3, 5e-4, 9};
        const double planning = workflow::learningTime(planned, planned.generations, cost) -
                                workflow::learningTime(graded, graded.generations, cost);
        QCOMPARE(study::estimateJudgingTrials(graded), std::int64_t{0});
        const double told = 5e-4 * static_cast<double>(study::estimatePlanningTrials(planned, 9)) +
                            1e-3 * static_cast<double>(study::estimateJudgingTrials(planned));
        QVERIFY(std::abs(planning - told) < 1e-6);
        QVERIFY(planning > 0.0);
        QCOMPARE(workflow::learningTime(planned, planned.generations - 1, cost),
                 workflow::learningTime(graded, graded.generations - 1, cost));
        // A draft has time for it, and for more traps where there is more time, up to all.
        int before = 0;
        for (const double seconds : {60.0, 150.0, 450.0, 36000.0}) {
            const auto draft = workflow::fitEvolution(planned, seconds, cost);
            QVERIFY(draft.has_value());
            QVERIFY(workflow::learningTime(*draft, draft->generations, cost) <= seconds);
            QVERIFY(draft->plannedTraps > before || draft->plannedTraps == planned.plannedTraps);
            before = draft->plannedTraps;
        }
        QCOMPARE(before, planned.plannedTraps);
        QVERIFY(!workflow::fitEvolution(planned, 20.0, cost).has_value());
    }

    // Who is told that the time is too short is told how much is needed.
    void theLeastTimeIsEnough() {
        study::EvolutionSettings bred;
        study::EvolutionSettings planned = bred;
        planned.firstGeneration = search::ga::FirstGeneration::planned;
        study::EvolutionSettings exchanged = planned;
        exchanged.search = search::Method::exchange;
        study::EvolutionSettings small = bred;
        small.generations = 5;
        const workflow::TrialCost cost{1e-3, 5e-4, 9};
        constexpr double kHair = 1e-6;
        for (const study::EvolutionSettings& full : {bred, planned, exchanged, small}) {
            const double least = workflow::leastTime(full, cost);
            QVERIFY(least > 0.0 && std::isfinite(least));
            QVERIFY(workflow::fitEvolution(full, (1.0 + kHair) * least, cost).has_value());
            QVERIFY(!workflow::fitEvolution(full, (1.0 - kHair) * least, cost).has_value());
        }
        QCOMPARE(workflow::leastTime(bred, {}), 0.0);
    }

    // One wrong part in a thousand is told by no hundred trials, and takes longer to plan for.
    void aDraftForPurityKeepsItsTrials() {
        study::EvolutionSettings sorting;
        sorting.firstGeneration = search::ga::FirstGeneration::planned;
        sorting.trialsPerEvaluation = 1000;
        sorting.racingTrials = 200;
        sorting.plannedTraps = 3000;
        sorting.objectives = objectives::kSorting;
        study::EvolutionSettings pure = sorting;
        pure.objectives = "F_C, purity, success";
        QVERIFY(study::estimatePlanningTrials(pure, 9) > study::estimatePlanningTrials(sorting, 9) + 30000);
        // Half of the traps are sorted by, the others have an end for purity; both begin with their ways.
        const std::int64_t both = study::estimatePlanningTrials(pure, 9, true);
        study::EvolutionSettings half = sorting;
        half.plannedTraps /= 2;
        QVERIFY(both > study::estimatePlanningTrials(half, 9) + 30000);
        QVERIFY(both < study::estimatePlanningTrials(pure, 9));
        const workflow::TrialCost cost{1e-3, 5e-4, 9};
        constexpr double kSeconds = 300.0;
        const auto draft = workflow::fitEvolution(pure, kSeconds, cost);
        QVERIFY(draft.has_value());
        QCOMPARE(draft->trialsPerEvaluation, 1000);
        QCOMPARE(draft->racingTrials, 200);
        QVERIFY(workflow::learningTime(*draft, draft->generations, cost) <= kSeconds);
        QCOMPARE(workflow::fitEvolution(sorting, kSeconds, cost)->trialsPerEvaluation, 100);
        // Two plans have two ends.
        pure.objectives = "F_C, purity, yield";
        for (const double seconds : {200.0, 250.0, 300.0, 350.0, 400.0}) {
            const auto two = workflow::fitEvolution(pure, seconds, cost);
            QVERIFY(two.has_value());
            const double takes = workflow::learningTime(*two, two->generations, cost);
            QVERIFY2(takes <= seconds && takes > 0.7 * seconds,
                     qPrintable(QString("%1 of %2").arg(takes).arg(seconds)));
        }
    }

    // What is bred behind a plan gains little, what is exchanged much: it gets what time there is.
    void aDraftHasTimeForExchanges() {
        study::EvolutionSettings full;
        full.search = search::Method::exchange;
        full.firstGeneration = search::ga::FirstGeneration::planned;
        full.populationSize = 32;
        full.trialsPerEvaluation = 400;
        full.plannedTraps = 30000;
        full.generations = 2000;
        const workflow::TrialCost cost{1e-4, 5e-4, 9};
        int generations = 2;
        int traps = 0;
        for (const double seconds : {60.0, 150.0, 300.0, 600.0}) {
            const auto draft = workflow::fitEvolution(full, seconds, cost);
            QVERIFY(draft.has_value());
            const double takes = workflow::learningTime(*draft, draft->generations, cost);
            QVERIFY2(takes <= seconds && takes > 0.9 * seconds,
                     qPrintable(QString("%1 of %2").arg(takes).arg(seconds)));
            QCOMPARE(draft->populationSize, full.populationSize);
            QVERIFY(draft->generations > generations && draft->plannedTraps >= traps);
            generations = draft->generations;
            traps = draft->plannedTraps;
        }
        QVERIFY(traps > 1000);
        const auto all = workflow::fitEvolution(full, 360000.0, cost);
        QVERIFY(all.has_value() && all->generations == full.generations);
        QCOMPARE(all->plannedTraps, full.plannedTraps);
    }

    // Tests of the operators that a draft must not break.
    void aDraftCanBeLearned() {
        study::Settings settings;
        settings.evolution.tournamentSize = 50;
        settings.evolution.racingTrials = 60;
        for (const double seconds : {1e-4, 1e-3, 1e-2, 0.1}) {
            study::Settings draft = settings;
            draft.evolution = makeDraft(settings.evolution, seconds).value();
            QVERIFY(study::findProblems(draft).empty());
            QVERIFY(draft.evolution.tournamentSize <= draft.evolution.populationSize);
            QVERIFY(draft.evolution.racingTrials <= draft.evolution.trialsPerEvaluation);
        }
    }

    void aTrialIsTimed() {
        const fake::WaveStudy study("native");
        const auto cost = workflow::timeTrials(study.inputs, 0.05, {});
        QVERIFY2(cost.ok(), cost.ok() ? "" : cost.error().message.c_str());
        QVERIFY(cost->learning > 0.0);
        QCOMPARE(cost->planning, 0.0);
        base::RunControl cancelled;
        cancelled.cancel();
        QVERIFY(!workflow::timeTrials(study.inputs, 0.05, cancelled).ok());
    }
};

QTEST_GUILESS_MAIN(EstimateTest)
#include "estimate_test.moc"
