#include "core/search/racing.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/search/ranking.h"

using namespace trapwright;
using search::RacingStage;
using search::RacingStep;

namespace {

/// A population whose true fitness is known and whose estimates have the error of a mean of `trials`.
struct Field {
    explicit Field(int size) : random({.seed = 5}) {
        for (int i = 0; i < size; ++i)
            truth.push_back(random.normal());
        estimates.assign(truth.size(), 0.0);
        trials.assign(truth.size(), 0);
    }
    void run(const std::vector<RacingStep>& round) {
        for (const RacingStep& step : round) {
            trials[step.individual] = step.trials;
            estimates[step.individual] = truth[step.individual] + random.normal() / std::sqrt(step.trials);
        }
    }

    base::Random random;
    std::vector<double> truth;
    std::vector<double> estimates;
    std::vector<int> trials;
};

}  // namespace

Q_DECLARE_METATYPE(std::vector<RacingStage>)

class RacingTest : public QObject {
    Q_OBJECT

 private slots:
    void laddersByHand_data() {
        QTest::addColumn<int>("first");
        QTest::addColumn<std::vector<RacingStage>>("stages");
        const auto row = [](const char* name, int first, const std::vector<RacingStage>& stages) {
            QTest::newRow(name) << first << stages;
        };
        row("no race", 0, {{100, 100}});
        row("nothing to save", 100, {{100, 100}});
        row("two stages", 60, {{60, 100}, {100, 30}});
        row("the half is doubled once", 50, {{50, 100}, {100, 30}});
        row("100 sqrt(0.3) = 54.8", 20, {{20, 100}, {40, 55}, {100, 30}});
        row("100 cbrt(0.3) = 66.9", 10, {{10, 100}, {20, 67}, {40, 45}, {100, 30}});
    }
    void laddersByHand() {
        QFETCH(int, first);
        QFETCH(std::vector<RacingStage>, stages);
        // Twice half of 100 is the end itself, which needs no stage of its own.
        QVERIFY(search::makeRacingStages(100, first, 100, 0.3) == stages);
    }

    void withoutRaceAllRunOnce() {
        const std::vector<RacingStage> stages = search::makeRacingStages(5, 0, 80, 0.3);
        Field field(5);
        const std::vector<RacingStep> round = search::findNextRound(field.estimates, field.trials, stages);
        QCOMPARE(round.size(), std::size_t{5});
        for (std::size_t i = 0; i < 5; ++i)
            QVERIFY(round[i] == (RacingStep{i, 80}));
        field.run(round);
        QVERIFY(search::findNextRound(field.estimates, field.trials, stages).empty());
    }

    void bestPlacesAreHeldByThoseWhoRanAll_data() {
        QTest::addColumn<int>("first");
        for (const int first : {2, 10, 20, 70})
            QTest::addRow("from %d trials", first) << first;
    }
    void bestPlacesAreHeldByThoseWhoRanAll() {
        QFETCH(int, first);
        const std::vector<RacingStage> stages = search::makeRacingStages(100, first, 100, 0.3);
        Field field(100);
        int rounds = 0;
        for (;;) {
            const auto round = search::findNextRound(field.estimates, field.trials, stages);
            if (round.empty()) break;
            QVERIFY(++rounds < 100);
            // Nobody skips a stage: the trials of each decide whether it runs those of the next.
            for (const RacingStep& step : round) {
                const int had = field.trials[step.individual];
                const auto stage = std::find_if(stages.begin(), stages.end(),
                                                [&](const RacingStage& s) { return s.trials > had; });
                QVERIFY(stage != stages.end());
                QCOMPARE(step.trials, stage->trials);
            }
            field.run(round);
        }
        const std::vector<std::size_t> ranking = search::rankByFitness(field.estimates);
        for (const RacingStage& stage : stages) {
            for (int place = 0; place < stage.places; ++place)
                QVERIFY(field.trials[ranking[static_cast<std::size_t>(place)]] >= stage.trials);
        }
        const int total = std::accumulate(field.trials.begin(), field.trials.end(), 0);
        QVERIFY2(total < 10000, QByteArray::number(total));
        QCOMPARE(search::countRacingTrials(field.trials, 100, stages), std::int64_t{total});
        // The truly best of all has not been lost on the way.
        const auto best = std::max_element(field.truth.begin(), field.truth.end()) - field.truth.begin();
        if (first >= 10) QCOMPARE(field.trials[static_cast<std::size_t>(best)], 100);
    }

    void whoDoesNotRunIsNeverNamed() {
        const std::vector<RacingStage> stages = search::makeRacingStages(4, 10, 40, 0.5);
        const std::vector<double> fitnesses = {-1.0, 5.0, 0.0, 0.5};
        std::vector<int> trials = {0, 40, 0, 0};
        QCOMPARE(search::countRacingTrials(trials, 3, stages), std::int64_t{30 + 3 * 10 + 2 * 20});
        for (const RacingStep& step : search::findNextRound(fitnesses, trials, stages))
            QVERIFY(step.individual != 1);
        trials = {10, 40, 10, 10};
        const auto second = search::findNextRound(fitnesses, trials, stages);
        QCOMPARE(second.size(), std::size_t{2});  // three places, one of them held by the one that rests
        QVERIFY(second[0] == (RacingStep{2, 20}) && second[1] == (RacingStep{3, 20}));
    }
};

QTEST_APPLESS_MAIN(RacingTest)
#include "racing_test.moc"
