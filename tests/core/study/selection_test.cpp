#include "core/study/selection.h"

#include <QTest>

using namespace trapwright;
using study::findSuccess;

class SelectionTest : public QObject {
    Q_OBJECT

 private slots:
    void successIsThatOfTheNewestWord() {
        study::Winner winner{4, 2, {}};
        QVERIFY(!findSuccess({}, {}, winner));
        winner.record.trials = 100;
        winner.record.oriented = 70;
        QCOMPARE(findSuccess({}, {}, winner)->successes, 70);

        study::SelectionEntry entry;
        entry.generation = 4;
        entry.individual = 2;
        entry.trials = 1000;
        entry.oriented = 991;
        const std::vector<study::SelectionRecord> selections = {{"simbody", {entry}}, {"simbody", {}}};
        QCOMPARE(findSuccess(selections, {}, winner)->successes, 991);

        // Validated twice: 10 of 30 failed, then 3 of 20.
        study::ValidationRecord first{4, 2, "native", {}, 0.0, {{0, 10, 4}, {1, 20, 6}}};
        study::ValidationRecord second{4, 2, "native", {}, 0.0, {{0, 20, 3}}};
        study::ValidationRecord other{4, 3, "native", {}, 0.0, {{0, 20, 20}}};
        const std::vector<study::ValidationRecord> validations = {first, second, other};
        QCOMPARE(findSuccess({}, {&first, 1}, winner)->successes, 20);
        QCOMPARE(findSuccess({}, validations, winner)->successes, 17);
        QCOMPARE(findSuccess({}, validations, winner)->trials, 20);
        QCOMPARE(findSuccess(selections, validations, winner)->successes, 17);
        winner.individual = 3;
        QCOMPARE(findSuccess(selections, validations, winner)->successes, 0);
    }
};

QTEST_APPLESS_MAIN(SelectionTest)
#include "selection_test.moc"
