#include "core/trial/backed_engine.h"

#include <QtTest>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "core/trial/engine_registry.h"

using namespace trapwright;
using trial::Ending;
using trial::Outcome;
using trial::RemadeTrial;
using trial::TrialBatch;

namespace {

/// How an engine treats the trials with these numbers; all others finish in orderly fashion.
struct Faults {
    std::set<unsigned> lost{};    // its pose is not a number
    std::set<unsigned> thrown{};  // far off the track
    std::set<unsigned> sunk{};    // through the track's surface
    std::set<unsigned> fatal{};   // ends the whole call with an error
};

/// Parts go one metre per second; the time of a trial tells the step that it was made in.
class FaultyEngine : public trial::Engine {
 public:
    FaultyEngine(std::string name, Faults faults) : name_(std::move(name)), faults_(std::move(faults)) {}

    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] double step() const override { return 1e-4; }

    [[nodiscard]] base::Result<std::vector<std::vector<Outcome>>> run(
        std::span<const TrialBatch> batches, base::RunControl control) const override {
        std::vector<std::vector<Outcome>> outcomes;
        for (const TrialBatch& batch : batches) {
            outcomes.emplace_back();
            for (const trial::TrialSpec& spec : batch.trials) {
                if (control.cancelled()) return base::Error{"cancelled"};
                if (faults_.fatal.contains(spec.stream.trial)) return base::Error{"it broke"};
                outcomes.back().push_back(simulate(batch, spec));
                control.advance(1);
            }
        }
        return outcomes;
    }
    [[nodiscard]] base::Result<trial::Trajectory> replay(const TrialBatch& batch, std::size_t index, double,
                                                         base::RunControl) const override {
        if (faults_.fatal.contains(batch.trials[index].stream.trial)) return base::Error{"it broke"};
        return trial::Trajectory{{}, simulate(batch, batch.trials[index])};
    }

 private:
    [[nodiscard]] Outcome simulate(const TrialBatch& batch, const trial::TrialSpec& spec) const {
        trial::PartOutcome part;
        part.ending = Ending::finished;
        part.initial.position.x() = batch.track->start;
        part.farthest.position.x() = batch.track->finish;
        part.time = batch.stepOf(0.0, step());
        if (faults_.lost.contains(spec.stream.trial))
            part.farthest.position.z() = std::numeric_limits<double>::quiet_NaN();
        if (faults_.thrown.contains(spec.stream.trial)) part.farthest.position.x() = 1e6;
        part.throughSurface = faults_.sunk.contains(spec.stream.trial);
        return {{part}, {}};
    }

    std::string name_;
    Faults faults_;
};

std::shared_ptr<const part::Part> makePart() {
    auto part = std::make_shared<part::Part>();
    part->pieces.resize(1);
    part->massProperties.mass = 1e-3;
    return part;
}

/// Two batches of ten trials, numbered on.
std::vector<TrialBatch> makeBatches() {
    auto track = std::make_shared<track::Track>();
    track->sections = {{0.0, {}}, {0.5, {}}};
    track->start = 0.06;
    track->finish = 0.4;
    track->width = 0.06;
    std::vector<TrialBatch> batches(2);
    unsigned number = 0;
    for (TrialBatch& batch : batches) {
        batch.track = track;
        batch.parts = {makePart()};
        batch.step = 4e-4;
        batch.termination.stuckTime = 0.5;
        for (int i = 0; i < 10; ++i) {
            trial::TrialSpec spec;
            spec.stream = {1, 2, 3, number++, base::Purpose::test};
            spec.parts = {{0, {base::Quaternion::Identity(), {0.06, 0.0, 0.02}}}};
            batch.trials.push_back(spec);
        }
    }
    return batches;
}

trial::EngineRegistry registryOf(const Faults& quick, const Faults& reference) {
    const auto kind = [](const char* name, trial::EngineRole role, const Faults& faults) {
        return trial::EngineKind{name,
                                 [name, faults](const trial::EngineOptions&) {
                                     return std::make_unique<FaultyEngine>(name, faults);
                                 },
                                 name, role};
    };
    return trial::EngineRegistry({kind("quick", trial::EngineRole::quick, quick),
                                  kind("sure", trial::EngineRole::reference, reference)});
}

}  // namespace

class BackedEngineTest : public QObject {
    Q_OBJECT

