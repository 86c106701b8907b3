#include "core/workflow/study_trials.h"

#include <QtTest>

#include "core/workflow/judging.h"
#include "core/workflow/learning.h"
#include "tests/core/workflow/workflow_fixture.h"

using namespace trapwright;
using workflow::TrialKind;

/// The trials behind a score or a table, made again.
class StudyTrialsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        study_ = std::make_unique<fake::WaveStudy>("hybrid", 2);
        study::Settings& settings = study_->inputs.settings;
        settings.validation.selectionTrials = 9;
        settings.validation.trialsPerPose = 5;
        QVERIFY(workflow::learn(*study_->file, study_->inputs, fake::lawEngines(), {}, {}).ok());
        winner_ = study_->file->loadWinners().value().back();
        QVERIFY(workflow::validateAndSave(*study_->file, study_->inputs, winner_, std::nullopt, {}).ok());
        QVERIFY(workflow::selectAndSave(*study_->file, study_->inputs, {winner_}, {}).ok());
    }

    void storedTrialsAreFound() {
        const auto learned = find({TrialKind::learning, winner_});
        QCOMPARE(learned.count, 6);
        QCOMPARE(learned.engine, std::string("native"));
        QVERIFY(!learned.goal);
        const auto selected = find({TrialKind::selection, winner_});
        QCOMPARE(selected.count, 9);
        QCOMPARE(selected.engine, std::string("fake"));
        const auto validated = find({TrialKind::validation, winner_, {2}});
        QCOMPARE(validated.count, 5);
        QVERIFY(validated.goal);
        study::Individual other = winner_;
        other.individual += 1;
        QCOMPARE(find({TrialKind::selection, other}).count, 0);
        QCOMPARE(find({TrialKind::validation, other, {2}}).count, 0);
        QCOMPARE(find({TrialKind::validation, winner_, {7}}).count, 0);
    }

    void trialsAreTheSameAgain() {
        // Counted from the table's own definition: trial i of pose p is trial 5 p + i of the stream.
        const auto all = make({TrialKind::validation, winner_, {2}});
        QCOMPARE(all.trials.size(), std::size_t{5});
        const auto few = make({TrialKind::validation, winner_, {2}, 3});
        QCOMPARE(few.trials.size(), std::size_t{3});
        for (std::size_t i = 0; i < 3; ++i) {
            QCOMPARE(few.trials[i].stream.trial, static_cast<std::uint32_t>(10 + i));
            QVERIFY(few.trials[i].parts[0].pose == all.trials[i].parts[0].pose);
        }
        QCOMPARE(make({TrialKind::validation, winner_, {2}, 50}).trials.size(), std::size_t{5});
        QCOMPARE(make({TrialKind::learning, winner_, {0}, 50}).trials.size(), std::size_t{50});
        QCOMPARE(make({TrialKind::selection, winner_}).trials.size(), std::size_t{9});
    }

    void whatIsStoredIsWhatTheEngineGave() {
        for (const workflow::TrialsRequest& request :
             std::vector<workflow::TrialsRequest>{{TrialKind::learning, winner_},
                                                  {TrialKind::selection, winner_},
                                                  {TrialKind::validation, winner_, {1}},
                                                  {TrialKind::validation, winner_, {2, 0}},
                                                  {TrialKind::learning, winner_, {0}, 2}}) {
            const trial::TrialBatch batch = make(request);
            const auto stored = unpack(request);
            QVERIFY(stored);
            QCOMPARE(stored->maker.program, std::string("test"));
            QCOMPARE(stored->maker.engine, std::string("fake"));
            QCOMPARE(stored->maker.instructionSet, study_->inputs.engine->instructionSet());
            const auto again = study::runTrials(*study_->inputs.engine, {&batch, 1}, {}).value().front();
            QCOMPARE(stored->outcomes.size(), again.size());
            for (std::size_t i = 0; i < again.size(); ++i) {
                QVERIFY(trial::endAlike(stored->outcomes[i].parts.at(0), again[i].parts.at(0)));
                QVERIFY(std::abs(stored->outcomes[i].parts[0].initial.position.x() - batch.track->start) <
                        1e-12);
            }
        }
    }

    void otherTrialsAreNotStored() {
        // More than there were, of another engine, of an individual that was not in it.
        QVERIFY(!unpack({TrialKind::learning, winner_, {0}, 7}));
        QVERIFY(!unpack({TrialKind::learning, winner_, {0}, 0, "simbody"}));
        study::Individual other = winner_;
        other.individual += 1;
        QVERIFY(!unpack({TrialKind::selection, other, {0}, 3}));
        QVERIFY(!unpack({TrialKind::validation, other, {2}, 3}));
    }

    void differencesAreToldInWords() {
        const trial::OutcomeMaker before{"trapwright 1.0.0", "native", "AVX3"};
        const trial::OutcomeMaker now{"trapwright 1.1.0", "native", "AVX2"};
        trial::PartOutcome stored;
        stored.ending = trial::Ending::finished;
        stored.time = 3.2;
        stored.farthest.position.x() = 0.56;
        trial::PartOutcome replayed = stored;
        QVERIFY(!workflow::findDifference({{stored}, {}}, before, {{replayed}, {}}, now));
        // Starts are no ends.
        replayed.initial.position.x() = 1e-3;
        QVERIFY(!workflow::findDifference({{stored}, {}}, before, {{replayed}, {}}, now));

        const auto text = [&](const trial::OutcomeMaker& maker) {
            const auto difference = workflow::findDifference({{stored}, {}}, before, {{replayed}, {}}, maker);
            return difference ? QString::fromStdString(workflow::describe(*difference)) : QString();
        };
        replayed.farthest.position.x() = std::nextafter(0.56, 1.0);
        QCOMPARE(text(now),
                 QString("Stored: finished after 3.200 s at 560.00 mm (trapwright 1.0.0, native with "
                         "AVX3).\nReplayed here: finished after 3.200 s at 560.00 mm, but for its "
                         "last digits (trapwright 1.1.0, native with AVX2).\nScores and tables "
                         "go by what is stored."));
        replayed.ending = trial::Ending::fellOff;
        replayed.time = 2.31;
        replayed.farthest.position.x() = 0.4123;
        replayed.farthest.rotation = Eigen::AngleAxisd(90.0 * base::kDegree, base::Vec3::UnitZ());
        QVERIFY2(
            text(now).contains("Replayed here: fell off after 2.310 s at 412.30 mm, turned by 90.0° from it"),
            qPrintable(text(now)));
        // The same program on the same machine: something is wrong.
        QVERIFY(!text(now).contains("The same should come of both"));
        QVERIFY(text(before).contains("The same should come of both"));
    }

    void aPoseThatThePartDoesNotHave() {
        for (const int pose : {-1, 3, 999}) {
            const auto made = workflow::makeTrials(study_->inputs.settings, study_->inputs.part,
                                                   {TrialKind::validation, winner_, {pose}}, {});
            QVERIFY(!made.ok());
            QVERIFY(
                QString::fromStdString(made.error().message)
                    .startsWith(
                        QString("The study has trials of stable pose %1, but its part has 3").arg(pose + 1)));
        }
    }

    void trialsAreCountedByTheirEnd() {
        const auto outcome = [](trial::Ending ending, double degrees) {
            trial::Outcome one;
            trial::PartOutcome& part = one.parts.emplace_back();
            part.ending = ending;
            part.farthest.rotation = Eigen::AngleAxisd(degrees * base::kDegree, base::Vec3::UnitZ());
            return one;
        };
        const std::vector<trial::Outcome> outcomes = {
            outcome(trial::Ending::finished, 3.0),   outcome(trial::Ending::finished, 90.0),
            outcome(trial::Ending::fellOff, 0.0),    outcome(trial::Ending::stuck, 0.0),
            outcome(trial::Ending::timedOut, 0.0),   outcome(trial::Ending::finished, 0.0),
            outcome(trial::Ending::finished, 179.0),
        };
        const auto judged =
            workflow::judgeTrials(outcomes, fake::block()->symmetry, std::nullopt, 25.0 * base::kDegree);
        // Half a turn about z maps the block onto itself.
        const std::vector<trial::Verdict> expected = {
            trial::Verdict::success, trial::Verdict::wrongOrientation,
            trial::Verdict::fellOff, trial::Verdict::stuck,
            trial::Verdict::stuck,   trial::Verdict::success,
            trial::Verdict::success};
        QVERIFY(judged.verdicts == expected);
        const base::Quaternion turned(Eigen::AngleAxisd(base::kPi / 2, base::Vec3::UnitZ()));
        const auto others = workflow::judgeTrials(outcomes, fake::block()->symmetry, trial::makeGoal(turned),
                                                  25.0 * base::kDegree);
        QCOMPARE(others.verdicts[0], trial::Verdict::wrongOrientation);
        QCOMPARE(others.verdicts[1], trial::Verdict::success);
    }

 private:
    workflow::StoredTrials find(const workflow::TrialsRequest& request) {
        const auto stored =
            workflow::findStoredTrials(*study_->file, study_->inputs.settings, fake::lawEngines(), request);
        [&] { VERIFY_OK(stored); }();
        return *stored;
    }

    std::optional<trial::MadeOutcomes> unpack(const workflow::TrialsRequest& request) {
        const auto made = workflow::unpackTrials(find(request), make(request));
        [&] { VERIFY_OK(made); }();
        return *made;
    }

    trial::TrialBatch make(const workflow::TrialsRequest& request) {
        const auto batch =
            workflow::makeTrials(study_->inputs.settings, study_->inputs.part, request, find(request));
        [&] { VERIFY_OK(batch); }();
        return *batch;
    }

    std::unique_ptr<fake::WaveStudy> study_;
    study::Individual winner_;
};

QTEST_GUILESS_MAIN(StudyTrialsTest)
#include "study_trials_test.moc"
