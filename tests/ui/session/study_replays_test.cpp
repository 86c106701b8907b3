#include <QtTest>

#include "core/study/field_text.h"
#include "core/study/validation.h"
#include "sim/native/native_engine.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/study_design.h"
#include "ui/session/study_replays.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::session;

namespace {

Environment nativeEnvironment(const SessionFixture& fixture) {
    Environment environment = fixture.environment();
    environment.engines = fake::enginesMadeBy([](const std::string&, const trial::EngineOptions& options) {
        return std::make_unique<native::NativeEngine>(options);
    });
    return environment;
}

}  // namespace

/// Trials of a study made again, simulated in earnest.
class StudyReplaysTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        fixture_ = std::make_unique<SessionFixture>();
        auto made = StudySession::create(fixture_->path("a.trap"), smallSettings(2), cuboid(),
                                         nativeEnvironment(*fixture_));
        VERIFY_OK(made);
        session_ = std::move(made).value();
        QVERIFY(learnToTheEnd(*session_));
        session_->runs().startValidation(session_->runs().winners().back());
        QVERIFY(waitForState(*session_, RunState::idle));
        QCOMPARE(session_->runs().validations().size(), std::size_t{1});
    }

    void cleanupTestCase() { session_.reset(); }

    void learningTrialsEndAsTheyDid() {
        const study::Individual& winner = session_->runs().winners().back();
        const std::vector<ListedTrials> told = simulate({workflow::TrialKind::learning, winner});
        QCOMPARE(told.size(), std::size_t{1});
        QCOMPARE(static_cast<int>(told[0].outcomes.size()), winner.record.trials);
        int finished = 0;
        for (const trial::Outcome& outcome : told[0].outcomes)
            finished += outcome.parts[0].ending == trial::Ending::finished ? 1 : 0;
        QCOMPARE(finished, winner.record.finished);
        // The first ones, and more than there were.
        for (const int count : {2, 7}) {
            const std::vector<ListedTrials> others =
                simulate({workflow::TrialKind::learning, winner, {0}, count});
            QCOMPARE(static_cast<int>(others[0].outcomes.size()), count);
            QVERIFY(trial::endAlike(others[0].outcomes[1].parts[0], told[0].outcomes[1].parts[0]));
            QCOMPARE(others[0].stored, count == 2);
        }
    }

    void validationTrialsAreThoseOfTheTable() {
        const study::ValidationRecord& table = session_->runs().validations().front();
        for (const study::ValidationRow& row : table.rows) {
            workflow::TrialsRequest request{
                workflow::TrialKind::validation, session_->runs().winners().back(), {row.pose}};
            const std::vector<ListedTrials> told = simulate(request);
            QCOMPARE(told[0].outcomes.size(), std::size_t{10});
            const auto& verdicts = told[0].judged.verdicts;
            QCOMPARE(std::count(verdicts.begin(), verdicts.end(), trial::Verdict::stuck), row.tally.stuck);
            QCOMPARE(std::count(verdicts.begin(), verdicts.end(), trial::Verdict::fellOff),
                     row.tally.fellOff);
            QCOMPARE(std::count(verdicts.begin(), verdicts.end(), trial::Verdict::wrongOrientation),
                     row.tally.wrongOrientation);
            // Fewer are the first of them, whichever the pose is.
            request.count = 3;
            const std::vector<ListedTrials> fewer = simulate(request);
            QCOMPARE(fewer[0].outcomes.size(), std::size_t{3});
            for (std::size_t i = 0; i < 3; ++i)
                QVERIFY(trial::endAlike(fewer[0].outcomes[i].parts[0], told[0].outcomes[i].parts[0]));
        }
    }

    // Poses that look the same are listed together: one pose after the other.
    void trialsOfAlikePosesFollowEachOther() {
        const study::Individual& winner = session_->runs().winners().back();
        const auto of = [&](std::vector<int> poses) {
            return simulate({workflow::TrialKind::validation, winner, std::move(poses)})[0].outcomes;
        };
        const std::vector<trial::Outcome> first = of({0});
        const std::vector<trial::Outcome> second = of({1});
        const std::vector<ListedTrials> both = simulate({workflow::TrialKind::validation, winner, {0, 1}});
        QCOMPARE(both.back().outcomes.size(), std::size_t{20});
        for (std::size_t i = 0; i < 10; ++i) {
            QVERIFY(trial::endAlike(both.back().outcomes[i].parts[0], first[i].parts[0]));
            QVERIFY(trial::endAlike(both.back().outcomes[10 + i].parts[0], second[i].parts[0]));
        }
    }

    void replayEndsLikeTheTrial() {
        const workflow::TrialsRequest request{workflow::TrialKind::learning,
                                              session_->runs().winners().back()};
        const std::vector<ListedTrials> told = simulate(request);
        std::shared_ptr<const trial::Trajectory> trajectory;
        const auto connection = connect(&session_->replays(), &StudyReplays::replayed, this,
                                        [&](const workflow::TrialsRequest&, int trial,
                                            const std::shared_ptr<const trial::Trajectory>& replayed,
                                            const std::optional<workflow::OutcomeDifference>& difference) {
                                            QCOMPARE(trial, 3);
                                            QVERIFY(!difference);
                                            trajectory = replayed;
                                        });
        session_->replays().replay(request, 3, 0.01);
        QCOMPARE(session_->runs().state(), RunState::simulating);
        QTRY_VERIFY(trajectory);
        disconnect(connection);
        QVERIFY(trial::endAlike(trajectory->outcome.parts[0], told[0].outcomes[3].parts[0]));
        QVERIFY(trajectory->samples.size() >=
                static_cast<std::size_t>(trajectory->outcome.parts[0].time / 0.01));
        QVERIFY(waitForState(*session_, RunState::idle));
    }

    void whatThereIsNotIsAMessage() {
        QSignalSpy failed(session_.get(), &StudySession::failed);
        session_->replays().requestTrials(
            {workflow::TrialKind::selection, session_->runs().winners().back()});
        QTRY_COMPARE(failed.count(), 1);
        session_->replays().replay({workflow::TrialKind::learning, session_->runs().winners().back()}, 4,
                                   0.01);
        QTRY_COMPARE(failed.count(), 2);
        study::Individual broken = session_->runs().winners().back();
        broken.record.design.pop_back();
        session_->replays().requestTrials({workflow::TrialKind::learning, broken});
        QTRY_COMPARE(failed.count(), 3);
        QVERIFY(failed[2][1].toString().contains("numbers"));
    }

    void cancelledSimulationsAreNotHeardOf() {
        QSignalSpy told(&session_->replays(), &StudyReplays::trialsListed);
        QSignalSpy failed(session_.get(), &StudySession::failed);
        for (int i = 0; i < 5; ++i)
            session_->replays().requestTrials(
                {workflow::TrialKind::learning, session_->runs().winners().back(), {0}, 500});
        session_->replays().cancelSimulations();
        QVERIFY(waitForState(*session_, RunState::idle));
        QCOMPARE(told.count() + failed.count(), 0);
        QCOMPARE(simulate({workflow::TrialKind::learning, session_->runs().winners().back()}).size(),
                 std::size_t{1});
    }

    void estimateIsOfTheOrderOfTheRun() {
        study::Settings settings = smallSettings(4);
        settings.evolution.populationSize = 16;
        settings.evolution.trialsPerEvaluation = 10;
        auto made =
            StudySession::create(fixture_->path("b.trap"), settings, cuboid(), nativeEnvironment(*fixture_));
        VERIFY_OK(made);
        StudySession& session = **made;
        QSignalSpy estimated(&session.runs(), &StudyRuns::estimated);
        QCOMPARE(session.runs().estimatedSeconds(), 0.0);
        session.runs().requestEstimate();
        QTRY_COMPARE_WITH_TIMEOUT(estimated.count(), 1, 10000);
        const double expected = session.runs().estimatedSeconds();
        QElapsedTimer clock;
        clock.start();
        QVERIFY(learnToTheEnd(session));
        const double took = 1e-3 * static_cast<double>(clock.elapsed());
        qInfo("estimated %.2f s, took %.2f s", expected, took);
        QVERIFY(expected > 0.0);
        // Other work on the machine must not fail this.
        QVERIFY(took < 20.0 * expected && expected < 20.0 * took);
        settings = session.design().settings();
        settings.evolution.generations = 8;
        session.design().changeSettings(settings, "Generations");
        // What a trial costs is known by then.
        QCOMPARE(session.runs().estimatedSeconds(), expected);
    }

    // The cost of a trial belongs to the settings that it depends on, and to no others.
    void estimateFollowsTheSettings_data() {
        QTest::addColumn<QString>("key");
        QTest::addColumn<QString>("value");
        QTest::addColumn<double>("factor");  // 0: it has to be timed again
        QTest::newRow("twice the population") << "evolution.populationSize"
                                              << "32" << 2.0;
        QTest::newRow("half the trials") << "evolution.trialsPerEvaluation"
                                         << "5" << 0.5;
        QTest::newRow("three times the generations") << "evolution.generations"
                                                     << "12" << 3.0;
        QTest::newRow("more trials to validate") << "validation.trialsPerPose"
                                                 << "5000" << 1.0;
        QTest::newRow("another drive") << "simulation.drive.halfStroke_mm"
                                       << "0.7" << 0.0;
        QTest::newRow("more sections") << "track.crossSections"
                                       << "6" << 0.0;
    }
    void estimateFollowsTheSettings() {
        QFETCH(QString, key);
        QFETCH(QString, value);
        QFETCH(double, factor);
        study::Settings settings = smallSettings(4);
        settings.evolution.populationSize = 16;
        settings.evolution.trialsPerEvaluation = 10;
        const std::string name = key.toStdString() + ".trap";
        auto made =
            StudySession::create(fixture_->path(name), settings, cuboid(), nativeEnvironment(*fixture_));
        VERIFY_OK(made);
        StudySession& session = **made;
        session.runs().requestEstimate();
        QTRY_VERIFY_WITH_TIMEOUT(session.runs().estimatedSeconds() > 0.0, 20000);
        const double before = session.runs().estimatedSeconds();
        study::Settings next = session.design().settings();
        VERIFY_OK(study::setField(next, key.toStdString(), value.toStdString()));
        session.design().changeSettings(next, "Change");
        QCOMPARE(session.runs().estimatedSeconds(), factor * before);
        QCOMPARE(session.runs().draft().has_value(), factor > 0.0);
        if (factor > 0.0) QVERIFY(session.runs().draft()->seconds < 600.0);
    }

 private:
    std::vector<ListedTrials> simulate(const workflow::TrialsRequest& request) {
        std::vector<ListedTrials> told;
        const auto connection = connect(&session_->replays(), &StudyReplays::trialsListed, this,
                                        [&](const ListedTrials& trials) { told.push_back(trials); });
        session_->replays().requestTrials(request);
        [&] { QTRY_VERIFY_WITH_TIMEOUT(!told.empty(), 20000); }();
        disconnect(connection);
        return told;
    }

    std::unique_ptr<SessionFixture> fixture_;
    std::unique_ptr<StudySession> session_;
};

QTEST_GUILESS_MAIN(StudyReplaysTest)
#include "study_replays_test.moc"
