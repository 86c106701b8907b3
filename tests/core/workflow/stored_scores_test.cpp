#include <QTemporaryDir>
#include <QtTest>
#include <set>

#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/presets.h"
#include "core/study/trial_batches.h"
#include "core/workflow/judging.h"
#include "core/workflow/learning.h"
#include "core/workflow/part_source.h"
#include "core/workflow/study_trials.h"
#include "sim/engines/registry.h"

#define VERIFY_OK(result)                                                                                 \
    do {                                                                                                  \
        const auto& verifiedResult = (result);                                                            \
        QVERIFY2(verifiedResult.ok(), verifiedResult.ok() ? "" : verifiedResult.error().message.c_str()); \
    } while (false)

using namespace trapwright;
using workflow::TrialKind;

namespace {

const workflow::LoadedPart& cuboid() {
    static const workflow::LoadedPart part = workflow::importPart({"cuboid"}).value();
    return part;
}

/// In every bit but one: SQLite knows no -0, which F_C is without overlaps.
bool agree(const objectives::Fitness& a, const objectives::Fitness& b) {
    return a == b;
}

}  // namespace

/// What is stored of the trials is all that the scores were made of, to the last bit: with the engines as
/// they are.
class StoredScoresTest : public QObject {
    Q_OBJECT

 private slots:
    void scoresComeFromTheStoredTrials_data() {
        QTest::addColumn<QString>("engine");
        QTest::addColumn<bool>("race");
        for (const char* engine : {"native", "simbody"}) {
            for (const bool race : {false, true})
                QTest::addRow("%s%s", engine, race ? ", in a race" : "") << engine << race;
        }
    }
    void scoresComeFromTheStoredTrials() {
        QFETCH(QString, engine);
        QFETCH(bool, race);
        QTemporaryDir folder;
        study::StudyInputs inputs;
        inputs.settings = study::presetSettings("cuboid").value();
        study::EvolutionSettings& evolution = inputs.settings.evolution;
        evolution.populationSize = 6;
        evolution.trialsPerEvaluation = 7;
        evolution.generations = 2;
        evolution.tournamentSize = 3;
        evolution.seed = 12;
        evolution.racingTrials = race ? 3 : 0;
        evolution.simulateOverlapping = true;
        inputs.settings.track.segmentHeight = 6e-3;  // low hills: some parts finish, some fall
        inputs.settings.simulation.engine = engine.toStdString();
        inputs.settings.validation.selectionTrials = 9;
        inputs.settings.validation.selectionCornerTrials = 4;
        inputs.settings.validation.trialsPerPose = 4;
        inputs.part = cuboid().part;
        inputs.engine = engines::registry().make(engine.toStdString(), {2, 0.0}).value();
        inputs.threads = 2;
        const std::filesystem::path path = folder.filePath("study.trap").toStdString();
        auto file = store::StudyFile::create(path, inputs.settings, cuboid().stored, "trapwright test");
        VERIFY_OK(file);
        QVERIFY(workflow::learn(*file, inputs, engines::registry(), {}, {}).ok());

        const objectives::ObjectiveList summed = study::summedObjectives(evolution);
        std::set<int> counts;
        for (int generation = 0; generation < evolution.generations; ++generation) {
            const auto record = file->loadGeneration(generation);
            VERIFY_OK(record);
            for (std::size_t i = 0; i < record->individuals.size(); ++i) {
                const study::IndividualRecord& individual = record->individuals[i];
                counts.insert(individual.trials);
                const auto [batch, outcomes] = read(
                    *file, inputs, {TrialKind::learning, {{generation, static_cast<int>(i)}, individual}});
                QCOMPARE(static_cast<int>(outcomes.size()), individual.trials);
                QVERIFY(agree(
                    objectives::measureAll(study::makeEvaluation(inputs, *batch.track, individual.overlaps,
                                                                 outcomes, study::listPlaces(batch)),
                                           summed),
                    individual.fitness));
                const auto counted = study::countTrials(outcomes, inputs.part->symmetry, std::nullopt,
                                                        inputs.settings.validation.tolerance);
                QCOMPARE(counted.tally.finished(), individual.finished);
                QCOMPARE(counted.tally.fellOff, individual.fellOff);
                QCOMPARE(counted.tally.stuck, individual.stuck);
                QCOMPARE(std::optional(counted.tally.success), individual.oriented);
            }
        }
        // A race gives them different numbers of trials.
        QCOMPARE(counts.size() > 1, race);

        const study::Individual winner = file->loadWinners()->back();
        QVERIFY(workflow::selectAndSave(*file, inputs, *file->loadWinners(), {}).ok());
        QVERIFY(workflow::validateAndSave(*file, inputs, winner, std::nullopt, {}).ok());
        const study::SelectionRecord selection = file->loadSelections()->front();
        for (const study::SelectionEntry& entry : selection.entries) {
            const study::Individual individual{entry, file->loadIndividual(entry).value()};
            const auto [batch, outcomes] = read(*file, inputs, {TrialKind::selection, individual});
            QCOMPARE(static_cast<int>(outcomes.size()), entry.trials);
            QVERIFY(agree(
                objectives::measureAll(study::makeEvaluation(inputs, *batch.track, individual.record.overlaps,
                                                             outcomes, study::listPlaces(batch)),
                                       summed),
                entry.fitness));
        }
        const study::ValidationRecord validation = file->loadValidations()->front();
        for (const study::ValidationRow& row : validation.rows) {
            const auto [batch, outcomes] = read(*file, inputs, {TrialKind::validation, winner, {row.pose}});
            const auto counted = study::countTrials(outcomes, inputs.part->symmetry, validation.goal.shown(),
                                                    validation.tolerance);
            QCOMPARE(counted.tally.failures(), row.tally.failures());
            QCOMPARE(counted.tally.fellOff, row.tally.fellOff);
            QCOMPARE(counted.tally.stuck, row.tally.stuck);
        }
    }

 private:
    struct Trials {
        trial::TrialBatch batch;
        std::vector<trial::Outcome> outcomes;
    };

    /// The stored outcomes, with the very starts that the engine gave them: of a batch without time it
    /// simulates nothing else.
    static Trials read(const store::StudyFile& file, const study::StudyInputs& inputs,
                       const workflow::TrialsRequest& request) {
        const auto stored =
            workflow::findStoredTrials(file, inputs.settings, engines::registry(), request).value();
        Trials trials;
        trials.batch = workflow::makeTrials(inputs.settings, inputs.part, request, stored).value();
        auto made = workflow::unpackTrials(stored, trials.batch).value();
        if (!made) return trials;
        trials.outcomes = std::move(made->outcomes);
        trial::TrialBatch starts = trials.batch;
        starts.termination.timeLimit = 0.0;
        const auto begun = inputs.engine->run({&starts, 1}, {}).value().front();
        for (std::size_t i = 0; i < begun.size(); ++i) {
            base::Pose& initial = trials.outcomes[i].parts[0].initial;
            const base::Pose& own = begun[i].parts[0].initial;
            // But for the last bits they are what is known without an engine.
            if ((own.position - initial.position).norm() > 1e-9 ||
                own.rotation.angularDistance(initial.rotation) > 1e-6)
                return {trials.batch, {}};
            initial = own;
        }
        return trials;
    }
};

QTEST_GUILESS_MAIN(StoredScoresTest)
#include "stored_scores_test.moc"
