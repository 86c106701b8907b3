#include "core/study/runner.h"

#include <QtTest>
#include <limits>

#include "core/study/track_design.h"
#include "core/track/print_flaws.h"
#include "fake_engine.h"
#include "tests/core/objectives/paper_fitness.h"

using namespace trapwright;
using study::GenerationRecord;
using study::LearningControl;
using study::LearningEnd;

namespace {

bool sameBits(const std::vector<GenerationRecord>& a, const std::vector<GenerationRecord>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].index != b[i].index || a[i].individuals != b[i].individuals || a[i].winner != b[i].winner ||
            !(a[i].statistics == b[i].statistics)) {
            return false;
        }
    }
    return true;
}

/// Goes on from what is in `saved`, and adds to it.
base::Result<LearningEnd> learn(const study::StudyInputs& inputs, std::vector<GenerationRecord>& saved,
                                const LearningControl& control = {}) {
    study::LearningEvents events;
    events.save = [&](const GenerationRecord& record) {
        saved.push_back(record);
        return base::success();
    };
    return study::evolve(inputs,
                         saved.empty() ? std::nullopt : std::optional(study::stateAfter(saved.back())),
                         events, control);
}

std::shared_ptr<const trial::Engine> engineOf(fake::Law law) {
    return std::make_shared<fake::FakeEngine>(std::move(law));
}

objectives::ObjectiveList paperObjectives() {
    return *objectives::readObjectives(objectives::kPaperObjectives);
}

}  // namespace

class RunnerTest : public QObject {
    Q_OBJECT

 private slots:
    void learnsWhatTheLawRewards() {
        study::StudyInputs inputs = fake::waveInputs(2);
        inputs.settings.evolution.generations = 30;
        inputs.settings.evolution.populationSize = 40;
        std::vector<GenerationRecord> saved;
        const auto end = learn(inputs, saved);
        VERIFY_OK(end);
        QVERIFY(*end == LearningEnd::completed);
        QCOMPARE(saved.size(), std::size_t{30});
        const study::GenerationStatistics& first = saved.front().statistics;
        const study::GenerationStatistics& last = saved.back().statistics;
        QVERIFY2(last.topMean.total > first.topMean.total + 0.5,
                 qPrintable(QString("%1 -> %2").arg(first.topMean.total).arg(last.topMean.total)));
        const auto nearest = [](const GenerationRecord& record) {
            const auto& winner = record.individuals[static_cast<std::size_t>(record.winner)];
            return fake::distanceFromWave(
                study::decodeTrack(fake::waveInputs().settings.track, winner.design).value());
        };
        QVERIFY(nearest(saved.back()) < 0.75 * nearest(saved.front()));
    }

    // What cannot be printed is learned away where it counts; what it is worth is the track's alone.
    void learnsWhatCanBePrinted() {
        study::StudyInputs inputs = fake::waveInputs(2);
        inputs.settings.evolution.generations = 12;
        inputs.settings.evolution.firstGeneration = search::ga::FirstGeneration::random;
        inputs.settings.evolution.objectives = "F_P";
        std::vector<GenerationRecord> saved;
        VERIFY_OK(learn(inputs, saved));
        for (const study::IndividualRecord& individual : saved.front().individuals) {
            const auto track = study::decodeTrack(inputs.settings.track, individual.design);
            const track::PrintFlaws flaws = track::findPrintFlaws(track.value());
            QCOMPARE(individual.fitness.total, -(flaws.thin + flaws.overhang) / 1e-6);
            QCOMPARE(testing::scoreOf(individual.fitness, "F_P"), individual.fitness.total);
        }
        const double first = saved.front().statistics.topMean.total;
        const double last = saved.back().statistics.topMean.total;
        QVERIFY2(first < 0.0 && last > 0.5 * first, qPrintable(QString("%1 -> %2").arg(first).arg(last)));
    }

    void knownTracksMustFitTheSettings() {
        study::StudyInputs inputs = fake::waveInputs();
        QVERIFY(study::findKnownProblem(inputs.settings, {}).empty());
        inputs.settings.evolution.firstGeneration = search::ga::FirstGeneration::known;
        const auto tells = [&](const char* words) {
            return study::findKnownProblem(inputs.settings, inputs.known).find(words) != std::string::npos;
        };
        QVERIFY(tells("no tracks of another one"));
        const std::size_t numbers = study::designSpace(inputs.settings.track).dimensions.size();
        inputs.known = {"other.trap", {{search::Design(numbers, 0.5)}}};
        QVERIFY(study::findKnownProblem(inputs.settings, inputs.known).empty());
        inputs.settings.track.crossSections += 1;
        QVERIFY(tells("the tracks of other.trap are made of"));
        std::vector<GenerationRecord> saved;
        const auto refused = learn(inputs, saved);
        QVERIFY(!refused.ok() && saved.empty());
    }

