#include "core/verify/agreement.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/verify/scenes.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;

class AgreementTest : public QObject {
    Q_OBJECT

    static constexpr int kTrials = 200;

    std::vector<verify::AgreementScene> scenes_;

    /// Finishes after a time that differs from trial to trial, turned as it started.
    static trial::PartOutcome finish(const trial::TrialSpec& spec) {
        trial::PartOutcome outcome;
        outcome.ending = trial::Ending::finished;
        outcome.initial = spec.parts[0].pose;
        outcome.farthest = spec.parts[0].pose;
        outcome.time = 2.0 + 0.01 * spec.stream.trial;
        return outcome;
    }

    /// The rows of an engine against one in which every trial finishes.
    [[nodiscard]] std::vector<verify::Agreement> holdAgainst(const fake::Law& law) const {
        const fake::FakeEngine engine(law);
        const fake::FakeEngine reference(
            [](const trial::TrialBatch&, const trial::TrialSpec& spec) { return finish(spec); });
        const base::RunControl control;
        auto table = verify::compareEngines(engine, reference, scenes_, control);
        if (!table) return {};
        const auto again = std::ranges::count_if(
            *table, [](const verify::Agreement& row) { return row.freshP.has_value(); });
        if (control.done() != 2 * (9 + again) * kTrials) return {};
        return std::move(table).value();
    }

 private slots:
    void initTestCase() {
        auto scenes = verify::makeAgreementScenes(verify::makeFlat(), kTrials);
        VERIFY_OK(scenes);
        scenes_ = std::move(scenes).value();
    }

    void everyPartOnEveryTrack() {
        QCOMPARE(scenes_.size(), 9U);
        for (const verify::AgreementScene& scene : scenes_) {
            QVERIFY2(!findProblem(scene.batch), scene.part.c_str());
            QCOMPARE(scene.batch.parts[0]->name, scene.part);
            QCOMPARE(scene.batch.trials.size(), static_cast<std::size_t>(kTrials));
        }
        // The bracket is the one that is not convex.
        QCOMPARE(scenes_[6].part, "bracket");
        QVERIFY(scenes_[6].batch.parts[0]->pieces.size() > 1);
    }

    void anEngineAgreesWithItself() {
        const auto table =
            holdAgainst([](const trial::TrialBatch&, const trial::TrialSpec& spec) { return finish(spec); });
        QCOMPARE(table.size(), 9U);
        for (const verify::Agreement& row : table) {
            QCOMPARE(row.engine.finished, kTrials);
            QCOMPARE(row.engine.oriented, row.reference.oriented);
            QCOMPARE(row.finishedInOne, 0);
            QCOMPARE(row.familyP, 1.0);
            QVERIFY(std::abs(row.engine.medianTime - (2.0 + 0.01 * 0.5 * (kTrials - 1))) < 1e-12);
            QVERIFY(row.alikeAlone && row.passed());
        }
    }

    /// One part of twenty that falls off on one track of one part: that row fails, and no other. All of ten
    /// trials fall to one side: p = 2 / 1024; adjusted, 27 times that is no longer significant, of twenty it
    /// is.
    void aRateThatDiffers_data() {
        QTest::addColumn<int>("falling");
        QTest::addColumn<double>("p");
        QTest::addColumn<bool>("passed");
        QTest::newRow("10 of 200") << 10 << std::ldexp(1.0, -9) << true;
        QTest::newRow("20 of 200") << 20 << std::ldexp(1.0, -19) << false;
    }
    void aRateThatDiffers() {
        QFETCH(int, falling);
        QFETCH(double, p);
        QFETCH(bool, passed);
        const part::Part* part = scenes_[4].batch.parts[0].get();
        const track::Track* track = scenes_[4].batch.track.get();
        const auto table = holdAgainst([=](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = finish(spec);
            if (batch.parts[0].get() == part && batch.track.get() == track &&
                static_cast<int>(spec.stream.trial) % (kTrials / falling) == 0)
                outcome.ending = trial::Ending::fellOff;
            return outcome;
        });
        QCOMPARE(table.size(), 9U);
        for (std::size_t i = 0; i < table.size(); ++i) {
            QCOMPARE(table[i].finishedInOne, i == 4 ? falling : 0);
            QVERIFY(std::abs(table[i].finishedP - (i == 4 ? p : 1.0)) < 1e-12);
            QCOMPARE(table[i].passed(), i != 4 || passed);
            QCOMPARE(table[i].freshP.has_value(), i == 4 && !passed);
            // Clopper and Pearson: from 200 of 200 the bound is 0.025^(1/200) = 98.2 %.
            QCOMPARE(table[i].alikeAlone, i != 4);
        }
    }

    // Bad luck on the starts that all versions of an engine meet is looked at again on others.
    void whatIsNotSoOnFreshStartsPasses() {
        const auto table = holdAgainst([](const trial::TrialBatch&, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = finish(spec);
            if (spec.stream.individual == 0 && spec.stream.trial % 5 == 0)
                outcome.ending = trial::Ending::fellOff;
            return outcome;
        });
        QCOMPARE(table.size(), 9U);
        for (const verify::Agreement& row : table) {
            QCOMPARE(row.finishedInOne, kTrials / 5);
            QVERIFY(row.familyP < 0.05 && row.freshP == 1.0 && row.passed());
        }
    }

    void timesThatDiffer() {
        const auto table = holdAgainst([](const trial::TrialBatch&, const trial::TrialSpec& spec) {
            trial::PartOutcome outcome = finish(spec);
            outcome.time += 0.4;
            return outcome;
        });
        QCOMPARE(table.size(), 9U);
        for (const verify::Agreement& row : table) {
            // 40 of 200 equally spaced values.
            QVERIFY(std::abs(row.times.statistic - 0.2) < 0.006);
            QCOMPARE(row.finishedP, 1.0);
            QVERIFY(!row.alikeAlone && !row.passed());
        }
    }

    void nobodyFinishes() {
        const auto table = holdAgainst(
            [](const trial::TrialBatch&, const trial::TrialSpec&) { return trial::PartOutcome(); });
        QCOMPARE(table.size(), 9U);
        QCOMPARE(table[0].engine.finished, 0);
        QCOMPARE(table[0].engine.medianTime, 0.0);
        QCOMPARE(table[0].times.p, 1.0);
        QVERIFY(!table[0].passed());
    }

    void cancelled() {
        base::RunControl control;
        control.cancel();
        const fake::FakeEngine engine(
            [](const trial::TrialBatch&, const trial::TrialSpec& spec) { return finish(spec); });
        QVERIFY(!verify::compareEngines(engine, engine, scenes_, control).ok());
    }
};

QTEST_APPLESS_MAIN(AgreementTest)
#include "agreement_test.moc"
