#include "core/study/physical_table.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>

using namespace trapwright;
using study::PhysicalOutcome;
using study::PhysicalValidation;
using study::ValidationRecord;

namespace {

/// So many of each pose on the feeder, the first ones failed.
PhysicalValidation physical(const std::vector<int>& failures, int trials) {
    PhysicalValidation validation;
    validation.plan.repetitions = trials;
    for (std::size_t pose = 0; pose < failures.size(); ++pose) {
        validation.plan.poses.push_back(static_cast<int>(pose));
        for (int i = 0; i < trials; ++i) {
            study::PhysicalTrial trial;
            trial.number = static_cast<int>(validation.trials.size());
            trial.pose = static_cast<int>(pose);
            if (i < failures[pose]) trial.outcome = PhysicalOutcome::wrongOrientation;
            validation.trials.push_back(trial);
        }
    }
    return validation;
}

ValidationRecord simulated(const std::vector<int>& failures, int trials) {
    ValidationRecord record;
    for (std::size_t pose = 0; pose < failures.size(); ++pose)
        record.rows.push_back({static_cast<int>(pose), trials, failures[pose], failures[pose], 0, 0});
    return record;
}

bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

class PhysicalTableTest : public QObject {
    Q_OBJECT

 private slots:
    void everyPoseHasItsRepetitions() {
        const study::PhysicalPlan plan{{0, 2, 5}, 3};
        QCOMPARE(study::orderOfTrials(plan), (std::vector<int>{0, 0, 0, 2, 2, 2, 5, 5, 5}));
        study::PhysicalPlan shuffled{{0, 1, 2, 3, 4, 5}, 100, true, 11};
        const std::vector<int> order = study::orderOfTrials(shuffled);
        QCOMPARE(order, study::orderOfTrials(shuffled));
        QCOMPARE(order.size(), std::size_t{600});
        std::map<int, int> counts;
        for (const int pose : order)
            ++counts[pose];
        for (const int pose : shuffled.poses)
            QCOMPARE(counts[pose], 100);
        // Each pose has about half of its trials in the first half: 50 with a deviation of 4.6.
        for (const int pose : shuffled.poses)
            QVERIFY(std::abs(std::count(order.begin(), order.begin() + 300, pose) - 50) < 23);
        shuffled.seed = 12;
        QVERIFY(order != study::orderOfTrials(shuffled));
        QVERIFY(study::orderOfTrials({{}, 100, true, 1}).empty());
    }

    // So that a study that is gone on with elsewhere has the same plan.
    void orderIsForEver() {
        const study::PhysicalPlan plan{{0, 1, 2}, 4, true, 1};
        const std::vector<int> order = study::orderOfTrials(plan);
        PhysicalValidation validation;
        validation.plan = plan;
        for (const int pose : order) {
            QCOMPARE(study::nextPose(validation).value(), pose);
            study::PhysicalTrial& trial = validation.trials.emplace_back();
            trial.pose = pose;
        }
        QVERIFY(!study::nextPose(validation));
        QCOMPARE(order, (std::vector<int>{0, 1, 2, 0, 2, 1, 2, 0, 2, 0, 1, 1}));
    }

    void outcomesHaveNames() {
        for (const PhysicalOutcome outcome : {PhysicalOutcome::success, PhysicalOutcome::wrongOrientation,
                                              PhysicalOutcome::stuck, PhysicalOutcome::fellOff})
            QVERIFY(study::physicalOutcomeOf(study::nameOf(outcome)) == outcome);
        QVERIFY(!study::physicalOutcomeOf("lost"));
    }

    // The paper's Table 2.
    void cuboid() {
        const ValidationRecord record = simulated({0, 10, 5, 9, 7, 7}, 1000);
        const study::PhysicalTable table = study::comparePhysical(&record, physical({0, 0, 0, 0, 0, 0}, 100));
        QCOMPARE(table.rows.size(), std::size_t{6});
        QCOMPARE(table.total.simulated.failures, 38);
        QCOMPARE(table.total.simulated.trials, 6000);
        QCOMPARE(table.total.physical.trials, 600);
        QCOMPARE(table.total.physical.failures, 0);
        QVERIFY(std::abs(table.total.physical.bounds.low - 0.9939) < 5e-5);
        for (const study::PhysicalRow& row : table.rows)
            QVERIFY(row.p.value() > 0.2);
        // Fisher's test of the pooled totals gives 0.0452; with as many trials in each pose strata change
        // little.
        QVERIFY2(std::abs(table.total.p.value() - 0.0452) < 0.004,
                 qPrintable(QString::number(*table.total.p)));
        QVERIFY2(contains(table.verdict, "600 of 600") && contains(table.verdict, "better"),
                 table.verdict.c_str());
        const std::string text = study::formatPhysical(table);
        QVERIFY2(contains(text, "99.4 %") && contains(text, "100.0 %") && contains(text, "Total"),
                 text.c_str());
    }

