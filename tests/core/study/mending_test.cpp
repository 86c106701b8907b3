#include "core/study/mending.h"

#include <QTest>

#include "core/study/runner.h"
#include "core/study/track_design.h"
#include "core/track/print_solid.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;

namespace {

constexpr double kSquareMillimetre = 1e-6;  // [m^2]

study::TrackSettings cuboidTrack() {
    return study::presetSettings("cuboid")->track;
}

/// A rough track, a little of which cannot be printed.
search::Design findFlawedDesign(const study::TrackSettings& settings) {
    const std::vector<search::Dimension> dimensions = study::designSpace(settings).dimensions;
    constexpr double kRelief = 0.35;
    for (std::uint32_t number = 0;; ++number) {
        base::Random random({7, 0, number, 0, base::Purpose::test});
        search::Design design;
        for (const search::Dimension& dimension : dimensions)
            design.push_back(search::roundToBits(
                dimension.ofPoint ? 0.5 + kRelief * (random.uniform() - 0.5) : random.uniform(),
                dimension.bits));
        const auto area = study::measureUnprintable(settings, design, {});
        if (area && *area > 1.0 * kSquareMillimetre && *area < 10.0 * kSquareMillimetre) return design;
    }
}

const search::Design& flawedDesign() {
    static const search::Design design = findFlawedDesign(cuboidTrack());
    return design;
}

study::Individual individualOf(search::Design design) {
    study::Individual individual{{2, 5}, {}};
    individual.record.design = std::move(design);
    individual.record.traits = {{"p_x", 0.25}, {"p_dm", 0.001}, {"p_s", 0.0625}};
    return individual;
}

}  // namespace

class MendingTest : public QObject {
    Q_OBJECT

 private slots:
    void nothingIsLeftAndLittleIsChanged() {
        const study::TrackSettings settings = cuboidTrack();
        const search::DesignSpace space = study::designSpace(settings);
        const search::Design& design = flawedDesign();
        // Not every variant comes to an end.
        base::StreamKey stream{1, 3, 0, 0, base::Purpose::mending};
        auto mended = study::mendDesign(settings, design, {}, stream, {});
        while (mended && mended->unprintable > 0.0 && stream.individual < 9) {
            ++stream.individual;
            mended = study::mendDesign(settings, design, {}, stream, {});
        }
        VERIFY_OK(mended);
        QCOMPARE(mended->unprintable, 0.0);
        QCOMPARE(study::measureUnprintable(settings, mended->design, {}).value(), 0.0);
        VERIFY_OK(space.check(mended->design));
        int changed = 0;
        for (std::size_t i = 0; i < design.size(); ++i) {
            const search::Dimension& dimension = space.dimensions[i];
            QCOMPARE(search::roundToBits(mended->design[i], dimension.bits), mended->design[i]);
            if (mended->design[i] == design[i]) continue;
            ++changed;
            QVERIFY2(dimension.ofPoint, dimension.key.c_str());
        }
        QVERIFY(changed > 0 && changed < static_cast<int>(design.size()) / 2);

        const auto printed = track::buildPrintSolid(*study::decodeTrack(settings, mended->design), {});
        QVERIFY(printed.ok());
        QVERIFY(geometry::checkForPrinting(*printed, {}).isFlawless());

        QVERIFY(study::mendDesign(settings, design, {}, stream, {})->design == mended->design);
        const base::StreamKey another{2, 3, stream.individual, 0, base::Purpose::mending};
        QVERIFY(study::mendDesign(settings, design, {}, another, {})->design != mended->design);
    }

    /// What parts do may hang on little: nothing stays moved that could be where it was.
    void whatIsNotNeededIsTakenBack() {
        const study::TrackSettings settings = cuboidTrack();
        const search::Design& design = flawedDesign();
        int mendings = 0;
        for (std::uint32_t variant = 0; variant < 6; ++variant) {
            const base::StreamKey stream{1, 3, variant, 0, base::Purpose::mending};
            const auto mended = study::mendDesign(settings, design, {}, stream, {});
            VERIFY_OK(mended);
            if (mended->unprintable > 0.0) continue;
            ++mendings;
            for (std::size_t i = 0; i < design.size(); ++i) {
                if (mended->design[i] == design[i]) continue;
                search::Design restored = mended->design;
                restored[i] = design[i];
                const auto left = study::measureUnprintable(settings, restored, {});
                QVERIFY2(!left || *left > 0.0,
                         qPrintable(QString("variant %1, number %2").arg(variant).arg(i)));
            }
        }
        QVERIFY(mendings > 0);
    }

