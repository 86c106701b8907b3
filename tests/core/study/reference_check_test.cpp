#include "core/study/reference_check.h"

#include <QElapsedTimer>
#include <QtTest>
#include <algorithm>
#include <future>
#include <iterator>
#include <set>

#include "core/study/runner.h"
#include "fake_engine.h"
#include "tests/core/objectives/paper_fitness.h"

using namespace trapwright;
using study::BackgroundChecks;
using study::CheckRecord;
using study::GenerationRecord;
using study::Individual;

namespace {

/// Every fourth part that finishes by the law turns upside down, and every fifth falls off.
trial::PartOutcome otherLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    trial::PartOutcome outcome = fake::waveLaw(batch, spec);
    if (outcome.ending != trial::Ending::finished) return outcome;
    if (spec.stream.trial % 4 == 0)
        outcome.farthest.rotation =
            Eigen::AngleAxisd(base::kPi / 2, base::Vec3::UnitX()) * outcome.farthest.rotation;
    if (spec.stream.trial % 5 == 0) outcome.ending = trial::Ending::fellOff;
    return outcome;
}

std::shared_ptr<fake::FakeEngine> engineOf(fake::Law law, const std::string& title) {
    auto engine = std::make_shared<fake::FakeEngine>(std::move(law));
    engine->title = title;
    return engine;
}

/// A perfect feeder, whatever its track.
trial::PartOutcome perfectLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    trial::PartOutcome outcome = fake::waveLaw(batch, spec);
    outcome.ending = trial::Ending::finished;
    outcome.farthest = {base::Quaternion::Identity(), {batch.track->finish, 0.0, 0.0}};
    return outcome;
}

/// Learns, and has every winner checked if there are checks.
std::vector<GenerationRecord> learn(const study::StudyInputs& inputs, BackgroundChecks* checks) {
    std::vector<GenerationRecord> saved;
    study::LearningEvents events;
    events.save = [&](const GenerationRecord& record) {
        const auto& winner = record.individuals[static_cast<std::size_t>(record.winner)];
        if (checks != nullptr) checks->add({{record.index, record.winner}, winner});
        saved.push_back(record);
        return base::success();
    };
    (void)study::evolve(inputs, std::nullopt, events, {});
    return saved;
}

Individual winnerOf(const GenerationRecord& record) {
    return {{record.index, record.winner}, record.individuals[static_cast<std::size_t>(record.winner)]};
}

/// Waits until so many checks are there.
std::vector<CheckRecord> waitFor(BackgroundChecks& checks, std::size_t count) {
    std::vector<CheckRecord> all;
    QElapsedTimer timer;
    timer.start();
    while (all.size() < count && timer.elapsed() < 30000) {
        for (CheckRecord& record : checks.takeFinished())
            all.push_back(std::move(record));
        QTest::qSleep(1);
    }
    return all;
}

}  // namespace

class ReferenceCheckTest : public QObject {
    Q_OBJECT