    void countsAddUp() {
        std::vector<GenerationRecord> saved;
        study::StudyInputs inputs = fake::waveInputs();
        VERIFY_OK(learn(inputs, saved));
        for (const GenerationRecord& record : saved) {
            QCOMPARE(record.individuals.size(), std::size_t{24});
            QVERIFY(record.seconds > 0.0);
            for (const study::IndividualRecord& individual : record.individuals) {
                QCOMPARE(individual.finished + individual.fellOff + individual.stuck, individual.trials);
                QCOMPARE(individual.trials, individual.overlaps == 0 ? 6 : 0);
                QCOMPARE(testing::scoreOf(individual.fitness, "F_C"), -double(individual.overlaps));
            }
        }
    }

    void sameBitsForAnyNumberOfThreads() {
        std::vector<GenerationRecord> one;
        std::vector<GenerationRecord> many;
        VERIFY_OK(learn(fake::waveInputs(1), one));
        VERIFY_OK(learn(fake::waveInputs(5), many));
        QVERIFY(sameBits(one, many));
    }

    void anotherSeedGivesAnotherRun() {
        std::vector<GenerationRecord> one;
        std::vector<GenerationRecord> other;
        study::StudyInputs inputs = fake::waveInputs();
        VERIFY_OK(learn(inputs, one));
        ++inputs.settings.evolution.seed;
        VERIFY_OK(learn(inputs, other));
        QVERIFY(!sameBits(one, other));
        QVERIFY(one[0].individuals[0].design != other[0].individuals[0].design);
    }

    void stoppedAndResumedGivesTheSameBits() {
        std::vector<GenerationRecord> whole;
        VERIFY_OK(learn(fake::waveInputs(), whole));

        // A stop after every generation.
        std::vector<GenerationRecord> pieces;
        for (std::size_t i = 1; i <= 5; ++i) {
            LearningControl control;
            study::LearningEvents events;
            events.save = [&](const GenerationRecord& record) {
                pieces.push_back(record);
                control.stopAfterGeneration();
                return base::success();
            };
            const auto last = pieces.empty() ? std::nullopt : std::optional(study::stateAfter(pieces.back()));
            const auto end = study::evolve(fake::waveInputs(), last, events, control);
            VERIFY_OK(end);
            QCOMPARE(pieces.size(), i);
            QVERIFY(*end == (i < 5 ? LearningEnd::stopped : LearningEnd::completed));
        }
        QVERIFY(sameBits(whole, pieces));

        // Nothing is left to do.
        QVERIFY(learn(fake::waveInputs(), pieces).value() == LearningEnd::completed);
        QCOMPARE(pieces.size(), std::size_t{5});
    }

    void cancelDropsTheUnfinishedGeneration() {
        std::vector<GenerationRecord> whole;
        VERIFY_OK(learn(fake::waveInputs(), whole));

        LearningControl control;
        study::StudyInputs inputs = fake::waveInputs();
        auto engine = std::make_shared<fake::FakeEngine>(fake::waveLaw, 3);
        engine->afterTrial = [&] {
            if (control.run.done() >= 2 * 24 * 6 + 50) control.run.cancel();
        };
        inputs.engine = engine;
        std::vector<GenerationRecord> saved;
        const auto end = learn(inputs, saved, control);
        VERIFY_OK(end);
        QVERIFY(*end == LearningEnd::cancelled);
        QVERIFY(saved.size() == 2 || saved.size() == 3);  // by how many tracks overlap themselves

        VERIFY_OK(learn(fake::waveInputs(), saved));
        QVERIFY(sameBits(whole, saved));
    }

    void endIsMovedWhileItRuns() {
        for (const int generations : {2, 7}) {
            study::LearningControl control;
            int saved = 0;
            study::LearningEvents events;
            events.planned = [](const study::GenerationPlan&) {};
            events.save = [&](const study::GenerationRecord& record) {
                if (record.index == 1) control.setGenerations(generations);
                ++saved;
                return base::success();
            };
            const auto end = study::evolve(fake::waveInputs(), std::nullopt, events, control);
            VERIFY_OK(end);
            QCOMPARE(*end, study::LearningEnd::completed);
            QCOMPARE(saved, generations);
        }
    }

