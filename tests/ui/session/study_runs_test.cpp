#include <QElapsedTimer>
#include <QtTest>

#include "core/study/runner.h"
#include "core/study/selection.h"
#include "core/study/validation.h"
#include "tests/core/study/flawed_track.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/recovery_note.h"
#include "ui/session/study_design.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::session;

namespace {

/// The same study learned without a window and without a break.
std::vector<study::GenerationRecord> learnAtOnce(const study::Settings& settings) {
    study::StudyInputs inputs;
    inputs.settings = settings;
    inputs.settings.part = cuboid().settings;
    inputs.part = cuboid().part;
    inputs.engine = std::make_shared<fake::FakeEngine>(fake::waveLaw);
    std::vector<study::GenerationRecord> records;
    study::LearningEvents events;
    events.planned = [](const study::GenerationPlan&) {};
    events.save = [&](const study::GenerationRecord& record) {
        records.push_back(record);
        return base::success();
    };
    if (!study::evolve(inputs, std::nullopt, events, {}).ok()) records.clear();
    return records;
}

}  // namespace

/// What a study that is open does: learning, selection, validation.
class StudyRunsTest : public QObject {
    Q_OBJECT

 private slots:
    void init() { fixture_ = std::make_unique<SessionFixture>(); }

    void learningIsToldAndSaved() {
        const auto session = fixture_->create("a.trap", smallSettings(4));
        QVERIFY(session);
        QSignalSpy saved(&session->runs(), &StudyRuns::generationSaved);
        QSignalSpy states(&session->runs(), &StudyRuns::stateChanged);
        QVERIFY(learnToTheEnd(*session));
        QCOMPARE(saved.count(), 4);
        QCOMPARE(states.count(), 2);
        const std::vector<study::GenerationRecord> truth = learnAtOnce(smallSettings(4));
        QCOMPARE(truth.size(), std::size_t{4});
        for (int i = 0; i < 4; ++i) {
            const auto at = static_cast<std::size_t>(i);
            QCOMPARE(saved[i][0].toInt(), i);
            const auto record = session->runs().loadGeneration(i);
            VERIFY_OK(record);
            QCOMPARE(record->individuals, truth[at].individuals);
            QCOMPARE(session->runs().summaries()[at].statistics, truth[at].statistics);
            QCOMPARE(session->runs().winners()[at].individual, truth[at].winner);
            const auto winner = session->runs().loadIndividual({i, truth[at].winner});
            VERIFY_OK(winner);
            QCOMPARE(winner->record, session->runs().winners()[at].record);
        }
        QVERIFY(session->runs().checks().empty());
        QVERIFY(!session->runs().loadGeneration(4).ok());
    }

    void pauseStandsStillAndChangesNothing() {
        fixture_->trialTime = std::chrono::milliseconds(3);
        const auto session = fixture_->create("a.trap", smallSettings(3));
        QVERIFY(session);
        session->runs().setThreads(1);
        session->runs().startLearning();
        QVERIFY(waitUntil([&] { return session->runs().progress().trialsDone > 3; }));
        session->runs().pause();
        QCOMPARE(session->runs().state(), RunState::paused);
        QTest::qWait(50);
        const RunProgress still = session->runs().progress();
        QTest::qWait(150);
        QCOMPARE(session->runs().progress().trialsDone, still.trialsDone);
        QCOMPARE(session->runs().progress().trialsPerSecond, still.trialsPerSecond);
        QVERIFY(session->design().locked());
        session->runs().resume();
        QCOMPARE(session->runs().state(), RunState::learning);
        QVERIFY(waitForState(*session, RunState::idle));
        const std::vector<study::GenerationRecord> truth = learnAtOnce(smallSettings(3));
        for (int i = 0; i < 3; ++i)
            QCOMPARE(session->runs().loadGeneration(i).value().individuals,
                     truth[static_cast<std::size_t>(i)].individuals);
    }

