#include <QAbstractItemModelTester>
#include <QFont>
#include <QSignalSpy>
#include <QtTest>

#include "core/part/part_builder.h"
#include "core/part/shapes.h"
#include "core/workflow/study_trials.h"
#include "tests/core/objectives/paper_fitness.h"
#include "tests/ui/sample_records.h"
#include "ui/models/csv.h"
#include "ui/models/generation_model.h"
#include "ui/models/individual_model.h"
#include "ui/models/selection_model.h"
#include "ui/models/validation_model.h"

using namespace trapwright;
using models::GenerationModel;
using models::IndividualModel;
using models::SelectionModel;
using models::ValidationModel;

namespace {

constexpr auto kFatal = QAbstractItemModelTester::FailureReportingMode::QtTest;

QString textAt(const QAbstractItemModel& model, int row, int column) {
    return model.index(row, column).data().toString();
}

/// The column of that title.
int columnOf(const QAbstractItemModel& model, const QString& title) {
    for (int column = 0; column < model.columnCount(); ++column)
        if (model.headerData(column, Qt::Horizontal).toString() == title) return column;
    return -1;
}

double valueAt(const QAbstractItemModel& model, int row, int column) {
    return model.index(row, column).data(models::ValueRole).toDouble();
}

/// An individual of these strategy values.
study::IndividualRecord individual(double fitness, const std::vector<double>& strategy) {
    study::IndividualRecord record;
    record.fitness = testing::paperFitness(-1.0, -0.5, fitness);
    record.fitness.scores.push_back({"conveying_speed", 0.05, 0.002});
    record.traits = {{"p_x", strategy[0]}, {"p_dm", strategy[1]}, {"p_s", strategy[2]}};
    record.trials = 10;
    record.finished = 7;
    record.stuck = 2;
    record.fellOff = 1;
    record.oriented = 6;
    return record;
}

/// Table 2 of the paper, the cube's simulation column.
study::ValidationTable paperTable(const std::vector<part::PoseGroup>& groups = {}) {
    study::ValidationRecord record;
    const std::vector<int> failures = {0, 10, 5, 9, 7, 7};
    for (int pose = 0; pose < 6; ++pose) {
        const int failed = failures[static_cast<std::size_t>(pose)];
        record.rows.push_back({pose, {1000 - failed, failed, 0, 0}});
    }
    return study::tabulate(record, groups);
}

}  // namespace

class RecordModelsTest : public QObject {
    Q_OBJECT

 private slots:
    void generationsGrowAndAreChecked() {
        GenerationModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setGenerations({sample::summary(0), sample::summary(1)}, {sample::check(1, 10, 9)},
                             search::describeMethod(search::Method::genetic));
        QCOMPARE(model.rowCount(), 2);
        QCOMPARE(textAt(model, 0, GenerationModel::ReferenceSuccess), QString());
        QCOMPARE(textAt(model, 1, GenerationModel::ReferenceSuccess), QString("90.0"));

        QSignalSpy inserted(&model, &QAbstractItemModel::rowsInserted);
        QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
        QSignalSpy reset(&model, &QAbstractItemModel::modelReset);
        model.append(sample::summary(2));
        model.setCheck(sample::check(2, 8, 7));
        model.setCheck(sample::check(7, 1, 1));  // of no generation that is there
        QCOMPARE(inserted.count(), 1);
        QCOMPARE(changed.count(), 1);
        QCOMPARE(reset.count(), 0);
        QCOMPARE(textAt(model, 2, GenerationModel::LearningSuccess), QString("80.0"));
        QCOMPARE(model.index(2, GenerationModel::ReferenceSuccess).data(Qt::ToolTipRole).toString(),
                 QString("simbody: 7 of 10 parts"));
        QCOMPARE(model.index(2, 0).data(models::IndividualRole).toInt(), 5);
    }

    void generationShowsItsNumbers() {
        GenerationModel model;
        model.setGenerations({sample::summary(4, 0.75)}, {}, search::describeMethod(search::Method::genetic));
        QCOMPARE(textAt(model, 0, GenerationModel::Generation), QString("4"));
        QCOMPARE(textAt(model, 0, GenerationModel::firstDetail()), QString("-1.500"));
        QCOMPARE(textAt(model, 0, columnOf(model, "F_C")), QString("-2"));
        QCOMPARE(textAt(model, 0, columnOf(model, "p_dm")), QString("0.0100"));
        QCOMPARE(valueAt(model, 0, columnOf(model, "Mean F of top 30 %")), -4.0 - 0.5 + 0.375);
        QVERIFY(!model.headerData(columnOf(model, "F_O [√rad]"), Qt::Horizontal, Qt::ToolTipRole)
                     .toString()
                     .isEmpty());
    }

