#include <QElapsedTimer>
#include <QtTest>

#include "core/study/runner.h"
#include "core/study/selection.h"
#include "core/study/validation.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/recovery_note.h"

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
        QSignalSpy saved(session.get(), &StudySession::generationSaved);
        QSignalSpy states(session.get(), &StudySession::stateChanged);
        QVERIFY(learnToTheEnd(*session));
        QCOMPARE(saved.count(), 4);
        QCOMPARE(states.count(), 2);
        const std::vector<study::GenerationRecord> truth = learnAtOnce(smallSettings(4));
        QCOMPARE(truth.size(), std::size_t{4});
        for (int i = 0; i < 4; ++i) {
            const auto at = static_cast<std::size_t>(i);
            QCOMPARE(saved[i][0].toInt(), i);
            const auto record = session->loadGeneration(i);
            VERIFY_OK(record);
            QCOMPARE(record->individuals, truth[at].individuals);
            QCOMPARE(session->summaries()[at].statistics, truth[at].statistics);
            QCOMPARE(session->winners()[at].individual, truth[at].winner);
            const auto winner = session->loadWinner(i, truth[at].winner);
            VERIFY_OK(winner);
            QCOMPARE(winner->record, session->winners()[at].record);
        }
        QVERIFY(session->checks().empty());
        QVERIFY(!session->loadGeneration(4).ok());
    }

    void pauseStandsStillAndChangesNothing() {
        fixture_->trialTime = std::chrono::milliseconds(3);
        const auto session = fixture_->create("a.trap", smallSettings(3));
        QVERIFY(session);
        session->setThreads(1);
        session->startLearning();
        QVERIFY(waitUntil([&] { return session->progress().trialsDone > 3; }));
        session->pause();
        QCOMPARE(session->state(), RunState::paused);
        QTest::qWait(50);
        const RunProgress still = session->progress();
        QTest::qWait(150);
        QCOMPARE(session->progress().trialsDone, still.trialsDone);
        QCOMPARE(session->progress().trialsPerSecond, still.trialsPerSecond);
        QVERIFY(session->locked());
        session->resume();
        QCOMPARE(session->state(), RunState::learning);
        QVERIFY(waitForState(*session, RunState::idle));
        const std::vector<study::GenerationRecord> truth = learnAtOnce(smallSettings(3));
        for (int i = 0; i < 3; ++i)
            QCOMPARE(session->loadGeneration(i).value().individuals,
                     truth[static_cast<std::size_t>(i)].individuals);
    }

    void progressTellsWhereItIs() {
        // Long enough to be told of more than once.
        fixture_->trialTime = std::chrono::milliseconds(12);
        const auto session = fixture_->create("a.trap", smallSettings(3));
        QVERIFY(session);
        session->setThreads(1);
        std::vector<RunProgress> told;
        connect(session.get(), &StudySession::progressed, this,
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
        QCOMPARE(session->progress().trials, 0);
    }

    void stopsAfterTheGeneration() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings(50));
        QVERIFY(session);
        session->setThreads(1);
        connect(session.get(), &StudySession::generationSaved, this, [&](int generation) {
            if (generation == 0) session->stopAfterGeneration();
        });
        session->startLearning();
        QVERIFY(waitForState(*session, RunState::stoppingAfterGeneration));
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->summaries().size(), std::size_t{2});
    }

    void stopsAfterTheGenerationFromAPause() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings(50));
        QVERIFY(session);
        session->startLearning();
        QVERIFY(waitUntil([&] { return session->progress().trialsDone > 2; }));
        session->pause();
        QTest::qWait(100);
        const std::size_t before = session->summaries().size();
        session->stopAfterGeneration();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->summaries().size(), before + 1);
    }

    void stopsAtOnceAndGoesOnAfterReopening() {
        const study::Settings settings = smallSettings(6);
        fixture_->trialTime = std::chrono::milliseconds(5);
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->startLearning();
        QVERIFY(waitUntil(
            [&] { return session->summaries().size() >= 2 && session->progress().trialsDone > 2; }));
        session->stopNow();
        QCOMPARE(session->state(), RunState::stopping);
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(failed.count(), 0);
        const std::size_t kept = session->summaries().size();
        QVERIFY(kept < 6);
        session.reset();
        QVERIFY(!std::filesystem::exists(fixture_->path("a.trap-wal")));

        fixture_->trialTime = {};
        session = fixture_->open("a.trap");
        QVERIFY(session);
        QCOMPARE(session->summaries().size(), kept);
        QCOMPARE(session->winners().size(), kept);
        QVERIFY(session->locked());
        QVERIFY(learnToTheEnd(*session));
        const std::vector<study::GenerationRecord> truth = learnAtOnce(settings);
        QCOMPARE(session->summaries().size(), truth.size());
        for (std::size_t i = 0; i < truth.size(); ++i)
            QCOMPARE(session->loadGeneration(static_cast<int>(i)).value().individuals, truth[i].individuals);
    }

    void stopBeforeTheFirstGenerationLeavesItFree() {
        fixture_->trialTime = std::chrono::milliseconds(5);
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->startLearning();
        QVERIFY(session->locked());
        session->stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QVERIFY(session->summaries().empty() && !session->locked());
    }

    void moreGenerationsHoldForTheRunThatGoesOn() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        auto session = fixture_->create("a.trap", smallSettings(2));
        QVERIFY(session);
        session->startLearning();
        QVERIFY(waitUntil([&] { return session->progress().trialsDone > 0; }));
        study::Settings longer = session->settings();
        longer.evolution.generations = 4;
        session->changeSettings(longer, "Generations");
        QCOMPARE(session->progress().generations, 4);
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->summaries().size(), std::size_t{4});
        session.reset();
        session = fixture_->open("a.trap");
        QCOMPARE(session->settings().evolution.generations, 4);
    }

    void winnersAreChecked() {
        study::Settings settings = smallSettings(3);
        settings.simulation.engine = "hybrid";
        const auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy checked(session.get(), &StudySession::checkSaved);
        QVERIFY(learnToTheEnd(*session));
        int simulated = 0;
        for (const study::Individual& winner : session->winners())
            simulated += winner.record.trials > 0 ? 1 : 0;
        QCOMPARE(checked.count(), simulated);
        QCOMPARE(session->checks().size(), static_cast<std::size_t>(simulated));
        for (const study::CheckRecord& check : session->checks()) {
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
        session->startLearning();
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY(failed[0][1].toString().contains("bullet"));
        QCOMPARE(session->state(), RunState::idle);
    }

    void selectionAndValidationAreSaved() {
        const study::Settings settings = smallSettings(3);
        auto session = fixture_->create("a.trap", settings);
        QVERIFY(session);
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->startSelection();
        QTRY_COMPARE(failed.count(), 1);  // nothing was learned yet
        QVERIFY(learnToTheEnd(*session));
        QSignalSpy selected(session.get(), &StudySession::selectionSaved);
        session->startSelection();
        QCOMPARE(session->state(), RunState::selecting);
        QVERIFY(waitUntil([&] { return selected.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));

        study::StudyInputs inputs{session->settings(), session->part(),
                                  std::make_shared<fake::FakeEngine>(fake::waveLaw), 1};
        const auto truth = study::selectWinners(inputs, session->winners(), {});
        VERIFY_OK(truth);
        const study::SelectionRecord& selection = session->selections().front();
        QCOMPARE(selection.entries.size(), std::size_t{2});
        QCOMPARE(selection.entries[0].finished, truth->entries[0].finished);
        QCOMPARE(selection.entries[0].generation, truth->entries[0].generation);

        QSignalSpy validated(session.get(), &StudySession::validationSaved);
        const study::Individual winner = session->winners().back();
        session->startValidation(winner);
        QCOMPARE(session->state(), RunState::validating);
        QVERIFY(waitUntil([&] { return validated.count() == 1; }));
        QVERIFY(waitForState(*session, RunState::idle));
        const auto table = study::validate(inputs, winner, std::nullopt, {});
        VERIFY_OK(table);
        const study::ValidationRecord& validation = session->validations().front();
        QCOMPARE(validation.rows.size(), session->part()->stablePoses.size());
        for (std::size_t row = 0; row < validation.rows.size(); ++row)
            QCOMPARE(validation.rows[row].tally.failures(), table->rows[row].tally.failures());
        session.reset();
        session = fixture_->open("a.trap");
        QCOMPARE(session->selections().size(), std::size_t{1});
        QCOMPARE(session->validations().size(), std::size_t{1});
    }

    void validationIsPausedAndStopped() {
        auto session = fixture_->create("a.trap", smallSettings(1));
        QVERIFY(session && learnToTheEnd(*session));
        session.reset();
        fixture_->trialTime = std::chrono::milliseconds(10);
        session = fixture_->open("a.trap");
        session->setThreads(1);
        session->startValidation(session->winners().front());
        QVERIFY(waitUntil([&] { return session->progress().trialsDone > 2; }));
        QCOMPARE(session->progress().trials,
                 static_cast<std::int64_t>(10 * session->part()->stablePoses.size()));
        session->pause();
        QTest::qWait(30);
        const std::int64_t done = session->progress().trialsDone;
        QTest::qWait(100);
        QCOMPARE(session->progress().trialsDone, done);
        session->resume();
        QCOMPARE(session->state(), RunState::validating);
        session->stopNow();
        QVERIFY(waitForState(*session, RunState::idle));
        QVERIFY(session->validations().empty());
    }

    void oneRunAtATime() {
        fixture_->trialTime = std::chrono::milliseconds(2);
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->startLearning();
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->startLearning();
        session->startSelection();
        QCOMPARE(failed.count(), 2);
        QVERIFY(!session->saveAs(fixture_->path("b.trap")).ok());
        session->pause();
        session->pause();
        session->resume();
        session->resume();
        QVERIFY(waitForState(*session, RunState::idle));
        QCOMPARE(session->summaries().size(), std::size_t{3});
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
        session->startLearning();
        QVERIFY(waitUntil(
            [&] { return session->summaries().size() >= 2 && session->progress().trialsDone > 0; }));
        if (paused) session->pause();
        QElapsedTimer clock;
        clock.start();
        session.reset();
        QVERIFY2(clock.elapsed() < 1000, qPrintable(QString::number(clock.elapsed())));
        // It can be opened at once, and nothing is left beside it.
        QVERIFY(!std::filesystem::exists(fixture_->path("a.trap-wal")));
        session = fixture_->open("a.trap");
        QVERIFY(session && session->summaries().size() >= 2);
        QVERIFY(takeInterruptedStudies(fixture_->path("state")).empty());
    }

 private:
    std::unique_ptr<SessionFixture> fixture_;
};

QTEST_GUILESS_MAIN(StudyRunsTest)
#include "study_runs_test.moc"