    void progressTellsWhereItIs() {
        // Long enough to be told of more than once.
        fixture_->trialTime = std::chrono::milliseconds(12);
        const auto session = fixture_->create("a.trap", smallSettings(3));
        QVERIFY(session);
        session->runs().setThreads(1);
        std::vector<RunProgress> told;
        connect(&session->runs(), &StudyRuns::progressed, this,
                [&](const RunProgress& progress) { told.push_back(progress); });
        QVERIFY(learnToTheEnd(*session));
        QVERIFY(told.size() >= 2);
        for (const RunProgress& progress : told) {
            QCOMPARE(progress.generations, 3);
            QCOMPARE(progress.individuals, 8);
            QVERIFY(progress.trialsDone <= progress.trials && progress.trials <= 32);
            QVERIFY(progress.individualsDone <= 8);
        }
        // One thread, 4 ms each.
        const auto fastest = std::max_element(told.begin(), told.end(), [](const auto& a, const auto& b) {
            return a.trialsPerSecond < b.trialsPerSecond;
        });
        QVERIFY(fastest->trialsPerSecond > 0.0 && fastest->trialsPerSecond <= 250.0);
        QCOMPARE(session->runs().progress().trials, 0);
    }

    void stopsAfterTheGeneration() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings(50));
        QVERIFY(session);
        session->runs().setThreads(1);
        connect(&session->runs(), &StudyRuns::generationSaved, this, [&](int generation) {
            if (generation == 0) session->runs().stopAfterGeneration();
        });
        session->runs().startLearning();
        QVERIFY(waitForState(*session, RunState::stoppingAfterGeneration));
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->runs().summaries().size(), std::size_t{2});
    }

    void stopsAfterTheGenerationFromAPause() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings(50));
        QVERIFY(session);
        session->runs().startLearning();
        QVERIFY(waitUntil([&] { return session->runs().progress().trialsDone > 2; }));
        session->runs().pause();
        QTest::qWait(100);
        const std::size_t before = session->runs().summaries().size();
        session->runs().stopAfterGeneration();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->runs().summaries().size(), before + 1);
    }

    void stopsAtOnceAndGoesOnAfterReopening() {
        const study::Settings settings = smallSettings(6);
        fixture_->trialTime = std::chrono::milliseconds(5);
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startLearning();
        QVERIFY(waitUntil([&] {
            return session->runs().summaries().size() >= 2 && session->runs().progress().trialsDone > 2;
        }));
        session->runs().stopNow();
        QCOMPARE(session->runs().state(), RunState::stopping);
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(failed.count(), 0);
        const std::size_t kept = session->runs().summaries().size();
        QVERIFY(kept < 6);
        session.reset();
        QVERIFY(!std::filesystem::exists(fixture_->path("a.trap-wal")));

        fixture_->trialTime = {};
        session = fixture_->open("a.trap");
        QVERIFY(session);
        QCOMPARE(session->runs().summaries().size(), kept);
        QCOMPARE(session->runs().winners().size(), kept);
        QVERIFY(session->design().locked());
        QVERIFY(learnToTheEnd(*session));
        const std::vector<study::GenerationRecord> truth = learnAtOnce(settings);
        QCOMPARE(session->runs().summaries().size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i)
            QCOMPARE(session->runs().loadGeneration(static_cast<int>(i)).value().individuals,
                     truth[i].individuals);
    }

    void stopBeforeTheFirstGenerationLeavesItFree() {
        fixture_->trialTime = std::chrono::milliseconds(5);
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->runs().startLearning();
        QVERIFY(session->design().locked());
        session->runs().stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QVERIFY(session->runs().summaries().empty() && !session->design().locked());
    }

    void moreGenerationsHoldForTheRunThatGoesOn() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        session->runs().startLearning();
        QVERIFY(waitUntil([&] { return session->runs().progress().trialsDone > 0; }));
        study::Settings longer = session->design().settings();
        longer.evolution.generations = 4;
        session->design().changeSettings(longer, "Generations");
        QCOMPARE(session->runs().progress().generations, 4);
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->runs().summaries().size(), std::size_t{4});
        session.reset();
        session = fixture_->open("a.trap");
        QCOMPARE(session->design().settings().evolution.generations, 4);
    }

    void winnersAreChecked() {
        study::Settings settings = smallSettings(3);
        settings.simulation.engine = "hybrid";
        const auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy checked(&session->runs(), &StudyRuns::checkSaved);
        QVERIFY(learnToTheEnd(*session));
        int simulated = 0;
        for (const study::Individual& winner : session->runs().winners())
            simulated += winner.record.trials > 0 ? 1 : 0;
        QCOMPARE(checked.count(), simulated);
        QCOMPARE(session->runs().checks().size(), static_cast<std::size_t>(simulated));
        for (const study::CheckRecord& check : session->runs().checks()) {
            QCOMPARE(check.learning.engine, std::string("native"));
            QCOMPARE(check.reference.engine, std::string("simbody"));
            // The same law under two names.
            QVERIFY(check.learning.fitness == check.reference.fitness);
        }
    }

    void unknownEngineIsAMessage() {
        study::Settings settings = smallSettings();
        settings.simulation.engine = "bullet";
        const auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startLearning();
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY(failed[0][1].toString().contains("bullet"));
        QCOMPARE(session->runs().state(), RunState::idle);
    }

    void selectionAndValidationAreSaved() {
        const study::Settings settings = smallSettings(3);
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startSelection();
        QTRY_COMPARE(failed.count(), 1);  // nothing was learned yet
        QVERIFY(learnToTheEnd(*session));
        QSignalSpy selected(&session->runs(), &StudyRuns::selectionSaved);
        session->runs().startSelection();
        QCOMPARE(session->runs().state(), RunState::selecting);
        QVERIFY(waitUntil([&] { return selected.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));

        study::StudyInputs inputs{session->design().settings(), session->design().part(),
                                  std::make_shared<fake::FakeEngine>(fake::waveLaw), 1};
        const auto truth = study::selectWinners(inputs, session->runs().winners(), {});
        VERIFY_OK(truth);
        const study::SelectionRecord& selection = session->runs().selections().front();
        QCOMPARE(selection.entries.size(), std::size_t{2});
        QCOMPARE(selection.entries[0].finished, truth->entries[0].finished);
        QCOMPARE(selection.entries[0].generation, truth->entries[0].generation);

        QSignalSpy validated(&session->runs(), &StudyRuns::validationSaved);
        const study::Individual winner = session->runs().winners().back();
        session->runs().startValidation(winner);
        QCOMPARE(session->runs().state(), RunState::validating);
        QVERIFY(waitUntil([&] { return validated.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));
        const auto table = study::validate(inputs, winner, std::nullopt, {});
        VERIFY_OK(table);
        const study::ValidationRecord& validation = session->runs().validations().front();
        QCOMPARE(validation.rows.size(), session->design().part()->stablePoses.size());
        for (std::size_t row = 0; row < validation.rows.size(); ++row)
            QCOMPARE(validation.rows[row].tally.failures(), table->rows[row].tally.failures());
        session.reset();
        session = fixture_->open("a.trap");
        QCOMPARE(session->runs().selections().size(), std::size_t{1});
        QCOMPARE(session->runs().validations().size(), std::size_t{1});
    }

    void validationIsPausedAndStopped() {
        auto session = fixture_->create("a.trap", smallSettings(1));
        QVERIFY(session && learnToTheEnd(*session));
        session.reset();
        fixture_->trialTime = std::chrono::milliseconds(10);
        session = fixture_->open("a.trap");
        session->runs().setThreads(1);
        session->runs().startValidation(session->runs().winners().front());
        QVERIFY(waitUntil([&] { return session->runs().progress().trialsDone > 2; }));
        QCOMPARE(session->runs().progress().trials,
                 static_cast<std::int64_t>(10 * session->design().part()->stablePoses.size()));
        session->runs().pause();
        QTest::qWait(30);
        const std::int64_t done = session->runs().progress().trialsDone;
        QTest::qWait(100);
        QCOMPARE(session->runs().progress().trialsDone, done);
        session->runs().resume();
        QCOMPARE(session->runs().state(), RunState::validating);
        session->runs().stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QVERIFY(session->runs().validations().empty());
    }

    void robustnessIsMeasuredAndKept() {
        auto session = fixture_->create("a.trap", smallSettings(1));
        QVERIFY(session && learnToTheEnd(*session));
        const study::Individual winner = session->runs().winners().front();
        QVERIFY(session->runs().findRobustness(winner) == nullptr);
        QSignalSpy measured(&session->runs(), &StudyRuns::robustnessMeasured);
        const study::RobustnessPlan plan{10, 20, 3, 2};
        session->runs().startRobustness({winner}, plan);
        QCOMPARE(session->runs().state(), RunState::measuring);
        QVERIFY(waitUntil([&] { return measured.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));
        const study::RobustnessRecord* known = session->runs().findRobustness(winner);
        QVERIFY(known != nullptr);
        QCOMPARE(known->robustness.nominal.tally.trials(), 10);
        QCOMPARE(known->robustness.overBox.tally.trials(), 20);
        QVERIFY(!known->robustness.corners.empty());
        // Once more takes its place; what is stopped does not.
        session->runs().startRobustness({winner}, {12, 20, 3, 2});
        QVERIFY(waitUntil([&] { return measured.count() == 2; }));
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->runs().findRobustness(winner)->robustness.nominal.tally.trials(), 12);
        fixture_->trialTime = std::chrono::milliseconds(10);
        session.reset();
        session = fixture_->open("a.trap");
        const auto kept = [&] {
            const study::RobustnessRecord* record = session->runs().findRobustness(winner);
            return record == nullptr ? -1 : record->robustness.nominal.tally.trials();
        };
        QCOMPARE(kept(), 12);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startRobustness({winner});
        session->runs().stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(kept(), 12);
        QCOMPARE(failed.count(), 0);
    }

    void streamsAreMeasuredAndKept() {
        study::Settings settings = smallSettings(1);
        settings.stream.streams = 3;
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session && learnToTheEnd(*session));
        const study::Individual winner = session->runs().winners().front();
        QVERIFY(session->runs().findStreams(winner) == nullptr);
        QSignalSpy measured(&session->runs(), &StudyRuns::streamsMeasured);
        session->runs().startStreams(winner, {60.0, 30.0});
        QCOMPARE(session->runs().state(), RunState::streaming);
        QVERIFY(waitUntil([&] { return measured.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));
        const study::StreamsRecord* known = session->runs().findStreams(winner);
        QVERIFY(known != nullptr);
        QCOMPARE(known->streams.results.size(), std::size_t{2});
        QCOMPARE(known->streams.results.front().streams.size(), std::size_t{3});
        // Once more takes its place, and is there when the study is opened again.
        session->runs().startStreams(winner, {20.0});
        QVERIFY(waitUntil([&] { return measured.count() == 2; }));
        QVERIFY(waitForState(*session, RunState::idle));
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session->runs().findStreams(winner) != nullptr);
        QCOMPARE(session->runs().findStreams(winner)->streams.results.front().partsPerMinute, 20.0);
        // What cannot be is told.
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startStreams(winner, {90000.0});
        QVERIFY(waitUntil([&] { return failed.count() == 1; }));
        QVERIFY(failed.front().at(1).toString().contains("0.1 to 10000"));
        QVERIFY(waitForState(*session, RunState::idle));
    }

    void allThatWereComparedAreMeasured() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session && learnToTheEnd(*session));
        session::StudyRuns& runs = session->runs();
        QVERIFY(runs.listUnmeasured().empty());  // nothing was compared
        runs.startSelection();
        QVERIFY(waitForState(*session, RunState::idle));
        const std::vector<study::SelectionEntry> entries = runs.selections().back().entries;
        QVERIFY(entries.size() > 1);
        QCOMPARE(runs.listUnmeasured().size(), entries.size());
        std::vector<study::Individual> tracks;
        for (const study::IndividualId& id : runs.listUnmeasured())
            tracks.push_back(runs.loadIndividual(id).value());
        QSignalSpy measured(&runs, &StudyRuns::robustnessMeasured);
        runs.startRobustness(tracks, {10, 20, 3, 2});
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(static_cast<std::size_t>(measured.count()), entries.size());
        QCOMPARE(measured.front().front().toInt(), static_cast<int>(entries.size()));
        for (const study::SelectionEntry& entry : entries)
            QVERIFY(runs.findRobustness(entry) != nullptr);
        QVERIFY(runs.listUnmeasured().empty());
        // Stopped in the middle: the first stays.
        fixture_->trialTime = std::chrono::milliseconds(2);
        session.reset();
        session = fixture_->open("a.trap");
        session::StudyRuns& reopened = session->runs();
        QVERIFY(reopened.listUnmeasured().empty());
        QObject::connect(&reopened, &StudyRuns::robustnessMeasured, &reopened, &StudyRuns::stopNow);
        reopened.startRobustness(tracks, {11, 20, 3, 2});
        QVERIFY(waitForState(*session, RunState::idle));
        const auto trialsOf = [&](const study::Individual& track) {
            return reopened.findRobustness(track)->robustness.nominal.tally.trials();
        };
        QCOMPARE(trialsOf(tracks.front()), 11);
        QCOMPARE(trialsOf(tracks.back()), 10);
    }

    void mendedTracksAreAGenerationAndChosen() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session && learnToTheEnd(*session));
        session::StudyRuns& runs = session->runs();
        std::vector<study::GenerationRecord> generations;
        for (const study::GenerationSummary& summary : runs.summaries())
            generations.push_back(runs.loadGeneration(summary.index).value());
        const auto [track, limits] =
            fake::findFlawedTrack(session->design().settings().track, generations).value();
        study::MendingPlan plan;
        plan.variants = 6;
        plan.trials = 8;
        plan.compared = 2;
        plan.limits = limits;
        QSignalSpy saved(&runs, &StudyRuns::generationSaved);
        QSignalSpy selected(&runs, &StudyRuns::selectionSaved);
        QSignalSpy mended(&runs, &StudyRuns::mended);
        runs.startMending(track, plan);
        QCOMPARE(runs.state(), RunState::mending);
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(saved.count(), 1);
        QCOMPARE(selected.count(), 1);
        QCOMPARE(mended.count(), 1);
        QCOMPARE(runs.summaries().size(), std::size_t{4});
        QVERIFY(runs.mendedFrom(3) == study::IndividualId(track));
        QVERIFY(!runs.mendedFrom(2) && !runs.mendedFrom(4) && !runs.mendedFrom(-1));
        QCOMPARE(runs.chosen()->generation, 3);
        const study::Individual chosen = *runs.chosen();
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session->runs().mendedFrom(3) == study::IndividualId(track));
        QVERIFY(isSameIndividual(*session->runs().chosen(), chosen));
        // What is stopped leaves nothing.
        session.reset();
        fixture_->trialTime = std::chrono::milliseconds(10);
        session = fixture_->open("a.trap");
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startMending(track, plan);
        session->runs().stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(failed.count(), 0);
        QCOMPARE(session->runs().summaries().size(), std::size_t{4});
    }

    void oneRunAtATime() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->runs().startLearning();
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->runs().startLearning();
        session->runs().startSelection();
        QCOMPARE(failed.count(), 2);
        QVERIFY(!session->saveAs(fixture_->path("b.trap")).ok());
        session->runs().pause();
        session->runs().pause();
        session->runs().resume();
        session->runs().resume();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->runs().summaries().size(), std::size_t{3});
    }

    void deletingEndsTheWork_data() {
        QTest::addColumn<bool>("paused");
        QTest::newRow("while it learns") << false;
        QTest::newRow("while it is paused") << true;
    }

    void deletingEndsTheWork() {
        QFETCH(bool, paused);
        fixture_->trialTime = std::chrono::milliseconds(2);
        study::Settings settings = smallSettings(1000);
        settings.simulation.engine = "hybrid";
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        session->runs().startLearning();
        QVERIFY(waitUntil([&] {
            return session->runs().summaries().size() >= 2 && session->runs().progress().trialsDone > 0;
        }));
        if (paused) session->runs().pause();
        QElapsedTimer clock;
        clock.start();
        session.reset();
        QVERIFY2(clock.elapsed() < 1000, qPrintable(QString::number(clock.elapsed())));
        // It can be opened at once, and nothing is left beside it.
        QVERIFY(!std::filesystem::exists(fixture_->path("a.trap-wal")));
        session = fixture_->open("a.trap");
        QVERIFY(session && session->runs().summaries().size() >= 2);
        QVERIFY(takeInterruptedStudies(fixture_->path("state")).empty());
    }

 private:
    std::unique_ptr<SessionFixture> fixture_;
};

QTEST_GUILESS_MAIN(StudyRunsTest)
#include "study_runs_test.moc"