    void successIsKnownOrADash() {
        GenerationModel model;
        study::GenerationSummary old = sample::summary(1);
        old.statistics.success.reset();
        old.statistics.topSuccess.reset();
        model.setGenerations({sample::summary(0), old}, {}, search::describeMethod(search::Method::genetic));
        QCOMPARE(textAt(model, 0, GenerationModel::Success), QString("85.0"));
        QCOMPARE(textAt(model, 0, GenerationModel::Bounds), QString("62.1 … 96.8"));
        QCOMPARE(textAt(model, 0, GenerationModel::TopSuccess), QString("50.0"));
        for (const int column :
             {GenerationModel::Success, GenerationModel::Bounds, GenerationModel::TopSuccess}) {
            QCOMPARE(textAt(model, 1, column), QString("–"));
            QVERIFY(!model.index(1, column).data(models::ValueRole).isValid());
        }
        QVERIFY(model.index(0, GenerationModel::Bounds)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .contains("17 of 20 parts finished in the expected orientation; 95 % Clopper-Pearson"));
        QVERIFY(model.index(1, GenerationModel::Success)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .startsWith("Not known"));
        // Both bounds are in CSV, and which they are; nothing where they are not known.
        const QStringList lines = models::toCsv(model).split('\n');
        QVERIFY2(lines[0].startsWith("Generation,Winner,Success [%],\"Success, 95 % Clopper-Pearson low "
                                     "[%]\",\"Success, 95 % Clopper-Pearson high [%]\",Top 30 % [%],"),
                 qPrintable(lines[0]));
        QVERIFY2(lines[1].startsWith("0,3,85,62.107317") && lines[1].contains(",96.792906"),
                 qPrintable(lines[1]));
        QVERIFY2(lines[2].startsWith("1,4,,,,,"), qPrintable(lines[2]));
    }

    void smallNegativeNumbersAreNotMinusNothing() {
        GenerationModel model;
        study::GenerationSummary summary = sample::summary(0);
        summary.statistics.best = testing::paperFitness(-0.0, -1e-9, 1.0);
        model.setGenerations({summary}, {}, search::describeMethod(search::Method::genetic));
        QCOMPARE(textAt(model, 0, columnOf(model, "F_C")), QString("0"));
        QCOMPARE(textAt(model, 0, columnOf(model, "F_D [segments]")), QString("0.000"));
    }

    void individualsShowTheirTraits() {
        study::GenerationRecord record;
        record.index = 12;
        record.winner = 1;
        record.individuals = {individual(0.1, {0.25, 0.002, 0.3}), individual(0.9, {1.0, 0.5, 0.5})};
        IndividualModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setGeneration(record, search::describeMethod(search::Method::genetic));
        QCOMPARE(model.rowCount(), 2);
        const int columns = model.columnCount();
        QCOMPARE(textAt(model, 0, columnOf(model, "p_x")), QString("0.2500"));
        QCOMPARE(textAt(model, 0, columnOf(model, "p_dm")), QString("0.0020"));
        QCOMPARE(textAt(model, 0, columnOf(model, "p_s")), QString("0.3000"));
        QCOMPARE(columnOf(model, "p_s"), columns - 1);
        // Disorder, sorting, the correct share and speed are for everybody, the paper's scores are details.
        QCOMPARE(columnOf(model, "Disorder [bit]"), int(IndividualModel::FirstScore));
        QCOMPARE(columnOf(model, "Speed [mm/s]"), IndividualModel::FirstScore + 3);
        QCOMPARE(textAt(model, 0, IndividualModel::FirstScore + 3), QString("50.0"));
        QCOMPARE(columnOf(model, "F"), IndividualModel::firstDetail());
        QVERIFY(columnOf(model, "F_C") > IndividualModel::firstDetail());
        QCOMPARE(textAt(model, 0, IndividualModel::Stuck), QString("2"));
        QCOMPARE(textAt(model, 0, IndividualModel::Finished), QString("7"));
        QCOMPARE(textAt(model, 0, IndividualModel::Success), QString("60.0"));
        QCOMPARE(valueAt(model, 0, IndividualModel::Success), 60.0);
        QVERIFY(!model.index(0, 0).data(models::IsWinnerRole).toBool());
        QVERIFY(model.index(1, 0).data(models::IsWinnerRole).toBool());
        QVERIFY(model.index(1, 0).data(Qt::FontRole).value<QFont>().bold());
        QCOMPARE(model.index(1, 0).data(models::GenerationRole).toInt(), 12);
        model.clear();
        QCOMPARE(model.rowCount(), 0);
        // A study that is searched otherwise.
        model.setGeneration(record, search::describeMethod(search::Method::random));
        QCOMPARE(model.columnCount(), columns - 3);
        model.setGeneration(record,
                            search::describeMethod(search::Method::genetic, search::ga::StrategyScope::gene));
        QCOMPARE(model.columnCount(), columns + 4);
    }

