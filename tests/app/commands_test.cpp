#include <QJsonArray>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/store/study_file.h"
#include "tests/app/program.h"

using namespace trapwright::test;

/// What the commands answer, where it is known from outside the program.
class CommandsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        const Ran ran = ask(quickStudy("study.trap", 2));
        QVERIFY2(ran.code == 0, ran.all());
        // A line for each generation.
        QVERIFY2(ran.output.contains("\n         1 "), ran.all());
    }

    void help_data() {
        QTest::addColumn<QString>("command");
        for (const char* name :
             {"part",   "new",      "settings", "evolve",  "select", "validate", "robustness",
              "stream", "physical", "mend",     "export",  "replay", "track",    "submit",
              "sweep",  "verify",   "bench",    "compare", "demo",   "dump"}) {
            QTest::newRow(name) << name;
        }
    }

    void help() {
        QFETCH(QString, command);
        const Ran ran = ask({command, "--help"});
        QCOMPARE(ran.code, 0);
        QVERIFY2(ran.output.contains("--json") &&
                     ran.output.contains("Example:\n  trapwright " + command.toUtf8()),
                 ran.all());
        QVERIFY(ask({"--help"}).output.contains("  " + command.toUtf8() + " "));
        // In lines that a terminal holds, and in words instead of the parser's types.
        for (const QByteArray& line : ran.output.split('\n'))
            QVERIFY2(line.size() <= 100 || line.startsWith("  trapwright "), line);
        for (const char* type : {"TEXT", "FLOAT", "INT", "REQUIRED", "Excludes", "Needs", "\n\n\n"})
            QVERIFY2(!ran.output.contains(type), type);
    }

    void version() {
        const Ran ran = ask({"--version"});
        QCOMPARE(ran.code, 0);
        QCOMPARE(ran.output, QByteArray("trapwright " TRAPWRIGHT_VERSION "\n"));
    }

    /// A homogeneous box: volume, mass and moments of inertia in closed form.
    void cuboid() {
        const QJsonObject part = ask({"part", "cuboid", "--density", "1000", "--json"}).json();
        QCOMPARE(part["size_mm"].toArray(), QJsonArray({4.0, 8.0, 12.0}));
        QVERIFY(std::abs(part["volume_mm3"].toDouble() - 384.0) < 1e-6);
        QVERIFY(std::abs(part["mass_g"].toDouble() - 0.384) < 1e-9);
        const QJsonArray inertia = part["inertia_g_mm2"].toArray();
        const double expected[] = {0.384 * (64 + 144) / 12, 0.384 * (16 + 144) / 12, 0.384 * (16 + 64) / 12};
        for (int i = 0; i < 3; ++i)
            QVERIFY(std::abs(inertia[i].toArray()[i].toDouble() - expected[i]) < 1e-6);
        QCOMPARE(part["convex_pieces"].toInt(), 1);
        QCOMPARE(part["symmetry"].toObject()["name"].toString(), "D2");
        double probability = 0.0;
        for (const QJsonValue pose : part["stable_poses"].toArray())
            probability += pose["probability"].toDouble();
        QCOMPARE(part["stable_poses"].toArray().size(), 6);
        QVERIFY(std::abs(probability - 1.0) < 1e-9);
    }

    /// A hexagon bolt lies on any of six sides, or stands on its head or its tip.
    void boltHasThreeKindsOfPoses() {
        const QJsonObject part = ask({"part", "bolt", "--json"}).json();
        QCOMPARE(part["stable_poses"].toArray().size(), 8);
        const QJsonArray groups = part["pose_groups"].toArray();
        QCOMPARE(groups.size(), 3);
        QCOMPARE(groups[0].toObject()["poses"].toArray(), QJsonArray({1, 2, 3, 4, 5, 6}));
        double probability = 0.0;
        for (const QJsonValue group : groups)
            probability += group["probability"].toDouble();
        QVERIFY(std::abs(probability - 1.0) < 1e-9);
        const Ran shown = ask({"part", "bolt"});
        QVERIFY2(shown.output.contains("    1-6       6 "), shown.all());
        QVERIFY2(!shown.output.contains("\n          2 "), shown.all());
        QVERIFY2(ask({"part", "bolt", "--poses"}).output.contains("\n          2 "), shown.all());
    }

    /// Where the file lies in its own coordinates, and its unit.
    void unitsAndCentre() {
        QByteArray obj;
        for (int i = 0; i < 8; ++i) {
            obj += "v " + QByteArray::number(10 + 4 * (i & 1)) + " " + QByteArray::number(4 * (i & 2)) + " " +
                   QByteArray::number(3 * (i & 4)) + "\n";
        }
        obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
        write(folder_.filePath("box.obj"), obj);
        const QJsonObject millimetres = ask({"part", "box.obj", "--json"}).json();
        QCOMPARE(millimetres["units"].toString(), "mm");
        const QJsonArray centre = millimetres["centre_mm"].toArray();
        QVERIFY(std::abs(centre[0].toDouble() - 12.0) < 1e-6 && std::abs(centre[1].toDouble() - 4.0) < 1e-6 &&
                std::abs(centre[2].toDouble() - 6.0) < 1e-6);
        const QJsonObject inches = ask({"part", "box.obj", "--units", "inch", "--json"}).json();
        QVERIFY(std::abs(inches["size_mm"].toArray()[2].toDouble() - 12.0 * 25.4) < 1e-6);
    }

    void settingsComeBack() {
        const Ran settings = ask({"settings", "study.trap"});
        QCOMPARE(settings.code, 0);
        write(folder_.filePath("settings.json"), settings.output);
        QCOMPARE(ask({"new", "copy.trap", "--settings", "settings.json"}).code, 0);
        QCOMPARE(ask({"settings", "copy.trap"}).output, settings.output);
        QCOMPARE(ask({"settings", "study.trap", "--json"})
                     .json()["evolution"]
                     .toObject()["populationSize"]
                     .toInt(),
                 8);
    }

    void paperMode() {
        QCOMPARE(ask({"new", "paper.trap", "--preset", "cone", "--paper"}).code, 0);
        const QJsonObject settings = ask({"settings", "paper.trap", "--json"}).json();
        QCOMPARE(settings["track"].toObject()["encoding"].toString(), "free");
        QCOMPARE(settings["evolution"].toObject()["orientationDistance"].toString(), "plain");
        QCOMPARE(settings["part"].toObject()["file"].toString(), "cone");
    }

    // How far a pair of materials may be off comes with it; what is set one by one comes after it.
    void surfaceSetsTheOperatingBox() {
        QCOMPARE(ask({"new", "steel.trap", "--part", "bolt", "--material", "steel", "--surface",
                      "steel-sheet", "--set", "box.restitution=0.05"})
                     .code,
                 0);
        const QJsonObject box = ask({"settings", "steel.trap", "--json"}).json()["box"].toObject();
        QCOMPARE(box["friction"].toDouble(), 0.35);
        QCOMPARE(box["restitution"].toDouble(), 0.05);
    }

    // In proportion to the part; what is set one by one comes after it.
    void sortingMode() {
        QCOMPARE(ask({"new", "sorting.trap", "--part", "wedge", "--sorting", "--population", "7", "--set",
                      "evolution.tournamentSize=5"})
                     .code,
                 0);
        const QJsonObject settings = ask({"settings", "sorting.trap", "--json"}).json();
        QCOMPARE(settings["track"].toObject()["traps"].toString(), "groove, groove, 8 x gap");
        QCOMPARE(settings["evolution"].toObject()["objectives"].toString(), "sorting");
        QCOMPARE(settings["evolution"].toObject()["firstGeneration"].toString(), "planned");
        QCOMPARE(settings["evolution"].toObject()["populationSize"].toInt(), 7);
        // What a selection does not give up learning does not either.
        QCOMPARE(settings["evolution"].toObject()["learningStuckTime_s"].toDouble(), 1.5);
        const double longest = settings["track"].toObject()["maxSegmentLength_mm"].toDouble();
        const double width = settings["track"].toObject()["segmentWidth_mm"].toDouble();
        QVERIFY2(longest > 28.0 && longest < 34.0, qPrintable(QString::number(longest)));
        QVERIFY(std::abs(width / longest - 2.0) < 0.05);
        const Ran both = ask({"new", "both.trap", "--part", "wedge", "--sorting", "--paper"});
        QCOMPARE(both.code, 2);
        QVERIFY(both.errors.contains("--sorting"));
    }

    // Planned like gaps, and a slot is not made of fewer points than it has.
    void slotMode() {
        QCOMPARE(ask({"new", "slots.trap", "--part", "bolt", "--slots"}).code, 0);
        const QJsonObject settings = ask({"settings", "slots.trap", "--json"}).json();
        QCOMPARE(settings["track"].toObject()["traps"].toString(), "groove, groove, 3 x slot");
        QCOMPARE(settings["evolution"].toObject()["objectives"].toString(), "sorting");
        QCOMPARE(settings["evolution"].toObject()["firstGeneration"].toString(), "planned");
        for (const char* other : {"--sorting", "--ledges", "--paper"}) {
            const Ran both = ask({"new", "both.trap", "--part", "bolt", "--slots", other});
            QCOMPARE(both.code, 2);
            QVERIFY(both.errors.contains("--slots"));
        }
        const Ran few =
            ask({"new", "few.trap", "--part", "bolt", "--slots", "--set", "track.pointsPerSection=5"});
        QCOMPARE(few.code, 2);
        QVERIFY2(few.errors.contains("track.pointsPerSection is 5; the trap slot needs at least 6."),
                 few.errors.constData());
    }

    // Learned without a plan, and head up is what is wanted.
    void railsMode() {
        QCOMPARE(ask({"new", "rails.trap", "--part", "bolt", "--rails"}).code, 0);
        const QJsonObject settings = ask({"settings", "rails.trap", "--json"}).json();
        QCOMPARE(settings["track"].toObject()["traps"].toString(), "drop, groove, narrow rails");
        QCOMPARE(settings["track"].toObject()["leadOutSegments"].toInt(), 3);
        QVERIFY(settings["track"].toObject()["innerWall_mm"].toDouble() > 0.0);
        QCOMPARE(settings["evolution"].toObject()["firstGeneration"].toString(), "graded");
        QCOMPARE(settings["target"].toObject()["poses"].toString(), "8");
        QCOMPARE(settings["target"].toObject()["heading_deg"].toString(), "any");
        const Ran both = ask({"new", "both.trap", "--part", "bolt", "--rails", "--slots"});
        QCOMPARE(both.code, 2);
        QVERIFY(both.errors.contains("--rails"));
        // A plan that cannot bring it so says what can.
        const Ran planned = ask({"evolve", "planned.trap", "--part", "bolt", "--slots", "--engine", "native",
                                 "--set", "target.poses=8"});
        QCOMPARE(planned.code, 2);
        QVERIFY2(planned.errors.contains("rails may bring it so"), planned.all());
    }

    // Gaps and ledges in proportion to the part, planned; ledges also behind a track that is there.
    void ledgeMode() {
        QCOMPARE(ask({"new", "ledges.trap", "--part", "bracket", "--ledges"}).code, 0);
        const QJsonObject settings = ask({"settings", "ledges.trap", "--json"}).json();
        const QJsonObject track = settings["track"].toObject();
        QCOMPARE(track["traps"].toString(), "groove, groove, 8 x gap, 6 x ledge");
        QCOMPARE(track["returns"].toString(), "anywhere");
        QCOMPARE(track["spiralWidth_mm"].toDouble(), 0.0);
        const double wall = track["spiralWall_mm"].toDouble();
        QVERIFY2(wall > 9.0 && wall < 11.5, qPrintable(QString::number(wall)));
        QCOMPARE(settings["evolution"].toObject()["objectives"].toString(), "F_C, purity, yield");
        QCOMPARE(settings["evolution"].toObject()["firstGeneration"].toString(), "planned");
        QCOMPARE(settings["evolution"].toObject()["search"].toString(), "exchange");
        for (const char* other : {"--sorting", "--paper"}) {
            const Ran both = ask({"new", "both.trap", "--part", "bracket", "--ledges", other});
            QCOMPARE(both.code, 2);
            QVERIFY(both.errors.contains("--ledges"));
        }
        const QByteArray cone = QByteArray(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/cone_track.json";
        QCOMPARE(ask({"new", "behind.trap", "--behind", cone.constData(), "--preset", "cone", "--set",
                      "track.traps=4 x ledge", "--set", "evolution.firstGeneration=planned"})
                     .code,
                 0);
        const Ran gaps =
            ask({"new", "gaps.trap", "--behind", cone.constData(), "--preset", "cone", "--set",
                 "track.traps=groove, groove, gap", "--set", "evolution.firstGeneration=planned"});
        QVERIFY(gaps.code != 0);
        QVERIFY2(gaps.errors.contains("only ledges are planned"), gaps.errors.constData());
        // Behind a spiral, gaps and other ledges they are what is proposed.
        const std::pair<const char*, const char*> proposed[] = {
            {"bracket_ledges_track.json", "4 x ledge"},
            {"bracket_track.json", "6 x ledge"},
            {"bracket_gaps_ledges_box_track.json", "4 x ledge"}};
        for (const auto& [file, traps] : proposed) {
            const QByteArray path = QByteArray(TRAPWRIGHT_SOURCE_DIR) + "/resources/tracks/" + file;
            const QByteArray study = QByteArray("behind-") + file + ".trap";
            QCOMPARE(ask({"new", study.constData(), "--behind", path.constData(), "--part", "bracket"}).code,
                     0);
            const QJsonObject more = ask({"settings", study.constData(), "--json"}).json();
            QCOMPARE(more["track"].toObject()["traps"].toString(), traps);
            QVERIFY(more["track"].toObject()["spiralInclination_deg"].toDouble() > 5.0);
            QCOMPARE(more["evolution"].toObject()["firstGeneration"].toString(), "planned");
            QCOMPARE(more["evolution"].toObject()["learningStuckTime_s"].toDouble(), 1.5);
        }
    }

    // What is learned goes by the part, how much of it by the time; what is set one by one comes after it.
    void settingsForATime() {
        // Enough of it for a busy machine too.
        const Ran made = ask({"new", "timed.trap", "--part", "wedge", "--engine", "native", "--time",
                              "1h30min", "--generations", "3"});
        QVERIFY2(made.code == 0, made.all());
        QVERIFY2(made.errors.contains("wedge (symmetry C1) looks another way"), made.all());
        QVERIFY2(made.errors.contains("here, of 1 h 30 min."), made.all());
        const QJsonObject settings = ask({"settings", "timed.trap", "--json"}).json();
        QVERIFY(settings["track"].toObject()["traps"].toString().startsWith("groove, groove, 8 x gap"));
        QCOMPARE(settings["evolution"].toObject()["generations"].toInt(), 3);

        // How it is learned can be the user's, and only how much of it goes by the time.
        for (const auto& [idea, last] :
             {std::pair("--sorting", "gap"), std::pair("--ledges", "ledge"), std::pair("--slots", "slot")}) {
            const std::string name = std::string("asked") + idea + ".trap";
            const Ran asked = ask(
                {"new", name.c_str(), "--part", "wedge", "--engine", "native", "--time", "1h30min", idea});
            QVERIFY2(asked.code == 0, asked.all());
            QVERIFY2(asked.errors.contains("here, of 1 h 30 min."), asked.all());
            const QJsonObject fitted = ask({"settings", name.c_str(), "--json"}).json();
            QVERIFY(fitted["track"].toObject()["traps"].toString().endsWith(QString(" x ") + last));
        }

        // Refused before anything is made, with what to write instead.
        for (const char* wrong : {"", "10", "10 apples", "min", "-1h", "1h nonsense"}) {
            const Ran refused = ask({"new", "no.trap", "--part", "wedge", "--time", wrong});
            QCOMPARE(refused.code, 2);
            QVERIFY2(*wrong == '\0' || refused.errors.contains("1h30min"), refused.all());
        }
        const Ran tooShort = ask({"new", "no.trap", "--part", "wedge", "--time", "30s"});
        QCOMPARE(tooShort.code, 2);
        QVERIFY2(tooShort.errors.contains("60 s or more"), tooShort.all());
        QCOMPARE(ask({"new", "no.trap", "--part", "wedge", "--time", "2min", "--paper"}).code, 2);
        QVERIFY(!QFile::exists("no.trap"));
        QCOMPARE(ask({"evolve", "timed.trap", "--time", "2min"}).code, 2);
    }

    void selectValidateExportReplay() {
        const QJsonObject selection =
            ask({"select", "study.trap", "--winners", "2", "--trials", "5", "--json"}).json();
        const QJsonArray entries = selection["selection"].toObject()["entries"].toArray();
        QVERIFY(!entries.isEmpty() && entries.size() <= 2);
        QCOMPARE(entries[0].toObject()["trials"].toInt(), 5);
        const int generation = entries[0].toObject()["generation"].toInt();

        // The selected one is validated, pose by pose, as the sum tells.
        const QJsonObject answer =
            ask({"validate", "study.trap", "--trials", "3", "--tolerance", "30", "--json"}).json();
        const QJsonObject validation = answer["validation"].toObject();
        QCOMPARE(validation["generation"].toInt(), generation);
        QCOMPARE(validation["poses"].toArray().size(), 6);
        QCOMPARE(validation["total"].toObject()["trials"].toInt(), 18);
        QCOMPARE(validation["groups"].toArray().size(), 3);
        QCOMPARE(validation["groups"].toArray()[0].toObject()["trials"].toInt(), 6);
        const QJsonObject weighted = validation["weighted_success"].toObject();
        QVERIFY(weighted["low"].toDouble() <= weighted["share"].toDouble() &&
                weighted["share"].toDouble() <= weighted["high"].toDouble());
        QVERIFY(std::abs(validation["tolerance_deg"].toDouble() - 30.0) < 1e-9);

        const Ran exported = ask({"export", "study.trap", "track.stl", "track.3mf", "track.json", "--json"});
        QVERIFY2(exported.code == 0, exported.all());
        const QJsonArray files = exported.json()["files"].toArray();
        QCOMPARE(files.size(), 3);
        for (const QJsonValue file : files) {
            QVERIFY(file["closed_and_manifold"].toBool());
            QVERIFY(std::abs(file["size_mm"].toArray()[1].toDouble() - 60.0) < 1e-3);
        }
        // 80 bytes, a count, 50 bytes for each triangle.
        const int triangles = files[0]["triangles"].toInt();
        QCOMPARE(QFileInfo(folder_.filePath("track.stl")).size(), 84 + 50 * triangles);
        // The program's own part import finds a solid of that size in it.
        const QJsonObject track = ask({"part", "track.stl", "--units", "mm", "--json"}).json();
        QVERIFY(std::abs(track["volume_mm3"].toDouble() / files[0]["volume_mm3"].toDouble() - 1.0) < 1e-6);
        // The flange is wider than the track by 8 + 8 mm at both sides, the walls are 2 mm thick.
        const Ran mounted = ask({"export", "study.trap", "mounted.stl", "--wall-height", "6", "--flange",
                                 "--bolt-diameter", "3.4", "--base-thickness", "4", "--json"});
        QVERIFY2(mounted.code == 0, mounted.all());
        const QJsonValue solid = mounted.json()["files"].toArray()[0];
        QVERIFY(solid["closed_and_manifold"].toBool());
        QVERIFY(std::abs(solid["size_mm"].toArray()[1].toDouble() - 96.0) < 1e-3);
        QVERIFY(solid["volume_mm3"].toDouble() > files[0]["volume_mm3"].toDouble());
        QVERIFY(mounted.json()["print"].toObject().contains("overhangs"));
        const Ran thick = ask({"export", "study.trap", "thick.stl", "--flange", "--flange-thickness", "9"});
        QCOMPARE(thick.code, 2);
        QVERIFY2(thick.errors.contains("at most the base thickness"), thick.all());
        // For a small bed it is cut into pieces that fit, and for machining it is one solid of plane faces.
        const Ran cut = ask({"export", "study.trap", "cut.stl", "cut.3mf", "whole.step", "--bed",
                             "150x120x100", "--split", "--json"});
        QVERIFY2(cut.code == 0, cut.all());
        const QJsonArray pieces = cut.json()["print"].toObject()["pieces"].toArray();
        QVERIFY(pieces.size() >= 2);
        for (const QJsonValue piece : pieces) {
            QVERIFY(piece["fits"].toBool());
            QVERIFY(piece["dowel_holes"].toInt() >= 2);
        }
        QVERIFY(QFileInfo::exists(folder_.filePath(QString("cut-1-of-%1.stl").arg(pieces.size()))));
        const Ran step = ask({"export", "study.trap", "track.step", "--json"});
        QVERIFY2(step.code == 0, step.all());
        const QJsonValue machined = step.json()["files"].toArray()[0];
        QVERIFY(machined["faces"].toInt() < triangles);
        QVERIFY(std::abs(machined["volume_mm3"].toDouble() / files[0]["volume_mm3"].toDouble() - 1.0) < 1e-4);
        const Ran noFit = ask({"export", "study.trap", "large.stl", "--printer", "prusa-mini"});
        QCOMPARE(noFit.code, 0);
        QVERIFY2(noFit.output.contains("mm too large in"), noFit.all());
        const Ran unknown = ask({"export", "study.trap", "x.stl", "--printer", "prusa"});
        QCOMPARE(unknown.code, 2);
        QVERIFY2(unknown.errors.contains("prusa-mk4"), unknown.all());
        for (const char* bed : {"250x210", "250,210,220", "0x210x220", "250x210x220mm"})
            QCOMPARE(ask({"export", "study.trap", "x.stl", "--bed", bed}).code, 2);
        QCOMPARE(ask({"export", "study.trap", "x.stl", "--split"}).code, 2);
        QCOMPARE(ask({"export", "study.trap", "x.stl", "--cut", "99"}).code, 2);
        // What is written for `track` can be exported again, to the same solid.
        const Ran again = ask({"export", "track.json", "again.stl", "--json"});
        QVERIFY2(again.code == 0, again.all());
        QCOMPARE(again.json()["track"].toString(), "track.json");
        const QJsonValue solidAgain = again.json()["files"].toArray()[0];
        QVERIFY(std::abs(solidAgain["volume_mm3"].toDouble() / files[0]["volume_mm3"].toDouble() - 1.0) <
                1e-9);
        const Ran chosen = ask({"export", "track.json", "again.stl", "--generation", "0"});
        QCOMPARE(chosen.code, 2);
        QVERIFY2(chosen.errors.contains("choose from a study"), chosen.all());
        QVERIFY(QFile::copy(folder_.filePath("track.json"), folder_.filePath("alone.json")));
        const Ran beside = ask({"export", "alone.json"});
        QVERIFY2(beside.code == 0, beside.all());
        for (const char* file : {"alone.stl", "alone.3mf"})
            QVERIFY(QFileInfo::exists(folder_.filePath(file)));
        // What is written for `track` can be simulated.
        const Ran simulated = ask({"track", "track.json", "--trials", "2", "--json"});
        QVERIFY2(simulated.code == 0, simulated.all());
        QCOMPARE(simulated.json()["trials"].toInt(), 2);
    }

    void replayTellsTheTrial() {
        const Ran ran = ask({"replay", "study.trap", "--generation", "1", "--individual", "3", "--trial", "2",
                             "--interval", "10"});
        QVERIFY2(ran.code == 0, ran.all());
        QByteArrayList lines = ran.output.trimmed().split('\n');
        QVERIFY(lines[0].startsWith("# study.trap: generation 1, individual 3, learning trial 2"));
        QVERIFY(lines[1].startsWith("# "));
        QVERIFY(lines[2].startsWith("time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,"));
        // The first pose is above the lead-in at the start point, 60 mm along and half of 30 mm up; at rest
        // in the room, so that only the drive moves it relative to the track.
        const QByteArrayList first = lines[3].split(',');
        QCOMPARE(first.size(), lines[2].split(',').size());
        QCOMPARE(first[0].toDouble(), 0.0);
        QVERIFY(std::abs(first[1].toDouble() - 60.0) < 1.0);
        QVERIFY(first[3].toDouble() > 15.0 && first[3].toDouble() < 30.0);
        double norm = 0.0;
        for (int i = 4; i < 8; ++i)
            norm += std::pow(first[i].toDouble(), 2);
        QVERIFY(std::abs(norm - 1.0) < 1e-6);
        QVERIFY(std::abs(lines[4].split(',')[0].toDouble() - 0.01) < 2e-4);
        QCOMPARE(ask({"replay", "study.trap", "--generation", "1", "--individual", "3", "--trial", "2",
                      "--interval", "10"})
                     .output,
                 ran.output);
        QCOMPARE(ask({"replay", "study.trap", "--trial", "3"}).code, 2);
        QCOMPARE(ask({"replay", "study.trap", "--generation", "2"}).code, 2);
    }

    void track() {
        const QString file = QStringLiteral(TRAPWRIGHT_SOURCE_DIR "/resources/tracks/cuboid_track.json");
        const QJsonObject answer = ask({"track", file, "--trials", "6", "--json"}).json();
        QCOMPARE(answer["trials"].toInt(), 6);
        const int ended = answer["finished"].toObject()["count"].toInt() +
                          answer["fell_off"].toObject()["count"].toInt() +
                          answer["stuck"].toObject()["count"].toInt();
        QCOMPARE(ended, 6);
        // Who finishes ends in one of the ways; the first is the one that most do.
        int finished = 0;
        int before = 6;
        for (const QJsonValue way : answer["ends"].toArray()) {
            const int count = way["count"].toInt();
            QVERIFY(count >= 1 && count <= before && way["pose"].toInt() >= 1);
            QVERIFY(std::abs(way["heading_deg"].toDouble()) <= 180.0);
            finished += count;
            before = count;
        }
        QCOMPARE(finished, answer["finished"].toObject()["count"].toInt());
        // 1.0 at 0.478 mm (50 Hz, 12 degrees), and proportional to the half-stroke.
        QVERIFY(std::abs(answer["throw_number"].toDouble() - 0.8 / 0.478) < 2e-3);
    }

    // Judged over the box, each trial counts once in each condition; of trials that are all alike nothing is
    // told.
    void judgedByCondition() {
        QVERIFY(QFile::copy(folder_.filePath("study.trap"), folder_.filePath("sliced.trap")));
        const auto sumOf = [](const QJsonValue& condition) {
            int trials = 0;
            for (const QJsonValue slice : condition["slices"].toArray())
                trials += slice["trials"].toInt();
            return trials;
        };
        const Ran validated = ask({"validate", "sliced.trap", "--trials", "8", "--conditions", "varied",
                                   "--engine", "native", "--json"});
        QVERIFY2(validated.code == 0, validated.all());
        const QJsonArray conditions = validated.json()["conditions"].toArray();
        QCOMPARE(conditions.size(), 4);
        for (const QJsonValue condition : conditions)
            QCOMPARE(sumOf(condition), 8 * 6);
        QCOMPARE(conditions[0]["condition"].toString(), QString("friction"));
        const Ran selected = ask({"select", "sliced.trap", "--trials", "8", "--winners", "2", "--conditions",
                                  "varied", "--corner-trials", "16", "--engine", "native", "--json"});
        QCOMPARE(sumOf(selected.json()["conditions"][0]), 8);
        const QJsonArray entries = selected.json()["selection"].toObject()["entries"].toArray();
        QCOMPARE(entries.size(), 2);
        for (const QJsonValue entry : entries) {
            QCOMPARE(entry["trials"].toInt(), 8);
            QCOMPARE(entry["corners"].toObject()["trials"].toInt(), 16);
        }
        const Ran text =
            ask({"validate", "sliced.trap", "--trials", "8", "--conditions", "varied", "--engine", "native"});
        QVERIFY2(text.output.contains("By condition"), text.all());
        // Varied, too, if nothing is said.
        QVERIFY(ask({"validate", "sliced.trap", "--trials", "1", "--engine", "native", "--json"})
                    .json()
                    .contains("conditions"));
        QVERIFY(!ask({"validate", "sliced.trap", "--trials", "1", "--conditions", "nominal", "--engine",
                      "native", "--json"})
                     .json()
                     .contains("conditions"));
    }

    void stream() {
        const QStringList few = {"--streams", "2",   "--duration", "3",        "--warm-up", "1",
                                 "--inflow",  "120", "30",         "--engine", "simbody",   "--json"};
        const Ran ran = ask(QStringList{"stream", "study.trap"} + few);
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonArray results = ran.json()["results"].toArray();
        QCOMPARE(results.size(), 2);
        QCOMPARE(results[0]["inflow_per_min"].toDouble(), 30.0);
        QCOMPARE(results[1]["inflow_per_min"].toDouble(), 120.0);
        // 12 are to come in the time of both that counts.
        const int offered = results[1]["counts"]["offered"].toInt();
        QVERIFY2(offered > 2 && offered < 30, qPrintable(QString::number(offered)));
        QVERIFY(results[1]["oriented_per_min"]["low"].toDouble() <=
                results[1]["oriented_per_min"]["mean"].toDouble());
        QCOMPARE(ask(QStringList{"stream", "study.trap"} + few).output, ran.output);

        QVERIFY(QFile::copy(folder_.filePath("study.trap"), folder_.filePath("stream.trap")));
        const Ran saved = ask(QStringList{"stream", "stream.trap", "--save", "--nominal"} + few);
        QVERIFY2(saved.code == 0, saved.all());
        {
            const auto kept =
                trapwright::store::StudyFile::openReadOnly(folder_.filePath("stream.trap").toStdString());
            QVERIFY(kept.ok());
            QCOMPARE(kept->loadStreams()->size(), std::size_t{1});
            QVERIFY(!kept->loadStreams()->front().box);
            QCOMPARE(kept->loadStreams()->front().streams.results[1].sum().success,
                     saved.json()["results"][1]["counts"]["success"].toInt());
        }
        QFile::remove(folder_.filePath("stream.trap"));

        const Ran table =
            ask(QStringList{"stream", "study.trap", "--regular", "--anyhow"} + few.mid(0, few.size() - 1));
        QVERIFY2(table.code == 0 && table.output.contains("share as wanted"), table.all());
        // What falls comes again or is lost.
        const auto fallen = [&](const char* returns) {
            const Ran one = ask(QStringList{"stream", "study.trap", "--returns", returns} + few);
            const QJsonObject counts = one.json()["results"][1]["counts"].toObject();
            return std::pair(counts["returned"].toInt(), counts["fell_off"].toInt());
        };
        QCOMPARE(fallen("anywhere").first, fallen("nowhere").second);
        QCOMPARE(fallen("anywhere").second, 0);
        const Ran where = ask({"stream", "study.trap", "--returns", "below"});
        QVERIFY2(where.code == 2 && where.errors.contains("inner"), where.all());
        const Ran many = ask({"stream", "study.trap", "--inflow", "9000"});
        QCOMPARE(many.code, 2);
        QVERIFY2(many.all().contains("no more than 3600 can"), many.all());
        QCOMPARE(ask({"stream", "study.trap", "--streams", "1"}).code, 2);
    }

    void robustness() {
        const QStringList few = {"--trials", "10", "--box-trials", "16",     "--points", "3",
                                 "--map",    "2",  "--engine",     "native", "--json"};
        const Ran ran = ask(QStringList{"robustness", "study.trap"} + few);
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonObject ofStudy = ran.json()["robustness"].toObject();
        QCOMPARE(ofStudy["as_set"]["trials"].toInt(), 10);
        QCOMPARE(ofStudy["over_box"]["trials"].toInt(), 16);
        // Friction, restitution, half-stroke and size vary at first.
        const QJsonArray sweeps = ofStudy["sweeps"].toArray();
        QCOMPARE(sweeps.size(), 4);
        QCOMPARE(sweeps[0]["points"].toArray().size(), 3);
        QCOMPARE(ofStudy["worst_corners"].toArray().size(), 4);
        QCOMPARE(ofStudy["worst_pair"]["places"].toArray().size(), 4);
        // The same study and numbers give the same, whatever there was before.
        QCOMPARE(ask(QStringList{"robustness", "study.trap"} + few).output, ran.output);

        QVERIFY(QFile::copy(folder_.filePath("study.trap"), folder_.filePath("robust.trap")));
        const Ran saved = ask(QStringList{"robustness", "robust.trap", "--save"} + few);
        QVERIFY2(saved.code == 0, saved.all());
        const auto kept =
            trapwright::store::StudyFile::openReadOnly(folder_.filePath("robust.trap").toStdString());
        QVERIFY(kept.ok());
        QCOMPARE(kept->loadRobustness()->size(), std::size_t{1});
        QCOMPARE(kept->loadRobustness()->front().robustness.overBox.tally.success,
                 ofStudy["over_box"]["success"]["count"].toInt());

        // The best of the last selection, each as if it were asked for alone, by their worst corner.
        const QStringList plan = few.mid(0, few.size() - 1);
        QVERIFY(QFile::copy(folder_.filePath("study.trap"), folder_.filePath("best.trap")));
        QCOMPARE(ask({"select", "best.trap", "--winners", "2", "--trials", "8", "--engine", "native"}).code,
                 0);
        const Ran best = ask(QStringList{"robustness", "best.trap", "--best", "2", "--save"} + few);
        QVERIFY2(best.code == 0, best.all());
        const QJsonArray tracks = best.json()["tracks"].toArray();
        QCOMPARE(tracks.size(), 2);
        const auto keptBest =
            trapwright::store::StudyFile::openReadOnly(folder_.filePath("best.trap").toStdString());
        QCOMPARE(keptBest->loadRobustness()->size(), std::size_t{2});
        for (const QJsonValue track : tracks) {
            const Ran alone = ask(QStringList{"robustness", "best.trap", "--generation",
                                              QString::number(track["generation"].toInt()), "--individual",
                                              QString::number(track["individual"].toInt())} +
                                  few);
            QCOMPARE(alone.json()["robustness"], track["robustness"]);
        }
        const Ran table = ask(QStringList{"robustness", "best.trap", "--best", "2"} + plan);
        const QStringList lines = QString::fromUtf8(table.output).split('\n');
        QVERIFY2(lines.size() >= 5 && lines[1].contains("Worst corner"), table.all());
        const auto corner = [&](int line) { return lines[line].simplified().section(' ', 2, 2).toDouble(); };
        QVERIFY2(corner(2) >= corner(3), table.all());
        QCOMPARE(ask({"robustness", "best.trap", "--best", "2", "--generation", "0"}).code, 2);
        QFile::remove(folder_.filePath("best.trap"));

        // A track of no study, with a box of its own about other values.
        const QString file = QStringLiteral(TRAPWRIGHT_SOURCE_DIR "/resources/tracks/cuboid_track.json");
        const Ran onTrack =
            ask(QStringList{"robustness", file, "--friction", "0.6", "--friction-range", "0.1",
                            "--restitution-range", "0", "--half-stroke-range", "0", "--size-range", "0"} +
                few);
        QVERIFY2(onTrack.code == 0, onTrack.all());
        const QJsonObject ofTrack = onTrack.json()["robustness"].toObject();
        QCOMPARE(ofTrack["sweeps"].toArray().size(), 1);
        QVERIFY(std::abs(ofTrack["sweeps"][0]["points"][0]["friction"].toDouble() - 0.5) < 1e-9);
        QVERIFY(std::abs(ofTrack["sweeps"][0]["points"][2]["friction"].toDouble() - 0.7) < 1e-9);
        QVERIFY(!ofTrack.contains("worst_pair"));
        QCOMPARE(ask({"robustness", file, "--save"}).code, 2);

        const Ran none = ask({"robustness", "study.trap", "--friction-range", "0", "--restitution-range", "0",
                              "--half-stroke-range", "0", "--size-range", "0"});
        QVERIFY2(none.code != 0 && none.all().contains("has no room"), none.all());
        QCOMPARE(ask({"robustness", "study.trap", "--trials", "3"}).code, 2);
        QCOMPARE(ask({"robustness", "nowhere.trap"}).code, 3);
    }

    void mend() {
        QVERIFY(QFile::copy(folder_.filePath("study.trap"), folder_.filePath("mend.trap")));
        const QStringList few = {"--variants",   "2", "--variant-trials", "4", "--compared",   "2",
                                 "--trials",     "6", "--corner-trials",  "4", "--generation", "0",
                                 "--individual", "0"};  // with a wall that is quickly mended
        // A printer that can do all of it.
        const Ran whole =
            ask(QStringList{"mend", "mend.trap", "--thinnest", "0.001", "--steepest", "90"} + few);
        QVERIFY2(whole.code == 0 && whole.all().contains("nothing to mend"), whole.all());
        const Ran ran = ask(QStringList{"mend", "mend.trap", "--json", "--thinnest", "0.8"} + few);
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonObject mended = ran.json();
        QCOMPARE(mended["tried"].toInt(), 2);
        QCOMPARE(mended["best"]["generation"].toInt(), 2);
        QVERIFY(mended["unprintable_mm2"].toDouble() > 0.0);
        const int printable = mended["printable"].toInt();
        QVERIFY(printable >= 1 && printable <= 2);
        QCOMPARE(mended["selection"]["entries"].toArray().size(), 1 + printable);
        // What is exported from now on.
        const QJsonObject exported =
            ask({"export", "mend.trap", "mend.stl", "--json", "--thinnest", "0.8"}).json();
        QCOMPARE(exported["generation"].toInt(), 2);
        QCOMPARE(exported["print"]["thin_walls"].toArray().size(), 0);
        QCOMPARE(ask(QStringList{"mend", "mend.trap", "--variants", "0"}).code, 2);
        QCOMPARE(ask({"mend", "nowhere.trap"}).code, 3);
        QFile::remove(folder_.filePath("mend.trap"));
    }

    // Told by name, and by those that there are where the name is unknown.
    void instructionSetIsChosen() {
        const QStringList verify = {"verify", "--engine", "native", "--case", "lift-off"};
        const auto askWith = [&](const char* set) {
            qputenv("TRAPWRIGHT_INSTRUCTION_SET", set);
            Ran ran = ask(verify);
            qunsetenv("TRAPWRIGHT_INSTRUCTION_SET");
            return ran;
        };
        const Ran refused = askWith("AVX99");
        QCOMPARE(refused.code, 2);
        QVERIFY2(refused.errors.contains("AVX99") && refused.errors.contains("it has "), refused.all());
        const QByteArray known = refused.errors.mid(refused.errors.indexOf("it has ") + 7).split('.').first();
        const QByteArray least = known.split(',').last().trimmed();
        const Ran ran = askWith(least.constData());
        QVERIFY2(ran.code == 0, ran.all());
    }

    // Two studies of one task and a study that was only made.
    void compare() {
        QCOMPARE(ask(quickStudy("two.trap", 3) + QStringList{"--seed", "2"}).code, 0);
        QCOMPARE(ask({"new", "empty.trap", "--preset", "cuboid"}).code, 0);
        const Ran ran =
            ask({"compare", "study.trap", "two.trap", "empty.trap", "--json", "--curves", "c.csv"});
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonArray studies = ran.json()["studies"].toArray();
        QCOMPARE(studies.size(), 3);
        QCOMPARE(studies[0]["generations"].toInt(), 2);
        QCOMPARE(studies[1]["seed"].toInt(), 2);
        QVERIFY(studies[1]["learning"]["of"].toInt() > 0);
        QVERIFY(studies[2]["learning"].isNull());
        const QJsonArray curves = ran.json()["curves"].toArray();
        QCOMPARE(curves.size(), 3);
        QCOMPARE(curves[0]["studies"].toInt(), 2);
        QCOMPARE(curves[2]["studies"].toInt(), 1);
        QFile file(folder_.filePath("c.csv"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll().count('\n'), 4);
        const Ran table = ask({"compare", "study.trap", "two.trap"});
        QVERIFY2(table.output.contains("Learning counted: median"), table.all());
        QCOMPARE(ask({"compare", "study.trap", "gone.trap"}).code, 3);
        QCOMPARE(ask({"compare", "study.trap", "--curves", "/nowhere/c.csv"}).code, 4);
    }

    void sweep() {
        const Ran ran = ask({"sweep", "--from", "0.2", "--to", "0.4", "--step", "0.1", "--json"});
        const QJsonArray rows = ran.json()["rows"].toArray();
        QVERIFY2(rows.size() == 3, ran.all());
        QVERIFY(std::abs(rows[2].toObject()["half_stroke_mm"].toDouble() - 0.4) < 1e-9);
        // No faster than the vibration itself, and faster the more it vibrates.
        double before = 0.0;
        for (const QJsonValue row : rows) {
            const double speed = row["speed_mm_s"].toDouble();
            QVERIFY2(speed > before && speed < row["half_stroke_mm"].toDouble() * 314.2, ran.all());
            before = speed;
        }
    }

    void bench() {
        const Ran ran = ask({"bench", "--trials", "4", "--repeats", "2", "--engine", "simbody", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonArray rows = ran.json()["measurements"].toArray();
        QStringList scenes;
        for (const QJsonValue row : rows) {
            scenes << row["scene"].toString();
            QCOMPARE(row["engine"].toString(), "simbody");
            QCOMPARE(row["trials"].toInt(), 4);
            QCOMPARE(row["step_ms"].toDouble(), 0.2);
            QCOMPARE(row["ratio_to_first"].toDouble(), 1.0);
            QCOMPARE(row["cpu_seconds"].toArray().size(), 2);
            const double perTrial = row["cpu_seconds_per_trial"].toDouble();
            QVERIFY(perTrial > 0.0);
            QVERIFY(std::abs(perTrial * row["trials_per_second_per_core"].toDouble() - 1.0) < 1e-9);
            QVERIFY(std::abs(row["cpu_microseconds_per_step"].toDouble() * 1e-6 *
                                 row["steps_per_trial"].toDouble() / perTrial -
                             1.0) < 1e-9);
            const QJsonObject shares = row["shares"].toObject();
            double sum = 0.0;
            for (const char* share : {"detection", "law", "integration"}) {
                QVERIFY(shares[share].toDouble() > 0.0);
                sum += shares[share].toDouble();
            }
            QVERIFY(std::abs(sum - 1.0) < 1e-9);
            QVERIFY(row["finished"]["high"].toDouble() >= row["oriented"]["share"].toDouble());
        }
        QCOMPARE(scenes, QStringList({"cuboid flat", "cuboid rough", "cuboid learned", "cone learned",
                                      "bracket rough", "bowl"}));
    }

    void benchComparesWithTheFirst() {
        const Ran ran = ask({"bench", "--trials", "4", "--repeats", "1", "--scene", "flat", "--engine",
                             "simbody,simbody", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonArray rows = ran.json()["measurements"].toArray();
        QCOMPARE(rows.size(), 2);
        const double rate = rows[1]["trials_per_second_per_core"].toDouble() /
                            rows[0]["trials_per_second_per_core"].toDouble();
        QVERIFY(std::abs(rows[1]["ratio_to_first"].toDouble() / rate - 1.0) < 1e-9);
    }

    void verify() {
        const Ran ran = ask({"verify", "--case", "stable-poses", "--json"});
        QCOMPARE(ran.code, 0);
        QVERIFY(ran.json()["passed"].toBool());
        QVERIFY(!ran.json()["rows"].toArray().isEmpty());
    }

    /// So few trials that no verdict is asked for; what must hold is the table's own arithmetic.
    void verifyAgreement() {
        const Ran ran =
            ask({"verify", "--engine", "native", "--case", "agreement", "--trials", "6", "--json"});
        const QJsonObject answer = ran.json();
        QVERIFY2(answer["rows"].toArray().isEmpty(), ran.all());
        const QJsonArray rows = answer["agreement"].toObject()["rows"].toArray();
        QCOMPARE(rows.size(), 9);
        for (const QJsonValue row : rows) {
            for (const char* engine : {"native", "simbody"}) {
                const QJsonObject tally = row[engine].toObject();
                const int finished = tally["finished"].toObject()["count"].toInt();
                const int oriented = tally["oriented"].toObject()["count"].toInt();
                QVERIFY2(oriented <= finished && finished <= 6, ran.all());
                QCOMPARE(tally["median_transit_s"].toDouble() > 0.0, finished > 0);
            }
            QCOMPARE(row["passed"].toBool(), row["family_p"].toDouble() > 0.05);
        }
        // The cuboid leaves a level track by no side.
        QCOMPARE(rows[0].toObject()["native"].toObject()["finished"].toObject()["count"].toInt(), 6);
        QCOMPARE(ran.code, answer["passed"].toBool() ? 0 : 1);
    }

    void verifyWithoutAgreement() {
        const Ran ran = ask({"verify", "--engine", "native", "--case", "agreement", "--no-agreement"});
        QCOMPARE(ran.code, 2);
        QCOMPARE(ask({"verify", "--case", "agreement"}).code, 2);
        const Ran poses = ask({"verify", "--engine", "native", "--case", "stable-poses", "--json"});
        QVERIFY(!poses.json().contains("agreement"));
    }

    /// The main job, as short as it can be; a second time it goes on in the same folder.
    void demo() {
        QStringList arguments = quickStudy("", 1).mid(4);
        arguments =
            QStringList{"demo", "--out", "demo", "--selection-trials", "4", "--trials-per-pose", "2"} +
            arguments;
        const Ran ran = ask(arguments);
        QVERIFY2(ran.code == 0, ran.all());
        for (const char* file : {"cuboid.trap", "cuboid.stl", "cuboid.3mf"})
            QVERIFY2(QFileInfo(folder_.filePath("demo/" + QString(file))).size() > 0, file);
        QVERIFY2(ran.output.contains("95 % Clopper-Pearson"), ran.all());
        const Ran again = ask(arguments);
        QVERIFY2(again.code == 0, again.all());
        QCOMPARE(ask({"dump", "demo/cuboid.trap"}).output.count('\n'), 8);
    }

 private:
    [[nodiscard]] Ran ask(const QStringList& arguments) const { return run(folder_.path(), arguments); }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(CommandsTest)
#include "commands_test.moc"
