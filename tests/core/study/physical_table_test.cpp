#include "core/study/physical_table.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>

using namespace trapwright;
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
            if (i < failures[pose]) trial.outcome = trial::Verdict::wrongOrientation;
            validation.trials.push_back(trial);
        }
    }
    return validation;
}

ValidationRecord simulated(const std::vector<int>& failures, int trials) {
    ValidationRecord record;
    for (std::size_t pose = 0; pose < failures.size(); ++pose)
        record.rows.push_back({static_cast<int>(pose), {trials - failures[pose], failures[pose], 0, 0}});
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
        for (const trial::Verdict outcome : {trial::Verdict::success, trial::Verdict::wrongOrientation,
                                             trial::Verdict::stuck, trial::Verdict::fellOff})
            QVERIFY(trial::findVerdict(trial::verdictName(outcome)) == outcome);
        QVERIFY(!trial::findVerdict("lost"));
    }

    // The paper's Table 2.
    void cuboid() {
        const ValidationRecord record = simulated({0, 10, 5, 9, 7, 7}, 1000);
        const study::PhysicalTable table =
            study::comparePhysical(&record, physical({0, 0, 0, 0, 0, 0}, 100), {});
        QCOMPARE(table.rows.size(), std::size_t{6});
        QCOMPARE(table.total.simulated.tally.failures(), 38);
        QCOMPARE(table.total.simulated.tally.trials(), 6000);
        QCOMPARE(table.total.physical.tally.trials(), 600);
        QCOMPARE(table.total.physical.tally.failures(), 0);
        QVERIFY(std::abs(table.total.physical.bounds.low - 0.9939) < 5e-5);
        for (const study::PhysicalRow& row : table.rows)
            QVERIFY(row.p.value() > 0.2);
        // Fisher's test of the pooled totals gives 0.0452; with as many trials in each pose strata change
        // little.
        QVERIFY2(std::abs(table.total.p.value() - 0.0452) < 0.004,
                 qPrintable(QString::number(*table.total.p)));
        QVERIFY2(contains(table.summary, "The feeder does better, pose by pose (p = 0.0"),
                 table.summary.c_str());
        QVERIFY2(contains(table.verdict, "600 of 600") && contains(table.verdict, "better"),
                 table.verdict.c_str());
        const std::string text = study::formatPhysical(table);
        QVERIFY2(contains(text, "99.4 %") && contains(text, "100.0 %") && contains(text, "Total, alike"),
                 text.c_str());
    }

    // Where a pose was never simulated there is no weighted rate of the simulation to stand beside the
    // feeder's.
    void aPoseWithoutSimulation() {
        ValidationRecord record = simulated({0, 10, 5}, 1000);
        record.rows[2].tally = {};
        const std::vector<part::PoseGroup> groups = {{{0}, 0.6}, {{1}, 0.3}, {{2}, 0.1}};
        const study::PhysicalTable table = study::comparePhysical(&record, physical({0, 1, 0}, 100), groups);
        QVERIFY2(contains(table.summary, "99.7 % on the feeder") &&
                     contains(table.summary, "99.5 % in simulation."),
                 table.summary.c_str());
    }

    // Table 3.
    void cone() {
        const ValidationRecord record = simulated({25, 40, 37, 24}, 1000);
        const study::PhysicalTable table = study::comparePhysical(&record, physical({1, 3, 2, 0}, 100), {});
        QVERIFY(std::abs(table.total.physical.bounds.low - 0.9676) < 5e-5);
        QVERIFY(std::abs(table.total.physical.bounds.high - 0.9945) < 5e-5);
        QVERIFY2(std::abs(table.total.p.value() - 0.0652) < 0.008,
                 qPrintable(QString::number(*table.total.p)));
        QVERIFY2(contains(table.verdict, "no difference"), table.verdict.c_str());
    }

    void oneBadPoseIsNamed() {
        const ValidationRecord record = simulated({10, 10, 10}, 1000);
        const study::PhysicalTable table = study::comparePhysical(&record, physical({1, 60, 1}, 100), {});
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
            half.trials[i].outcome = trial::Verdict::success;
        const study::PhysicalTable table = study::comparePhysical(&record, half, {});
        QVERIFY(table.total.p.value() > 0.9);
        QCOMPARE(table.total.planned, 200);
        QVERIFY2(contains(table.verdict, "no difference"), table.verdict.c_str());
    }

    void oneSideAlone() {
        const study::PhysicalTable nothing = study::comparePhysical(nullptr, physical({}, 0), {});
        QVERIFY(!nothing.total.p && contains(nothing.verdict, "No part"));
        const study::PhysicalTable alone = study::comparePhysical(nullptr, physical({1}, 10), {});
        QVERIFY(!alone.total.p && !alone.rows[0].p);
        QVERIFY2(contains(alone.verdict, "9 of 10") && contains(alone.verdict, "nothing to compare"),
                 alone.verdict.c_str());
        const ValidationRecord record = simulated({10}, 1000);
        const study::PhysicalTable one = study::comparePhysical(&record, physical({1}, 10), {});
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
        const study::PhysicalTable table = study::comparePhysical(nullptr, validation, {});
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
        selections[0].entries[0].goal = trial::makeGoal(one);
        QVERIFY(!study::findExpected({}, {}, {3, 7}, {}));
        // None finished: their most frequent orientation says nothing.
        QVERIFY(!study::findExpected({}, selections, {3, 7}, {}));
        selections[0].entries[0].finished = 5;
        QVERIFY(!study::findExpected({}, selections, {3, 8}, {}));
        QVERIFY(study::findExpected({}, selections, {3, 7}, {}) == trial::makeGoal(one));
        // What is wanted tells it before anything was simulated.
        const trial::Goal wanted{{{two, true}}};
        QVERIFY(study::findExpected({}, {}, {3, 7}, wanted) == wanted);
        QVERIFY(study::findExpected({}, selections, {3, 7}, wanted) == trial::makeGoal(one));
        std::vector<ValidationRecord> validations(2);
        validations[0].generation = 3;
        validations[0].individual = 7;
        validations[0].goal = trial::makeGoal(two);
        QVERIFY(study::findExpected(validations, selections, {3, 7}, {}) == trial::makeGoal(two));
    }

    void csvCanBeReadAgain() {
        const ValidationRecord record = simulated({3, 4}, 100);
        PhysicalValidation validation = physical({1, 0}, 2);
        validation.trials[0].note = "slow, \"humming\"";
        validation.trials[0].time = "2026-03-31T12:00:00Z";
        validation.trials[0].setPoint = 0.5;
        const std::string table = study::physicalTableCsv(study::comparePhysical(&record, validation, {}));
        QCOMPARE(std::count(table.begin(), table.end(), '\n'), 5);
        const auto columns = [](const std::string& line) {
            return std::count(line.begin(), line.end(), ',');
        };
        const std::string heading = table.substr(0, table.find('\n'));
        QCOMPARE(columns(table), 5 * columns(heading));
        QVERIFY2(contains(table, "\n1,0,100,3,97,3,0,0,"), table.c_str());
        const std::string trials = study::physicalTrialsCsv(validation);
        QVERIFY2(contains(trials,
                          "\n1,1,wrong-orientation,0,50,0,2026-03-31T12:00:00Z,\"slow, "
                          "\"\"humming\"\"\",unknown,,\n"),
                 trials.c_str());
        QCOMPARE(std::count(trials.begin(), trials.end(), '\n'), 5);
    }

    // A hexagon bolt: six alike poses lying, one on its head, one on its tip.
    void alikePosesAreOneRow() {
        const std::vector<part::PoseGroup> groups = {{{0, 1, 2, 3, 4, 5}, 0.906}, {{6}, 0.083}, {{7}, 0.011}};
        const ValidationRecord record = simulated({10, 20, 10, 20, 10, 20, 100, 1000}, 1000);
        PhysicalValidation feeder;
        feeder.plan.poses = {0, 6, 7};
        QCOMPARE(study::orderOfTrials(feeder.plan).size(), std::size_t{300});
        for (const int pose : study::orderOfTrials(feeder.plan)) {
            study::PhysicalTrial& trial = feeder.trials.emplace_back();
            trial.number = static_cast<int>(feeder.trials.size()) - 1;
            trial.pose = pose;
            if (pose == 7) trial.outcome = trial::Verdict::stuck;
        }
        const study::PhysicalTable table = study::comparePhysical(&record, feeder, groups);
        QCOMPARE(table.rows.size(), std::size_t{3});
        QCOMPARE(table.rows[0].poses, groups[0].poses);
        QCOMPARE(table.rows[0].planned, 100);
        QCOMPARE(table.rows[0].simulated.tally.trials(), 6000);
        QCOMPARE(table.rows[0].simulated.tally.failures(), 90);
        QCOMPARE(table.rows[0].physical.tally.trials(), 100);
        QCOMPARE(table.total.physical.tally.trials(), 300);
        QCOMPARE(table.total.planned, 300);
        QVERIFY(std::abs(*table.total.physical.rate - 200.0 / 300.0) < 1e-12);
        QVERIFY(std::abs(*table.weighted.physical.rate - 0.989) < 1e-12);
        QVERIFY(std::abs(*table.weighted.simulated.rate - (0.906 * 0.985 + 0.083 * 0.9)) < 1e-12);
        QVERIFY(table.weighted.physical.bounds.low < 0.989 && table.weighted.physical.bounds.high > 0.989);
        const std::string text = study::formatPhysical(table);
        QVERIFY2(contains(text, "\n1-6 ") && contains(text, "90.6 %") && contains(text, "Total, weighted") &&
                     contains(text, "98.9 %") && contains(text, "Total, alike"),
                 text.c_str());
        QVERIFY2(contains(table.summary, ", weighted"), table.summary.c_str());
        QVERIFY2(contains(table.verdict, "200 of 300") && contains(table.verdict, "Weighted"),
                 table.verdict.c_str());
        const std::string csv = study::physicalTableCsv(table);
        QVERIFY2(contains(csv, "\n1 2 3 4 5 6,90.6"), csv.c_str());
    }

    // Studies of older programs planned every one of the alike poses.
    void olderPlansAreGroupedToo() {
        const std::vector<part::PoseGroup> groups = {{{0, 1}, 0.7}, {{2}, 0.3}};
        const study::PhysicalTable table = study::comparePhysical(nullptr, physical({3, 5, 0}, 100), groups);
        QCOMPARE(table.rows.size(), std::size_t{2});
        QCOMPARE(table.rows[0].planned, 200);
        QCOMPARE(table.rows[0].physical.tally.trials(), 200);
        QCOMPARE(table.rows[0].physical.tally.failures(), 8);
        QCOMPARE(table.total.planned, 300);
        // A pose that the plan leaves out has no row and no weight.
        const study::PhysicalTable some = study::comparePhysical(nullptr, physical({3, 5}, 100), groups);
        QCOMPARE(some.rows.size(), std::size_t{1});
        QVERIFY(std::abs(*some.weighted.physical.rate - 0.96) < 1e-12);
        // Nor is a rate known before each kind was tried.
        PhysicalValidation begun = physical({0, 0, 0}, 100);
        begun.trials.resize(150);
        QVERIFY(!study::comparePhysical(nullptr, begun, groups).weighted.physical.rate);
    }
};

QTEST_APPLESS_MAIN(PhysicalTableTest)
#include "physical_table_test.moc"