    void movesAreCounted() {
        study::MendingPlan plan;
        plan.moves = 1;
        const auto mended = study::mendDesign(cuboidTrack(), flawedDesign(), plan, {}, {});
        VERIFY_OK(mended);
        QVERIFY(mended->unprintable > 0.0);
        int changed = 0;
        for (std::size_t i = 0; i < mended->design.size(); ++i)
            changed += mended->design[i] != flawedDesign()[i] ? 1 : 0;
        QVERIFY(changed <= 1);
    }

    /// A printer that does more leaves nothing to mend, one that does less more.
    void limitsAreThePrinters() {
        const study::TrackSettings settings = cuboidTrack();
        const search::Design& design = flawedDesign();
        const double usual = study::measureUnprintable(settings, design, {}).value();
        geometry::PrintLimits coarse;
        coarse.thinnestWall *= 2.0;
        coarse.steepestOverhang = 0.5 * base::kDegree;
        QVERIFY(study::measureUnprintable(settings, design, coarse).value() > usual);
        geometry::PrintLimits fine;
        fine.thinnestWall = 1e-6;
        fine.steepestOverhang = base::kPi / 2;
        QCOMPARE(study::measureUnprintable(settings, design, fine).value(), 0.0);
        study::MendingPlan plan;
        plan.limits = fine;
        const auto mended = study::mendDesign(settings, design, plan, {}, {});
        VERIFY_OK(mended);
        QVERIFY(mended->design == design);
    }

    void variantsAreAGeneration() {
        const study::StudyInputs inputs = fake::waveInputs(2);
        const study::Individual track = individualOf(flawedDesign());
        study::MendingPlan plan;
        plan.variants = 6;
        plan.trials = 12;
        plan.moves = 300;
        const study::LearningState last{4, "state"};
        const auto variants = study::mendVariants(inputs, 5, track, plan, {});
        VERIFY_OK(variants);
        QCOMPARE(variants->size(), std::size_t{6});
        const auto record = study::judgeVariants(inputs, last, track, *variants, plan, {});
        VERIFY_OK(record);
        QCOMPARE(record->index, 5);
        QVERIFY(record->mendedFrom == study::IndividualId(track));
        QVERIFY(study::summarize(*record).mendedFrom == study::IndividualId(track));
        QCOMPARE(record->searchState, last.search);
        QVERIFY(!record->individuals.empty() && record->individuals.size() <= 6);
        for (const study::IndividualRecord& variant : record->individuals) {
            QCOMPARE(study::measureUnprintable(inputs.settings.track, variant.design, {}).value(), 0.0);
            QCOMPARE(variant.trials, 12);
            QVERIFY(variant.traits == track.record.traits);
        }
        QCOMPARE(record->made.outcomes.size(), 12 * record->individuals.size());
        const std::size_t winner = static_cast<std::size_t>(record->winner);
        for (const study::IndividualRecord& variant : record->individuals)
            QVERIFY(record->individuals[winner].fitness.total >= variant.fitness.total);

        // The same on one thread.
        const auto same = study::mendVariants(fake::waveInputs(1), 5, track, plan, {});
        VERIFY_OK(same);
        const auto again = study::judgeVariants(fake::waveInputs(1), last, track, *same, plan, {});
        VERIFY_OK(again);
        QVERIFY(again->individuals == record->individuals);
    }

    void errorsSayWhatToDo() {
        const study::StudyInputs inputs = fake::waveInputs();
        const study::Individual flawed = individualOf(flawedDesign());
        const auto mend = [&](const study::Individual& track, const study::MendingPlan& plan) {
            return fake::messageOf(study::mendVariants(inputs, 5, track, plan, {}));
        };

        study::MendingPlan plan;
        plan.variants = 0;
        QVERIFY(mend(flawed, plan).contains("variants must be 1 to 1000, and is 0"));
        plan = {};
        plan.trials = -1;
        QVERIFY(mend(flawed, plan).contains("trials of each variant"));
        plan = {};
        plan.moves = 0;
        QVERIFY(mend(flawed, plan).contains("moves"));
        plan = {};
        plan.compared = 0;
        QVERIFY(mend(flawed, plan).contains("compared"));

        search::Design strange = flawed.record.design;
        strange.pop_back();
        QVERIFY(!study::measureUnprintable(inputs.settings.track, strange, {}).ok());
        QVERIFY(!study::mendVariants(inputs, 5, individualOf(strange), {}, {}).ok());
    }

    void stopsWhenItIsCancelled() {
        const study::StudyInputs inputs = fake::waveInputs();
        base::RunControl control;
        control.cancel();
        const study::Individual track = individualOf(flawedDesign());
        QVERIFY(!study::mendVariants(inputs, 5, track, {}, control).ok());
    }
};

QTEST_APPLESS_MAIN(MendingTest)
#include "mending_test.moc"