    void plansTellWhatIsToCome() {
        LearningControl control;
        std::vector<study::GenerationPlan> plans;
        study::LearningEvents events;
        events.planned = [&](const study::GenerationPlan& plan) { plans.push_back(plan); };
        std::int64_t expected = 0;
        events.save = [&](const GenerationRecord& record) {
            const study::GenerationPlan& plan = plans.back();
            const auto simulated =
                std::count_if(record.individuals.begin(), record.individuals.end(),
                              [](const study::IndividualRecord& r) { return r.trials > 0; });
            if (plan.generation != record.index || plan.individuals != 24 || plan.simulated != simulated ||
                plan.doneBefore != expected || plan.trials != 6 * simulated) {
                return base::Status(base::Error{"the plan is wrong"});
            }
            expected += plan.trials;
            return control.run.done() == expected ? base::success()
                                                  : base::Status(base::Error{"trials are miscounted"});
        };
        VERIFY_OK(study::evolve(fake::waveInputs(), std::nullopt, events, control));
        QCOMPARE(plans.size(), std::size_t{5});
    }

    void overlappingTracksAreSimulatedOnlyIfWanted_data() {
        QTest::addColumn<bool>("wanted");
        QTest::newRow("default") << false;
        QTest::newRow("as in the paper") << true;
    }
    void overlappingTracksAreSimulatedOnlyIfWanted() {
        QFETCH(bool, wanted);
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.track.encoding = study::PointEncoding::free;
        inputs.settings.evolution.simulateOverlapping = wanted;
        inputs.settings.evolution.generations = 1;
        std::vector<GenerationRecord> saved;
        VERIFY_OK(learn(inputs, saved));
        int overlapping = 0;
        for (const study::IndividualRecord& individual : saved[0].individuals) {
            if (individual.overlaps == 0) continue;
            ++overlapping;
            QCOMPARE(individual.trials, wanted ? 6 : 0);
            QCOMPARE(testing::scoreOf(individual.fitness, "F_C"), -double(individual.overlaps));
            const auto track = study::decodeTrack(inputs.settings.track, individual.design);
            if (wanted) continue;
            QVERIFY(individual.fitness ==
                    objectives::measureAll(study::makeEvaluation(inputs, *track, individual.overlaps, {}),
                                           study::summedObjectives(inputs.settings.evolution)));
        }
        QVERIFY(overlapping > 12);  // free points cross nearly always (feasibility: F_C of -60 at random)
    }

    // The paper's search and drawing at random through the same runner; a state is its own search's.
    void everySearchLearnsAndGoesOn_data() {
        QTest::addColumn<int>("method");
        for (const auto& [name, method] : search::kMethods)
            QTest::newRow(name.data()) << static_cast<int>(method);
    }
    void everySearchLearnsAndGoesOn() {
        QFETCH(int, method);
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.search = search::Method(method);
        std::vector<GenerationRecord> whole;
        VERIFY_OK(learn(inputs, whole));
        std::vector<GenerationRecord> pieces;
        for (int count = 1; count <= inputs.settings.evolution.generations; ++count) {
            study::StudyInputs some = inputs;
            some.settings.evolution.generations = count;
            VERIFY_OK(learn(some, pieces));
        }
        QVERIFY(sameBits(whole, pieces));
        for (const GenerationRecord& record : whole) {
            QCOMPARE(record.statistics.curves.size(),
                     search::describeMethod(inputs.settings.evolution.search).curves.size());
            QVERIFY(!record.searchState.empty());
        }
        whole.back().searchState = "of something else";
        ++inputs.settings.evolution.generations;
        QVERIFY(fake::messageOf(learn(inputs, whole)).startsWith("This is not the state of a"));
    }

    void failedSaveEndsTheRun() {
        study::LearningEvents events;
        int calls = 0;
        events.save = [&](const GenerationRecord&) {
            return ++calls == 2 ? base::Status(base::Error{"the disk is full"}) : base::success();
        };
        QCOMPARE(fake::messageOf(study::evolve(fake::waveInputs(), std::nullopt, events, {})),
                 QString("the disk is full"));
        QCOMPARE(calls, 2);
    }

    void unusableInputsAreRefused() {
        std::vector<GenerationRecord> saved;
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.populationSize = -1;
        inputs.settings.track.minSegmentLength = 40e-3;
        QString message = fake::messageOf(learn(inputs, saved));
        QVERIFY(message.contains("evolution.populationSize is -1") &&
                message.contains("track.minSegmentLength_mm is 40"));

        inputs = fake::waveInputs();
        part::Part large = *inputs.part;
        large.boundingRadius = 0.1;
        inputs.part = std::make_shared<part::Part>(large);
        QVERIFY(fake::messageOf(learn(inputs, saved)).contains("too large for a track 60 mm wide"));

        inputs = fake::waveInputs();
        VERIFY_OK(learn(inputs, saved));
        inputs.settings.track.pointsPerSection = 9;
        inputs.settings.evolution.generations = 9;
        QVERIFY(!learn(inputs, saved).ok());
        QCOMPARE(saved.size(), std::size_t{5});
    }

