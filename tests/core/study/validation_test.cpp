#include "core/study/validation.h"

#include <QtTest>
#include <atomic>
#include <set>

#include "core/study/pose_weights.h"
#include "core/study/robustness.h"
#include "core/study/runner.h"
#include "core/study/selection.h"
#include "core/study/tables.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "fake_engine.h"
#include "tests/core/objectives/paper_fitness.h"

using namespace trapwright;

namespace {

base::Quaternion about(const base::Vec3& axis, double degrees) {
    return base::Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

trial::PartOutcome ended(trial::Ending ending,
                         const base::Quaternion& rotation = base::Quaternion::Identity()) {
    trial::PartOutcome outcome;
    outcome.ending = ending;
    outcome.farthest.rotation = rotation;
    return outcome;
}

study::Individual winnerOf(const study::StudyInputs& inputs, int generation, std::uint64_t genes,
                           double fitness) {
    base::Random random({.seed = genes});
    study::Individual winner;
    winner.generation = generation;
    winner.individual = generation % 5;
    for (const search::Dimension& dimension : study::designSpace(inputs.settings.track).dimensions)
        winner.record.design.push_back(search::roundToBits(random.uniform(), dimension.bits));
    winner.record.fitness = testing::paperFitness(0.0, fitness, 0.0);
    return winner;
}

}  // namespace

class ValidationTest : public QObject {
    Q_OBJECT

 private slots:
    void winnersAreRankedWithoutTwins() {
        const study::StudyInputs inputs = fake::waveInputs();
        const std::vector<study::Individual> ranked = study::rankWinners(
            {winnerOf(inputs, 0, 1, -3.0), winnerOf(inputs, 1, 2, -1.0), winnerOf(inputs, 2, 3, -2.0),
             winnerOf(inputs, 3, 2, -1.5), winnerOf(inputs, 4, 4, -2.0)},
            3);
        QCOMPARE(ranked.size(), std::size_t{3});
        QCOMPARE(ranked[0].generation, 1);  // its twin of generation 3 is left out
        QCOMPARE(ranked[1].generation, 4);  // the later among equals
        QCOMPARE(ranked[2].generation, 2);
    }

    void bestWinnerIsTheOneWithTheGreatestSuccess() {
        const study::StudyInputs inputs = fake::waveInputs();
        const auto winner = [&](int generation, std::optional<int> oriented, int trials, double fitness) {
            study::Individual made = winnerOf(inputs, generation, 1, fitness);
            made.record.oriented = oriented;
            made.record.trials = trials;
            return made;
        };
        QVERIFY(study::findBestWinner({}, false) == nullptr);
        const auto bestOf = [](const std::vector<study::Individual>& winners) {
            return study::findBestWinner(winners, false)->generation;
        };
        // The share counts, not the number; then fitness; then who is last.
        QCOMPARE(bestOf({winner(0, 9, 10, -3.0), winner(1, 17, 20, -1.0)}), 0);
        QCOMPARE(bestOf({winner(0, 9, 10, -3.0), winner(1, 18, 20, -1.0), winner(2, 9, 10, -2.0)}), 1);
        QCOMPARE(bestOf({winner(0, 9, 10, -1.0), winner(1, 9, 10, -1.0)}), 1);
        // What is not known, or was not simulated, is not 0 %, but below it.
        QCOMPARE(bestOf({winner(0, std::nullopt, 10, 5.0), winner(1, 0, 10, -5.0)}), 1);
        QCOMPARE(bestOf({winner(0, 0, 0, 5.0), winner(1, 0, 10, -5.0)}), 1);
        QCOMPARE(bestOf({winner(0, std::nullopt, 10, -2.0), winner(1, std::nullopt, 10, -1.0)}), 1);
        // What holds in corners of the box, where trials are harder, is better than what was not tried there.
        std::vector<study::Individual> later{winner(0, 10, 10, 3.0), winner(1, 8, 10, 2.0)};
        later[0].record.fitness.scores = {{"corners", 0.0}};
        QCOMPARE(bestOf(later), 0);
        later[1].record.fitness.scores = {{"corners", 0.7}};
        QCOMPARE(bestOf(later), 1);
        // Where parts that fall come again, fitness counts.
        const std::vector<study::Individual> winners{winner(0, 9, 10, -3.0), winner(1, 2, 10, -1.0)};
        QCOMPARE(study::findBestWinner(winners, true)->generation, 1);
        QCOMPARE(study::findBestWinner(winners, false)->generation, 0);
    }

