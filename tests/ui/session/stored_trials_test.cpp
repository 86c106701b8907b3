#include <QtTest>
#include <atomic>

#include "core/store/study_file.h"
#include "sim/native/kernel.h"
#include "sim/native/native_engine.h"
#include "tests/core/store/stored_outcomes.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/study_design.h"
#include "ui/session/study_replays.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::session;
using workflow::TrialKind;

namespace {

/// The native engine, which counts what it is asked for.
class CountingEngine : public native::NativeEngine {
 public:
    CountingEngine(const trial::EngineOptions& options, std::atomic<int>& runs)
        : NativeEngine(options), runs_(&runs) {}

    [[nodiscard]] base::Result<std::vector<std::vector<trial::Outcome>>> run(
        std::span<const trial::TrialBatch> batches, base::RunControl control) const override {
        ++*runs_;
        return NativeEngine::run(batches, std::move(control));
    }

 private:
    std::atomic<int>* runs_;
};

}  // namespace

/// Trials as a study holds them, and replays that end otherwise.
class StoredTrialsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        fixture_ = std::make_unique<SessionFixture>();
        auto made =
            StudySession::create(fixture_->path("learned.trap"), smallSettings(2), cuboid(), environment());
        VERIFY_OK(made);
        QVERIFY(learnToTheEnd(**made));
        (*made)->runs().startSelection();
        QVERIFY(waitForState(**made, RunState::idle));
        (*made)->runs().startValidation((*made)->runs().winners().back());
        QVERIFY(waitForState(**made, RunState::idle));
    }

    void init() {
        study_ = fixture_->path(std::to_string(++studies_) + ".trap");
        std::filesystem::copy_file(fixture_->path("learned.trap"), study_);
    }

    void whatIsStoredNeedsNoEngine() {
        const auto session = open();
        const study::Individual& winner = session->runs().winners().back();
        runs_ = 0;
        for (const workflow::TrialsRequest& request :
             std::vector<workflow::TrialsRequest>{{TrialKind::learning, winner},
                                                  {TrialKind::selection, winner},
                                                  {TrialKind::validation, winner, {0}},
                                                  {TrialKind::validation, winner, {0, 1}}}) {
            const auto trials = list(*session, request);
            QVERIFY(trials);
            QVERIFY(trials->stored);
            QCOMPARE(static_cast<int>(trials->outcomes.size()), trials->wanted);
            QCOMPARE(trials->judged.verdicts.size(), trials->outcomes.size());
            QCOMPARE(trials->maker.program, kProgram);
            QCOMPARE(trials->maker.engine, std::string("native"));
            QCOMPARE(trials->maker.instructionSet, native::NativeEngine({}).instructionSet());
        }
        QCOMPARE(runs_.load(), 0);
        // The tallies of the table.
        const study::ValidationRow& row = session->runs().validations().front().rows.front();
        const auto trials = list(*session, {TrialKind::validation, winner, {row.pose}});
        const auto& verdicts = trials->judged.verdicts;
        QCOMPARE(std::count(verdicts.begin(), verdicts.end(), trial::Verdict::success), row.tally.success);
    }

    void replaysOfWhatIsStoredEndAlike() {
        const auto session = open();
        for (int trial = 0; trial < 4; ++trial) {
            const auto replayed = replay(*session, trial);
            QVERIFY(replayed);
            QVERIFY(!*replayed);
        }
    }

    void aReplayThatEndsOtherwiseIsTold() {
        const auto winner = static_cast<std::size_t>(open()->runs().winners().back().individual);
        const trial::OutcomeMaker other{"trapwright 0.0-other", "native", "AVX9"};
        sample::changeMaker(study_, other);
        sample::changeOutcomes(study_, 1, [&](std::size_t trial, trial::PartOutcome& outcome) {
            // Of the second trial of each individual its last bit.
            if (trial % 4 == 1)
                outcome.farthest.position.z() = std::nextafter(outcome.farthest.position.z(), 1.0);
            if (trial == 4 * winner + 2) outcome = {trial::Ending::timedOut, {}, {}, 9.5};
        });
        const auto session = open();
        const auto listed = list(*session, {TrialKind::learning, session->runs().winners().back()});
        QVERIFY(listed && listed->stored);
        QVERIFY(listed->maker == other);
        QCOMPARE(listed->outcomes[2].parts[0].time, 9.5);
        for (const int trial : {0, 1, 2, 3}) {
            const auto replayed = replay(*session, trial);
            QVERIFY(replayed);
            QCOMPARE(replayed->has_value(), trial == 1 || trial == 2);
            if (!*replayed) continue;
            const workflow::OutcomeDifference& difference = **replayed;
            QVERIFY(trial::endAlike(difference.stored,
                                    listed->outcomes[static_cast<std::size_t>(trial)].parts[0]));
            QVERIFY(!trial::endAlike(difference.stored, difference.replayed));
            QVERIFY(difference.storedBy == other);
            QCOMPARE(difference.replayedBy.program, kProgram);
            QCOMPARE(difference.replayedBy.instructionSet, native::NativeEngine({}).instructionSet());
            const std::string text = workflow::describe(difference);
            QVERIFY(text.find("AVX9") != std::string::npos && text.find(kProgram) != std::string::npos);
        }
    }

    /// As on a machine that has less.
    void anotherInstructionSetIsNamed() {
        const std::vector<std::string> sets = native::instructionSets();
        if (sets.size() < 2) QSKIP("This machine has one instruction set only.");
        QVERIFY(native::useInstructionSet(sets.back()));
        const auto session = open();
        int told = 0;
        for (int trial = 0; trial < 4; ++trial) {
            const auto replayed = replay(*session, trial);
            QVERIFY(replayed);
            if (!*replayed) continue;
            ++told;
            QCOMPARE((*replayed)->storedBy.instructionSet, sets.front());
            QCOMPARE((*replayed)->replayedBy.instructionSet, sets.back());
        }
        QVERIFY(native::useInstructionSet(""));
        qInfo("%d of 4 replays end otherwise with %s", told, sets.back().c_str());
        QVERIFY(told > 0);
    }

    void whatIsNotStoredIsSimulatedAgain() {
        const auto before = [&] {
            const auto session = open();
            return *list(*session, {TrialKind::learning, session->runs().winners().back()});
        }();
        sample::dropOutcomes(study_);
        const auto session = open();
        runs_ = 0;
        const auto again = list(*session, {TrialKind::learning, session->runs().winners().back()});
        QVERIFY(again);
        QVERIFY(!again->stored);
        QVERIFY(runs_.load() > 0);
        QCOMPARE(again->maker.program, kProgram);
        for (std::size_t i = 0; i < before.outcomes.size(); ++i)
            QVERIFY(trial::endAlike(again->outcomes[i].parts[0], before.outcomes[i].parts[0]));
        const auto replayed = replay(*session, 0);
        QVERIFY(replayed);
        QVERIFY(!*replayed);
    }

    void damageIsAMessage() {
        sample::alter(study_, "UPDATE outcomes SET trials = substr(trials, 1, 50)");
        const auto session = open();
        QSignalSpy failed(session.get(), &StudySession::failed);
        session->replays().requestTrials({TrialKind::learning, session->runs().winners().back()});
        QTRY_COMPARE(failed.count(), 1);
        QVERIFY(failed[0][1].toString().contains("is damaged"));
        QVERIFY(waitForState(*session, RunState::idle));
    }

    void learningOnStoresMore() {
        const auto session = open();
        study::Settings settings = session->design().settings();
        settings.evolution.generations = 3;
        session->design().changeSettings(settings, "Generations");
        QVERIFY(learnToTheEnd(*session));
        QVERIFY(session->runs().loadGeneration(2)->made.outcomes.empty());  // dropped from memory
        const auto trials = list(*session, {TrialKind::learning, session->runs().winners().back()});
        QVERIFY(trials && trials->stored);
    }

 private:
    [[nodiscard]] Environment environment() {
        Environment environment = fixture_->environment();
        environment.engines =
            fake::enginesMadeBy([this](const std::string&, const trial::EngineOptions& options) {
                return std::make_unique<CountingEngine>(options, runs_);
            });
        return environment;
    }

    [[nodiscard]] std::unique_ptr<StudySession> open() {
        return StudySession::open(study_, environment()).value();
    }

    static std::optional<ListedTrials> list(StudySession& session, const workflow::TrialsRequest& request) {
        std::optional<ListedTrials> listed;
        const QObject here;
        connect(&session.replays(), &StudyReplays::trialsListed, &here,
                [&](const ListedTrials& trials) { listed = trials; });
        session.replays().requestTrials(request);
        (void)waitUntil([&] { return listed.has_value(); });
        return listed;
    }

    /// None if there was no replay at all.
    static std::optional<std::optional<workflow::OutcomeDifference>> replay(StudySession& session,
                                                                            int trial) {
        std::optional<std::optional<workflow::OutcomeDifference>> told;
        const QObject here;
        connect(&session.replays(), &StudyReplays::replayed, &here,
                [&](const workflow::TrialsRequest&, int, const std::shared_ptr<const trial::Trajectory>&,
                    const std::optional<workflow::OutcomeDifference>& difference) { told = difference; });
        session.replays().replay({TrialKind::learning, session.runs().winners().back()}, trial, 0.01);
        (void)waitUntil([&] { return told.has_value(); });
        return told;
    }

    std::unique_ptr<SessionFixture> fixture_;
    std::filesystem::path study_;
    int studies_ = 0;
    std::atomic<int> runs_ = 0;
};

QTEST_GUILESS_MAIN(StoredTrialsTest)
#include "stored_trials_test.moc"