    void brokenEnginesAreFoundOut() {
        std::vector<GenerationRecord> saved;
        study::StudyInputs inputs = fake::waveInputs();
        inputs.engine = engineOf([](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = fake::waveLaw(batch, spec);
            if (spec.stream.trial == 3)
                outcome.farthest.position.x() = std::numeric_limits<double>::quiet_NaN();
            return outcome;
        });
        const QString message = fake::messageOf(learn(inputs, saved));
        QVERIFY2(message.contains("trial 3 of individual") && message.contains("engine fake"),
                 qPrintable(message));
        QVERIFY(saved.empty());
    }

    void statisticsAreThoseOfTheTop30Percent() {
        // Ten individuals: the top are those of F = 9 (twice) and 8.
        std::vector<study::IndividualRecord> individuals(10);
        for (std::size_t i = 0; i < 10; ++i) {
            individuals[i].fitness = testing::paperFitness(0.0, -1.0, double(i));
        }
        individuals[2].fitness = testing::paperFitness(-2.0, 0.0, 10.0);  // F = 8, as the last
        const GenerationRecord record =
            study::completeGeneration(4, individuals, {{"p_x", 0.5}}, paperObjectives());
        QCOMPARE(record.index, 4);
        QCOMPARE(record.winner, 2);  // the lowest among equals
        QVERIFY(record.statistics.best == individuals[2].fitness);
        QVERIFY(qAbs(testing::scoreOf(record.statistics.topMean, "F_C") + 2.0 / 3.0) < 1e-12);
        QVERIFY(qAbs(testing::scoreOf(record.statistics.topMean, "F_D") + 2.0 / 3.0) < 1e-12);
        QVERIFY(qAbs(testing::scoreOf(record.statistics.topMean, "F_O") - 9.0) < 1e-12);
        QCOMPARE(record.statistics.topMean.total, -2.0 / 3.0 - 2.0 / 3.0 + 9.0);
        QVERIFY((record.statistics.curves == std::vector<search::NamedNumber>{{"p_x", 0.5}}));
        QVERIFY(!record.statistics.success && !record.statistics.topSuccess);  // nobody counted
    }

    void successOfTheTop30PercentIsOfThoseSimulated() {
        // Of the three best, 9, 8 and 7, the first was not simulated.
        std::vector<study::IndividualRecord> individuals(10);
        for (std::size_t i = 0; i < 10; ++i) {
            individuals[i].fitness = testing::paperFitness(0.0, 0.0, double(i));
            individuals[i].trials = 10;
            individuals[i].oriented = 10;
        }
        individuals[9].trials = individuals[9].oriented.emplace(0);
        individuals[8].oriented = 4;
        individuals[7].trials = 20;
        individuals[7].oriented = 16;
        const auto first = study::completeGeneration(0, individuals, {}, paperObjectives()).statistics;
        QVERIFY(!first.success);
        QVERIFY(qAbs(first.topSuccess.value() - 0.6) < 1e-12);
        individuals[0].fitness = testing::paperFitness(0.0, 0.0, 20.0);
        const auto second = study::completeGeneration(1, individuals, {}, paperObjectives()).statistics;
        QVERIFY(second.success == (stats::Count{10, 10}));
        QVERIFY(qAbs(second.topSuccess.value() - 0.7) < 1e-12);  // of 10 of 10 and 4 of 10
    }

    void progressIsArithmetic() {
        const study::GenerationPlan plan{2, 10, 8, 800, 1600};
        const study::LearningProgress none = study::estimateProgress(plan, 5, 0, 0.0);
        QCOMPARE(none.individualsDone, 2);
        QCOMPARE(none.trialsPerSecond, 0.0);
        QCOMPARE(none.secondsLeft, 0.0);
        // 250 of 800 trials of generation 2 after 37 s; 550 and two generations of 800 are left.
        const study::LearningProgress some = study::estimateProgress(plan, 5, 1850, 37.0);
        QCOMPARE(some.individualsDone, 4);
        QCOMPARE(some.trialsPerSecond, 50.0);
        QCOMPARE(some.secondsLeft, 43.0);
        QCOMPARE(study::estimateProgress(plan, 3, 2400, 48.0).secondsLeft, 0.0);
        // Half of 1000 trials of a plan are left, and three generations of 100.
        const study::LearningProgress planning =
            study::estimateProgress({0, 10, 10, 1000, 0, 100}, 3, 500, 10.0);
        QCOMPARE(planning.individualsDone, 0);
        QCOMPARE(planning.secondsLeft, 16.0);
    }
};

QTEST_APPLESS_MAIN(RunnerTest)
#include "runner_test.moc"