    void selectionIsByFreshTrials() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.validation.selectionWinners = 3;
        inputs.settings.validation.selectionTrials = 50;
        inputs.settings.validation.selectionCornerTrials = 0;
        std::vector<study::Individual> winners;
        winners.reserve(5);
        for (int g = 0; g < 5; ++g)
            winners.push_back(winnerOf(inputs, g, 100 + static_cast<std::uint64_t>(g), -g));

        // Individuals of generation 1 do best, those of 0 and 2 equally well but for the distance.
        std::mutex mutex;
        std::set<std::uint32_t> trials;
        bool fresh = true;
        inputs.engine = std::make_shared<fake::FakeEngine>(
            [&](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                const std::lock_guard lock(mutex);
                trials.insert(spec.stream.trial);
                fresh = fresh && spec.stream.purpose == base::Purpose::finalSelection;
                const bool lost = spec.stream.trial < (spec.stream.generation == 1 ? 2U : 5U);
                // Every second part ends turned about a symmetry axis: the same to the eye.
                trial::PartOutcome outcome =
                    ended(lost ? trial::Ending::fellOff : trial::Ending::finished,
                          spec.stream.trial % 2 == 0 ? about(base::Vec3::UnitX(), 180)
                                                     : about(base::Vec3::UnitZ(), 0));
                outcome.farthest.position.x() =
                    lost ? (spec.stream.generation == 2 ? batch.track->finish - 0.01 : 0.0)
                         : batch.track->finish;
                if (spec.stream.trial == 10) outcome.farthest.rotation = about(base::Vec3::UnitX(), 40);
                return outcome;
            },
            2);
        const auto record = study::selectWinners(inputs, winners, {});
        VERIFY_OK(record);
        QVERIFY(fresh);
        QCOMPARE(trials.size(), std::size_t{50});
        QCOMPARE(record->engine, std::string("fake"));
        QCOMPARE(record->entries.size(), std::size_t{3});
        QCOMPARE(record->entries[0].generation, 1);
        QCOMPARE(record->entries[1].generation, 2);
        QCOMPARE(record->entries[2].generation, 0);
        QCOMPARE(record->entries[0].trials, 50);
        QCOMPARE(record->entries[0].finished, 48);
        QCOMPARE(record->entries[0].oriented, 47);
        QCOMPARE(record->entries[1].oriented, 44);
        QVERIFY(trial::calcOrientationAngle(record->entries[0].goal.shown(), base::Quaternion::Identity(),
                                            inputs.part->symmetry,
                                            trial::OrientationDistance::symmetric) < 1e-6);
    }

