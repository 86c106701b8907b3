#include "core/study/evaluator.h"

#include <QtTest>
#include <cmath>
#include <map>
#include <set>

#include "core/study/runner.h"
#include "core/study/trial_batches.h"
#include "core/trial/orientations.h"
#include "core/trial/predicted_speed.h"
#include "fake_engine.h"

using namespace trapwright;
using study::GenerationRecord;

namespace {

/// Goes on from what is in `saved`, and adds to it.
base::Result<study::LearningEnd> learn(const study::StudyInputs& inputs,
                                       std::vector<GenerationRecord>& saved) {
    study::LearningEvents events;
    events.save = [&](const GenerationRecord& record) {
        saved.push_back(record);
        return base::success();
    };
    return study::evolve(
        inputs, saved.empty() ? std::nullopt : std::optional(study::stateAfter(saved.back())), events, {});
}

/// A study that races: 4, 8 and 16 trials.
study::StudyInputs racingInputs(unsigned threads = 1) {
    study::StudyInputs inputs = fake::waveInputs(threads);
    inputs.settings.evolution.trialsPerEvaluation = 16;
    inputs.settings.evolution.racingTrials = 4;
    return inputs;
}

}  // namespace

/// Races, and common random numbers: what changes which trials a generation is judged by.
class EvaluatorTest : public QObject {
    Q_OBJECT

 private slots:
    void raceGivesAllTrialsToTheBest() {
        const study::StudyInputs inputs = racingInputs();
        std::vector<GenerationRecord> saved;
        VERIFY_OK(learn(inputs, saved));
        for (const GenerationRecord& record : saved) {
            std::vector<study::IndividualRecord> ranked = record.individuals;
            std::stable_sort(ranked.begin(), ranked.end(),
                             [](const study::IndividualRecord& a, const study::IndividualRecord& b) {
                                 return a.fitness.total > b.fitness.total;
                             });
            // 30 % of 24 are 7.2.
            for (std::size_t place = 0; place < 8; ++place)
                QCOMPARE(ranked[place].trials, 16);
            QVERIFY(ranked[0] == record.individuals[static_cast<std::size_t>(record.winner)]);
            int total = 0;
            for (const study::IndividualRecord& individual : ranked) {
                QVERIFY(QList({0, 4, 8, 16}).contains(individual.trials));
                QCOMPARE(individual.finished + individual.fellOff + individual.stuck, individual.trials);
                total += individual.trials;
            }
            QVERIFY2(total < 24 * 16 * 3 / 4, QByteArray::number(total));
        }
    }

    /// Trial i is trial i: who ran t trials in the race has the scores of a run of t trials.
    void raceTakesTheTrialsOfARunWithoutOne() {
        study::StudyInputs inputs = racingInputs();
        inputs.settings.evolution.generations = 1;
        std::vector<GenerationRecord> raced;
        VERIFY_OK(learn(inputs, raced));
        inputs.settings.evolution.racingTrials = 0;
        int compared = 0;
        for (const int trials : {4, 8, 16}) {
            inputs.settings.evolution.trialsPerEvaluation = trials;
            std::vector<GenerationRecord> plain;
            VERIFY_OK(learn(inputs, plain));
            for (std::size_t i = 0; i < 24; ++i) {
                if (raced[0].individuals[i].trials != trials) continue;
                ++compared;
                QVERIFY(raced[0].individuals[i] == plain[0].individuals[i]);
            }
        }
        QVERIFY(compared > 12);
    }

    void raceGivesTheSameBitsForAnyNumberOfThreadsAndAnyStop() {
        std::vector<GenerationRecord> one;
        VERIFY_OK(learn(racingInputs(1), one));
        std::vector<GenerationRecord> many;
        study::StudyInputs inputs = racingInputs(5);
        inputs.settings.evolution.generations = 2;
        VERIFY_OK(learn(inputs, many));
        inputs.settings.evolution.generations = 5;
        VERIFY_OK(learn(inputs, many));
        QCOMPARE(many.size(), one.size());
        for (std::size_t i = 0; i < one.size(); ++i)
            QVERIFY(one[i].individuals == many[i].individuals);
    }

    void racePlansComeTrueInTheLastRound() {
        study::LearningControl control;
        std::vector<study::GenerationPlan> plans;
        study::LearningEvents events;
        events.planned = [&](const study::GenerationPlan& plan) { plans.push_back(plan); };
        events.save = [&](const GenerationRecord& record) {
            std::int64_t total = 0;
            for (const study::IndividualRecord& individual : record.individuals)
                total += individual.trials;
            const study::GenerationPlan& last = plans.back();
            const bool right = last.generation == record.index && last.trials == total &&
                               last.doneBefore + total == control.run.done();
            return right ? base::success() : base::Status(base::Error{"the plan is wrong"});
        };
        VERIFY_OK(study::evolve(racingInputs(), std::nullopt, events, control));
        QVERIFY(plans.size() >= 5 * 3);  // three stages at least
    }

