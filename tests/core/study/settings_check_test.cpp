#include <QtTest>
#include <cmath>
#include <limits>

#include "core/study/evaluator.h"
#include "core/study/presets.h"
#include "core/study/settings.h"
#include "core/study/track_design.h"

using namespace trapwright;
using study::Settings;

namespace {

part::Part partOfRadius(double radius) {
    part::Part part;
    part.name = "block";
    part.boundingRadius = radius;
    part.hull.vertices = {base::Vec3::Constant(-0.5 * radius), base::Vec3::Constant(0.5 * radius)};
    return part;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines)
        all += line + "\n";
    return all;
}

}  // namespace

using Change = void (*)(Settings&);
Q_DECLARE_METATYPE(Change)

class SettingsCheckTest : public QObject {
    Q_OBJECT

 private slots:
    void presetsAreTable1() {
        const Settings cuboid = study::presetSettings("cuboid").value();
        const Settings cone = study::presetSettings("cone").value();
        for (const Settings& s : {cuboid, cone}) {
            QCOMPARE(s.track.crossSections, 5);
            QCOMPARE(s.track.pointsPerSection, 8);
            QCOMPARE(s.track.maxSegmentLength, 0.036);
            QCOMPARE(s.track.segmentWidth, 0.060);
            QCOMPARE(s.track.segmentHeight, 0.030);
            QCOMPARE(s.track.shape.bowlRadius, 0.175);
            QCOMPARE(s.evolution.trialsPerEvaluation, 100);
            QCOMPARE(s.evolution.populationSize, 100);
            QCOMPARE(s.evolution.tournamentSize, 6);
            QCOMPARE(s.simulation.drive.frequency, 50.0);
            QCOMPARE(s.simulation.drive.angle, 12.0 * base::kDegree);
            QCOMPARE(s.simulation.drive.halfStroke, 0.8e-3);
            QVERIFY2(study::findProblems(s).empty(), joined(study::findProblems(s)).c_str());
            QVERIFY(study::findProblems(study::paperMode(s)).empty());
            QVERIFY(study::findRecommendations(s).empty());
            QCOMPARE(s.track.shape.slope, 0.0);
            Settings steepest = s;
            for (const double slope : {15.0, -15.0}) {
                steepest.track.shape.slope = slope * base::kDegree;
                QVERIFY(study::findProblems(steepest).empty());
            }
        }
        QCOMPARE(cuboid.track.minSegmentLength, 0.015);
        QCOMPARE(cone.track.minSegmentLength, 0.022);
        QCOMPARE(cuboid.evolution.staticMutation, 0.002);
        QCOMPARE(cone.evolution.staticMutation, 0.001);
        QCOMPARE(cuboid.part.file, std::string("cuboid"));
        QCOMPARE(cone.part.file, std::string("cone"));
        QVERIFY(cone.part.density > 8000.0);

        for (const std::string_view name : study::presetNames())
            QVERIFY(study::presetSettings(std::string(name)).ok());
        QVERIFY(study::presetSettings("cube").error().message.find("\"cuboid\"") != std::string::npos);
    }

    void paperModeIsThePapersChoices() {
        const Settings s = study::paperMode(study::presetSettings("cuboid").value());
        QVERIFY(s.track.encoding == study::PointEncoding::free);
        QVERIFY(s.track.shape.type == track::FeederType::bowl);
        QCOMPARE(s.track.shape.bowlRadius, 0.175);
        QVERIFY(s.evolution.orientationDistance == trial::OrientationDistance::plain);
        QCOMPARE(s.evolution.smoothingLimit, 1.0);
        QCOMPARE(s.evolution.mutationFloor, 0.0);
        QVERIFY(s.evolution.strategyScope == search::ga::StrategyScope::individual);
        QVERIFY(s.evolution.firstGeneration == search::ga::FirstGeneration::random);
        QVERIFY(s.evolution.simulateOverlapping);
        QCOMPARE(s.evolution.racingTrials, 0);
        QVERIFY(!s.evolution.commonRandomNumbers);
        QCOMPARE(s.evolution.learningStep, 0.2e-3);
        QCOMPARE(s.evolution.learningStuckTime, s.simulation.termination.stuckTime);
        QCOMPARE(s.simulation.engine, std::string("simbody"));
    }