    // Generation 0 is better all over the box, 1 in its corners by more. Where nothing varies corners are not
    // asked.
    void cornersCountInSelection() {
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.validation.selectionTrials = 100;
        inputs.settings.validation.selectionCornerTrials = 32;
        inputs.settings.validation.conditions = study::TrialConditions::varied;
        const std::vector<study::Individual> winners{winnerOf(inputs, 0, 100, 0.0),
                                                     winnerOf(inputs, 1, 101, 0.0)};
        std::atomic<bool> inCorners = true;
        inputs.engine =
            std::make_shared<fake::FakeEngine>([&](const trial::TrialBatch&, const trial::TrialSpec& spec) {
                const bool isCorner = spec.stream.purpose == base::Purpose::corners;
                if (isCorner != (spec.place && trial::isCorner(*spec.place))) inCorners = false;
                const std::uint32_t generation = spec.stream.generation;
                const std::uint32_t lost = isCorner ? (generation == 0 ? 16 : 8) : (generation == 0 ? 1 : 6);
                return ended(spec.stream.trial < lost ? trial::Ending::fellOff : trial::Ending::finished,
                             about(base::Vec3::UnitZ(), 0));
            });
        const auto varied = study::selectWinners(inputs, winners, {});
        VERIFY_OK(varied);
        QVERIFY(inCorners);
        QCOMPARE(varied->entries[0].generation, 1);
        QCOMPARE(varied->entries[0].oriented, 94);
        QCOMPARE(varied->entries[0].trials, 100);
        QCOMPARE(varied->entries[0].corners, (stats::Count{24, 32}));
        QCOMPARE(varied->entries[1].corners, (stats::Count{16, 32}));
        QCOMPARE(varied->made.outcomes.size(), std::size_t{200});
        QVERIFY(study::formatSelection(*varied).find("Corners") != std::string::npos);

        inputs.settings.validation.selectionCornerTrials = 0;
        QCOMPARE(study::selectWinners(inputs, winners, {})->entries[0].generation, 0);
        inputs.settings.validation.selectionCornerTrials = 32;
        inputs.settings.validation.conditions = study::TrialConditions::nominal;
        const auto nominal = study::selectWinners(inputs, winners, {});
        QCOMPARE(nominal->entries[0].generation, 0);
        QCOMPARE(nominal->entries[0].corners, stats::Count{});
        QVERIFY(study::formatSelection(*nominal).find("Corners") == std::string::npos);
    }

    void selectionNeedsWinners() {
        QVERIFY(fake::messageOf(study::selectWinners(fake::waveInputs(), {}, {})).contains("no winners"));
    }

    void validationCountsFailuresByKind_data() {
        QTest::addColumn<bool>("given");
        QTest::newRow("expected orientation is the mode") << false;
        QTest::newRow("expected orientation is given") << true;
    }
    void validationCountsFailuresByKind() {
        QFETCH(bool, given);
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.validation.trialsPerPose = 100;
        // Pose p: p of the trials fall off, 2p stick, p time out; of the others 10 end 90 degrees off.
        inputs.engine =
            std::make_shared<fake::FakeEngine>([](const trial::TrialBatch&, const trial::TrialSpec& spec) {
                const int pose = static_cast<int>(spec.stream.trial) / 100;
                const int i = static_cast<int>(spec.stream.trial) % 100;
                if (spec.stream.purpose != base::Purpose::validation) return ended(trial::Ending::timedOut);
                if (i < pose) return ended(trial::Ending::fellOff);
                if (i < 3 * pose) return ended(trial::Ending::stuck);
                if (i < 4 * pose) return ended(trial::Ending::timedOut);
                if (i < 4 * pose + 10) return ended(trial::Ending::finished, about(base::Vec3::UnitX(), 90));
                return ended(trial::Ending::finished,
                             i % 2 == 0 ? about(base::Vec3::UnitZ(), 20) : about(base::Vec3::UnitZ(), 200));
            });
        const study::Individual winner = winnerOf(inputs, 6, 5, 0.0);
        const auto expected =
            given ? std::optional(trial::makeGoal(about(base::Vec3::UnitX(), 90))) : std::nullopt;
        const auto record = study::validate(inputs, winner, expected, {});
        VERIFY_OK(record);
        QCOMPARE(record->generation, 6);
        QCOMPARE(record->individual, 1);
        QCOMPARE(record->engine, std::string("fake"));
        QCOMPARE(record->tolerance, 25.0 * base::kDegree);
        QCOMPARE(record->rows.size(), std::size_t{3});
        for (int pose = 0; pose < 3; ++pose) {
            const study::ValidationRow& row = record->rows[static_cast<std::size_t>(pose)];
            QCOMPARE(row.pose, pose);
            QCOMPARE(row.tally.trials(), 100);
            QCOMPARE(row.tally.fellOff, pose);
            QCOMPARE(row.tally.stuck, 3 * pose);
            QCOMPARE(row.tally.wrongOrientation, given ? 90 - 4 * pose : 10);
            QCOMPARE(row.tally.failures(), row.tally.fellOff + row.tally.stuck + row.tally.wrongOrientation);
        }
        if (!given) {
            QVERIFY(trial::calcOrientationAngle(record->goal.shown(), about(base::Vec3::UnitZ(), 20),
                                                inputs.part->symmetry,
                                                trial::OrientationDistance::symmetric) < 1e-6);
        }
        const study::ValidationRow total = study::calcTotal(*record);
        QCOMPARE(total.tally.trials(), 300);
        QCOMPARE(total.tally.fellOff, 3);
        QCOMPARE(total.tally.stuck, 9);
    }