    // Table 3.
    void cone() {
        const ValidationRecord record = simulated({25, 40, 37, 24}, 1000);
        const study::PhysicalTable table = study::comparePhysical(&record, physical({1, 3, 2, 0}, 100));
        QVERIFY(std::abs(table.total.physical.bounds.low - 0.9676) < 5e-5);
        QVERIFY(std::abs(table.total.physical.bounds.high - 0.9945) < 5e-5);
        QVERIFY2(std::abs(table.total.p.value() - 0.0652) < 0.008,
                 qPrintable(QString::number(*table.total.p)));
        QVERIFY2(contains(table.verdict, "no difference"), table.verdict.c_str());
    }

    void oneBadPoseIsNamed() {
        const ValidationRecord record = simulated({10, 10, 10}, 1000);
        const study::PhysicalTable table = study::comparePhysical(&record, physical({1, 60, 1}, 100));
        QVERIFY(table.total.p.value() < 0.001 && table.rows[1].p.value() < 0.001);
        QVERIFY2(contains(table.verdict, "worse") && contains(table.verdict, "less than 0.001") &&
                     contains(table.verdict, "poses differ from simulation: 2."),
                 table.verdict.c_str());
    }

    // Pose after pose the first pose is done long before the others; the total must not take the mixture for
    // a difference.
    void holdsBeforeEveryPoseHasItsShare() {
        const ValidationRecord record = simulated({0, 500}, 1000);
        PhysicalValidation half = physical({0, 50}, 100);
        half.trials.resize(110);  // 100 of pose 1; 10 failures of pose 2
        for (std::size_t i = 105; i < 110; ++i)
            half.trials[i].outcome = PhysicalOutcome::success;
        const study::PhysicalTable table = study::comparePhysical(&record, half);
        QVERIFY(table.total.p.value() > 0.9);
        QCOMPARE(table.total.planned, 200);
        QVERIFY2(contains(table.verdict, "no difference"), table.verdict.c_str());
    }

    void oneSideAlone() {
        const study::PhysicalTable nothing = study::comparePhysical(nullptr, physical({}, 0));
        QVERIFY(!nothing.total.p && contains(nothing.verdict, "No part"));
        const study::PhysicalTable alone = study::comparePhysical(nullptr, physical({1}, 10));
        QVERIFY(!alone.total.p && !alone.rows[0].p);
        QVERIFY2(contains(alone.verdict, "9 of 10") && contains(alone.verdict, "nothing to compare"),
                 alone.verdict.c_str());
        const ValidationRecord record = simulated({10}, 1000);
        const study::PhysicalTable one = study::comparePhysical(&record, physical({1}, 10));
        QCOMPARE(one.total.p.value(), one.rows[0].p.value());
    }

    void newestSimulationOfThePrintedTrack() {
        std::vector<ValidationRecord> records(3);
        records[0].generation = records[1].generation = 7;
        records[1].engine = "newer";
        records[2].generation = 8;
        PhysicalValidation validation;
        validation.generation = 7;
        QCOMPARE(study::findSimulated(records, validation)->engine, std::string("newer"));
        validation.individual = 3;
        QVERIFY(study::findSimulated(records, validation) == nullptr);
    }

