#include "core/workflow/learning.h"

#include <QtTest>

#include "core/study/track_design.h"
#include "core/workflow/judging.h"
#include "tests/core/workflow/workflow_fixture.h"

using namespace trapwright;
using workflow::FailureKind;

/// Learning, selection and validation of a study file.
class LearningTest : public QObject {
    Q_OBJECT

 private slots:
    void learnsWhatEvolveLearns() {
        fake::WaveStudy study("native", 4);
        std::vector<study::GenerationRecord> told;
        workflow::LearnEvents events;
        events.saved = [&](const study::GenerationRecord& record) {
            told.push_back(record);
            QCOMPARE(study.file->generationCount().value(), record.index + 1);
        };
        const auto report = workflow::learn(*study.file, study.inputs, fake::lawEngines(), events, {});
        QVERIFY(report.ok());
        QCOMPARE(report->end, study::LearningEnd::completed);
        QVERIFY(report->unchecked.empty());
        std::vector<study::GenerationRecord> truth;
        study::LearningEvents watch;
        watch.planned = [](const study::GenerationPlan&) {};
        watch.save = [&](const study::GenerationRecord& record) {
            truth.push_back(record);
            return base::success();
        };
        QVERIFY(study::evolve(study.inputs, std::nullopt, watch, {}).ok());
        QCOMPARE(told.size(), truth.size());
        std::int64_t trials = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            QCOMPARE(told[i].individuals, truth[i].individuals);
            QCOMPARE(study.file->loadGeneration(static_cast<int>(i)).value().individuals,
                     truth[i].individuals);
            for (const study::IndividualRecord& individual : truth[i].individuals)
                trials += individual.trials;
        }
        QCOMPARE(report->trials, trials);
    }

    void goesOnFromTheFile() {
        fake::WaveStudy whole("native", 5);
        QVERIFY(workflow::learn(*whole.file, whole.inputs, fake::lawEngines(), {}, {}).ok());
        fake::WaveStudy broken("native", 5);
        study::LearningControl control;
        workflow::LearnEvents events;
        events.saved = [&](const study::GenerationRecord&) { control.stopAfterGeneration(); };
        const auto first = workflow::learn(*broken.file, broken.inputs, fake::lawEngines(), events, control);
        QVERIFY(first.ok());
        QCOMPARE(first->end, study::LearningEnd::stopped);
        QCOMPARE(broken.file->generationCount().value(), 1);
        QVERIFY(workflow::learn(*broken.file, broken.inputs, fake::lawEngines(), {}, {}).ok());
        QCOMPARE(broken.file->loadGeneration(4).value().individuals,
                 whole.file->loadGeneration(4).value().individuals);
    }

    void aSearchThatCannotGoOnIsDamage() {
        fake::WaveStudy study("native", 2);
        study::GenerationRecord record;
        for (const search::Proposal& proposal : study::makeSearch(study.inputs.settings)->ask()) {
            record.individuals.emplace_back();
            record.individuals.back().design = proposal.design;
            record.individuals.back().traits = proposal.traits;
        }
        record.searchState = "of nothing";
        QVERIFY(study.file->saveGeneration(record).ok());
        const auto report = workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {});
        QVERIFY(!report.ok());
        QCOMPARE(report.error().kind, FailureKind::reading);
        const QString message = QString::fromStdString(report.error().message);
        QVERIFY2(message.contains(QString::fromStdString(study.file->path().string())) &&
                     message.contains("not the state of a genetic search") && message.contains("copy"),
                 qPrintable(message));
        QCOMPARE(study.file->generationCount().value(), 1);
    }

    void winnersThatAreLeftAreChecked() {
        fake::WaveStudy study("hybrid", 3);
        int checked = 0;
        workflow::LearnEvents events;
        events.checked = [&](const study::CheckRecord&) { ++checked; };
        const auto report = workflow::learn(*study.file, study.inputs, fake::lawEngines(), events, {});
        QVERIFY(report.ok());
        int simulated = 0;
        const std::vector<study::Individual> winners = study.file->loadWinners().value();
        for (const study::Individual& winner : winners)
            simulated += winner.record.trials > 0 ? 1 : 0;
        QCOMPARE(checked + static_cast<int>(report->unchecked.size()), simulated);
        QCOMPARE(workflow::countCheckTrials(report->unchecked),
                 static_cast<std::int64_t>(2 * 6 * report->unchecked.size()));
        QVERIFY(workflow::checkWinners(*study.file, study.inputs, fake::lawEngines(), report->unchecked,
                                       events.checked, {})
                    .ok());
        QCOMPARE(checked, simulated);
        QVERIFY(study.file->loadUncheckedWinners().value().empty());
    }

    // What was planned best is among what is simulated again, whoever won its generation.
    void thePlansBestChainIsACandidate() {
        const fake::WaveStudy study("native", 6);
        QVERIFY(workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {}).ok());
        study::StudyInputs inputs = study.inputs;
        const auto isFirst = [](const study::Individual& one) {
            return one.generation == 0 && one.individual == 0;
        };
        const auto winners = workflow::findCandidates(*study.file, inputs);
        QVERIFY(winners.ok() && std::none_of(winners->begin(), winners->end(), isFirst));
        inputs.settings.track.traps = "groove, groove, 3 x cut-out";
        inputs.settings.evolution.firstGeneration = search::ga::FirstGeneration::planned;
        for (const int count : {1, 2, 3, 20}) {
            inputs.settings.validation.selectionWinners = count;
            const auto candidates = workflow::findCandidates(*study.file, inputs);
            QVERIFY(candidates.ok() && static_cast<int>(candidates->size()) <= count);
            QVERIFY(study::isSameIndividual(candidates->front(), winners->front()));
            QCOMPARE(std::count_if(candidates->begin(), candidates->end(), isFirst), count > 1 ? 1 : 0);
        }
        // So is what exchanges went on from last.
        inputs.settings.evolution.search = search::Method::exchange;
        const auto exchanged = workflow::findCandidates(*study.file, inputs);
        VERIFY_OK(exchanged);
        const study::IndividualRecord parent = study.file->loadIndividual({5, 0}).value();
        QVERIFY(std::ranges::any_of(
            *exchanged, [&](const study::Individual& one) { return one.record.design == parent.design; }));
    }

    // Of a study that trades two objectives tracks from one end of its front to the other are.
    void theFrontsTracksAreCandidates() {
        const fake::WaveStudy study("native", 6);
        QVERIFY(workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {}).ok());
        study::StudyInputs inputs = study.inputs;
        inputs.settings.evolution.objectives = "F_C, F_D, F_O, success";
        inputs.settings.evolution.tradeOff = "F_D, F_O";
        const auto pairs = study.file->loadScorePairs("F_D", "F_O").value();
        const std::vector<std::size_t> front = study::findParetoFront(
            pairs, *objectives::findObjective("F_D"), *objectives::findObjective("F_O"), 1);
        QVERIFY(front.size() > 1);
        for (const int count : {1, 2, 3, 100}) {
            inputs.settings.validation.selectionWinners = count;
            const auto candidates = workflow::findCandidates(*study.file, inputs);
            VERIFY_OK(candidates);
            QCOMPARE(candidates->size(), std::min(front.size(), static_cast<std::size_t>(count)));
            QVERIFY(study::isSameIndividual(candidates->front(), pairs[front.front()]));
            if (count > 1) QVERIFY(study::isSameIndividual(candidates->back(), pairs[front.back()]));
            for (std::size_t k = 0; k < candidates->size(); ++k) {
                const study::Individual& one = (*candidates)[k];
                QVERIFY(one.record == study.file->loadIndividual(one).value());
                for (std::size_t other = 0; other < k; ++other)
                    QVERIFY(!study::isSameIndividual(one, (*candidates)[other]));
            }
        }
    }

    // The final track first, then those of the last comparison, then their relatives, each once; a study that
    // begins with them has half of its first generation from there, and begins as good as the other ended.
    void aStudyBeginsWithTheTracksOfAnother() {
        const fake::WaveStudy from("native", 6);
        QVERIFY(fake::messageOf(workflow::collectTracks(*from.file)).contains("no tracks yet"));
        QVERIFY(workflow::learn(*from.file, from.inputs, fake::lawEngines(), {}, {}).ok());
        VERIFY_OK(from.file->chooseWinner(study::IndividualId{1, 3}));
        const auto known = workflow::collectTracks(*from.file);
        VERIFY_OK(known);
        QCOMPARE(known->study, from.file->path().filename().string());
        QVERIFY(known->tracks.front().design == from.file->loadIndividual({1, 3}).value().design);
        const study::GenerationRecord end = from.file->loadGeneration(5).value();
        for (const study::IndividualRecord& last : end.individuals)
            QCOMPARE(std::ranges::count(known->tracks, last.design, &search::Proposal::design), 1);

        fake::WaveStudy study("native", 3);
        study.inputs.settings.evolution.firstGeneration = search::ga::FirstGeneration::known;
        const auto none = workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {});
        QVERIFY(!none.ok() && none.error().message.find("no tracks of another one") != std::string::npos);
        VERIFY_OK(study.file->saveKnownTracks(*known, study.inputs.settings));
        QVERIFY(study.file->loadKnownTracks().value() == *known);
        QVERIFY(workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {}).ok());
        const study::GenerationRecord first = study.file->loadGeneration(0).value();
        const std::size_t half = first.individuals.size() / 2;
        QCOMPARE(study::countKnown(study.inputs.settings.evolution), half);
        for (std::size_t i = 0; i < half; ++i)
            QVERIFY(first.individuals[i].design == known->tracks[i].design);
        QVERIFY(first.individuals[half].design != known->tracks[half].design);
        // With the rates that they had adapted.
        for (std::size_t i = 0; i < half; ++i)
            for (const search::NamedNumber& rate : first.individuals[i].traits)
                QVERIFY(std::abs(rate.value - search::findNumber(known->tracks[i].traits, rate.key).value()) <
                        1e-4);
        const double before = from.file->loadSummaries().value()[0].statistics.topMean.total;
        const double ended = from.file->loadSummaries().value()[5].statistics.topMean.total;
        QVERIFY(first.statistics.topMean.total - before > 0.5 * (ended - before));
        // Once it has begun they stay.
        QVERIFY(fake::messageOf(study.file->saveKnownTracks({}, study.inputs.settings))
                    .contains("has begun already"));
        QVERIFY(study.file->loadKnownTracks().value() == *known);
    }

    void failuresTellTheirKind() {
        fake::WaveStudy study("hybrid", 2);
        auto reader = store::StudyFile::openReadOnly(study.path);
        VERIFY_OK(reader);
        QCOMPARE(kindOf(workflow::learn(*reader, study.inputs, fake::lawEngines(), {}, {})),
                 FailureKind::saving);
        study::StudyInputs broken = study.inputs;
        broken.engine = std::make_shared<fake::FakeEngine>(
            [](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                trial::PartOutcome outcome = fake::waveLaw(batch, spec);
                outcome.farthest.position.x() = std::nan("");
                return outcome;
            });
        QCOMPARE(kindOf(workflow::learn(*study.file, broken, fake::lawEngines(), {}, {})),
                 FailureKind::simulation);

        QCOMPARE(kindOf(workflow::findCandidates(*study.file, study.inputs)), FailureKind::reading);
        QVERIFY(workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {}).ok());
        auto candidates = workflow::findCandidates(*study.file, study.inputs);
        QVERIFY(candidates.ok());
        base::RunControl cancelled;
        cancelled.cancel();
        QCOMPARE(kindOf(workflow::selectAndSave(*study.file, study.inputs, *candidates, cancelled)),
                 FailureKind::cancelled);
        QCOMPARE(kindOf(workflow::validateAndSave(*study.file, study.inputs, candidates->front(),
                                                  std::nullopt, cancelled)),
                 FailureKind::cancelled);
        QVERIFY(study.file->loadSelections().value().empty());
        study.inputs.settings.track.segmentWidth = -1.0;
        QCOMPARE(kindOf(workflow::findCandidates(*study.file, study.inputs)), FailureKind::settings);
    }

 private:
    template <class T>
    static FailureKind kindOf(const workflow::Result<T>& result) {
        [&] { QVERIFY(!result.ok()); }();
        return result.error().kind;
    }
};

QTEST_GUILESS_MAIN(LearningTest)
#include "learning_test.moc"