    void validationStartsNearThePoses() {
        const study::StudyInputs inputs = fake::waveInputs();
        const auto track = std::make_shared<const track::Track>(
            study::decodeTrack(inputs.settings.track, winnerOf(inputs, 0, 1, 0).record.design).value());
        const study::TrialScene scene{&inputs.settings.simulation, inputs.part, track, 7};
        double sum = 0.0;
        base::Vec3 heading = base::Vec3::Zero();
        constexpr int kTrials = 400;
        for (int pose = 0; pose < 3; ++pose) {
            const trial::TrialBatch batch = study::makeValidationBatch(scene, {3, 4}, pose, kTrials);
            const base::Quaternion& stable =
                inputs.part->stablePoses[static_cast<std::size_t>(pose)].rotation;
            for (int i = 0; i < kTrials; ++i) {
                const trial::TrialSpec& spec = batch.trials[static_cast<std::size_t>(i)];
                QCOMPARE(spec.stream,
                         (base::StreamKey{7, 3, 4, static_cast<std::uint32_t>(pose * kTrials + i),
                                          base::Purpose::validation}));
                // The part's up direction is within a few standard deviations of 2 degrees of the pose's.
                const base::Vec3 up = spec.parts[0].pose.rotation.inverse() * base::Vec3::UnitZ();
                const double tilt = std::acos(std::min(1.0, up.dot(stable.inverse() * base::Vec3::UnitZ())));
                QVERIFY(tilt < 12 * base::kDegree);
                sum += tilt * tilt;
                heading += spec.parts[0].pose.rotation * (stable.inverse() * base::Vec3::UnitX());
            }
        }
        const double variance = sum / (3 * kTrials) / 2;  // two axes
        QVERIFY(qAbs(std::sqrt(variance) / base::kDegree - 2.0) < 0.2);
        QVERIFY((heading / (3 * kTrials)).norm() < 0.1);  // any heading
    }

    void trialsCanBeMadeAgainOneByOne() {
        const study::StudyInputs inputs = fake::waveInputs();
        const auto track = std::make_shared<const track::Track>(
            study::decodeTrack(inputs.settings.track, winnerOf(inputs, 0, 1, 0).record.design).value());
        const study::TrialScene scene{&inputs.settings.simulation, inputs.part, track, 7};
        const trial::TrialBatch few = study::makeLearningBatch(scene, {3, 4}, 5);
        const trial::TrialBatch many = study::makeLearningBatch(scene, {3, 4}, 50);
        const trial::TrialBatch fresh = study::makeSelectionBatch(scene, {3, 4}, 5);
        for (std::size_t i = 0; i < 5; ++i) {
            QCOMPARE(few.trials[i].stream,
                     (base::StreamKey{7, 3, 4, static_cast<std::uint32_t>(i), base::Purpose::trialStart}));
            QVERIFY(few.trials[i].parts[0].pose == many.trials[i].parts[0].pose);
            QCOMPARE(few.trials[i].phase, many.trials[i].phase);
            QVERIFY(!(few.trials[i].parts[0].pose == fresh.trials[i].parts[0].pose));
        }
    }