    void individualsAreSortedByNumber() {
        study::GenerationRecord record;
        for (const double fitness : {0.5, 10.0, -3.0, 9.0})
            record.individuals.push_back(individual(fitness, {0.0, 0.0, 0.0}));
        IndividualModel model;
        model.setGeneration(record, search::describeMethod(search::Method::genetic));
        QSortFilterProxyModel sorted;
        sorted.setSourceModel(&model);
        sorted.setSortRole(models::ValueRole);
        sorted.sort(IndividualModel::firstDetail(), Qt::DescendingOrder);
        QStringList order;
        for (int row = 0; row < 4; ++row)
            order.append(textAt(sorted, row, IndividualModel::Individual));
        QCOMPARE(order, (QStringList{"1", "3", "0", "2"}));  // as text 9 would come before 10
    }

    void validationIsThePapersTable() {
        ValidationModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setValidation(paperTable());
        QCOMPARE(model.rowCount(), 7);
        QCOMPARE(textAt(model, 0, ValidationModel::Pose), QString("1"));
        QCOMPARE(textAt(model, 1, ValidationModel::Success), QString("99.0"));
        QCOMPARE(textAt(model, 6, ValidationModel::Pose), QString("All alike"));
        QCOMPARE(textAt(model, 6, ValidationModel::Trials), QString("6000"));
        QCOMPARE(textAt(model, 6, ValidationModel::Failures), QString("38"));
        QCOMPARE(textAt(model, 6, ValidationModel::Success), QString("99.4"));
        QCOMPARE(model.totals(), 1);
        QVERIFY(model.index(6, 0).data(Qt::FontRole).value<QFont>().bold());
    }

    void boundsAreThoseOfClopperAndPearson() {
        ValidationModel model;
        model.setValidation(paperTable());
        // All of n succeed: (alpha / 2)^(1/n).
        const double low = 100.0 * std::pow(0.025, 1.0 / 1000.0);
        QVERIFY(std::abs(valueAt(model, 0, ValidationModel::Bounds) - low) < 1e-4);
        QVERIFY(model.headerData(ValidationModel::Bounds, Qt::Horizontal, Qt::ToolTipRole)
                    .toString()
                    .contains("95 % Clopper-Pearson"));
        QCOMPARE(textAt(model, 0, ValidationModel::Bounds), QString("99.6 … 100.0"));
    }

    // A condition shows its worst quarter, and opens to all four; each knows whose trials it counts, and
    // totals stay last.
    void validationsTellConditions() {
        ValidationModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        constexpr auto kStroke = trial::Condition::halfStroke;
        model.setConditions({{kStroke,
                              {{{kStroke, 0.0, 0.25}, 0.7e-3, 0.75e-3, {99, 1, 0, 0}},
                               {{kStroke, 0.25, 0.5}, 0.75e-3, 0.8e-3, {100, 0, 0, 0}},
                               {{kStroke, 0.5, 0.75}, 0.8e-3, 0.85e-3, {90, 4, 6, 0}},
                               {{kStroke, 0.75, 1.0}, 0.85e-3, 0.9e-3, {95, 5, 0, 0}}}}});
        QCOMPARE(model.rowCount(), 0);  // of what?
        model.setValidation(paperTable());
        QCOMPARE(model.rowCount(), 8);
        QCOMPARE(textAt(model, 6, ValidationModel::Pose), QString("Half-stroke 0.800…0.850 mm"));
        QCOMPARE(textAt(model, 6, ValidationModel::Success), QString("90.0"));
        QCOMPARE(textAt(model, 6, ValidationModel::Stuck), QString("6"));
        QVERIFY((model.rows()[6].slice == study::BoxSlice{kStroke, 0.5, 0.75}));
        QVERIFY(!model.rows()[5].slice);
        model.toggle(6);
        QCOMPARE(model.rowCount(), 12);
        QCOMPARE(textAt(model, 7, ValidationModel::Pose).trimmed(), QString("0.700…0.750 mm"));
        QCOMPARE(textAt(model, 10, ValidationModel::Success), QString("95.0"));
        QCOMPARE(textAt(model, 11, ValidationModel::Pose), QString("All alike"));
        QVERIFY(!model.index(7, 0).data(Qt::FontRole).value<QFont>().bold());
        model.toggle(6);
        model.setConditions({});
        QCOMPARE(model.rowCount(), 7);
    }

