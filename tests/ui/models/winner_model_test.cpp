#include "ui/models/winner_model.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>
#include <QtTest>

#include "ui/models/roles.h"

using namespace trapwright;
using models::WinnerModel;

namespace {

study::Winner winnerOf(int generation) {
    study::Winner winner;
    winner.generation = generation;
    winner.individual = 7;
    winner.record.fitness = {0.0, 0.0, 1.25};
    winner.record.trials = 100;
    winner.record.finished = 98;
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
                 QString("Generation 2: F 1.250, 98 of 100 parts finished"));
        QCOMPARE(model.index(2).data(models::IndividualRole).toInt(), 7);
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
};

QTEST_MAIN(WinnerModelTest)
#include "winner_model_test.moc"