    // A score that counts by the tolerance of success does not outlive a change of it.
    void toleranceCountsWhereItIsInTheSum_data() {
        QTest::addColumn<QString>("objectives");
        QTest::addColumn<bool>("kept");
        QTest::newRow("paper") << "F_C, F_D, F_O" << true;
        QTest::newRow("speed") << "F_C, conveying_speed" << true;
        QTest::newRow("success") << "F_C, success" << false;
        QTest::newRow("disorder") << "F_C, disorder" << false;
    }

    void toleranceCountsWhereItIsInTheSum() {
        QFETCH(QString, objectives);
        QFETCH(bool, kept);
        Settings before;
        before.evolution.objectives = objectives.toStdString();
        Settings after = before;
        after.validation.trialsPerPose = 7;
        QVERIFY(study::keepsScores(before, after, 5));
        after.validation.tolerance = 0.5 * before.validation.tolerance;
        QCOMPARE(study::keepsScores(before, after, 5), kept);
    }

    // More parts than a stream can have are a problem where learning sends streams.
    void streamsOfLearningMustFit() {
        study::Settings s = study::presetSettings("cuboid").value();
        s.stream.partsPerMinute = 5000.0;
        QVERIFY(study::findProblems(s).empty());
        s.evolution.objectives = "F_C, throughput";
        const auto problems = study::findProblems(s);
        QCOMPARE(problems.size(), std::size_t{1});
        QVERIFY(problems[0].find("no more than 3600 can") != std::string::npos);
        s.evolution.streamShare = 0.0;
        QVERIFY(study::findProblems(s).empty());
    }

    void aSlopeThatNothingClimbsIsToldOf() {
        Settings s = study::presetSettings("cuboid").value();
        const auto isTold = [&] {
            return std::ranges::any_of(study::findRecommendations(s), [](const std::string& one) {
                return one.find("does not come up a slope") != std::string::npos;
            });
        };
        QVERIFY(!isTold());
        s.track.shape.slope = 3.0 * base::kDegree;
        QVERIFY(!isTold());
        s.simulation.drive.halfStroke = 0.3e-3;
        s.simulation.contact = {0.3, 0.3, 0.2};
        s.track.shape.slope = 10.0 * base::kDegree;
        QVERIFY(isTold());
        s.track.shape.slope = -10.0 * base::kDegree;
        QVERIFY(!isTold());
    }

    // Two of the objectives that are summed, or none.
    void whatIsTradedIsInTheSum_data() {
        QTest::addColumn<QString>("tradeOff");
        QTest::addColumn<QString>("problem");  // empty: none
        QTest::newRow("none") << ""
                              << "";
        QTest::newRow("two") << "success, F_D"
                             << "";
        QTest::newRow("one") << "success"
                             << "Name the two objectives";
        QTest::newRow("three") << "success, F_D, F_C"
                               << "Name the two objectives";
        QTest::newRow("not in the sum") << "success, F_O"
                                        << "F_O is not among evolution.objectives";
        QTest::newRow("unknown") << "success, sucess"
                                 << "no objective named \"sucess\"";
        QTest::newRow("twice") << "success, success"
                               << "named twice";
    }
    void whatIsTradedIsInTheSum() {
        QFETCH(QString, tradeOff);
        QFETCH(QString, problem);
        study::Settings s = study::presetSettings("cuboid").value();
        s.evolution.objectives = "F_C, F_D, success";
        s.evolution.tradeOff = tradeOff.toStdString();
        const auto problems = study::findProblems(s);
        QCOMPARE(problems.empty(), problem.isEmpty());
        if (!problems.empty()) QVERIFY(QString::fromStdString(problems[0]).contains(problem));
        QCOMPARE(study::tradedObjectives(s.evolution).size(), tradeOff == "success, F_D" ? 2U : 0U);
        // What is nonsense in the sum is told once.
        s.evolution.objectives = "nothing";
        QCOMPARE(study::findProblems(s).size(), std::size_t{1});
    }