    void learningIsLessPatient() {
        study::StudyInputs inputs = fake::waveInputs();
        const auto track = std::make_shared<const track::Track>(
            study::decodeTrack(inputs.settings.track, winnerOf(inputs, 0, 1, 0).record.design).value());
        double& stuckTime = inputs.settings.simulation.termination.stuckTime;
        stuckTime = 1.5;
        inputs.settings.evolution.learningStuckTime = 0.5;
        const study::TrialScene scene = study::makeScene(inputs.settings, inputs.part, track);
        QCOMPARE(study::makeLearningBatch(scene, {0, 0}, 1).termination.stuckTime, 0.5);
        QCOMPARE(study::makeSelectionBatch(scene, {0, 0}, 1).termination.stuckTime, 1.5);
        QCOMPARE(study::makeValidationBatch(scene, {0, 0}, 0, 1).termination.stuckTime, 1.5);
        stuckTime = 0.3;  // the lesser counts
        QCOMPARE(study::makeLearningBatch(scene, {0, 0}, 1).termination.stuckTime, 0.3);
    }

    void longTracksHaveMoreTime() {
        study::StudyInputs inputs = fake::waveInputs();
        track::Track track =
            study::decodeTrack(inputs.settings.track, winnerOf(inputs, 0, 1, 0).record.design).value();
        double& set = inputs.settings.simulation.termination.timeLimit;
        QCOMPARE(set, 0.0);
        // The limits of learning, selection, validation, and of robustness over the box and at a place.
        const auto limitsOn = [&](double length) {
            track.finish = track.start + length;
            const auto shared = std::make_shared<const track::Track>(track);
            const study::TrialScene scene = study::makeScene(inputs.settings, inputs.part, shared);
            const auto placed = [&](const study::PlaceTrials& trials) {
                return study::makePlaceBatch(inputs.settings, inputs.part, shared, trials);
            };
            return std::set<double>{study::makeLearningBatch(scene, {0, 0}, 1).termination.timeLimit,
                                    study::makeSelectionBatch(scene, {0, 0}, 1).termination.timeLimit,
                                    study::makeValidationBatch(scene, {0, 0}, 0, 1).termination.timeLimit,
                                    placed({std::nullopt, 0, 1}).termination.timeLimit,
                                    placed({trial::kMiddle, 0, 1}).termination.timeLimit};
        };
        QCOMPARE(limitsOn(0.1), std::set{10.0});
        const std::set<double> ofLong = limitsOn(0.5);  // at 20 mm/s
        QCOMPARE(ofLong.size(), std::size_t{1});
        QVERIFY(std::abs(*ofLong.begin() - 25.0) < 1e-9);
        set = 3.0;
        QCOMPARE(limitsOn(0.5), std::set{3.0});
    }

    void learningTakesLargerSteps_data() {
        QTest::addColumn<double>("frequency");
        QTest::addColumn<double>("set");
        QTest::addColumn<double>("expected");
        QTest::newRow("mains") << 50.0 << 0.0 << 0.3e-3;
        QTest::newRow("slow") << 20.0 << 0.0 << 0.3e-3;
        QTest::newRow("60 Hz") << 60.0 << 0.0 << 0.25e-3;
        QTest::newRow("100 Hz") << 100.0 << 0.0 << 0.15e-3;
        QTest::newRow("set") << 100.0 << 0.4e-3 << 0.4e-3;
        QTest::newRow("set finer") << 50.0 << 0.1e-3 << 0.1e-3;
    }
    void learningTakesLargerSteps() {
        QFETCH(double, frequency);
        QFETCH(double, set);
        QFETCH(double, expected);
        study::StudyInputs inputs = fake::waveInputs();
        inputs.settings.simulation.drive.frequency = frequency;
        inputs.settings.evolution.learningStep = set;
        const auto track = std::make_shared<const track::Track>(
            study::decodeTrack(inputs.settings.track, winnerOf(inputs, 0, 1, 0).record.design).value());
        const study::TrialScene scene = study::makeScene(inputs.settings, inputs.part, track);
        QVERIFY(std::abs(study::makeLearningBatch(scene, {0, 0}, 1).step - expected) < 1e-12);
        QCOMPARE(study::makeSelectionBatch(scene, {0, 0}, 1).step, 0.0);
        QCOMPARE(study::makeValidationBatch(scene, {0, 0}, 0, 1).step, 0.0);
    }

