#include "ui/feeder/physical_model.h"

#include <QAbstractItemModelTester>
#include <QtTest>

#include "ui/models/csv.h"

using namespace trapwright;
using feeder::PhysicalModel;

class PhysicalModelTest : public QObject {
    Q_OBJECT

 private slots:
    void itIsAProperModel() {
        PhysicalModel model;
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        study::PhysicalValidation physical = plan();
        model.setTable(study::comparePhysical(nullptr, physical, {}));
        add(physical, 3, trial::Verdict::success);
        model.setTable(study::comparePhysical(nullptr, physical, {}));
        model.clear();
        QCOMPARE(model.rowCount(), 0);
    }

    // 394 of 400 gives 96.76 ... 99.45 % by Clopper and Pearson (1934), 397 of 400 97.82 ... 99.85 %.
    void itShowsBothSidesAndTheirBounds() {
        study::PhysicalValidation physical = plan();
        physical.plan.repetitions = 200;
        add(physical, 397, trial::Verdict::success);
        add(physical, 1, trial::Verdict::wrongOrientation);
        add(physical, 2, trial::Verdict::fellOff);
        add(physical, 0, trial::Verdict::stuck);
        study::ValidationRecord simulated;
        simulated.rows = {{0, {197, 3, 0, 0}}, {1, {197, 0, 3, 0}}};
        const std::vector<part::PoseGroup> groups = {{{0}, 0.9}, {{1}, 0.1}};
        PhysicalModel model;
        model.setTable(study::comparePhysical(&simulated, physical, groups));
        QCOMPARE(model.rowCount(), 4);
        QCOMPARE(model.index(2, PhysicalModel::Pose).data().toString(), QString("Weighted"));
        QCOMPARE(model.index(2, PhysicalModel::Trials).data().toString(), QString());
        // All three failures are of the second pose, in which one part of ten lands.
        QCOMPARE(model.index(2, PhysicalModel::Success).data().toString(), QString("99.9"));
        const auto total = [&](int column) { return model.index(3, column).data().toString(); };
        QCOMPARE(total(PhysicalModel::Pose), QString("All alike"));
        QCOMPARE(total(PhysicalModel::SimulatedTrials), QString("400"));
        QCOMPARE(total(PhysicalModel::SimulatedFailures), QString("6"));
        QCOMPARE(total(PhysicalModel::SimulatedSuccess), QString("98.5"));
        QCOMPARE(total(PhysicalModel::SimulatedBounds), QString("96.8 … 99.4"));
        QCOMPARE(total(PhysicalModel::Trials), QString("400"));
        QCOMPARE(total(PhysicalModel::Planned), QString("400"));
        QCOMPARE(total(PhysicalModel::Failures), QString("3"));
        QCOMPARE(total(PhysicalModel::FellOff), QString("2"));
        QVERIFY(!total(PhysicalModel::Difference).isEmpty());
        QCOMPARE(total(PhysicalModel::Bounds), QString("97.8 … 99.8"));
        QVERIFY(model.headerData(PhysicalModel::Bounds, Qt::Horizontal, Qt::ToolTipRole)
                    .toString()
                    .contains("95 % Clopper-Pearson"));
        const QString csv = models::toCsv(model);
        QVERIFY(csv.contains("98.5"));
        QVERIFY2(csv.startsWith("Pose,Sim. T,F,P [%],\"Simulated success, 95 % Clopper-Pearson low [%]\","
                                "\"Simulated success, 95 % Clopper-Pearson high [%]\",Feeder T,"),
                 qPrintable(csv));
        QVERIFY2(csv.contains(",96.76387055") && csv.contains(",99.447589"), qPrintable(csv));
    }

    void withoutTrialsThereAreDashes() {
        PhysicalModel model;
        model.setTable(study::comparePhysical(nullptr, plan(), {}));
        QCOMPARE(model.index(0, PhysicalModel::Success).data().toString(), QString("–"));
        QCOMPARE(model.index(0, PhysicalModel::SimulatedBounds).data().toString(), QString("–"));
        QCOMPARE(model.index(0, PhysicalModel::Difference).data().toString(), QString("–"));
    }

 private:
    static study::PhysicalValidation plan() {
        study::PhysicalValidation physical;
        physical.plan.poses = {0, 1};
        physical.plan.repetitions = 5;
        return physical;
    }
    static void add(study::PhysicalValidation& physical, int count, trial::Verdict outcome) {
        const std::vector<int> order = study::orderOfTrials(physical.plan);
        for (int i = 0; i < count; ++i) {
            study::PhysicalTrial trial;
            trial.number = static_cast<int>(physical.trials.size());
            trial.pose = order[physical.trials.size()];
            trial.outcome = outcome;
            physical.trials.push_back(trial);
        }
    }
};

QTEST_GUILESS_MAIN(PhysicalModelTest)

#include "physical_model_test.moc"
