#include <signal.h>

#include <QElapsedTimer>
#include <QJsonArray>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

/// Learning with one engine while another checks the winners, through the program.
class HybridTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
    }

    void everyWinnerIsChecked() {
        const Ran ran = learn(hybridStudy("study.trap", 4) + QStringList{"--json"});
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonObject json = ran.json();
        const QString learning = json["engine"].toString();
        QCOMPARE(json["reference_engine"].toString(), "simbody");
        const QJsonArray checks = json["checks"].toArray();
        QCOMPARE(checks.size(), 4);
        for (int i = 0; i < 4; ++i) {
            const QJsonObject check = checks[i].toObject();
            QCOMPARE(check["generation"].toInt(), i);
            QCOMPARE(check["individual"], json["generations"].toArray()[i].toObject()["winner"]);
            QCOMPARE(check["trials"].toInt(), 3);
            QCOMPARE(check["learning"].toObject()["engine"].toString(), learning);
            QCOMPARE(check["reference"].toObject()["engine"].toString(), "simbody");
            // What the winner was judged by is what the learning engine does again.
            const QJsonObject best = json["generations"].toArray()[i].toObject()["best"].toObject();
            QCOMPARE(check["learning"].toObject()["F_O"], best["F_O"]);
            QCOMPARE(check["learning"].toObject()["F_D"], best["F_D"]);
            const double difference =
                check["reference"].toObject()["F_D"].toDouble() - best["F_D"].toDouble();
            QCOMPARE(check["difference"].toObject()["F_D"].toDouble(), difference);
        }
        const Ran dumped = learn({"dump", "study.trap", "--checks", "--json"});
        QCOMPARE(dumped.json()["checks"].toArray(), checks);
    }

    void linesTellOfChecks() {
        const Ran ran = learn(hybridStudy("study.trap", 2));
        QVERIFY2(ran.code == 0, ran.all());
        QVERIFY2(ran.output.contains("winners checked by simbody"), ran.all());
        QVERIFY2(ran.output.contains("\n   check 0 ") && ran.output.contains("\n   check 1 "), ran.all());
    }

    void learningIsThatOfTheQuickEngineAlone() {
        const Ran hybrid = learn(hybridStudy("hybrid.trap", 3) + QStringList{"--json"});
        QVERIFY2(hybrid.code == 0, hybrid.all());
        const QStringList alone = {"--engine", hybrid.json()["engine"].toString(), "--json"};
        const Ran plain = learn(quickStudy("plain.trap", 3) + alone);
        QVERIFY2(plain.code == 0, plain.all());
        QVERIFY(plain.json()["reference_engine"].isNull());
        QVERIFY(plain.json()["checks"].toArray().isEmpty());
        QCOMPARE(learn({"dump", "hybrid.trap", "--compare", "plain.trap"}).code, 0);
        QCOMPARE(learn({"dump", "hybrid.trap"}).output, learn({"dump", "plain.trap"}).output);
        QVERIFY(learn({"dump", "plain.trap", "--checks"}).output.isEmpty());
    }

    void interruptedChecksAreTakenUp() {
        QVERIFY(learn(hybridStudy("whole.trap", 6)).code == 0);
        auto process = start(folder_->path(), hybridStudy("pieces.trap", 6));
        QElapsedTimer timer;
        timer.start();
        while (dumpOf("pieces.trap").count('\n') < 8 && timer.elapsed() < kPatience)
            QTest::qSleep(5);
        ::kill(static_cast<pid_t>(process->processId()), SIGKILL);
        process->waitForFinished(kPatience);
        // From the generations that were saved, and from those to come.
        const Ran resumed = learn({"evolve", "pieces.trap", "--resume"});
        QVERIFY2(resumed.code == 0, resumed.all());
        QCOMPARE(dumpOf("pieces.trap"), dumpOf("whole.trap"));
        const QByteArray checks = learn({"dump", "whole.trap", "--checks"}).output;
        QCOMPARE(checks.count('\n'), 6);
        QCOMPARE(learn({"dump", "pieces.trap", "--checks"}).output, checks);
    }

    void selectionAndReplayKnowTheirEngines() {
        const Ran ran = learn(hybridStudy("study.trap", 2) + QStringList{"--json"});
        QVERIFY2(ran.code == 0, ran.all());
        const Ran selected = learn({"select", "study.trap", "--winners", "1", "--trials", "4", "--json"});
        QVERIFY2(selected.code == 0, selected.all());
        QCOMPARE(selected.json()["selection"].toObject()["engine"].toString(), "simbody");
        const Ran learned = learn({"replay", "study.trap", "--trial", "1"});
        QVERIFY2(learned.code == 0, learned.all());
        QVERIFY(learned.output.contains("engine " + ran.json()["engine"].toString().toUtf8() + "\n"));
        const Ran again = learn({"replay", "study.trap", "--kind", "selection", "--trial", "1"});
        QVERIFY2(again.code == 0 && again.output.contains("engine simbody\n"), again.all());
    }

    void verifyAndBenchTakeHybridToo() {
        const Ran verified = learn({"verify", "--engine", "hybrid", "--case", "bounce", "--json"});
        QVERIFY2(verified.code == 0, verified.all());
        QCOMPARE(verified.json()["engine"].toString(), "native");
        const Ran timed = learn(
            {"bench", "--engine", "hybrid", "--scene", "cuboid flat", "--trials", "2", "--repeats", "1"});
        QVERIFY2(timed.code == 0, timed.all());
        QVERIFY(timed.output.contains("native") && timed.output.contains("simbody"));
    }

 private:
    [[nodiscard]] static QStringList hybridStudy(const QString& name, int generations) {
        return quickStudy(name, generations) + QStringList{"--engine", "hybrid"};
    }
    [[nodiscard]] Ran learn(const QStringList& arguments) const { return run(folder_->path(), arguments); }
    [[nodiscard]] QByteArray dumpOf(const QString& study) const { return learn({"dump", study}).output; }

    std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_GUILESS_MAIN(HybridTest)
#include "hybrid_test.moc"
