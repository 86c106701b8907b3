// What two small studies give, to the last bit. It may change only by intent: say in the commit what changed
// it.

#include <QCryptographicHash>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <string>
#include <vector>

#include "sim/native/kernel.h"
#include "tests/app/program.h"

using namespace trapwright::test;

namespace {

/// What nearly every machine has; others can take it, too.
constexpr const char* kInstructionSet = "AVX2";

/// Designs and scores of all individuals, the comparison of the best winners, a validation and the track's
/// solid.
QByteArray hashStudy(const QString& folder, const QStringList& learning, const QString& trials) {
    QCryptographicHash hash(QCryptographicHash::Sha256);
    const QStringList evolve =
        QStringList{"evolve", "study.trap", "--population", "8", "--generations", "3"} + learning;
    for (const QStringList& arguments : {evolve, QStringList{"dump", "study.trap"},
                                         QStringList{"select", "study.trap", "--winners", "2", "--trials",
                                                     trials, "--corner-trials", "8", "--json"},
                                         QStringList{"validate", "study.trap", "--trials", "2", "--json"},
                                         QStringList{"export", "study.trap", "track.stl", "--rim", "0"}}) {
        const Ran ran = run(folder, arguments);
        if (ran.code != 0) return "failed: " + ran.all();
        // What evolve prints has wall times in it.
        if (arguments.front() != "evolve" && arguments.front() != "export") hash.addData(ran.output);
    }
    QFile solid(folder + "/track.stl");
    if (!solid.open(QIODevice::ReadOnly)) return "no track.stl";
    hash.addData(solid.readAll());
    return hash.result().toHex().left(16);
}

}  // namespace

class GoldenStudyTest : public QObject {
    Q_OBJECT

 private slots:
    void givesTheSameBits_data() {
        QTest::addColumn<QStringList>("learning");
        QTest::addColumn<QString>("trials");
        QTest::addColumn<QByteArray>("expected");
        const QStringList race = {"--preset", "cuboid", "--engine", "native",
                                  "--trials", "12",     "--set",    "evolution.racingTrials=4"};
        QTest::newRow("cuboid, linear, native, race, varied")
            << race << "6" << QByteArray("ce976ebd75dad54f");
        QTest::newRow("cuboid, linear, native, race")
            << QStringList{race + QStringList{"--set", "evolution.conditions=nominal", "--set",
                                              "validation.conditions=nominal"}}
            << "6" << QByteArray("c2ed0adca932b18a");
        QTest::newRow("cone, bowl, Simbody, as in the paper")
            << QStringList{"--preset", "cone", "--paper", "--trials", "3"} << "2"
            << QByteArray("3f55796df6d766d0");
    }
    void givesTheSameBits() {
        QFETCH(QStringList, learning);
        QFETCH(QString, trials);
        QFETCH(QByteArray, expected);
        const std::vector<std::string> sets = trapwright::native::instructionSets();
        if (std::find(sets.begin(), sets.end(), kInstructionSet) == sets.end())
            QSKIP("Known for machines with AVX2 only.");
        qputenv("TRAPWRIGHT_INSTRUCTION_SET", kInstructionSet);
        const QTemporaryDir folder;
        const QByteArray got = hashStudy(folder.path(), learning, trials);
        QCOMPARE(got, expected);
    }
};

QTEST_GUILESS_MAIN(GoldenStudyTest)
#include "golden_study_test.moc"
