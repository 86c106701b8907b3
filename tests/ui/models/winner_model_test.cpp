#include "ui/models/winner_model.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>
#include <QtTest>

#include "tests/core/objectives/paper_fitness.h"
#include "ui/models/roles.h"

using namespace trapwright;
using models::WinnerModel;

namespace {

study::Individual winnerOf(int generation) {
    study::Individual winner;
    winner.generation = generation;
    winner.individual = 7;
    winner.record.fitness = testing::paperFitness(0.0, 0.0, 1.25);
    winner.record.trials = 100;
    winner.record.finished = 98;
    winner.record.oriented = 97;
    return winner;
}

}  // namespace

class WinnerModelTest : public QObject {
    Q_OBJECT

 private slots:
    void winnersComeOneByOne() {
        WinnerModel model;
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        model.setWinners({winnerOf(0), winnerOf(1)});
        model.append(winnerOf(2));
        QCOMPARE(model.rowCount(), 3);
        QCOMPARE(model.rowOf(2), 2);
        QCOMPARE(model.rowOf(3), -1);
        QCOMPARE(model.winnerAt(1)->generation, 1);
        QVERIFY(model.winnerAt(3) == nullptr);
        QCOMPARE(model.index(2).data().toString(), QString("2"));
        QCOMPARE(model.index(2).data(Qt::ToolTipRole).toString(),
                 QString("Generation 2, winner: success 97.0 % (91.5 … 99.4). 98 of 100 parts finished. F "
                         "1.250"));
        QCOMPARE(model.index(2).data(models::SuccessRole).toString(), QString("97 %"));
        QCOMPARE(model.index(2).data(models::IndividualRole).toInt(), 7);
    }

    void labelsAreAsShortAsTheyAreExact_data() {
        QTest::addColumn<int>("oriented");
        QTest::addColumn<int>("trials");
        QTest::addColumn<QString>("label");
        QTest::newRow("all") << 100 << 100 << "100 %";
        QTest::newRow("almost all") << 996 << 1000 << "99.6 %";
        QTest::newRow("none") << 0 << 20 << "0 %";
        QTest::newRow("not counted") << -1 << 20 << "–";
        QTest::newRow("not simulated") << 0 << 0 << "–";
    }
    void labelsAreAsShortAsTheyAreExact() {
        QFETCH(int, oriented);
        QFETCH(int, trials);
        study::Individual winner = winnerOf(0);
        winner.record.trials = trials;
        winner.record.oriented = oriented < 0 ? std::nullopt : std::optional(oriented);
        WinnerModel model;
        model.setWinners({winner});
        QTEST(model.index(0).data(models::SuccessRole).toString(), "label");
    }

    // Where parts that fall off come again.
    void rightOnesAreCountedAmongThoseThatFinish() {
        study::Individual sorted = winnerOf(0);
        sorted.record.finished = 20;
        sorted.record.oriented = 19;
        study::Individual empty = winnerOf(1);
        empty.record.finished = 0;
        empty.record.oriented = 0;
        WinnerModel model;
        model.setWinners({sorted, empty});
        QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
        model.setForgiving(true);
        model.setForgiving(true);
        QCOMPARE(changed.count(), 1);
        QCOMPARE(model.index(0).data(models::SuccessRole).toString(), QString("95 %"));
        QVERIFY(model.index(0).data(Qt::ToolTipRole).toString().contains("correct 95.0 %"));
        QVERIFY(model.index(0).data(Qt::ToolTipRole).toString().contains("20 of 100 parts finished"));
        QCOMPARE(model.index(1).data(models::SuccessRole).toString(), QString("–"));
        model.setForgiving(false);
        QCOMPARE(model.index(0).data(models::SuccessRole).toString(), QString("19 %"));
    }

    void picturesStayWithTheirGeneration() {
        WinnerModel model;
        model.setWinners({winnerOf(0), winnerOf(1)});
        QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
        QPixmap picture(8, 8);
        picture.fill(Qt::red);
        model.setPicture(1, picture);
        model.setPicture(9, picture);  // of no winner that is there
        QCOMPARE(changed.count(), 1);
        QVERIFY(model.hasPicture(1));
        QVERIFY(!model.hasPicture(9));
        QVERIFY(model.index(1).data(Qt::DecorationRole).isValid());
        QVERIFY(!model.index(0).data(Qt::DecorationRole).isValid());
        model.setWinners({winnerOf(1)});
        QVERIFY(!model.hasPicture(1));
    }

    // Thousands of generations must not fill the memory with pictures that nobody looks at.
    void onlyPicturesThatWereSeenLastAreKept() {
        constexpr int kMost = WinnerModel::kMostPictures;
        std::vector<study::Individual> winners;
        winners.reserve(kMost + 10);
        for (int i = 0; i < kMost + 10; ++i)
            winners.push_back(winnerOf(i));
        WinnerModel model;
        model.setWinners(std::move(winners));
        const QPixmap picture(8, 8);
        for (int i = 0; i < kMost; ++i)
            model.setPicture(i, picture);
        QVERIFY(model.index(0).data(Qt::DecorationRole).isValid());  // it is looked at
        for (int i = kMost; i < kMost + 10; ++i)
            model.setPicture(i, picture);
        QVERIFY(model.hasPicture(0) && model.hasPicture(kMost + 9));
        for (int i = 1; i <= 10; ++i)
            QVERIFY(!model.hasPicture(i));
        QVERIFY(model.hasPicture(11));
    }
};

QTEST_MAIN(WinnerModelTest)
#include "winner_model_test.moc"