    // The cuboid's opposite faces look the same.
    void alikePosesAreOneRowThatOpens() {
        ValidationModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setValidation(paperTable({{{0, 1}, 0.645}, {{2, 3}, 0.243}, {{4, 5}, 0.112}}));
        QCOMPARE(model.rowCount(), 5);
        QCOMPARE(model.totals(), 2);
        QCOMPARE(textAt(model, 0, ValidationModel::Pose), QString("1–2"));
        QCOMPARE(textAt(model, 0, ValidationModel::Weight), QString("64.5"));
        QCOMPARE(textAt(model, 0, ValidationModel::Trials), QString("2000"));
        QCOMPARE(textAt(model, 1, ValidationModel::Failures), QString("14"));
        QCOMPARE(textAt(model, 3, ValidationModel::Pose), QString("Weighted"));
        QCOMPARE(textAt(model, 3, ValidationModel::Trials), QString());
        const double rate = 100.0 * (1.0 - 0.645 * 0.005 - 0.355 * 0.007);
        QVERIFY(std::abs(valueAt(model, 3, ValidationModel::Success) - rate) < 1e-9);
        QVERIFY(valueAt(model, 3, ValidationModel::Bounds) < rate);
        QVERIFY(model.index(3, 0).data(Qt::ToolTipRole).toString().contains("weighted by how often"));
        QCOMPARE(textAt(model, 4, ValidationModel::Failures), QString("38"));

        model.toggle(1);
        QCOMPARE(model.rowCount(), 7);
        QCOMPARE(textAt(model, 2, ValidationModel::Pose).trimmed(), QString("3"));
        QCOMPARE(textAt(model, 3, ValidationModel::Failures), QString("9"));
        QCOMPARE(model.rows()[3].poses, std::vector<int>{3});
        model.toggle(3);  // one pose does not open
        QCOMPARE(model.rowCount(), 7);
        model.setValidation(paperTable({{{0, 1}, 0.645}, {{2, 3}, 0.243}, {{4, 5}, 0.112}}));
        QCOMPARE(model.rowCount(), 7);  // what is open stays open
        model.toggle(1);
        QCOMPARE(model.rowCount(), 5);
    }

    void failedCountsLeadToTheirTrials() {
        ValidationModel model;
        model.setValidation(paperTable());
        const auto verdictAt = [&](int column) {
            return model.index(2, column).data(models::VerdictRole).toInt();
        };
        QCOMPARE(verdictAt(ValidationModel::WrongOrientation),
                 static_cast<int>(trial::Verdict::wrongOrientation));
        QCOMPARE(verdictAt(ValidationModel::Stuck), static_cast<int>(trial::Verdict::stuck));
        QCOMPARE(verdictAt(ValidationModel::FellOff), static_cast<int>(trial::Verdict::fellOff));
        QCOMPARE(verdictAt(ValidationModel::Trials), -1);
        QCOMPARE(model.rows()[2].poses, std::vector<int>{2});
    }

    void withoutTrialsThereIsNoRate() {
        study::ValidationRecord record;
        record.rows.push_back({});
        ValidationModel model;
        model.setValidation(study::tabulate(record, {}));
        QCOMPARE(textAt(model, 0, ValidationModel::Success), QString("–"));
        QCOMPARE(textAt(model, 0, ValidationModel::Bounds), QString("–"));
        QVERIFY(!model.index(0, ValidationModel::Success).data(models::ValueRole).isValid());
    }

