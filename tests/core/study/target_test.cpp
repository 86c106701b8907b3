#include "core/study/target.h"

#include <QtTest>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "core/part/shapes.h"
#include "core/study/presets.h"
#include "core/study/reference_check.h"
#include "core/study/robustness.h"
#include "core/study/runner.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/study/validation.h"
#include "fake_engine.h"

using namespace trapwright;

namespace {

part::Part cuboid() {
    part::PartOptions options;
    options.name = "cuboid";
    options.density = 1000.0;
    return part::buildPart(part::makeBox({4e-3, 8e-3, 12e-3}), options)->part;
}

study::TargetSettings poses(const std::string& text, const std::string& heading = "any") {
    return {text, heading, {}};
}

/// What is wanted, on a track that ends level.
study::Settings wish(const study::TargetSettings& target) {
    study::Settings settings;
    settings.target = target;
    return settings;
}

/// 60 % lie as pose 1 of the block, 30 % as pose 2 in some heading, 10 % fall off.
trial::PartOutcome threeWays(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    trial::PartOutcome outcome = fake::waveLaw(batch, spec);
    const std::uint32_t i = spec.stream.trial % 10;
    outcome.ending = i == 9 ? trial::Ending::fellOff : trial::Ending::finished;
    const base::Quaternion heading(Eigen::AngleAxisd(0.7 * spec.stream.trial, base::Vec3::UnitZ()));
    const std::vector<part::StablePose>& lying = batch.parts.front()->stablePoses;
    outcome.farthest = {i < 6 ? lying[0].rotation : heading * lying[1].rotation,
                        {batch.track->finish, 0.0, 0.0}};
    return outcome;
}

study::StudyInputs threeWayInputs(const study::TargetSettings& target) {
    study::StudyInputs inputs = fake::waveInputs();
    inputs.settings.target = target;
    inputs.settings.evolution.objectives =
        target.isSet() ? objectives::kWantedObjectives : objectives::kPaperObjectives;
    inputs.settings.evolution.trialsPerEvaluation = 20;
    inputs.settings.evolution.generations = 1;
    inputs.settings.validation.selectionTrials = 50;
    inputs.settings.validation.trialsPerPose = 20;
    inputs.engine = std::make_shared<fake::FakeEngine>(threeWays);
    return inputs;
}

}  // namespace

class TargetTest : public QObject {
    Q_OBJECT

 private slots:
    // Wanting what is found for an orientation wants that orientation.
    void namesTheTargetNearestToAnOrientation() {
        const part::Part part = cuboid();
        study::Settings settings = wish({});
        settings.track.traps = "groove, groove, gap";  // whose walls parts may lean on
        for (std::size_t pose = 0; pose < part.stablePoses.size(); ++pose) {
            for (const double heading : {0.0, 40.0, 135.0, 300.0}) {
                for (const double lean : {0.0, -20.0}) {
                    const base::Quaternion end(
                        Eigen::AngleAxisd(lean * base::kDegree, base::Vec3::UnitX()) *
                        Eigen::AngleAxisd(heading * base::kDegree, base::Vec3::UnitZ()) *
                        part.stablePoses[pose].rotation);
                    settings.target = study::findNearestTarget(settings, part, end);
                    QVERIFY(settings.target.heading != "any");
                    const auto named = study::readPoses(settings.target.poses);
                    VERIFY_OK(named);
                    QVERIFY(std::ranges::find(*named, static_cast<int>(pose)) != named->end());
                    const auto goal = study::findWanted(settings, part);
                    QVERIFY(goal.has_value());
                    QVERIFY(trial::calcAngleToGoal(end, *goal, part.symmetry) < 0.6 * base::kDegree);
                }
            }
        }
        part::PartOptions round;
        round.density = 1000.0;
        const std::vector<base::Vec2> profile = {{0.0, 0.0}, {8e-3, 0.0}, {8e-3, 2e-3}, {0.0, 2e-3}};
        const part::Part disc = part::buildPart(part::makeTurned(profile, 48), round)->part;
        QVERIFY(disc.symmetry.continuous);
        settings.target = study::findNearestTarget(settings, disc, disc.stablePoses.front().rotation);
        QCOMPARE(settings.target.heading, std::string("any"));
    }