    void partWithoutPosesIsRefused() {
        study::StudyInputs inputs = fake::waveInputs();
        part::Part part = *inputs.part;
        part.stablePoses.clear();
        inputs.part = std::make_shared<part::Part>(part);
        QVERIFY(fake::messageOf(study::validate(inputs, winnerOf(inputs, 0, 1, 0), std::nullopt, {}))
                    .contains("no stable poses"));
    }

    void tableIsThePapers() {
        // Table 2, the cube's simulation column. All successes: the lower bound is 0.025^(1/1000) = 99.63 %.
        study::ValidationRecord record;
        const std::vector<int> failures = {0, 10, 5, 9, 7, 7};
        for (int i = 0; i < 6; ++i)
            record.rows.push_back({i,
                                   {1000 - failures[static_cast<std::size_t>(i)],
                                    failures[static_cast<std::size_t>(i)], 0, 0}});
        const QStringList lines =
            QString::fromStdString(study::formatValidation(study::tabulate(record, {}))).split('\n');
        const auto words = [&](int line) { return lines[line].simplified(); };
        QCOMPARE(lines.size(), 10);
        QVERIFY(words(0).startsWith("Pose lands so T F P 95 % Clopper-Pearson"));
        QCOMPARE(words(1), QString("1 0.0 % 1000 0 100.0 % 99.6 ... 100.0 % 0 0 0"));
        QVERIFY(words(2).startsWith("2 0.0 % 1000 10 99.0 % "));
        QVERIFY(words(3).startsWith("3 0.0 % 1000 5 99.5 % "));
        QVERIFY(words(7).startsWith("Total, alike 6000 38 99.4 % 99.1 ... 99.6 %"));
        for (int i = 1; i < 8; ++i)
            QCOMPARE(lines[i].size(), lines[0].size());
    }

    void alikePosesAreOneRow() {
        study::ValidationRecord record;
        const std::vector<int> failures = {0, 10, 5, 9, 7, 7};
        for (int i = 0; i < 6; ++i)
            record.rows.push_back({i,
                                   {1000 - failures[static_cast<std::size_t>(i)],
                                    failures[static_cast<std::size_t>(i)], 0, 0}});
        const std::vector<part::PoseGroup> groups = {{{0, 1}, 0.645}, {{2, 3}, 0.243}, {{4, 5}, 0.112}};
        const study::ValidationTable table = study::tabulate(record, groups);
        QCOMPARE(table.groups.size(), std::size_t{3});
        QCOMPARE(table.groups[1].sum.tally.trials(), 2000);
        QCOMPARE(table.groups[1].sum.tally.failures(), 14);
        QCOMPARE(table.groups[1].rows.size(), std::size_t{2});
        QCOMPARE(table.total.tally.failures(), 38);
        const double rate = 1.0 - 0.645 * 0.005 - 0.243 * 0.007 - 0.112 * 0.007;
        QVERIFY(std::abs(table.weighted.rate.value() - rate) < 1e-12);
        const QStringList lines = QString::fromStdString(study::formatValidation(table)).split('\n');
        QVERIFY2(lines[1].simplified().startsWith("1-2 64.5 % 2000 10 99.5 % "), qPrintable(lines[1]));
        QVERIFY2(lines[4].simplified().startsWith("Total, weighted 99.4 % "), qPrintable(lines[4]));
        QVERIFY2(lines[5].simplified().startsWith("Total, alike 6000 38 99.4 %"), qPrintable(lines[5]));
        QVERIFY(lines[6].startsWith("Weighted by how often"));
        for (int i = 1; i < 6; ++i)
            QCOMPARE(lines[i].size(), lines[0].size());
        const QStringList all = QString::fromStdString(study::formatValidation(table, true)).split('\n');
        QCOMPARE(all.size(), lines.size() + 6);
        QVERIFY2(all[2].simplified().startsWith("1 1000 0 100.0 %"), qPrintable(all[2]));
    }

