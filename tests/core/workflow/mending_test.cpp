#include <QTest>
#include <algorithm>

#include "core/study/selection.h"
#include "core/workflow/judging.h"
#include "core/workflow/learning.h"
#include "tests/core/study/flawed_track.h"
#include "tests/core/workflow/workflow_fixture.h"

using namespace trapwright;

namespace {

void learn(fake::WaveStudy& study, int generations) {
    study.inputs.settings.evolution.generations = generations;
    const auto report = workflow::learn(*study.file, study.inputs, fake::lawEngines(), {}, {});
    QVERIFY2(report.ok(), report.ok() ? "" : report.error().message.c_str());
}

fake::FlawedTrack findFlawed(const fake::WaveStudy& study) {
    std::vector<study::GenerationRecord> generations;
    for (int i = 0; i < study.file->generationCount().value(); ++i)
        generations.push_back(study.file->loadGeneration(i).value());
    return fake::findFlawedTrack(study.inputs.settings.track, generations).value();
}

}  // namespace

class MendingTest : public QObject {
    Q_OBJECT

 private slots:
    void variantsAreKeptComparedAndLeftOutOfLearning() {
        fake::WaveStudy study("native", 3);
        learn(study, 3);
        const fake::FlawedTrack flawed = findFlawed(study);
        const study::Individual& track = flawed.track;
        study::MendingPlan plan;
        plan.variants = 8;
        plan.trials = 10;
        plan.compared = 3;
        plan.limits = flawed.limits;
        study.inputs.settings.validation.selectionTrials = 40;
        study.inputs.settings.validation.selectionCornerTrials = 20;

        int told = 0;
        const base::RunControl control;
        const auto report = workflow::mendAndSave(
            *study.file, study.inputs, track, plan,
            [&](const study::GenerationRecord& record) { told = record.index; }, control);
        QVERIFY2(report.ok(), report.ok() ? "" : report.error().message.c_str());
        QCOMPARE(told, 3);
        QVERIFY(report->unprintable > 0.0);
        QVERIFY(control.done() <= workflow::countMendingTrials(study.inputs.settings, plan));

        // In the file: a generation, whence it comes, its trials, and a selection that has the track, too.
        QCOMPARE(study.file->generationCount().value(), 4);
        QVERIFY(study.file->loadSummaries()->back().mendedFrom == study::IndividualId(track));
        QVERIFY(!study.file->loadSummaries()->front().mendedFrom);
        const auto kept = study.file->loadGeneration(3);
        VERIFY_OK(kept);
        QVERIFY(kept->mendedFrom == study::IndividualId(track));
        QVERIFY(kept->individuals == report->generation.individuals);
        const auto outcomes = study.file->loadLearningOutcomes({3, 0});
        VERIFY_OK(outcomes);
        QVERIFY(outcomes->has_value());
        QCOMPARE((*outcomes)->count, std::size_t{10});
        const auto selections = study.file->loadSelections();
        VERIFY_OK(selections);
        QCOMPARE(selections->size(), std::size_t{1});
        const std::vector<study::SelectionEntry>& entries = selections->front().entries;
        const auto variants =
            static_cast<std::size_t>(std::ranges::count(entries, 3, &study::SelectionEntry::generation));
        QCOMPARE(variants, std::min(kept->individuals.size(), std::size_t{3}));
        QCOMPARE(entries.size(), variants + 1);
        QVERIFY(std::ranges::any_of(entries, [&](const study::SelectionEntry& entry) {
            return isSameIndividual(entry, track) && entry.trials == 40;
        }));
        const auto best = std::ranges::find(entries, 3, &study::SelectionEntry::generation);
        QVERIFY(isSameIndividual(*best, report->best));
        QVERIFY(study.file->loadChosenWinner().value() == report->best);

        // Learning goes on as if nothing had been mended.
        learn(study, 5);
        fake::WaveStudy twin("native", 4);
        learn(twin, 4);
        const auto after = study.file->loadGeneration(4);
        const auto without = twin.file->loadGeneration(3);
        VERIFY_OK(after);
        VERIFY_OK(without);
        QVERIFY(!after->mendedFrom);
        QCOMPARE(after->individuals.size(), without->individuals.size());
        for (std::size_t i = 0; i < after->individuals.size(); ++i)
            QVERIFY(after->individuals[i].design == without->individuals[i].design);
    }

    void whatCannotBeMendedLeavesTheStudyAsItIs() {
        fake::WaveStudy study("native", 2);
        study::Individual none{{0, 0}, {}};
        const auto mend = [&](const study::Individual& track, const study::MendingPlan& plan) {
            return workflow::mendAndSave(*study.file, study.inputs, track, plan, {}, {});
        };
        const auto early = mend(none, {});
        QVERIFY(!early.ok());
        QVERIFY(early.error().kind == workflow::FailureKind::reading);

        learn(study, 2);
        const fake::FlawedTrack flawed = findFlawed(study);
        const study::Individual& track = flawed.track;
        study::MendingPlan plan;
        plan.variants = 1;
        plan.moves = 1;
        plan.limits = flawed.limits;
        const auto thin = mend(track, plan);
        QVERIFY(!thin.ok());
        QVERIFY(thin.error().kind == workflow::FailureKind::notSolid);
        QVERIFY2(thin.error().message.find("none of 1 variants") != std::string::npos,
                 thin.error().message.c_str());
        plan.limits.thinnestWall = 1e-6;
        plan.limits.steepestOverhang = base::kPi / 2;
        const auto whole = mend(track, plan);
        QVERIFY(!whole.ok());
        QVERIFY2(whole.error().message.find("nothing to mend") != std::string::npos,
                 whole.error().message.c_str());
        base::RunControl control;
        control.cancel();
        plan.limits = flawed.limits;
        plan.moves = 2000;
        const auto cancelled = workflow::mendAndSave(*study.file, study.inputs, track, plan, {}, control);
        QVERIFY(!cancelled.ok());
        QVERIFY(cancelled.error().kind == workflow::FailureKind::cancelled);
        // In the middle of the comparison, when all variants were judged.
        base::RunControl later;
        auto engine = std::make_shared<fake::FakeEngine>(fake::waveLaw);
        engine->afterTrial = [&] {
            if (later.done() > plan.variants * plan.trials) later.cancel();
        };
        study.inputs.engine = engine;
        plan.variants = 8;
        plan.trials = 10;
        const auto stopped = workflow::mendAndSave(*study.file, study.inputs, track, plan, {}, later);
        QVERIFY(!stopped.ok());
        QVERIFY(stopped.error().kind == workflow::FailureKind::cancelled);
        QCOMPARE(study.file->generationCount().value(), 2);
        QVERIFY(study.file->loadSelections()->empty());
        QVERIFY(!study.file->loadChosenWinner().value());
    }
};

QTEST_APPLESS_MAIN(MendingTest)
#include "mending_test.moc"