    void poseNumbersAreRead_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QList<int>>("indices");
        QTest::newRow("one") << "3" << QList{2};
        QTest::newRow("several") << " 5, 3" << QList{2, 4};
        QTest::newRow("as the page names a group") << "5-6,1" << QList{0, 4, 5};
        QTest::newRow("twice") << "3, 2-3" << QList{1, 2};
        for (const char* bad : {"three", "0", "-1", "3-", "4-3", "3,", "3.5", "1000001", "any", " "})
            QTest::newRow(bad) << bad << QList<int>();
    }
    void poseNumbersAreRead() {
        QFETCH(QString, text);
        QFETCH(QList<int>, indices);
        const auto read = study::readPoses(text.toStdString());
        QCOMPARE(read.ok(), !indices.empty());
        if (read) QCOMPARE(QList<int>(read->begin(), read->end()), indices);
        if (!read) QVERIFY(read.error().message.find("is no stable pose") != std::string::npos);
    }

    void headingsAreRead() {
        QVERIFY(study::readHeading("any").ok() && !*study::readHeading("any"));
        QCOMPARE(**study::readHeading("90"), base::kPi / 2);
        QCOMPARE(**study::readHeading("-45.5"), -45.5 * base::kDegree);
        for (const char* bad : {"", "north", "361", "nan", "90 deg"})
            QVERIFY2(!study::readHeading(bad).ok(), bad);
    }

    void alikePosesAreOne() {
        const part::Part part = cuboid();
        QVERIFY(!study::findWanted(wish({}), part));
        const auto wanted = study::findWanted(wish(poses("3")), part);
        QVERIFY(*wanted == *study::findWanted(wish(poses("3-4")), part));
        QVERIFY(*wanted == *study::findWanted(wish(poses("4")), part));
        QCOMPARE(wanted->orientations.size(), std::size_t{1});
        QVERIFY(wanted->orientations[0].anyHeading);
        QCOMPARE(study::findWanted(wish(poses("6, 4")), part)->orientations.size(), std::size_t{2});
        // Either of the two is right.
        for (const std::size_t pose : {2U, 3U})
            QVERIFY(trial::calcAngleToGoal(part.stablePoses[pose].rotation, *wanted, part.symmetry) < 1e-6);
        QVERIFY(trial::calcAngleToGoal(part.stablePoses[4].rotation, *wanted, part.symmetry) > 1.0);
        // With its symmetry switched off the part has six poses.
        part::Part plain = part;
        plain.symmetry = {};
        QCOMPARE(study::findWanted(wish(poses("3-4")), plain)->orientations.size(), std::size_t{2});
    }

    void aHeadingTurnsThePose() {
        const part::Part part = cuboid();
        const trial::Goal goal = *study::findWanted(wish(poses("1", "90")), part);
        QVERIFY(goal.isOneOrientation());
        const base::Quaternion& pose = part.stablePoses[0].rotation;
        const auto angle = [&](double degrees) {
            const base::Quaternion turn(Eigen::AngleAxisd(degrees * base::kDegree, base::Vec3::UnitZ()));
            return trial::calcAngleToGoal(turn * pose, goal, part.symmetry) / base::kDegree;
        };
        QVERIFY(angle(90.0) < 1e-6);
        QVERIFY(angle(-90.0) < 1e-6);  // alike
        QVERIFY(std::abs(angle(60.0) - 30.0) < 1e-6);
    }

    // What lies on a groove's wall lies as it is wanted; an orientation is meant as it stands.
    void aPoseLeansAsTheTracksEndDoes() {
        const part::Part part = cuboid();
        study::Settings settings = wish(poses("1", "0"));
        settings.track.traps = "groove, groove, 2 x gap";
        const auto leaning = [&](double degrees) {
            const base::Quaternion turn(Eigen::AngleAxisd(degrees * base::kDegree, base::Vec3::UnitX()));
            const auto goal = study::findWanted(settings, part);
            return trial::calcAngleToGoal(turn * part.stablePoses[0].rotation, *goal, part.symmetry) /
                   base::kDegree;
        };
        QVERIFY(leaning(24.0) < 1e-6);
        QVERIFY(leaning(-24.0) < 1e-6);
        QVERIFY(std::abs(leaning(30.0) - 6.0) < 1e-6);
        QCOMPARE(study::describeTarget(settings, part),
                 std::string("in stable pose 1-2, turned to 0°, leaning across the track by up to 24°"));
        settings.track.traps = "2 x ledge";
        settings.track.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        QVERIFY(std::abs(leaning(24.0) - 14.0) < 1e-6);
        settings.track.traps = "free-form";
        settings.track.spiral = {};
        QVERIFY(std::abs(leaning(24.0) - 24.0) < 1e-6);
        settings.track.traps = "groove, groove, 2 x gap";
        settings.target = {};
        settings.target.orientation = part.stablePoses[0].rotation;
        QVERIFY(std::abs(leaning(24.0) - 24.0) < 1e-6);
    }

    void anOrientationIsItself() {
        study::TargetSettings target;
        target.orientation = base::Quaternion(0.5, 0.5, 0.5, 0.5);
        QVERIFY(*study::findWanted(wish(target), cuboid()) == trial::makeGoal(*target.orientation));
    }

    void anOrientationMayTurn() {
        const part::Part part = cuboid();
        study::TargetSettings target;
        target.orientation = base::Quaternion(Eigen::AngleAxisd(0.7, base::Vec3::UnitY()));
        const base::Quaternion turned =
            base::Quaternion(Eigen::AngleAxisd(1.1, base::Vec3::UnitZ())) * *target.orientation;
        const auto angle = [&] {
            return trial::calcAngleToGoal(turned, *study::findWanted(wish(target), part), part.symmetry);
        };
        QVERIFY(angle() > 1.0);
        QVERIFY(study::describeTarget(wish(target), part).find("any heading") == std::string::npos);
        target.orientationTurns = true;
        QVERIFY(angle() < 1e-6);
        QVERIFY(study::describeTarget(wish(target), part).find(" in any heading, ") != std::string::npos);
        const std::string goal = study::describeGoal(*study::findWanted(wish(target), part), part);
        QVERIFY2(goal.starts_with("the orientation") && goal.ends_with("in any heading"), goal.c_str());
    }

    // Head up: a stable pose of what stands on its tip.
    void whatHangsIsWantedHeadUp() {
        const auto made = [](const geometry::TriangleMesh& mesh) {
            return part::buildPart(mesh, {.name = "part"})->part;
        };
        const part::Part bolt = made(part::makeBundledShape("bolt"));
        const study::TargetSettings standing = study::findHangingTarget(bolt);
        QVERIFY(standing == poses("8"));
        QVERIFY(study::wantsHanging(wish(standing), bolt));
        QVERIFY(study::wantsHanging(wish(poses("7, 8")), bolt));
        QVERIFY(!study::wantsHanging(wish(poses("8", "10")), bolt));
        for (const char* other : {"7", "9", "x"})
            QVERIFY(!study::wantsHanging(wish(poses(other)), bolt));
        QVERIFY(!study::wantsHanging(wish(poses("8", "up")), bolt));
        QVERIFY(!study::wantsHanging(wish({}), bolt));
        // What has a point has no such pose: the cone's lies about its point, which is then below.
        const part::Part cone = made(part::makeTurned(
            std::array{base::Vec2(0.0, 0.0), base::Vec2(4e-3, 16e-3), base::Vec2(0.0, 16e-3)}, 32));
        const study::TargetSettings pointed = study::findHangingTarget(cone);
        QVERIFY(pointed.orientation && pointed.orientationTurns && pointed.poses.empty());
        QVERIFY(study::wantsHanging(wish(pointed), cone));
        const base::Vec3 up = pointed.orientation->conjugate() * base::Vec3::UnitZ();
        const auto lowest = std::ranges::min_element(
            cone.hull.vertices, {}, [&](const base::Vec3& vertex) { return up.dot(vertex); });
        QVERIFY(std::abs(up.dot(*lowest) + 12e-3) < 0.2e-3);
        // A rivet that is shorter than its head is wide.
        const part::Part rivet = made(part::makeTurned(
            std::array{base::Vec2(0.0, 0.0), base::Vec2(2.5e-3, 0.0), base::Vec2(2.5e-3, 5e-3),
                       base::Vec2(6e-3, 5e-3), base::Vec2(6e-3, 6e-3), base::Vec2(0.0, 6e-3)},
            32));
        const study::TargetSettings riveted = study::findHangingTarget(rivet);
        QVERIFY(riveted.isSet());
        const auto hanging = part::findHanging(rivet);
        QVERIFY(hanging && (*hanging * base::Vec3::UnitZ()).z() > 0.999);
        // A block, and a pin whose centre of mass is 0.3 mm below its collar.
        QVERIFY(!study::findHangingTarget(cuboid()).isSet());
        QVERIFY(!study::findHangingTarget(made(part::makeBundledShape("pin"))).isSet());
    }

    void whatCanBeAttainedIsKnownOfPartsAtRest() {
        const part::Part part = cuboid();
        study::Settings settings;
        const auto isKnown = [&](const study::TargetSettings& target) {
            settings.target = target;
            const objectives::Fitness best{0.0, objectives::listAttainable(study::makeTask(settings, part))};
            return objectives::findScore(best, "F_W") != nullptr;
        };
        QVERIFY(!isKnown({}));
        QVERIFY(isKnown(poses("5")));
        const auto tilted = [&](double degrees) {
            study::TargetSettings target;
            target.orientation =
                base::Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, base::Vec3::UnitX())) *
                part.stablePoses[0].rotation;
            return target;
        };
        QVERIFY(isKnown(tilted(20.0)));
        QVERIFY(!isKnown(tilted(45.0)));
    }

    void problemsAreTold_data() {
        QTest::addColumn<QString>("poses");
        QTest::addColumn<QString>("heading");
        QTest::addColumn<bool>("orientation");
        QTest::addColumn<QString>("objectives");
        QTest::addColumn<QString>("told");
        const QString paper = "F_C, F_D, F_O";
        QTest::newRow("nothing") << ""
                                 << "any" << false << paper << "";
        QTest::newRow("a pose") << "3"
                                << "12.5" << false << "F_C, F_W"
                                << "";
        QTest::newRow("no pose") << "x"
                                 << "any" << false << paper << "target.poses is \"x\"";
        QTest::newRow("no heading") << "3"
                                    << "up" << false << paper << "target.heading_deg is \"up\"";
        QTest::newRow("both") << "3"
                              << "any" << true << paper << "both set";
        QTest::newRow("nothing is wanted") << ""
                                           << "any" << false << "F_O, F_W"
                                           << "names F_W, but nothing is wanted";
    }
    void problemsAreTold() {
        QFETCH(QString, poses);
        QFETCH(QString, heading);
        QFETCH(bool, orientation);
        QFETCH(QString, objectives);
        QFETCH(QString, told);
        study::Settings settings = study::presetSettings("cuboid").value();
        settings.target.poses = poses.toStdString();
        settings.target.heading = heading.toStdString();
        if (orientation) settings.target.orientation = base::Quaternion::Identity();
        settings.evolution.objectives = objectives.toStdString();
        QStringList problems;
        for (const std::string& problem : study::findProblems(settings))
            problems += QString::fromStdString(problem);
        QVERIFY2(told.isEmpty() ? problems.isEmpty() : problems.join(' ').contains(told),
                 qPrintable(problems.join(' ')));
    }

    void whatThePartDoesNotHaveIsTold() {
        const part::Part part = cuboid();
        QVERIFY(study::findTargetPartProblems(poses("1, 6"), part).empty());
        const auto problems = study::findTargetPartProblems(poses("2, 7"), part);
        QCOMPARE(problems.size(), std::size_t{1});
        QCOMPARE(
            problems[0],
            std::string("target.poses is \"2, 7\", but the part cuboid has no stable pose 7. It has 1-2; "
                        "3-4; 5-6 (alike ones together)."));
    }

    void learningThatIsContentWithAnyWayIsTold() {
        study::Settings settings = study::presetSettings("cuboid").value();
        settings.target = poses("3");
        const auto told = study::findRecommendations(settings);
        QCOMPARE(told.size(), std::size_t{1});
        QVERIFY(told[0].find("F_C, F_D, F_O, F_W is recommended") != std::string::npos);
        settings.evolution.objectives = objectives::kWantedObjectives;
        QVERIFY(study::findRecommendations(settings).empty());
        // Another goal is another task.
        study::Settings other = settings;
        other.target.poses = "5";
        QVERIFY(!study::keepsScores(settings, other, 5));
    }

    void itIsTold() {
        const part::Part part = cuboid();
        QCOMPARE(study::describeTarget(wish({}), part), std::string("in whatever way most do"));
        QCOMPARE(study::describeTarget(wish(poses("3,5")), part),
                 std::string("in stable pose 3-4 or 5-6, any heading"));
        QCOMPARE(study::describeTarget(wish(poses("3", "90")), part),
                 std::string("in stable pose 3-4, turned to 90°"));
        study::TargetSettings target;
        target.orientation = part.stablePoses[0].rotation;
        QVERIFY(study::describeTarget(wish(target), part).ends_with("0° from stable pose 1"));
        QCOMPARE(study::describeGoal(*study::findWanted(wish(poses("3,5")), part), part),
                 std::string("stable pose 3-4 in any heading or stable pose 5-6 in any heading"));
        QVERIFY(study::describeGoal(trial::makeGoal(base::Quaternion::Identity()), part)
                    .starts_with("the orientation (w, x, y, z) = (1.000, 0.000"));
    }

    void goalsAsJsonAreExact() {
        const trial::Goal goal{{{base::Quaternion(0.1, 1.0 / 3.0, -0.7, 1e-17), true},
                                {base::Quaternion(0.1 + 0.2, 0.0, 0.5, 1.0), false, 1.0 / 3.0}}};
        QVERIFY(*study::goalFromJson(study::goalToJson(goal)) == goal);
        for (const char* bad :
             {"", "[]", "{}", "[1]", R"([{"rotation": [1, 0, 0], "any_heading": true}])",
              R"([{"rotation": [1, 0, 0, "x"], "any_heading": true}])", R"([{"rotation": [1, 0, 0, 0]}])",
              R"([{"rotation": [1, 0, 0, 0], "any_heading": true, "lean_rad": "x"}])",
              R"([{"rotation": [1, 0, 0, 0], "any_heading": true, "lean_rad": 2}])"})
            QVERIFY2(!study::goalFromJson(bad).ok(), bad);
    }

    void everythingGoesByWhatIsWanted_data() {
        QTest::addColumn<QString>("poses");
        QTest::addColumn<QString>("heading");
        QTest::addColumn<int>("ofTen");
        QTest::newRow("nothing: the mode") << ""
                                           << "any" << 6;
        QTest::newRow("pose 1") << "1"
                                << "any" << 6;
        QTest::newRow("pose 1, turned") << "1"
                                        << "90" << 0;
        QTest::newRow("pose 2") << "2"
                                << "any" << 3;
        QTest::newRow("pose 3, in which none ends") << "3"
                                                    << "any" << 0;
        QTest::newRow("pose 1 or 2") << "1-2"
                                     << "any" << 9;
    }
    void everythingGoesByWhatIsWanted() {
        QFETCH(QString, poses);
        QFETCH(QString, heading);
        QFETCH(int, ofTen);
        const study::StudyInputs inputs = threeWayInputs({poses.toStdString(), heading.toStdString(), {}});
        const bool isWanted = !poses.isEmpty();
        std::vector<study::Individual> winners;
        study::LearningEvents events;
        events.save = [&](const study::GenerationRecord& record) {
            const study::IndividualRecord& winner =
                record.individuals[static_cast<std::size_t>(record.winner)];
            winners.push_back({{record.index, record.winner}, winner});
            return base::success();
        };
        VERIFY_OK(study::evolve(inputs, std::nullopt, events, {}));
        const study::IndividualRecord& learned = winners.at(0).record;
        QCOMPARE(learned.oriented, std::optional(2 * ofTen));
        const objectives::Score* share = objectives::findScore(learned.fitness, "F_W");
        QCOMPARE(share != nullptr, isWanted);
        if (share != nullptr) QCOMPARE(share->value, 0.1 * ofTen);

        const auto selection = study::selectWinners(inputs, winners, {});
        VERIFY_OK(selection);
        QCOMPARE(selection->entries[0].oriented, 5 * ofTen);
        QCOMPARE(objectives::findScore(selection->entries[0].fitness, "F_W") != nullptr, isWanted);

        const auto validation = study::validate(inputs, winners[0], std::nullopt, {});
        VERIFY_OK(validation);
        QCOMPARE(study::calcTotal(*validation).tally.success, 6 * ofTen);
        QCOMPARE(validation->goal.orientations.size(), std::size_t{poses == "1-2" ? 2U : 1U});
        // What is given goes before what the study wants.
        const auto given = study::validate(inputs, winners[0],
                                           trial::Goal{{{inputs.part->stablePoses[1].rotation, true}}}, {});
        VERIFY_OK(given);
        QCOMPARE(study::calcTotal(*given).tally.success, 6 * 3);

        const auto check = study::checkWinner(inputs, *inputs.engine, winners[0], {});
        VERIFY_OK(check);
        QCOMPARE(check->learning.oriented, 2 * ofTen);
        QCOMPARE(check->reference.oriented, 2 * ofTen);

        const auto track = std::make_shared<const track::Track>(
            study::decodeTrack(inputs.settings.track, learned.design).value());
        const auto robustness = study::measureRobustness(inputs, track, std::nullopt, {20, 20, 2, 2}, {});
        VERIFY_OK(robustness);
        QCOMPARE(robustness->nominal.tally.success, 2 * ofTen);
        QCOMPARE(robustness->overBox.tally.success, 2 * ofTen);
    }

    void aStudyOfAnotherPartIsRefused() {
        const study::StudyInputs inputs = threeWayInputs(poses("9"));
        const std::string told = study::checkInputs(inputs).error().message;
        QVERIFY2(told.find("no stable pose 9. It has 1; 2; 3.") != std::string::npos, told.c_str());
    }
};

QTEST_APPLESS_MAIN(TargetTest)
#include "target_test.moc"