    /// Streams go over the best by single parts; what they come to counts, for any number of threads.
    void streamsAreSentOverTheBest() {
        std::vector<std::vector<GenerationRecord>> runs;
        for (const unsigned threads : {1U, 4U}) {
            study::StudyInputs inputs = racingInputs(threads);
            inputs.settings.evolution.objectives = "F_C, F_D, F_O, throughput";
            inputs.settings.evolution.streamShare = 0.2;  // 5 of 24
            inputs.settings.evolution.streamsEach = 2;
            inputs.settings.stream.duration = 10.0;
            inputs.settings.stream.warmUp = 0.5;
            std::int64_t announced = 0;
            study::LearningControl control;
            study::LearningEvents events;
            events.planned = [&](const study::GenerationPlan& plan) {
                announced = plan.doneBefore + plan.trials;
            };
            std::vector<GenerationRecord>& saved = runs.emplace_back();
            events.save = [&](const GenerationRecord& record) {
                saved.push_back(record);
                return control.run.done() == announced ? base::success()
                                                       : base::Status(base::Error{"the plan is wrong"});
            };
            VERIFY_OK(study::evolve(inputs, std::nullopt, events, control));
        }
        const auto scoreOf = [](const study::IndividualRecord& individual, std::string_view key) {
            const auto* score = objectives::findScore(individual.fitness, key);
            return score == nullptr ? 0.0 : score->value;
        };
        for (std::size_t g = 0; g < runs[0].size(); ++g) {
            const GenerationRecord& record = runs[0][g];
            QVERIFY(record.individuals == runs[1][g].individuals);
            int sent = 0;
            double leastSent = 1e9;
            double bestOther = -1e9;
            for (const study::IndividualRecord& individual : record.individuals) {
                const double single =
                    scoreOf(individual, "F_C") + scoreOf(individual, "F_D") + scoreOf(individual, "F_O");
                const double throughput = scoreOf(individual, "throughput");
                QVERIFY(throughput >= 0.0 && throughput <= 1.0);
                QVERIFY(std::abs(individual.fitness.total - single - throughput) < 1e-12);
                if (throughput > 0.0) {
                    ++sent;
                    leastSent = std::min(leastSent, single);
                    QCOMPARE(individual.trials, 16);
                } else {
                    bestOther = std::max(bestOther, single);
                }
            }
            QVERIFY2(sent <= 5 && (g == 0 || sent > 0), QByteArray::number(sent));
            if (sent == 5) QVERIFY(leastSent >= bestOther);
        }
    }

    /// Unless a limit is set: as long as a part takes at 20 mm/s, and where it climbs as many times longer as
    /// it is slower.
    void theTimeLimitKnowsTheSlope() {
        study::SimulationSettings simulation;
        track::Track track;
        track.start = 0.06;
        track.finish = 0.56;
        QCOMPARE(study::terminationOn(simulation, track).timeLimit, 25.0);
        track.shape.slope = -3.0 * base::kDegree;
        QCOMPARE(study::terminationOn(simulation, track).timeLimit, 25.0);
        track.shape.slope = 3.0 * base::kDegree;
        const auto speed = [&](double slope) {
            return trial::predictConveying(simulation.drive, simulation.contact, simulation.gravity, slope)
                .speed;
        };
        const double expected = 25.0 * speed(0.0) / speed(track.shape.slope);
        QVERIFY(expected > 26.0);
        QCOMPARE(study::terminationOn(simulation, track).timeLimit, std::ceil(expected));
        // Nothing comes up there.
        simulation.drive.halfStroke = 0.3e-3;
        simulation.contact = {0.3, 0.3, 0.2};
        track.shape.slope = 10.0 * base::kDegree;
        QVERIFY(speed(track.shape.slope) <= 0.0);
        QCOMPARE(study::terminationOn(simulation, track).timeLimit, 250.0);
        simulation.termination.timeLimit = 7.0;
        QCOMPARE(study::terminationOn(simulation, track).timeLimit, 7.0);
    }

    /// By F, or by the fronts of two sums that differ in what is traded.
    void tracksAreRankedByWhatIsTraded() {
        study::EvolutionSettings settings;
        settings.objectives = "F_C, purity, success";
        std::vector<objectives::Fitness> fitnesses;
        const auto add = [&](double collisions, double purity, double success) {
            objectives::Fitness fitness;
            fitness.scores = {{"F_C", collisions}, {"purity", purity}, {"success", success}};
            fitness.total = objectives::calcTotal(fitness.scores, study::summedObjectives(settings));
            fitnesses.push_back(fitness);
        };
        add(0.0, 1.0, 0.9);   // the most right
        add(0.0, 3.0, 0.2);   // the fewest wrong
        add(0.0, 2.0, 0.5);   // between both
        add(0.0, 1.9, 0.4);   // worse than that
        add(-5.0, 3.0, 0.9);  // best of both, but it cannot be
        const auto totals = study::rankingScores(settings, fitnesses);
        for (std::size_t i = 0; i < fitnesses.size(); ++i)
            QCOMPARE(totals[i], fitnesses[i].total);
        settings.tradeOff = "purity, success";
        const auto places = study::rankingScores(settings, fitnesses);
        QVERIFY((places == std::vector{0.0, -1.0, -2.0, -3.0, -4.0}));
    }