    void virtualTrialsAreNamedAsSuch_data() {
        QTest::addColumn<int>("virtualOnes");
        QTest::addColumn<int>("real");
        QTest::addColumn<int>("unknown");
        QTest::addColumn<QString>("notice");
        QTest::newRow("real") << 0 << 20 << 0 << "";
        QTest::newRow("virtual") << 20 << 0 << 0 << "Made with the virtual feeder, for training";
        QTest::newRow("mixed") << 12 << 8 << 0 << "Mixed: 12 trials were made with the virtual feeder";
        QTest::newRow("mixed, real") << 19 << 1 << 0 << "1 trial was made on a real feeder.";
        QTest::newRow("unknown") << 0 << 0 << 20 << "20 trials were made by an older version";
        QTest::newRow("virtual and unknown") << 1 << 0 << 19 << "Mixed: 1 trial was made with the virtual";
        QTest::newRow("real and unknown") << 0 << 18 << 2 << "2 trials were made by an older version";
    }
    void virtualTrialsAreNamedAsSuch() {
        QFETCH(int, virtualOnes);
        QFETCH(int, real);
        QFETCH(int, unknown);
        QFETCH(QString, notice);
        PhysicalValidation validation = physical({0, 0}, 10);
        for (int i = 0; i < 20; ++i) {
            validation.trials[static_cast<std::size_t>(i)].feeder =
                i < virtualOnes          ? study::FeederKind::virtualFeeder
                : i < virtualOnes + real ? study::FeederKind::real
                                         : study::FeederKind::unknown;
        }
        const study::PhysicalTable table = study::comparePhysical(nullptr, validation);
        QCOMPARE(table.feeders.unknown, unknown);
        QCOMPARE(table.notice.empty(), notice.isEmpty());
        QVERIFY2(contains(table.notice, notice.toUtf8().constData()), table.notice.c_str());
        QCOMPARE(contains(table.verdict, "on the virtual feeder"), virtualOnes == 20);
        if (!table.notice.empty()) QCOMPARE(study::formatPhysical(table).find(table.notice), std::size_t{0});
    }

    void expectedPoseIsOfTheNewestResult() {
        const base::Quaternion one(Eigen::AngleAxisd(0.5, base::Vec3::UnitX()));
        const base::Quaternion two(Eigen::AngleAxisd(1.0, base::Vec3::UnitY()));
        std::vector<study::SelectionRecord> selections(1);
        selections[0].entries.resize(1);
        selections[0].entries[0].generation = 3;
        selections[0].entries[0].individual = 7;
        selections[0].entries[0].modalOrientation = one;
        QVERIFY(!study::findExpected({}, {}, 3, 7));
        // None finished: their most frequent orientation says nothing.
        QVERIFY(!study::findExpected({}, selections, 3, 7));
        selections[0].entries[0].finished = 5;
        QVERIFY(!study::findExpected({}, selections, 3, 8));
        QVERIFY(study::findExpected({}, selections, 3, 7)->coeffs() == one.coeffs());
        std::vector<ValidationRecord> validations(2);
        validations[0].generation = 3;
        validations[0].individual = 7;
        validations[0].expectedOrientation = two;
        QVERIFY(study::findExpected(validations, selections, 3, 7)->coeffs() == two.coeffs());
    }

    void csvCanBeReadAgain() {
        const ValidationRecord record = simulated({3, 4}, 100);
        PhysicalValidation validation = physical({1, 0}, 2);
        validation.trials[0].note = "slow, \"humming\"";
        validation.trials[0].time = "2026-03-31T12:00:00Z";
        validation.trials[0].setPoint = 0.5;
        const std::string table = study::physicalTableCsv(study::comparePhysical(&record, validation));
        QCOMPARE(std::count(table.begin(), table.end(), '\n'), 4);
        const auto columns = [](const std::string& line) {
            return std::count(line.begin(), line.end(), ',');
        };
        const std::string heading = table.substr(0, table.find('\n'));
        QCOMPARE(columns(table), 4 * columns(heading));
        QVERIFY2(contains(table, "\n1,100,3,97,3,0,0,"), table.c_str());
        const std::string trials = study::physicalTrialsCsv(validation);
        QVERIFY2(contains(trials,
                          "\n1,1,wrong-orientation,0,50,0,2026-03-31T12:00:00Z,\"slow, "
                          "\"\"humming\"\"\",unknown,,\n"),
                 trials.c_str());
        QCOMPARE(std::count(trials.begin(), trials.end(), '\n'), 5);
    }
};

QTEST_APPLESS_MAIN(PhysicalTableTest)
#include "physical_table_test.moc"