 private slots:
    void whatCannotBeFinishedIsMadeAgain_data() {
        QTest::addColumn<QList<int>>("lost");
        QTest::addColumn<QList<int>>("thrown");
        QTest::addColumn<QList<int>>("sunk");
        QTest::addColumn<QList<int>>("fatal");
        const QList<int> none;
        QTest::newRow("none") << none << none << none << none;
        QTest::newRow("lost") << QList<int>{0, 13} << none << none << none;
        QTest::newRow("thrown") << none << QList<int>{19} << none << none;
        QTest::newRow("through the surface") << none << none << QList<int>{2, 11} << none;
        QTest::newRow("an error") << none << none << none << QList<int>{7};
        QTest::newRow("all kinds") << QList<int>{1, 18} << QList<int>{5} << QList<int>{3}
                                   << QList<int>{0, 9, 10};
    }
    void whatCannotBeFinishedIsMadeAgain() {
        QFETCH(QList<int>, lost);
        QFETCH(QList<int>, thrown);
        QFETCH(QList<int>, sunk);
        QFETCH(QList<int>, fatal);
        const auto remade = std::make_shared<trial::RemadeTrials>();
        const trial::EngineRegistry engines = registryOf({{lost.begin(), lost.end()},
                                                          {thrown.begin(), thrown.end()},
                                                          {sunk.begin(), sunk.end()},
                                                          {fatal.begin(), fatal.end()}},
                                                         {});
        const auto engine = engines.make("quick", {1, 0.0, nullptr, remade}).value();
        const std::vector<TrialBatch> batches = makeBatches();
        const base::RunControl control;
        const auto outcomes = engine->run(batches, control);
        QVERIFY2(outcomes.ok(), outcomes.ok() ? "" : outcomes.error().message.c_str());
        // Each trial counts once.
        QCOMPARE(control.done(), std::int64_t{20});
        const QList<int> all = lost + thrown + sunk + fatal;
        QCOMPARE(remade->count(), static_cast<std::size_t>(all.size()));
        for (std::size_t b = 0; b < batches.size(); ++b) {
            for (std::size_t i = 0; i < batches[b].trials.size(); ++i) {
                const trial::PartOutcome& part = (*outcomes)[b][i].parts.front();
                QCOMPARE(part.ending, Ending::finished);
                QCOMPARE(part.farthest.position.x(), 0.4);
                // The reference goes in its own step, not in the coarse one of the batch.
                const int number = static_cast<int>(batches[b].trials[i].stream.trial);
                QCOMPARE(part.time, all.contains(number) ? 1e-4 : 4e-4);
            }
        }
        for (const RemadeTrial& trial : remade->list()) {
            QCOMPARE(trial.engine, std::string("quick"));
            QVERIFY(!trial.isStuck);
            const int number = static_cast<int>(trial.stream.trial);
            QVERIFY(all.contains(number));
            QCOMPARE(trial.reason,
                     std::string(lost.contains(number)     ? "its pose is not a number"
                                 : thrown.contains(number) ? "it was thrown 1e+06 m off the track"
                                 : sunk.contains(number)   ? "it fell through the track's surface"
                                                           : "it broke"));
        }
    }

    // Only what the reference cannot finish either counts as stuck, where it began.
    void whatNobodyFinishesIsStuck() {
        const auto remade = std::make_shared<trial::RemadeTrials>();
        const trial::EngineRegistry engines = registryOf({{3, 4}, {}, {}, {5}}, {{3}, {}, {5}, {}});
        const auto engine = engines.make("quick", {1, 0.0, nullptr, remade}).value();
        const std::vector<TrialBatch> batches = makeBatches();
        const auto outcomes = engine->run(batches, {});
        QVERIFY(outcomes.ok());
        for (std::size_t i = 0; i < 10; ++i) {
            const trial::PartOutcome& part = (*outcomes)[0][i].parts.front();
            const bool isStuck = i == 3 || i == 5;
            QCOMPARE(part.ending, isStuck ? Ending::stuck : Ending::finished);
            if (!isStuck) continue;
            QVERIFY(std::abs(part.farthest.position.x() - 0.06) < 1e-12);
            QCOMPARE(part.farthest, part.initial);
            QCOMPARE(part.time, 0.5);
        }
        const std::vector<RemadeTrial> list = remade->list();
        QCOMPARE(list.size(), 3U);
        QCOMPARE(list[0].stream, batches[0].trials[3].stream);
        QVERIFY(list[0].isStuck && !list[1].isStuck && list[2].isStuck);
        QCOMPARE(trial::describe(list[0]), std::string("trial 3 of individual 3 of generation 2 (quick: its "
                                                       "pose is not a number; counts as stuck)"));
        QVERIFY(
            trial::describe(list).starts_with("3 trials could not be finished and were made again with the "
                                              "reference engine, 2 of them in vain: trial 3 of"));
        QVERIFY(trial::describe(std::span<const RemadeTrial>()).empty());
    }

    // Where nothing can be finished at all, the trials are not what is wrong.
    void anEngineThatCanNothingIsAnError() {
        std::set<unsigned> all;
        for (unsigned i = 0; i < 20; ++i)
            all.insert(i);
        const auto remade = std::make_shared<trial::RemadeTrials>();
        const auto engine =
            registryOf({{}, {}, {}, all}, {{}, {}, {}, all}).make("quick", {1, 0.0, nullptr, remade});
        const auto outcomes = (*engine)->run(makeBatches(), {});
        QVERIFY(!outcomes.ok());
        QCOMPARE(outcomes.error().message,
                 std::string("Neither quick nor sure could finish any of 20 trials: it broke"));
        QCOMPARE(remade->count(), 0U);
    }

    // Nor is it a matter of a trial that no engine takes what it is given.
    void brokenBatchesAreAnError() {
        std::vector<TrialBatch> batches = makeBatches();
        batches[1].parts.clear();
        const auto engine = registryOf({{}, {}, {}, {2}}, {}).make("quick", {});
        const auto outcomes = (*engine)->run(batches, {});
        QVERIFY(!outcomes.ok());
        QCOMPARE(outcomes.error().message, std::string("it broke"));
    }

    void cancellingEndsIt() {
        base::RunControl control;
        control.cancel();
        const auto engine = registryOf({{}, {}, {}, {2}}, {}).make("quick", {});
        QVERIFY(!(*engine)->run(makeBatches(), control).ok());
    }

    // A replay shows the trial that counts.
    void replayShowsWhoMadeIt() {
        const auto engine = registryOf({{1}, {2}, {}, {3}}, {}).make("quick", {}).value();
        const std::vector<TrialBatch> batches = makeBatches();
        const auto outcomes = engine->run(batches, {});
        for (std::size_t i = 0; i < 5; ++i) {
            const auto replay = engine->replay(batches[0], i, 1e-3, {});
            QVERIFY(replay.ok());
            QCOMPARE(replay->outcome, (*outcomes)[0][i]);
        }
    }
};

QTEST_APPLESS_MAIN(BackedEngineTest)
#include "backed_engine_test.moc"