    void rightOnesOfThoseThatArriveHaveARow() {
        study::ValidationRecord record;
        record.rows = {{0, {600, 20, 0, 380}}};
        ValidationModel model;
        model.setValidation(study::tabulate(record, std::vector<part::PoseGroup>{{{0}, 1.0}}));
        QCOMPARE(model.rowCount(), 4);
        QCOMPARE(model.totals(), 3);
        QCOMPARE(textAt(model, 2, ValidationModel::Pose), QString("Correct"));
        QCOMPARE(textAt(model, 2, ValidationModel::Success), QString("96.8"));
        QCOMPARE(textAt(model, 2, ValidationModel::Trials), QString());
        QVERIFY(model.index(2, ValidationModel::Pose).data(Qt::ToolTipRole).toString().contains("arrive"));
    }

    void worstCornersOfWhatWasMeasured() {
        study::SelectionRecord record{"simbody", {}};
        record.entries.push_back({{4, 1}, testing::paperFitness(0.0, 0.0, 0.8), 100, 100, 99, trial::Goal()});
        record.entries.push_back({{3, 2}, testing::paperFitness(0.0, 0.0, 0.8), 100, 100, 98, trial::Goal()});
        study::RobustnessRecord other{{3, 1}, "native", {}, {}};
        study::RobustnessRecord known{{3, 2}, "native", {}, {}};
        for (const int success : {281, 290}) {  // the worst comes first
            study::PlaceResult corner;
            corner.tally = {success, 300 - success, 0, 0};
            known.robustness.corners.push_back(corner);
        }
        const std::vector<study::RobustnessRecord> measured = {other, known};
        SelectionModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setSelection(record, measured);
        QCOMPARE(textAt(model, 0, SelectionModel::Worst), QString("–"));
        QCOMPARE(textAt(model, 1, SelectionModel::Worst), QString("93.7 (90.3 … 96.1)"));
        const QStringList lines = models::toCsv(model).split('\n');
        QVERIFY2(lines[0].contains("Worst corner [%],\"Worst corner, 95 % Clopper-Pearson low [%]\""),
                 qPrintable(lines[0]));
        QVERIFY2(lines[2].contains(",93.66"), qPrintable(lines[2]));
    }

    void selectionIsRanked() {
        study::SelectionRecord record{"simbody", {}};
        record.entries.push_back(
            {{439, 17}, testing::paperFitness(0.0, -0.01, 0.85), 1000, 1000, 994, trial::Goal(), {456, 480}});
        record.entries.push_back({{12, 3}, testing::paperFitness(0.0, -0.25, 0.5), 0, 0, 0, trial::Goal()});
        SelectionModel model;
        const QAbstractItemModelTester tester(&model, kFatal);
        model.setSelection(record);
        QCOMPARE(textAt(model, 0, SelectionModel::Rank), QString("1"));
        QCOMPARE(textAt(model, 1, SelectionModel::Rank), QString("2"));
        QCOMPARE(textAt(model, 0, SelectionModel::Success), QString("99.4"));
        QCOMPARE(textAt(model, 1, SelectionModel::Success), QString("–"));
        QCOMPARE(textAt(model, 0, SelectionModel::Corners), QString("95.0 (92.7 … 96.8)"));
        QCOMPARE(textAt(model, 1, SelectionModel::Corners), QString("–"));
        QCOMPARE(textAt(model, 0, SelectionModel::Worst), QString("–"));
        const QStringList lines = models::toCsv(model).split('\n');
        QVERIFY2(lines[0].contains("In corners [%],\"In corners, 95 % Clopper-Pearson low [%]\""),
                 qPrintable(lines[0]));
        QVERIFY2(lines[1].contains(",95,92.65"), qPrintable(lines[1]));
        QCOMPARE(model.index(0, 0).data(models::GenerationRole).toInt(), 439);
        QCOMPARE(model.index(0, 0).data(models::IndividualRole).toInt(), 17);
    }

    void tablesBecomeCsv() {
        ValidationModel model;
        model.setValidation(paperTable());
        const QStringList lines = models::toCsv(model).split('\n');
        QCOMPARE(lines.size(), 9);
        QVERIFY(lines[0].startsWith("Pose,Share [%],Trials,Failed,Success [%]"));
        QVERIFY(lines[2].startsWith("2,0,1000,10,99,"));
        QVERIFY(lines[7].startsWith("All alike,,6000,38,"));
    }
};

QTEST_MAIN(RecordModelsTest)
#include "record_models_test.moc"