 private slots:
    void bothEnginesGetTheSameTrials() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.trialsPerEvaluation = 130;
        inputs.settings.evolution.generations = 1;
        const Individual winner = winnerOf(learn(inputs, nullptr).front());
        std::vector<trial::TrialSpec> given;
        const auto keep = [&](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            given.push_back(spec);
            return perfectLaw(batch, spec);
        };
        inputs.engine = engineOf(keep, "quick");
        const auto record = study::checkWinner(inputs, *engineOf(keep, "slow"), winner, {});
        VERIFY_OK(record);
        QCOMPARE(record->trials, 100);
        QCOMPARE(given.size(), std::size_t{200});
        for (std::size_t i = 0; i < 100; ++i) {
            QCOMPARE(given[i].stream,
                     (base::StreamKey{2024, 0, static_cast<std::uint32_t>(winner.individual),
                                      static_cast<std::uint32_t>(i), base::Purpose::trialStart}));
            QCOMPARE(given[i + 100].stream, given[i].stream);
            QVERIFY(given[i + 100].parts[0].pose == given[i].parts[0].pose);
            QCOMPARE(given[i + 100].phase, given[i].phase);
        }
    }

    /// A step of learning that is too large shows: the reference does not share it.
    void referenceHasItsOwnStep() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.generations = 1;
        inputs.settings.evolution.learningStep = 0.4e-3;
        std::vector<double> steps;
        const auto keep = [&](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            steps.push_back(batch.step);
            return perfectLaw(batch, spec);
        };
        inputs.engine = engineOf(keep, "quick");
        const Individual winner = winnerOf(learn(inputs, nullptr).front());
        QVERIFY(!steps.empty());
        QVERIFY(std::ranges::count(steps, 0.4e-3) == std::ssize(steps));
        steps.clear();
        VERIFY_OK(study::checkWinner(inputs, *engineOf(keep, "slow"), winner, {}));
        const auto own = static_cast<std::size_t>(winner.record.trials);
        QCOMPARE(steps.size(), 2 * own);
        for (std::size_t i = 0; i < own; ++i) {
            QCOMPARE(steps[i], 0.4e-3);
            QCOMPARE(steps[i + own], 0.0);
        }
    }

    void differencesAreThoseOfTheLaws() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.evolution.trialsPerEvaluation = 40;
        inputs.settings.evolution.generations = 1;
        inputs.engine = engineOf(perfectLaw, "quick");
        const Individual winner = winnerOf(learn(inputs, nullptr).front());
        const auto worse = [](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = perfectLaw(batch, spec);
            if (spec.stream.trial % 4 == 0)
                outcome.farthest.rotation = Eigen::AngleAxisd(base::kPi / 2, base::Vec3::UnitX());
            if (spec.stream.trial % 10 == 1) outcome.ending = trial::Ending::fellOff;
            return outcome;
        };
        const auto record = study::checkWinner(inputs, *engineOf(worse, "slow"), winner, {});
        VERIFY_OK(record);
        QCOMPARE(record->generation, 0);
        QCOMPARE(record->individual, winner.individual);
        QCOMPARE(record->trials, 40);
        QCOMPARE(record->learning.engine, std::string("quick"));
        QCOMPARE(record->reference.engine, std::string("slow"));
        // The learning engine repeats what the winner was judged by.
        QVERIFY(record->learning.fitness == winner.record.fitness);
        QCOMPARE(record->learning.finished, 40);
        QCOMPARE(record->learning.oriented, 40);
        // Of 40, those 0, 4, 8 ... lie on another side, and 1, 11, 21, 31 fall off.
        QCOMPARE(record->reference.finished, 36);
        QCOMPARE(record->reference.oriented, 26);
        QCOMPARE(testing::scoreOf(record->reference.fitness, "F_C"),
                 testing::scoreOf(winner.record.fitness, "F_C"));
        // 10 x 30 of the 780 pairs are a quarter turn apart.
        QVERIFY(qAbs(testing::scoreOf(winner.record.fitness, "F_O") -
                     testing::scoreOf(record->reference.fitness, "F_O") -
                     300.0 / 780.0 * std::sqrt(base::kPi / 2)) < 1e-9);
    }

    void learningIsTheSameWithAndWithoutChecks() {
        const study::StudyInputs inputs = fake::waveInputs(2);
        const std::vector<GenerationRecord> without = learn(inputs, nullptr);
        study::StudyInputs aside = inputs;
        aside.engine = engineOf(fake::waveLaw, "quick");
        BackgroundChecks checks(aside, engineOf(otherLaw, "slow"));
        const std::vector<GenerationRecord> with = learn(inputs, &checks);
        QCOMPARE(with.size(), without.size());
        for (std::size_t i = 0; i < with.size(); ++i)
            QVERIFY(with[i].individuals == without[i].individuals);

        // In the background comes out what comes out directly.
        std::vector<CheckRecord> finished = waitFor(checks, 5);
        QCOMPARE(finished.size(), std::size_t{5});
        QVERIFY(checks.stop().empty());
        for (const CheckRecord& record : finished) {
            const Individual winner = winnerOf(with[static_cast<std::size_t>(record.generation)]);
            QVERIFY(record == study::checkWinner(aside, *engineOf(otherLaw, "slow"), winner, {}).value());
        }
    }

    void latestWinnerIsCheckedFirst() {
        study::StudyInputs inputs = fake::waveInputs();
        const std::vector<GenerationRecord> saved = learn(inputs, nullptr);
        std::promise<void> begun;
        std::promise<void> allThere;
        std::atomic<bool> first{true};
        auto reference = engineOf(otherLaw, "slow");
        reference->afterTrial = [&] {
            if (!first.exchange(false)) return;
            begun.set_value();
            allThere.get_future().wait();
        };
        BackgroundChecks checks(inputs, reference);
        checks.add(winnerOf(saved[1]));
        begun.get_future().wait();
        for (const std::size_t i : {0, 2, 3})
            checks.add(winnerOf(saved[i]));
        allThere.set_value();
        std::vector<int> order;
        for (const CheckRecord& record : waitFor(checks, 4))
            order.push_back(record.generation);
        QVERIFY(order == (std::vector<int>{1, 3, 2, 0}));
    }

    void whatIsNotDoneIsGivenBack() {
        study::StudyInputs inputs = fake::waveInputs();
        const std::vector<GenerationRecord> saved = learn(inputs, nullptr);
        // The reference cannot do generation 2, and hangs at generation 0 until it is cancelled.
        std::promise<void> hanging;
        std::promise<void> released;
        auto law = [&](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = fake::waveLaw(batch, spec);
            if (spec.stream.generation == 2) outcome.initial.position.x() = std::nan("");
            if (spec.stream.generation == 0 && spec.stream.trial == 0) {
                hanging.set_value();
                released.get_future().wait();
            }
            return outcome;
        };
        BackgroundChecks checks(inputs, engineOf(law, "slow"));
        checks.add(winnerOf(saved[2]));
        checks.add(winnerOf(saved[3]));
        QCOMPARE(waitFor(checks, 1).size(), std::size_t{1});
        checks.add(winnerOf(saved[0]));
        hanging.get_future().wait();
        checks.add(winnerOf(saved[1]));
        auto left = std::async(std::launch::async, [&] { return checks.stop(); });
        released.set_value();
        std::vector<int> generations;
        for (const Individual& winner : left.get())
            generations.push_back(winner.generation);
        // Generation 0 was cancelled, or ended just before it heard of that.
        for (const CheckRecord& record : checks.takeFinished())
            generations.push_back(record.generation);
        std::sort(generations.begin(), generations.end());
        QVERIFY(generations == (std::vector<int>{0, 1, 2}));
    }
};

QTEST_APPLESS_MAIN(ReferenceCheckTest)
#include "reference_check_test.moc"
