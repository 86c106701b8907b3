#include <signal.h>

#include <QElapsedTimer>
#include <QJsonArray>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

namespace {

/// Reads what the process says until `count` generations are saved. False if it ended before.
bool waitForGenerations(QProcess& process, int count) {
    QElapsedTimer timer;
    timer.start();
    QByteArray said;
    while (timer.elapsed() < kPatience) {
        said += process.readAllStandardOutput();
        // A generation's line begins with its right-aligned number.
        if (said.contains("\n" + QByteArray::number(count - 1).rightJustified(10) + " ")) return true;
        if (process.state() == QProcess::NotRunning) return false;
        process.waitForReadyRead(20);
    }
    return false;
}

/// Waits for a word on stderr.
bool waitForNote(QProcess& process, const QByteArray& word) {
    QElapsedTimer timer;
    timer.start();
    QByteArray said;
    process.setReadChannel(QProcess::StandardError);
    while (timer.elapsed() < kPatience && process.state() != QProcess::NotRunning) {
        said += process.readAllStandardError();
        if (said.contains(word)) return true;
        process.waitForReadyRead(20);
    }
    return said.contains(word);
}

void interrupt(const QProcess& process) {
    ::kill(static_cast<pid_t>(process.processId()), SIGINT);
}

}  // namespace

