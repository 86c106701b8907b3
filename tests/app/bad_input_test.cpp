#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

namespace {

/// An ASCII STL of a cuboid of 4 x 8 x 12 mm with its first `triangles` triangles, flattened or with another
/// number for its first coordinate where asked.
QByteArray cuboidStl(int triangles, const QByteArray& first = "0", double thickness = 12.0) {
    const double corners[8][3] = {{0, 0, 0}, {4, 0, 0}, {0, 8, 0}, {4, 8, 0},
                                  {0, 0, 1}, {4, 0, 1}, {0, 8, 1}, {4, 8, 1}};
    const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    QByteArray text = "solid part\n";
    for (int t = 0; t < triangles; ++t) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (int k = 0; k < 3; ++k) {
            const double* corner = corners[faces[t][k]];
            const bool changed = t == 0 && k == 0;
            text += "vertex " + (changed ? first : QByteArray::number(corner[0])) + " " +
                    QByteArray::number(corner[1]) + " " + QByteArray::number(corner[2] * thickness) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid part\n";
}

}  // namespace

/// What goes wrong for users: each with an exit code that says of which kind it is, and a message that says
/// what is wrong.
class BadInputTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        QVERIFY(folder_.isValid());
        write(path("empty.stl"), "");
        write(path("text.stl"),
              "Dear reader,\nthis is not a mesh but a letter that somebody gave the wrong name.\n");
        write(path("nan.stl"), cuboidStl(12, "nan"));
        write(path("open.stl"), cuboidStl(10));
        write(path("flat.stl"), cuboidStl(12, "0", 0.0));
        write(path("whole.stl"), cuboidStl(12));
        write(path("garbage.trap"), QByteArray(5000, 'x'));
        write(path("empty.trap"), "");
        write(path("garbage.json"), "{\"track\": ");
        write(path("unknown.json"), "{\"track\": {\"colour\": 3}}");
        const Ran made = run(folder_.path(), {"new", "good.trap", "--preset", "cuboid"});
        QVERIFY2(made.code == 0, made.all());
    }

    void message_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<int>("code");
        QTest::addColumn<QString>("message");  // a part of it

        const auto part = [](const char* file) { return QStringList{"part", file}; };
        QTest::newRow("part: missing file") << part("missing.stl") << 3 << "missing.stl does not exist";
        QTest::newRow("part: unknown name") << part("sphere") << 3 << "bundled parts are cuboid, cone";
        QTest::newRow("part: empty file") << part("empty.stl") << 3 << "empty.stl is empty";
        QTest::newRow("part: text named .stl") << part("text.stl") << 3 << "text.stl";
        QTest::newRow("part: NaN") << part("nan.stl") << 3 << "nan.stl";
        QTest::newRow("part: open mesh") << part("open.stl") << 3 << "hole";
        QTest::newRow("part: zero volume") << part("flat.stl") << 3 << "volume";
        QTest::newRow("part: folder") << part(".") << 3 << "not a file";
        QTest::newRow("part: unknown unit")
            << QStringList{"part", "whole.stl", "--units", "parsec"} << 3 << "parsec";
        QTest::newRow("part: unknown material")
            << QStringList{"part", "whole.stl", "--material", "cheese"} << 2 << "The materials are ABS";
        QTest::newRow("part: density and material")
            << QStringList{"part", "cuboid", "--material", "ABS", "--density", "3"} << 2 << "excludes";

        // What there is not is named, with the nearest that there is.
        QTest::newRow("command: unknown")
            << QStringList{"frobnicate"} << 2 << "no command \"frobnicate\". The nearest is \"validate\"";
        QTest::newRow("command: misspelt")
            << QStringList{"evovle", "x.trap"} << 2 << "no command \"evovle\". Did you mean \"evolve\"?";
        QTest::newRow("option: misspelt")
            << QStringList{"part", "cuboid", "--densty", "3"} << 2
            << "`trapwright part` has no option --densty. Did you mean \"--density\"?";
        QTest::newRow("option: misspelt, with =")
            << QStringList{"demo", "--ot=x"} << 2 << "Did you mean \"--out\"?";
        QTest::newRow("setting: misspelt")
            << QStringList{"new", "x.trap", "--preset", "cuboid", "--set", "track.segmentWdth_mm=5"} << 2
            << "Did you mean \"track.segmentWidth_mm\"?";

        QTest::newRow("study: missing")
            << QStringList{"settings", "missing.trap"} << 3 << "no study at missing.trap";
        QTest::newRow("study: garbage")
            << QStringList{"evolve", "garbage.trap", "--resume"} << 3 << "garbage.trap";
        QTest::newRow("study: garbage, read") << QStringList{"dump", "garbage.trap"} << 3 << "garbage.trap";
        QTest::newRow("study: empty") << QStringList{"export", "empty.trap"} << 3 << "empty.trap";
        QTest::newRow("study: exists")
            << QStringList{"new", "good.trap", "--preset", "cuboid"} << 2 << "exists already";
        QTest::newRow("study: exists, evolve")
            << QStringList{"evolve", "good.trap", "--preset", "cuboid"} << 2 << "leave out";
        QTest::newRow("study: nothing to export")
            << QStringList{"export", "good.trap"} << 3 << "no generations yet";
        QTest::newRow("track: missing")
            << QStringList{"export", "missing.json"} << 3 << "Cannot open missing.json";
        QTest::newRow("track: missing, streams")
            << QStringList{"stream", "missing.json"} << 3 << "Cannot open missing.json";
        QTest::newRow("study: nothing to select")
            << QStringList{"select", "good.trap"} << 3 << "no generations";
        QTest::newRow("study: no folder")
            << QStringList{"new", "nowhere/x.trap", "--preset", "cuboid"} << 4 << "no folder";
        QTest::newRow("study: folder that cannot be written")
            << QStringList{"new", "/proc/x.trap", "--preset", "cuboid"} << 4 << "/proc/x.trap";

        const auto create = [](const QStringList& rest) {
            return QStringList{"new", "never.trap", "--preset", "cuboid"} + rest;
        };
        QTest::newRow("preset") << QStringList{"new", "never.trap", "--preset", "cube"} << 2
                                << "\"cuboid\" or \"cone\"";
        QTest::newRow("no part") << QStringList{"new", "never.trap"} << 2 << "--preset cuboid or --part";
        QTest::newRow("engine") << create({"--engine", "abacus"}) << 2 << "The engines are: simbody";
        QTest::newRow("negative population")
            << create({"--population", "-40"}) << 2 << "evolution.populationSize is -40";
        QTest::newRow("no trials") << create({"--trials", "0"}) << 2 << "evolution.trialsPerEvaluation is 0";
        QTest::newRow("segment lengths") << create({"--set", "track.minSegmentLength_mm=40"}) << 2
                                         << "must not be more than track.maxSegmentLength_mm";
        QTest::newRow("not a number") << create({"--population", "many"}) << 2 << "--population";
        QTest::newRow("unknown setting") << create({"--set", "track.colour=3"}) << 2 << "track.colour";
        QTest::newRow("setting without value") << create({"--set", "track"}) << 2 << "KEY=VALUE";
        QTest::newRow("settings file: missing")
            << create({"--settings", "missing.json"}) << 3 << "missing.json";
        QTest::newRow("settings file: garbage")
            << create({"--settings", "garbage.json"}) << 3 << "garbage.json";
        QTest::newRow("settings file: unknown key")
            << create({"--settings", "unknown.json"}) << 3 << "track.colour";
        QTest::newRow("part larger than the track")
            << create({"--part", "whole.stl", "--units", "cm"}) << 2 << "too large for a track";
        QTest::newRow("part that does not say its unit")
            << create({"--part", "whole.stl", "--units", "m"}) << 2 << "too large for a track";

        QTest::newRow("track: missing") << QStringList{"track", "missing.json"} << 3 << "missing.json";
        QTest::newRow("track: garbage") << QStringList{"track", "garbage.json"} << 3 << "garbage.json";
        QTest::newRow("sweep: order")
            << QStringList{"sweep", "--from", "1", "--to", "0.5"} << 2 << "more than --to";
        QTest::newRow("verify: no such case")
            << QStringList{"verify", "--case", "teapot"} << 2 << "The cases are";
        QTest::newRow("bench: no such engine")
            << QStringList{"bench", "--engine", "simbody,bullet"} << 2 << "The engines are";
        QTest::newRow("bench: no such scene")
            << QStringList{"bench", "--scene", "teapot"} << 2 << "The scenes are";
        QTest::newRow("no command") << QStringList{} << 2 << "--help";
        QTest::newRow("unknown command") << QStringList{"dance"} << 2 << "--help";
        QTest::newRow("unknown option") << QStringList{"part", "cuboid", "--colour"} << 2 << "--colour";
    }

    void message() {
        QFETCH(QStringList, arguments);
        QFETCH(int, code);
        QFETCH(QString, message);
        const Ran plain = run(folder_.path(), arguments);
        QVERIFY2(plain.code == code, plain.all());
        QVERIFY2(plain.errors.contains(message.toUtf8()), plain.all());
        QVERIFY2(plain.output.isEmpty(), plain.all());
        QVERIFY(!QFile::exists(path("never.trap")));

        const Ran json = run(folder_.path(), arguments + QStringList{"--json"});
        QVERIFY2(json.code == code || arguments.isEmpty(), json.all());
        QVERIFY2(json.json()["error"].toString().contains(message), json.all());
        QCOMPARE(json.json()["exit_code"].toInt(), json.code);
    }

    void fullDisk_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("file");
        QTest::newRow("new study") << QStringList{"new", "full.trap", "--preset", "cuboid"} << "full.trap";
        QTest::newRow("export") << QStringList{"export", "learned.trap", "full.stl"} << "full.stl";
        QTest::newRow("export 3MF") << QStringList{"export", "learned.trap", "full.3mf"} << "full.3mf";
        QTest::newRow("replay") << QStringList{"replay",   "learned.trap", "--out",
                                               "full.csv", "--interval",   "1"}
                                << "full.csv";
        QTest::newRow("evolve") << QStringList{"evolve", "learned.trap", "--resume"} << "";
    }

    void fullDisk() {
        QFETCH(QStringList, arguments);
        QFETCH(QString, file);
        if (!QFile::exists(path("learned.trap"))) {
            QVERIFY(run(folder_.path(), quickStudy("learned.trap", 1)).code == 0);
            QVERIFY(run(folder_.path(), {"evolve", "learned.trap", "--resume", "--generations", "1"}).code ==
                    0);
        }
        if (arguments.first() == "evolve") arguments += {"--generations", "3"};
        constexpr rlim_t kBytes = 1024;
        const Ran ran = runOnFullDisk(folder_.path(), arguments, kBytes);
        QVERIFY2(ran.code == 4, ran.all());
        if (!file.isEmpty()) QVERIFY(!QFile::exists(path(file)));
        const Ran after = run(folder_.path(), {"dump", "learned.trap"});
        QVERIFY2(after.code == 0 && after.output.count('\n') == 8, after.all());
    }

    /// A disk that fills up during a run: the generations before stay.
    void fullDiskWhileLearning() {
        QVERIFY(run(folder_.path(), quickStudy("filled.trap", 1)).code == 0);
        constexpr rlim_t kBytes = 100000;
        const Ran ran = runOnFullDisk(folder_.path(),
                                      {"evolve", "filled.trap", "--resume", "--generations", "100"}, kBytes);
        QVERIFY2(ran.code == 4, ran.all());
        const Ran after = run(folder_.path(), {"dump", "filled.trap"});
        const auto lines = after.output.count('\n');
        QVERIFY2(after.code == 0 && lines > 8 && lines % 8 == 0, ran.all());
    }

    void outputThatCannotBeWritten() {
        QProcess process;
        process.setWorkingDirectory(folder_.path());
        process.setStandardOutputFile("/dev/full");
        process.start(TRAPWRIGHT_PROGRAM, {"part", "cuboid", "--json"});
        const Ran ran = finish(process);
        QVERIFY2(ran.code == 4, ran.all());
        QVERIFY2(ran.errors.contains("standard output"), ran.all());
    }

 private:
    [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }

    QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(BadInputTest)
#include "bad_input_test.moc"