    /// Learning by fronts keeps both ends of what there is to choose from, for any number of threads.
    void learningTradesTwoObjectives() {
        std::vector<std::vector<GenerationRecord>> runs;
        for (const unsigned threads : {1U, 4U}) {
            study::StudyInputs inputs = racingInputs(threads);
            inputs.settings.evolution.objectives = "F_C, F_D, F_O";
            inputs.settings.evolution.tradeOff = "F_D, F_O";
            VERIFY_OK(learn(inputs, runs.emplace_back()));
        }
        study::StudyInputs summed = racingInputs();
        summed.settings.evolution.objectives = "F_C, F_D, F_O";
        std::vector<GenerationRecord> others;
        VERIFY_OK(learn(summed, others));
        QCOMPARE(runs[0].size(), others.size());
        for (std::size_t g = 0; g < others.size(); ++g)
            QVERIFY(runs[0][g].individuals == runs[1][g].individuals);
        // The same first generation, raced for by the front, and other children of it.
        QVERIFY(runs[0][0].individuals.front().design == others[0].individuals.front().design);
        QVERIFY(runs[0].back().individuals != others.back().individuals);
    }

    /// An individual's success is that of the selection: of all its trials, whether it raced or not. The law
    /// lays the parts of each trial as its number says.
    void successIsCountedOfAllTrials_data() {
        QTest::addColumn<int>("racingTrials");
        QTest::newRow("all at once") << 0;
        QTest::newRow("in a race") << 4;
    }
    void successIsCountedOfAllTrials() {
        QFETCH(int, racingTrials);
        study::StudyInputs inputs = racingInputs(3);
        inputs.settings.evolution.racingTrials = racingTrials;
        inputs.settings.evolution.generations = 1;
        inputs.engine = std::make_shared<fake::FakeEngine>(
            [](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                trial::PartOutcome outcome = fake::waveLaw(batch, spec);
                // Of 8 trials 3 end alike (one of them turned to where the block looks the same), 2 within
                // the tolerance of each other elsewhere, 1 aside; 2 do not finish, as they lie in the
                // majority.
                const double degrees =
                    std::array{0.0, 180.0, 10.0, 75.0, 80.0, 45.0, 0.0, 0.0}.at(spec.stream.trial % 8);
                outcome.farthest.rotation = Eigen::AngleAxisd(degrees * base::kDegree, base::Vec3::UnitZ());
                outcome.ending = spec.stream.trial % 8 < 6 ? trial::Ending::finished : trial::Ending::stuck;
                return outcome;
            });
        std::vector<GenerationRecord> saved;
        VERIFY_OK(learn(inputs, saved));
        std::set<int> seen;
        for (const study::IndividualRecord& individual : saved[0].individuals) {
            seen.insert(individual.trials);
            QVERIFY(individual.oriented.has_value());
            // 3 of the first 4, 3 of 8, 6 of 16.
            const int expected = individual.trials == 0   ? 0
                                 : individual.trials == 4 ? 3
                                                          : 3 * individual.trials / 8;
            QCOMPARE(*individual.oriented, expected);
            QCOMPARE(individual.success().has_value(), individual.trials > 0);
        }
        QVERIFY(seen.contains(16));
        QCOMPARE(seen.contains(4) || seen.contains(8), racingTrials == 4);
        QVERIFY(saved[0].statistics.success == (stats::Count{6, 16}));
        QVERIFY(qAbs(saved[0].statistics.topSuccess.value() - 6.0 / 16.0) < 1e-12);
    }

    void commonRandomNumbersAreAGenerations_data() {
        QTest::addColumn<bool>("common");
        QTest::newRow("common") << true;
        QTest::newRow("of its own") << false;
    }
    void commonRandomNumbersAreAGenerations() {
        QFETCH(bool, common);
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.commonRandomNumbers = common;
        inputs.settings.evolution.generations = 2;
        // What an engine is given: per generation and trial, how many starts there are.
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<double>> phases;
        inputs.engine = std::make_shared<fake::FakeEngine>(
            [&](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                phases[{spec.stream.generation, spec.stream.trial}].insert(spec.phase);
                return fake::waveLaw(batch, spec);
            });
        std::vector<GenerationRecord> saved;
        VERIFY_OK(learn(inputs, saved));
        QCOMPARE(phases.size(), std::size_t{2 * 6});
        std::set<double> all;
        for (const auto& [trial, own] : phases) {
            const GenerationRecord& record = saved[trial.first];
            const auto simulated = static_cast<std::size_t>(
                std::count_if(record.individuals.begin(), record.individuals.end(),
                              [](const study::IndividualRecord& r) { return r.trials > 0; }));
            QCOMPARE(own.size(), common ? std::size_t{1} : simulated);
            all.insert(own.begin(), own.end());
        }
        if (common) QCOMPARE(all.size(), std::size_t{2 * 6});  // no two trials alike
    }
};

QTEST_APPLESS_MAIN(EvaluatorTest)
#include "evaluator_test.moc"