    void whereFallsComeAgainTheRightOnesOfThoseThatArriveAreTold() {
        study::ValidationRecord record;
        record.rows = {{0, {600, 20, 0, 380}}, {1, {10, 40, 50, 900}}};
        const std::vector<part::PoseGroup> groups = {{{0}, 0.9}, {{1}, 0.1}};
        const study::ValidationTable table = study::tabulate(record, groups);
        QVERIFY(std::abs(table.correct.rate.value() - 0.541 / (0.558 + 0.005)) < 1e-12);
        QVERIFY(table.correct.interval.low > 0.94 && table.correct.interval.high < 0.98);
        const QStringList lines = QString::fromStdString(study::formatValidation(table)).split('\n');
        QVERIFY2(lines[4].simplified().startsWith("Correct 96.1 % "), qPrintable(lines[4]));
        QCOMPARE(lines[4].size(), lines[0].size());
        QCOMPARE(lines[7], QString("Correct: of those that arrive, weighted likewise."));
        // What is only stuck or wrong does not come again.
        record.rows = {{0, {600, 20, 380, 0}}};
        QVERIFY(!study::tabulate(record, groups).correct.rate);
    }

    void weightsSumToOne() {
        part::Part part = *fake::block();
        const std::vector<double> weights = study::poseWeights(part, {});
        QCOMPARE(weights.size(), part.stablePoses.size());
        QVERIFY(std::abs(weights[0] - 0.645) < 1e-9);
        part.stablePoses[0].probability = 1.5;
        double sum = 0.0;
        for (const double weight : study::poseWeights(part, {}))
            sum += weight;
        QVERIFY(std::abs(sum - 1.0) < 1e-12);
        QVERIFY(study::poseWeights(part::Part(), {}).empty());
        double joint = 0.0;
        for (const part::PoseGroup& group : study::weighPoseGroups(part, {}))
            joint += group.probability;
        QVERIFY(std::abs(joint - 1.0) < 1e-12);
    }

    void selectionTableListsTheBestFirst() {
        study::SelectionRecord record{"fake", {}};
        record.entries.push_back(
            {{439, 17}, testing::paperFitness(0.0, -0.01, 0.85), 1000, 1000, 1000, trial::Goal()});
        record.entries.push_back({{12, 3}, testing::paperFitness(0.0, -0.25, 0.5), 0, 0, 0, trial::Goal()});
        const QStringList lines = QString::fromStdString(study::formatSelection(record)).split('\n');
        QCOMPARE(lines[1].simplified(), QString("1 439 17 -0.010 0.850 1000 1000 100.0 % 99.6 ... 100.0 %"));
        QCOMPARE(lines[2].simplified(), QString("2 12 3 -0.250 0.500 0 0 - -"));
        QCOMPARE(lines[1].size(), lines[0].size());
    }

    void evolveSelectAndValidateAgree() {
        study::StudyInputs inputs = fake::waveInputs(2);
        inputs.settings.evolution.generations = 12;
        inputs.settings.validation = {4, 60, 32, 30, 25.0 * base::kDegree};
        std::vector<study::Individual> winners;
        study::LearningEvents events;
        events.save = [&](const study::GenerationRecord& record) {
            winners.push_back(
                {{record.index, record.winner}, record.individuals[static_cast<std::size_t>(record.winner)]});
            return base::success();
        };
        VERIFY_OK(study::evolve(inputs, std::nullopt, events, {}));
        const auto selection = study::selectWinners(inputs, winners, {});
        VERIFY_OK(selection);
        QCOMPARE(selection->entries.size(), std::size_t{4});
        const auto best = std::find_if(winners.begin(), winners.end(), [&](const study::Individual& w) {
            return w.generation == selection->entries[0].generation;
        });
        QVERIFY(best != winners.end());
        const auto table = study::validate(inputs, *best, std::nullopt, {});
        VERIFY_OK(table);
        QCOMPARE(study::calcTotal(*table).tally.trials(), 90);
        // The same again, on one thread.
        study::StudyInputs single = fake::waveInputs(1);
        single.settings = inputs.settings;
        const auto again = study::validate(single, *best, std::nullopt, {});
        VERIFY_OK(again);
        QCOMPARE(study::formatValidation(study::tabulate(*again, {})),
                 study::formatValidation(study::tabulate(*table, {})));
    }
};

QTEST_APPLESS_MAIN(ValidationTest)
#include "validation_test.moc"
