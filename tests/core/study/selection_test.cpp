#include "core/study/selection.h"

#include <QTest>

#include "core/study/validation.h"

using namespace trapwright;
using study::findSuccess;

class SelectionTest : public QObject {
    Q_OBJECT

 private slots:
    void successIsThatOfTheNewestWord() {
        study::Individual winner{{4, 2}, {}};
        QVERIFY(!findSuccess({}, {}, winner, {}, false));
        winner.record.trials = 100;
        winner.record.oriented = 70;
        winner.record.finished = 75;
        QCOMPARE(findSuccess({}, {}, winner, {}, false)->finished, 75);
        QCOMPARE(findSuccess({}, {}, winner, {}, false)->count.successes, 70);
        QCOMPARE(findSuccess({}, {}, winner, {}, false)->rate, 0.7);

        study::SelectionEntry entry;
        entry.generation = 4;
        entry.individual = 2;
        entry.trials = 1000;
        entry.oriented = 991;
        entry.finished = 995;
        const std::vector<study::SelectionRecord> selections = {{"simbody", {entry}}, {"simbody", {}}};
        QCOMPARE(findSuccess(selections, {}, winner, {}, false)->count.successes, 991);
        QCOMPARE(findSuccess(selections, {}, winner, {}, false)->finished, 995);

        // Validated twice: 10 of 30 failed, then 3 of 20.
        study::ValidationRecord first{{4, 2}, "native", {}, 0.0, {{0, {6, 4, 0, 0}}, {1, {14, 6, 0, 0}}}};
        study::ValidationRecord second{{4, 2}, "native", {}, 0.0, {{0, {17, 3, 0, 0}}}};
        study::ValidationRecord other{{4, 3}, "native", {}, 0.0, {{0, {0, 20, 0, 0}}}};
        const std::vector<study::ValidationRecord> validations = {first, second, other};
        QCOMPARE(findSuccess({}, {&first, 1}, winner, {}, false)->count.successes, 20);
        // Of the 10 that failed all came through, but another way up.
        QCOMPARE(findSuccess({}, {&first, 1}, winner, {}, false)->finished, 30);
        QCOMPARE(findSuccess({}, validations, winner, {}, false)->count.successes, 17);
        QCOMPARE(findSuccess({}, validations, winner, {}, false)->count.trials, 20);
        QCOMPARE(findSuccess(selections, validations, winner, {}, false)->count.successes, 17);
        winner.individual = 3;
        QCOMPARE(findSuccess(selections, validations, winner, {}, false)->count.successes, 0);
    }

    // 6 of 10 in a pose in which 90 % land, 20 of 20 in the other: 0.9 0.6 + 0.1 = 0.64, not 26 of 30.
    void aValidationCountsAsPartsLand() {
        const study::Individual winner{{4, 2}, {}};
        const study::ValidationRecord record{
            {4, 2}, "native", {}, 0.0, {{0, {6, 4, 0, 0}}, {1, {20, 0, 0, 0}}}};
        const std::vector<part::PoseGroup> groups = {{{0}, 0.9}, {{1}, 0.1}};
        const auto success = findSuccess({}, {&record, 1}, winner, groups, false);
        QCOMPARE(success->rate, 0.64);
        QCOMPARE(success->count.successes, 26);
        QCOMPARE(success->source, study::TrackSuccess::Source::validation);
        const auto table = study::tabulate(record, groups);
        QCOMPARE(success->rate, *table.weighted.rate);
        QCOMPARE(success->calcInterval().low, table.weighted.interval.low);
        QCOMPARE(success->calcInterval().high, table.weighted.interval.high);
    }

    // Where falls are forgiven: 6 right and 2 wrong of 10 in a pose in which 90 % land, 5 and 0 of 20 in the
    // other: (0.9 0.6 + 0.1 0.25) / (0.9 0.8 + 0.1 0.25) of those that arrive.
    void ofPartsThatArriveWhereFallsAreForgiven() {
        study::Individual winner{{4, 2}, {}};
        const study::ValidationRecord record{
            {4, 2}, "native", {}, 0.0, {{0, {6, 2, 0, 2}}, {1, {5, 0, 0, 15}}}};
        const std::vector<part::PoseGroup> groups = {{{0}, 0.9}, {{1}, 0.1}};
        const auto correct = findSuccess({}, {&record, 1}, winner, groups, true);
        QVERIFY(correct->ofArriving);
        QCOMPARE(correct->arriving, 0.745);
        QCOMPARE(correct->rate, 0.565 / 0.745);
        QCOMPARE(correct->finished, 13);
        const auto table = study::tabulate(record, groups);
        QCOMPARE(correct->rate, *table.correct.rate);
        QCOMPARE(correct->calcInterval().low, table.correct.interval.low);
        QCOMPARE(correct->calcInterval().high, table.correct.interval.high);
        QCOMPARE(findSuccess({}, {&record, 1}, winner, groups, false)->rate, 0.565);

        // As it was learned; and none arrives.
        winner.individual = 3;
        winner.record.trials = 100;
        winner.record.finished = 50;
        winner.record.oriented = 45;
        QCOMPARE(findSuccess({}, {}, winner, {}, true)->rate, 0.9);
        winner.record.finished = 0;
        winner.record.oriented = 0;
        const auto none = findSuccess({}, {}, winner, {}, true);
        QVERIFY(!none->ofArriving);
        QCOMPARE(none->rate, 0.0);
    }
};

QTEST_APPLESS_MAIN(SelectionTest)
#include "selection_test.moc"