    // What the presets were before there was a library, to the last bit.
    void presetsTakeTheirPairs_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QString>("pair");
        QTest::addColumn<double>("friction");
        QTest::addColumn<double>("density");
        QTest::newRow("cuboid") << "cuboid"
                                << "abs-on-printed-plastic" << 0.5 << 1040.0;
        QTest::newRow("cone") << "cone"
                              << "brass-on-printed-plastic" << 0.35 << 8500.0;
    }

    void presetsTakeTheirPairs() {
        QFETCH(QString, preset);
        QFETCH(QString, pair);
        QFETCH(double, friction);
        QFETCH(double, density);
        const auto settings = study::presetSettings(preset.toStdString());
        QVERIFY(settings.ok());
        QCOMPARE(settings->simulation.contact.staticFriction, friction);
        QCOMPARE(settings->simulation.contact.kineticFriction, friction);
        QCOMPARE(settings->simulation.contact.restitution, 0.2);
        QCOMPARE(settings->part.density, density);
        const part::MaterialLibrary library = part::readMaterials();
        QCOMPARE(study::findUsedPair(library, *settings), part::findPair(library, pair.toStdString()));
    }

    void pairIsKnownByItsNumbers() {
        const part::MaterialLibrary library = part::readMaterials();
        study::Settings settings = *study::presetSettings("cuboid");
        // Studies of before tell neither material nor surface.
        settings.part.material.clear();
        settings.simulation.surface.clear();
        QCOMPARE(study::findUsedPair(library, settings), part::findPair(library, "ABS", "printed plastic"));
        study::usePair(settings, *part::findPair(library, "steel", "steel sheet"));
        QCOMPARE(study::findUsedPair(library, settings), part::findPair(library, "steel", "steel sheet"));
        // What the pair does not know for sure is what the operating box does not.
        QCOMPARE(settings.box.friction, 0.35);
        QCOMPARE(settings.box.restitution, 0.15);
        settings.simulation.contact.restitution += 0.01;
        QVERIFY(study::findUsedPair(library, settings) == nullptr);
        QCOMPARE(study::findUsedMaterial(library, settings.part)->name, std::string("steel"));
        settings.part.density += 1.0;
        QVERIFY(study::findUsedMaterial(library, settings.part) == nullptr);
        // Two materials of one density are told apart by name.
        study::usePair(settings, *part::findPair(library, "rubber", "SLA resin"));
        QCOMPARE(study::findUsedMaterial(library, settings.part)->name, std::string("rubber"));
    }

    void materialSuggestsItsPair() {
        const part::MaterialLibrary library = part::readMaterials();
        const part::MaterialPair* used = part::findPair(library, "ABS", "steel sheet");
        QCOMPARE(study::suggestPair(library, "POM", used), part::findPair(library, "POM", "steel sheet"));
        QCOMPARE(study::suggestPair(library, "POM", nullptr),
                 part::findPair(library, "POM", "printed plastic"));
        QVERIFY(study::suggestPair(library, "cheese", used) == nullptr);
    }

    void rangesAreHeld_data() {
        QTest::addColumn<Change>("change");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, Change change, const char* expected) {
            QTest::newRow(name) << change << QString(expected);
        };
        row(
            "negative population", [](Settings& s) { s.evolution.populationSize = -5; },
            "evolution.populationSize is -5; it must be from 2 to 100000.");
        row(
            "race of one trial", [](Settings& s) { s.evolution.racingTrials = 1; },
            "evolution.racingTrials is 1; F_O compares two parts at least, so it must be 0 (no race) or at "
            "least 2.");
        row(
            "step that never ends", [](Settings& s) { s.evolution.learningStep = 1e-6; },
            "evolution.learningStep_ms is 0.001; it must be 0 (chosen by the program) or from 0.01 to 1.");
        row(
            "no time at all", [](Settings& s) { s.simulation.termination.timeLimit = 0.02; },
            "simulation.termination.timeLimit_s is 0.02; it must be 0 (as long as the track needs) or from "
            "0.1 to 600.");
        row(
            "race for fewer than the statistics show", [](Settings& s) { s.evolution.racingShare = 0.25; },
            "evolution.racingShare is 0.25; it must be from 0.3 to 1, as what breeds and what is shown is "
            "the best 30 %, unless evolution.search is exchange.");
        row(
            "negative length", [](Settings& s) { s.track.segmentWidth = -3e-3; },
            "track.segmentWidth_mm is -3; it must be from 1 to 1000.");
        row(
            "not a number",
            [](Settings& s) { s.track.segmentHeight = std::numeric_limits<double>::quiet_NaN(); },
            "track.segmentHeight_mm is not a number; it must be from 0.1 to 1000.");
        row(
            "infinite", [](Settings& s) { s.simulation.gravity = std::numeric_limits<double>::infinity(); },
            "simulation.gravity_m_s2 is infinite; it must be from 0.1 to 100.");
        row(
            "slope", [](Settings& s) { s.track.shape.slope = -16 * base::kDegree; },
            "track.slope_deg is -16; it must be from -15 to 15.");
        row(
            "angle", [](Settings& s) { s.simulation.drive.angle = 95 * base::kDegree; },
            "simulation.drive.angle_deg is 95; it must be from 0.1 to 89.");
        row(
            "mutation", [](Settings& s) { s.evolution.staticMutation = 1.5; },
            "evolution.staticMutation is 1.5; it must be from 0 to 1.");
        row(
            "lengths crossed", [](Settings& s) { s.track.minSegmentLength = 40e-3; },
            "track.minSegmentLength_mm is 40; it must not be more than track.maxSegmentLength_mm, which is "
            "36.");
        row(
            "start in the trap", [](Settings& s) { s.track.startFromLeadInEnd = 80e-3; },
            "track.startFromLeadInEnd_mm is 80; the start must lie on the lead-in, so it must be less than "
            "track.leadInLength_mm, which is 80.");
        row(
            "spiral", [](Settings& s) { s.track.spiral.width = 56e-3; },
            "track.spiralWidth_mm is 56; with its wall it must find room in track.segmentWidth_mm, so it "
            "must be 55.6 mm at most.");
        row(
            "spiral, start", [](Settings& s) { s.track.spiral.width = 3e-3; },
            "track.spiralWidth_mm is 3; parts start up to 2 mm beside the middle, so it must be at least 4 "
            "mm, or simulation.start.lateral_mm or box.startOffset_mm less.");
        row(
            "spiral, points",
            [](Settings& s) {
                s.track.spiral.width = 20e-3;
                s.track.pointsPerSection = 3;
            },
            "track.pointsPerSection is 3; a spiral's ledge and wall (track.spiralWidth_mm) need at least 4.");
        row(
            "spiral, wall",
            [](Settings& s) {
                s.track.spiral = {20e-3, 16e-3, 0.0};
            },
            "track.spiralWall_mm is 16; ledge and wall keep to track.segmentHeight_mm, in the middle of "
            "which the ledge lies, so it must be 15 mm at most, or that higher.");
        row(
            "chute", [](Settings& s) { s.track.chute.angle = 61 * base::kDegree; },
            "track.chuteAngle_deg is 61; it must be from 1 to 60.");
        row(
            "tournament", [](Settings& s) { s.evolution.populationSize = 4; },
            "evolution.tournamentSize is 6; it must not be more than evolution.populationSize, which is 4.");
        row(
            "friction", [](Settings& s) { s.simulation.contact.kineticFriction = 0.75; },
            "simulation.contact.kineticFriction is 0.75; it must not be more than "
            "simulation.contact.staticFriction, which is 0.5.");
        row(
            "start beside", [](Settings& s) { s.simulation.start.lateral = 31e-3; },
            "simulation.start.lateral_mm is 31; parts would start beside the track, so it must not be more "
            "than half of track.segmentWidth_mm, which is 60.");
        row(
            "no rotation", [](Settings& s) { s.simulation.start.nearPose = base::Quaternion(2, 0, 0, 0); },
            "simulation.start.nearPose has the length 2; a rotation [w, x, y, z] must have the length 1.");
        row(
            "no engine", [](Settings& s) { s.simulation.engine.clear(); },
            "simulation.engine is empty; name an engine, e.g. hybrid.");
        row(
            "wide bowl",
            [](Settings& s) {
                s.track.shape.type = track::FeederType::bowl;
                s.track.segmentWidth = 0.35;
            },
            "track.segmentWidth_mm is 350; on a bowl it must be less than twice track.bowlRadius_mm, which "
            "is 175.");
        row(
            "long bowl",
            [](Settings& s) {
                s.track.shape.type = track::FeederType::bowl;
                s.track.crossSections = 27;
            },
            "track.bowlRadius_mm is 175: one turn of that bowl is 1099.5574 mm and the longest track of "
            "these settings is 1124 mm. "
            "Enlarge the radius or shorten the segments, the lead-in or the lead-out.");
    }
    void rangesAreHeld() {
        QFETCH(Change, change);
        QFETCH(QString, expected);
        Settings settings;
        QVERIFY(study::findProblems(settings).empty());
        change(settings);
        const auto problems = study::findProblems(settings);
        QCOMPARE(QString::fromStdString(joined(problems)), expected + "\n");
    }

    void boundsThemselvesAreAllowed() {
        Settings settings;
        settings.track.segmentHeight = 0.1e-3;
        settings.simulation.drive.halfStroke = 0.001e-3;
        settings.simulation.drive.angle = 0.1 * base::kDegree;
        settings.validation.tolerance = 180.0 * base::kDegree;
        QVERIFY2(study::findProblems(settings).empty(), joined(study::findProblems(settings)).c_str());
    }

    void roomBehindTheStartIsRecommended() {
        Settings settings;
        settings.track.startFromLeadInEnd = 21e-3;
        const auto lines = study::findRecommendations(settings);
        QCOMPARE(lines.size(), std::size_t{1});
        QVERIFY2(lines[0].find("59 mm") != std::string::npos, lines[0].c_str());
        QVERIFY(study::findProblems(settings).empty());
    }

    // A chain of drops needs a higher segment than a free-form trap.
    void heightForTrapsThatFallIsRecommended() {
        Settings settings;
        settings.track.traps = "step, free-form";
        QVERIFY(study::findRecommendations(settings).empty());
        settings.track.traps = "groove, 6 x drop";
        const auto lines = study::findRecommendations(settings);
        QCOMPARE(lines.size(), std::size_t{1});
        const double fall = study::calcTypicalFall(settings.track);
        QVERIFY(fall > 100e-3 && fall < 130e-3);
        const std::string least = std::to_string(static_cast<int>(std::ceil(2e3 * fall))) + " mm";
        QVERIFY2(lines[0].find("at least " + least) != std::string::npos, lines[0].c_str());
        QVERIFY(study::findProblems(settings).empty());
        settings.track.segmentHeight = std::ceil(2e3 * fall) * 1e-3;
        QVERIFY(study::findRecommendations(settings).empty());
        QVERIFY(std::abs(study::calcTypicalFall(settings.track) - fall) < 1e-12);
    }

    // Corners of the box are learned from a generation to come on, and nothing else changes with that.
    void cornersCanBeLearnedLater() {
        Settings before;
        before.evolution.generations = 30;
        const Settings after = study::learnInCorners(before, 20);
        QCOMPARE(study::cornerShareIn(after.evolution, 19), 0.0);
        QCOMPARE(study::cornerShareIn(after.evolution, 20), 0.6);
        QCOMPARE(after.evolution.objectives, std::string("F_C, F_D, F_O, corners"));
        QCOMPARE(after.evolution.generations, 40);
        QVERIFY(study::findProblems(after).empty() && study::findRecommendations(after).empty());
        QVERIFY(study::keepsScores(before, after, 20));
        QVERIFY(study::keepsScores(after, before, 20));
        QVERIFY(!study::keepsScores(before, after, 21));
        QVERIFY(!study::keepsScores(after, before, 21));  // one has been learned in corners
        Settings other = after;
        other.evolution.objectives = "F_C, F_O, corners";
        QVERIFY(!study::keepsScores(before, other, 20));
        other.evolution.objectives = "F_C, F_O, F_D, corners";
        QVERIFY(!study::keepsScores(before, other, 20));  // another order gives other bits
        // They can once, where there are some.
        QVERIFY(study::canLearnInCorners(before, 20));
        QVERIFY(study::canLearnInCorners(after, 19));
        QVERIFY(!study::canLearnInCorners(after, 20));
        Settings level = before;
        level.box = {};
        level.box.friction = level.box.restitution = level.box.halfStroke = 0.0;
        level.box.sizeBelow = level.box.sizeAbove = 0.0;
        QVERIFY(!study::canLearnInCorners(level, 20));
        before.evolution.conditions = study::TrialConditions::nominal;
        QVERIFY(!study::canLearnInCorners(before, 20));
        QCOMPARE(study::cornerShareIn(study::learnInCorners(before, 20).evolution, 30), 0.0);
        // What counts already is not counted twice, and more generations stay.
        Settings counted;
        counted.evolution.objectives = "F_C, corners, F_O";
        QCOMPARE(study::learnInCorners(counted, 20).evolution.objectives, counted.evolution.objectives);
        QCOMPARE(study::learnInCorners(counted, 20).evolution.generations, counted.evolution.generations);
    }

    // What is set and does nothing is told.
    void cornersNeedTrialsThatVary() {
        Settings settings;
        const auto isTold = [&](const char* words) {
            const auto lines = study::findRecommendations(settings);
            return lines.size() == 1 && lines[0].find(words) != std::string::npos;
        };
        settings.evolution.cornerShare = 0.3;
        settings.evolution.objectives = "F_C, F_D, F_O, corners";
        QVERIFY(study::findRecommendations(settings).empty());
        settings.evolution.cornerShare = 0.0;
        QVERIFY(isTold("no trial is in one"));
        settings.evolution.objectives = objectives::kPaperObjectives;
        QVERIFY(study::findRecommendations(settings).empty());
        settings.evolution.cornerShare = 0.3;
        settings.evolution.conditions = study::TrialConditions::nominal;
        QVERIFY(isTold("no trial varies"));
        settings.evolution.conditions = study::TrialConditions::varied;
        settings.evolution.cornersFrom = 100;
        QVERIFY(isTold("From generation 100 on"));
        settings.evolution.objectives = "F_C, F_D, F_O, corners";
        QVERIFY(study::findRecommendations(settings).empty());
        settings.evolution.generations = 100;
        QVERIFY(isTold("learning ends with generation 99"));
    }

    void partMustFit_data() {
        QTest::addColumn<double>("radius");
        QTest::addColumn<int>("problems");
        QTest::addColumn<QString>("named");
        QTest::newRow("cuboid") << 7.5e-3 << 0 << "";
        QTest::newRow("reaches the trap") << 21e-3 << 1 << "track.startFromLeadInEnd_mm (20)";
        QTest::newRow("wider than the track") << 29e-3 << 2 << "Set track.segmentWidth_mm to at least 62 mm";
        QTest::newRow("in metres") << 7.5 << 3 << "check the units";
    }
    void partMustFit() {
        QFETCH(double, radius);
        QFETCH(int, problems);
        QFETCH(QString, named);
        const auto found = study::findPartProblems(Settings{}, partOfRadius(radius));
        QCOMPARE(static_cast<int>(found.size()), problems);
        QVERIFY2(QString::fromStdString(joined(found)).contains(named), joined(found).c_str());
    }
};

QTEST_APPLESS_MAIN(SettingsCheckTest)
#include "settings_check_test.moc"