/// Learning through the program: the same bits for any number of threads and after any stop.
class LearningTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
    }

    void sameForAnyNumberOfThreads() {
        const Ran one = learn(quickStudy("one.trap", 3) + QStringList{"--threads", "1"});
        const Ran two = learn(quickStudy("two.trap", 3) + QStringList{"--threads", "2"});
        const Ran other = learn(quickStudy("other.trap", 3) + QStringList{"--seed", "2"});
        QVERIFY2(one.code == 0 && two.code == 0 && other.code == 0, one.all() + two.all() + other.all());
        const QByteArray dump = dumpOf("one.trap");
        QCOMPARE(dump.count('\n'), 3 * 8);
        QCOMPARE(dumpOf("two.trap"), dump);
        QVERIFY(dumpOf("other.trap") != dump);
        QCOMPARE(learn({"dump", "one.trap", "--compare", "two.trap"}).code, 0);
        QCOMPARE(learn({"dump", "one.trap", "--compare", "other.trap"}).code, 1);
    }

    void killedAndResumed() {
        QVERIFY(learn(quickStudy("whole.trap", 5)).code == 0);
        auto process = start(folder_->path(), quickStudy("killed.trap", 5));
        QVERIFY(waitForGenerations(*process, 2));
        ::kill(static_cast<pid_t>(process->processId()), SIGKILL);
        process->waitForFinished(kPatience);
        const int saved = static_cast<int>(dumpOf("killed.trap").count('\n')) / 8;
        QVERIFY2(saved >= 2 && saved < 5, QByteArray::number(saved));

        const Ran refused = learn({"evolve", "killed.trap"});
        QVERIFY2(refused.code == 2 && refused.errors.contains("--resume"), refused.all());
        const Ran resumed = learn({"evolve", "killed.trap", "--resume"});
        QVERIFY2(resumed.code == 0, resumed.all());
        QCOMPARE(dumpOf("killed.trap"), dumpOf("whole.trap"));
    }

    void interruptOnceStopsAfterTheGeneration() {
        auto process = start(folder_->path(), quickStudy("stopped.trap", 100000));
        QVERIFY(waitForGenerations(*process, 1));
        interrupt(*process);
        const Ran ran = finish(*process);
        QVERIFY2(ran.code == 130, ran.all());
        QVERIFY2(ran.errors.contains("Stopping after this generation"), ran.all());
        const QByteArray dump = dumpOf("stopped.trap");
        const int saved = static_cast<int>(dump.count('\n')) / 8;
        QVERIFY(saved >= 1);
        QCOMPARE(dump.count('\n'), saved * 8);
        QVERIFY(learn(quickStudy("whole.trap", saved)).code == 0);
        QCOMPARE(dumpOf("whole.trap"), dump);
    }

    void aTerminalThatIsGoneStopsAtOnceAndInOrder() {
        auto process = start(folder_->path(), quickStudy("hung.trap", 100000));
        QVERIFY(waitForGenerations(*process, 1));
        ::kill(static_cast<pid_t>(process->processId()), SIGHUP);
        const Ran ran = finish(*process);
        QVERIFY2(ran.code == 130, ran.all());
        const QByteArray dump = dumpOf("hung.trap");
        QVERIFY(!dump.isEmpty() && dump.count('\n') % 8 == 0);
        QVERIFY(!QFile::exists(folder_->filePath("hung.trap.lock")));
        QVERIFY(!QFile::exists(folder_->filePath("hung.trap-wal")));
    }

    void namesThatMeanSomethingToSqliteAreFiles() {
        for (const char* name : {":memory:", "file:study.trap?mode=memory"}) {
            const Ran ran = learn(quickStudy(name, 1));
            QVERIFY2(ran.code == 0, ran.all());
            QVERIFY(
                QFile::exists(folder_->path() + "/" + name));  // for Qt, too, a colon begins something else
            QCOMPARE(dumpOf(name).count('\n'), 8);
        }
        QCOMPARE(QDir(folder_->path()).entryList(QDir::Files).size(), 2);
    }

    /// One long run serves for all that happens beside it.
    void othersBesideAndInterruptTwice() {
        QStringList slow = quickStudy("slow.trap", 100000);
        slow[slow.indexOf("--trials") + 1] = "80";
        auto process = start(folder_->path(), slow);
        QVERIFY(waitForGenerations(*process, 1));

        const Ran writer = learn({"evolve", "slow.trap", "--resume"});
        QVERIFY2(writer.code == 5 && writer.errors.contains("another Trapwright"), writer.all());
        const Ran selector = learn({"select", "slow.trap"});
        QVERIFY2(selector.code == 5, selector.all());
        const Ran reader = learn({"dump", "slow.trap"});
        QVERIFY2(reader.code == 0 && reader.output.count('\n') % 8 == 0 && !reader.output.isEmpty(),
                 reader.all());
        QCOMPARE(learn({"settings", "slow.trap"}).code, 0);

        interrupt(*process);
        QVERIFY(waitForNote(*process, "Stopping after this generation"));
        QElapsedTimer timer;
        timer.start();
        interrupt(*process);
        const Ran ran = finish(*process);
        QVERIFY2(ran.code == 130, ran.all());
        QVERIFY2(timer.elapsed() < 2000, QByteArray::number(timer.elapsed()));
        // Whole generations only, and nobody is locked out afterwards.
        const QByteArray dump = dumpOf("slow.trap");
        QVERIFY(!dump.isEmpty() && dump.count('\n') % 8 == 0);
        QVERIFY(!QFile::exists(folder_->filePath("slow.trap.lock")));
    }

    void aStudyThatIsDeletedWhileItLearnsIsRescued_data() {
        QTest::addColumn<bool>("replaced");
        QTest::newRow("deleted") << false;
        QTest::newRow("replaced") << true;
    }

    void aStudyThatIsDeletedWhileItLearnsIsRescued() {
        QFETCH(bool, replaced);
        if (replaced) QVERIFY(learn(quickStudy("other.trap", 1)).code == 0);
        const QByteArray other = replaced ? dumpOf("other.trap") : QByteArray();
        auto process = start(folder_->path(), quickStudy("gone.trap", 100000));
        QVERIFY(waitForGenerations(*process, 2));
        QVERIFY(QFile::remove(folder_->filePath("gone.trap")));
        if (replaced) QVERIFY(QFile::rename(folder_->filePath("other.trap"), folder_->filePath("gone.trap")));
        const Ran ran = finish(*process);
        QVERIFY2(ran.code == 4, ran.all());
        QVERIFY2(ran.errors.contains("gone-rescued.trap") && !ran.output.contains("Done"), ran.all());
        QVERIFY2(ran.errors.contains(replaced ? "replaced by another file" : "deleted or moved"), ran.all());
        // Whole generations, those of a run that was not disturbed.
        const QByteArray dump = dumpOf("gone-rescued.trap");
        const int saved = static_cast<int>(dump.count('\n')) / 8;
        QVERIFY(saved >= 2);
        QVERIFY(learn(quickStudy("whole.trap", saved)).code == 0);
        QCOMPARE(dumpOf("whole.trap"), dump);
        QCOMPARE(QFile::exists(folder_->filePath("gone.trap")), replaced);
        if (replaced) QCOMPARE(dumpOf("gone.trap"), other);
    }

    void resumedWithMoreGenerations() {
        QVERIFY(learn(quickStudy("whole.trap", 3)).code == 0);
        QVERIFY(learn(quickStudy("longer.trap", 2)).code == 0);
        const Ran ran = learn({"evolve", "longer.trap", "--resume", "--generations", "3", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        QCOMPARE(ran.json()["end"].toString(), "completed");
        // Each generation tells its winner's success, which the dump has of everybody.
        const QList<QByteArray> dump = dumpOf("longer.trap").split('\n');
        const QJsonArray generations = ran.json()["generations"].toArray();
        QCOMPARE(generations.size(), 3);
        for (const auto value : generations) {
            const QJsonObject generation = value.toObject();
            const qsizetype line = 8 * generation["generation"].toInt() + generation["winner"].toInt();
            const QList<QByteArray> fields = dump[line].split(' ');
            QCOMPARE(fields.size(), 30);  // nine scores with their errors
            const QJsonObject success = generation["success"].toObject();
            QCOMPARE(success["count"].toInt(-1), fields[29].toInt());
            QCOMPARE(success["share"].toDouble(-1.0), fields[29].toDouble() / fields[25].toDouble());
            QVERIFY(success["low"].toDouble() <= success["share"].toDouble());
            QCOMPARE(success["bounds"].toString(), "95 % Clopper-Pearson");
            const double top = generation["top_30_percent_success"].toDouble(-1.0);
            QVERIFY(top >= 0.0 && top <= 1.0);
        }
        QCOMPARE(dumpOf("longer.trap"), dumpOf("whole.trap"));
        const Ran changed = learn({"evolve", "longer.trap", "--resume", "--trials", "7"});
        QVERIFY2(changed.code == 2 && changed.errors.contains("Only evolution.generations"), changed.all());
    }

    /// Corners of the operating box from a generation on: whether that was known from the start or is asked
    /// for then, the bits are the same.
    void cornersAreLearnedLater() {
        const QStringList planned{"--set", "evolution.cornerShare=0.6",
                                  "--set", "evolution.cornersFrom=2",
                                  "--set", "evolution.objectives=F_C, F_D, F_O, corners"};
        QVERIFY(learn(quickStudy("whole.trap", 22) + planned).code == 0);
        const Ran early = learn(quickStudy("asked.trap", 2) + QStringList{"--corners"});
        QVERIFY2(early.code == 2 && early.errors.contains("no study asked.trap yet"), early.all());
        QVERIFY(learn(quickStudy("asked.trap", 2)).code == 0);
        const Ran ran = learn({"evolve", "asked.trap", "--resume", "--corners", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonArray generations = ran.json()["generations"].toArray();
        QCOMPARE(generations.size(), 22);
        QVERIFY(!generations[1].toObject()["best"].toObject().contains("corners"));
        QVERIFY(generations[2].toObject()["best"].toObject().contains("corners"));
        const Ran same = learn({"dump", "asked.trap", "--compare", "whole.trap"});
        QVERIFY2(same.code == 0 && same.output.contains("The same designs and scores."), same.all());
        // Once they are learned they stay.
        const Ran back = learn({"evolve", "asked.trap", "--resume", "--set", "evolution.cornerShare=0"});
        QVERIFY2(back.code == 2 && back.errors.contains("Only evolution.generations"), back.all());
        QVERIFY(
            learn(quickStudy("level.trap", 1) + QStringList{"--set", "evolution.conditions=nominal"}).code ==
            0);
        const Ran level = learn({"evolve", "level.trap", "--resume", "--corners"});
        QVERIFY2(level.code == 2 && level.errors.contains("nominal"), level.all());
    }

    /// A study begins with the tracks of another one, under other physics, and goes on as any.
    void beginsWithTheTracksOfAnother() {
        QVERIFY(learn(quickStudy("first.trap", 3)).code == 0);
        const QStringList as{"--begin-with", "first.trap", "--set", "simulation.contact.restitution=0.3",
                             "--generations"};
        QVERIFY(learn(QStringList{"evolve", "whole.trap"} + as + QStringList{"3"}).code == 0);
        QVERIFY(learn(QStringList{"new", "pieces.trap"} + as + QStringList{"1"}).code == 0);
        QVERIFY(learn({"evolve", "pieces.trap"}).code == 0);
        const Ran ran = learn({"evolve", "pieces.trap", "--resume", "--generations", "3"});
        QVERIFY2(ran.code == 0, ran.all());
        QCOMPARE(dumpOf("pieces.trap"), dumpOf("whole.trap"));
        // Its first generation has designs of the other's last.
        const QList<QByteArray> last = dumpOf("first.trap").split('\n').mid(16, 8);
        const QByteArray design = dumpOf("whole.trap").split('\n')[0].split(' ')[2];
        QVERIFY(std::any_of(last.begin(), last.end(),
                            [&](const QByteArray& line) { return line.split(' ')[2] == design; }));
        const Ran other =
            learn({"evolve", "other.trap", "--begin-with", "first.trap", "--set", "track.crossSections=7"});
        QVERIFY2(other.code == 2 && other.errors.contains("first.trap"), other.all());
        QVERIFY(!QFile::exists(folder_->filePath("other.trap")));
        const Ran nowhere = learn({"evolve", "other.trap", "--begin-with", "nowhere.trap"});
        QVERIFY2(nowhere.code == 3 && nowhere.errors.contains("nowhere.trap"), nowhere.all());
        const Ran both = learn({"evolve", "other.trap", "--begin-with", "first.trap", "--preset", "cone"});
        QVERIFY2(both.code == 2, both.all());
    }

    /// Traps that throw out what lies wrong, behind a track that is there: of a study or of a file.
    void learnsBehindATrack() {
        QVERIFY(learn(quickStudy("first.trap", 2)).code == 0);
        const QStringList few{"--set",         "evolution.trialsPerEvaluation=8",
                              "--set",         "evolution.racingTrials=4",
                              "--population",  "6",
                              "--generations", "2",
                              "--engine",      "native"};
        const Ran ran = learn(QStringList{"evolve", "behind.trap", "--behind", "first.trap", "--json"} + few);
        QVERIFY2(ran.code == 0, ran.all());
        const QJsonObject best = ran.json()["generations"].toArray()[1].toObject()["best"].toObject();
        QVERIFY(best.contains("purity"));
        const Ran settings = learn({"settings", "behind.trap"});
        QCOMPARE(settings.json()["track"].toObject()["traps"].toString(), QString("notched"));
        QCOMPARE(settings.json()["track"].toObject()["returns"].toString(), QString("anywhere"));
        QCOMPARE(settings.json()["track"].toObject()["given"].toString().count(':'), 5);
        const Ran solid = learn({"export", "behind.trap", "behind.stl", "behind.json"});
        QVERIFY2(solid.code == 0 && solid.output.contains("closed and manifold"), solid.all());
        // The file has what is given as its own.
        const Ran file = learn(QStringList{"evolve", "file.trap", "--behind", "behind.json", "--preset",
                                           "cuboid", "--set", "track.traps=cut-out"} +
                               few);
        QVERIFY2(file.code == 0, file.all());
        QCOMPARE(learn({"settings", "file.trap"}).json()["track"].toObject()["given"].toString().count(':'),
                 9);
        const Ran both = learn({"new", "no.trap", "--behind", "first.trap", "--part", "cone"});
        QVERIFY2(both.code == 2 && both.errors.contains("part and settings are those of the study"),
                 both.all());
        const Ran nowhere = learn({"new", "no.trap", "--behind", "nowhere.trap"});
        QVERIFY2(nowhere.code == 3 && nowhere.errors.contains("nowhere.trap"), nowhere.all());
        // Which of both it would be is not known.
        const Ran noTrack = learn({"new", "no.trap", "--behind", "nowhere.json", "--part", "cone"});
        QVERIFY2(noTrack.code == 3 && noTrack.errors.contains("nowhere.json"), noTrack.all());
        const Ran planned =
            learn({"new", "no.trap", "--behind", "first.trap", "--set", "evolution.firstGeneration=planned"});
        QVERIFY2(planned.code == 2 && planned.errors.contains("track.given"), planned.all());
        QVERIFY(!QFile::exists(folder_->filePath("no.trap")));
    }

    /// Other searches and other traps than the paper's: learned, resumed, exported like it.
    void otherSearchesAndTraps_data() {
        QTest::addColumn<QString>("search");
        QTest::addColumn<QString>("traps");
        QTest::addColumn<QStringList>("curves");
        const QStringList strategy{"p_x", "p_dm", "p_s"};
        const QStringList scores{"best_so_far", "median_score"};
        QTest::newRow("random") << "random"
                                << "free-form" << scores;
        QTest::newRow("exchange") << "exchange"
                                  << "free-form" << QStringList{"gain", "exchanges"};
        QTest::newRow("step") << "genetic"
                              << "step" << strategy;
        QTest::newRow("both") << "random"
                              << "step, free-form" << scores;
    }
    void otherSearchesAndTraps() {
        QFETCH(QString, search);
        QFETCH(QString, traps);
        QFETCH(QStringList, curves);
        const QStringList with{"--set", "evolution.search=" + search, "--set", "track.traps=" + traps};
        QVERIFY(learn(quickStudy("whole.trap", 4) + with).code == 0);
        QVERIFY(learn(quickStudy("pieces.trap", 2) + with).code == 0);
        const Ran ran = learn({"evolve", "pieces.trap", "--resume", "--generations", "4", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        QCOMPARE(dumpOf("pieces.trap"), dumpOf("whole.trap"));
        const QJsonObject generation = ran.json()["generations"].toArray()[3].toObject();
        for (const char* key : {"p_x", "p_dm", "p_s", "best_so_far", "median_score", "gain", "exchanges"})
            QCOMPARE(generation.contains(QLatin1String(key)), curves.contains(QLatin1String(key)));
        const Ran solid = learn({"export", "whole.trap", "track.stl"});
        QVERIFY2(solid.code == 0 && solid.output.contains("closed and manifold"), solid.all());
        const Ran changed =
            learn({"evolve", "whole.trap", "--resume", "--set",
                   search == "genetic" ? "track.traps=free-form" : "evolution.search=genetic"});
        QVERIFY2(changed.code == 2 && changed.errors.contains("Only evolution.generations"), changed.all());
    }

    /// Another sum than the paper's: searched for, raced by, printed, resumed.
    void otherObjectives() {
        const QStringList with{"--set", "evolution.objectives=F_C, F_D, success, conveying_speed", "--set",
                               "evolution.racingTrials=2"};
        QVERIFY(learn(quickStudy("whole.trap", 3) + with).code == 0);
        const Ran first = learn(quickStudy("pieces.trap", 2) + with);
        QVERIFY2(first.code == 0 && first.output.contains("F_D Success   Speed"), first.all());
        const Ran ran = learn({"evolve", "pieces.trap", "--resume", "--generations", "3", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        QCOMPARE(dumpOf("pieces.trap"), dumpOf("whole.trap"));
        for (const auto value : ran.json()["generations"].toArray()) {
            const QJsonObject best = value.toObject()["best"].toObject();
            const double success = value.toObject()["success"].toObject()["share"].toDouble();
            QVERIFY(best.contains("F_O"));  // measured, but not counted
            QVERIFY(qAbs(best["F"].toDouble() - best["F_C"].toDouble() - best["F_D"].toDouble() - success -
                         best["conveying_speed"].toDouble()) < 1e-12);
        }
        const Ran unknown =
            learn(quickStudy("none.trap", 1) + QStringList{"--set", "evolution.objectives=F_Q"});
        QVERIFY2(unknown.code == 2 && unknown.errors.contains("The objectives are: F_C, F_D, F_O"),
                 unknown.all());
    }

    /// A wanted pose: told, learned for, resumed, and what selection and validation go by.
    void wantedPose() {
        const QStringList with{"--set", "target.poses=4", "--set", "evolution.objectives=F_C, F_D, F_O, F_W"};
        QVERIFY(learn(quickStudy("whole.trap", 3) + with).code == 0);
        const Ran first = learn(quickStudy("pieces.trap", 2) + with);
        QVERIFY2(first.code == 0 &&
                     first.output.contains("Parts shall end in stable pose 3-4, any heading.") &&
                     first.output.contains("F_W 100.0 %"),
                 first.all());
        const Ran ran = learn({"evolve", "pieces.trap", "--resume", "--generations", "3", "--json"});
        QVERIFY2(ran.code == 0, ran.all());
        QCOMPARE(dumpOf("pieces.trap"), dumpOf("whole.trap"));
        for (const auto value : ran.json()["generations"].toArray()) {
            const QJsonObject best = value.toObject()["best"].toObject();
            QVERIFY(best.contains("F_W"));
            QCOMPARE(best["F_W"].toDouble(), value.toObject()["success"].toObject()["share"].toDouble());
        }
        const Ran selected = learn({"select", "whole.trap", "--winners", "2", "--trials", "20"});
        QVERIFY2(selected.code == 0 && selected.output.contains("parts end in stable pose 3-4"),
                 selected.all());
        const Ran validated = learn({"validate", "whole.trap", "--trials", "10"});
        QVERIFY2(validated.code == 0 && validated.output.contains("of stable pose 3-4 in any heading"),
                 validated.all());
        const Ran given =
            learn({"validate", "whole.trap", "--trials", "10", "--expected", "1", "0", "0", "0"});
        QVERIFY2(given.code == 0 && given.output.contains("of the orientation (w, x, y, z) = (1.000"),
                 given.all());
        const Ran exported = learn({"export", "whole.trap", "track.json"});
        QVERIFY2(exported.code == 0, exported.all());
        const Ran other = learn({"evolve", "whole.trap", "--resume", "--set", "target.poses=5"});
        QVERIFY2(other.code == 2 && other.errors.contains("Only evolution.generations"), other.all());
    }

    void whatIsWantedMustBeThere() {
        const Ran none = learn(quickStudy("none.trap", 1) + QStringList{"--set", "target.poses=3, 7"});
        QVERIFY2(none.code == 2 &&
                     none.errors.contains("has no stable pose 7. It has 1-2; 3-4; 5-6 (alike ones together)"),
                 none.all());
        const Ran nothing =
            learn(quickStudy("none.trap", 1) + QStringList{"--set", "evolution.objectives=F_W"});
        QVERIFY2(nothing.code == 2 && nothing.errors.contains("but nothing is wanted"), nothing.all());
        const Ran idle = learn({"new", "idle.trap", "--preset", "cuboid", "--set", "target.poses=3"});
        QVERIFY2(idle.code == 0 && idle.errors.contains("F_C, F_D, F_O, F_W is recommended"), idle.all());
    }

    void unknownTrapsAreRefused() {
        const Ran ran = learn(quickStudy("none.trap", 1) + QStringList{"--set", "track.traps=shelf"});
        QVERIFY2(ran.code != 0 && ran.errors.contains("The kinds are: free-form, step"), ran.all());
        QVERIFY(!QFile::exists(folder_->filePath("none.trap")));
    }

 private:
    [[nodiscard]] Ran learn(const QStringList& arguments) const { return run(folder_->path(), arguments); }
    [[nodiscard]] QByteArray dumpOf(const QString& study) const { return learn({"dump", study}).output; }

    std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_GUILESS_MAIN(LearningTest)
#include "learning_test.moc"
