// Jobs of a batch system, with the real batch script and commands that stand for Slurm's: one job, started at
// once.

#include <signal.h>

#include <QDir>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"
#include "tests/app/slurm_stand_in.h"

using namespace trapwright::test;

namespace {

const QStringList kQuick = {"--preset", "cuboid", "--population", "6", "--trials", "4", "--engine", "native"};

}  // namespace

class SubmitTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
        environment_ = QProcessEnvironment::systemEnvironment();
    }

    void learnsWhatEvolveLearns() {
        standInForSlurm();
        QCOMPARE(run(path(), QStringList{"evolve", "alone.trap", "--generations", "5"} + kQuick).code, 0);
        QCOMPARE(run(path(), QStringList{"evolve", "home.trap", "--generations", "2"} + kQuick).code, 0);
        const Ran ran = submit({"home.trap", "--generations", "5", "--ranks", "2", "--hours", "1.5",
                                "--sbatch=--partition=long one"});
        QVERIFY2(ran.code == 0, ran.all());
        QVERIFY2(ran.output.contains("Job 7 of 2 ranks in "), ran.all());
        // A line for each generation that came.
        QVERIFY2(ran.output.contains("\n         4 ") && !ran.output.contains("\n         1 "), ran.all());
        QCOMPARE(read("options"), QByteArray("--parsable --ntasks=2 --time=1:30:00 --job-name=home "
                                             "--partition=long one\n"));
        QCOMPARE(dump("home.trap"), dump("alone.trap"));
        // It is over; the next one has a folder of its own.
        const Ran more = submit({"home.trap", "--generations", "6", "--json"});
        QVERIFY2(more.code == 0, more.all());
        QVERIFY(more.json()["folder"].toString().endsWith("home-job-2"));
        QCOMPARE(more.json()["generations"].toInt(), 6);
    }

    // The job ends with its generation; what it has is at home, and another goes on.
    void ctrlCStopsTheJob() {
        standInForSlurm();
        QCOMPARE(run(path(), QStringList{"new", "home.trap", "--preset", "cuboid", "--population", "6",
                                         "--trials", "4", "--engine", "native", "--generations", "100000"})
                     .code,
                 0);
        const auto process = startSubmit({"home.trap"});
        QElapsedTimer timer;
        timer.start();
        QByteArray said;
        while (!said.contains("\n         1 ") && timer.elapsed() < kPatience) {
            process->waitForReadyRead(50);
            said += process->readAllStandardOutput();
        }
        QVERIFY2(process->state() == QProcess::Running, said);
        ::kill(static_cast<pid_t>(process->processId()), SIGINT);
        const Ran ended = finish(*process);
        QCOMPARE(ended.code, 130);
        QVERIFY2(read("cancelled").contains("--batch --signal=USR2 7"), read("cancelled"));
        QCOMPARE(dump("home.trap"), dump("home-job/home.trap"));
        QVERIFY2(read("home-job/slurm-7.out").contains("stopped from outside"), read("home-job/slurm-7.out"));
    }

    // Who went away while it learned finds it again.
    void isFollowedAgain() {
        standInForSlurm();
        QCOMPARE(run(path(), QStringList{"new", "home.trap", "--generations", "8"} + kQuick).code, 0);
        const Ran queued = submit({"home.trap", "--no-follow", "--json"});
        QVERIFY2(queued.code == 0, queued.all());
        QCOMPARE(queued.json()["job"].toString(), QString("7"));
        const Ran followed = submit({"home.trap", "--json"});
        QVERIFY2(followed.code == 0, followed.all());
        QVERIFY(followed.json()["folder"].toString().endsWith("home-job"));
        QCOMPARE(followed.json()["generations"].toInt(), 8);
        QCOMPARE(dump("home.trap"), dump("home-job/home.trap"));
    }

    // The folder is learned elsewhere, and what comes back with it is taken.
    void withoutABatchSystem() {
        environment_.insert("PATH", path() + "/nothing");
        QCOMPARE(run(path(), QStringList{"new", "home.trap", "--generations", "3"} + kQuick).code, 0);
        const Ran written = submit({"home.trap"});
        QVERIFY2(written.code == 0, written.all());
        QVERIFY2(written.output.contains("There is no sbatch here"), written.all());
        QVERIFY2(written.output.contains(": sh home-job/submit.sh\n"), written.all());
        QCOMPARE(run(path(), QStringList{"new", "two parts.trap"} + kQuick).code, 0);
        const Ran spaced = submit({"two parts.trap"});
        QVERIFY2(spaced.output.contains(": sh 'two parts-job/submit.sh'\n"), spaced.all());
        QCOMPARE(run(path() + "/home-job", {"evolve", "home.trap"}).code, 0);
        const Ran taken = submit({"home.trap", "--folder", "home-job"});
        QVERIFY2(taken.output.contains("3 new generations"), taken.all());
        QCOMPARE(dump("home.trap"), dump("home-job/home.trap"));
        // What is no job, and a study that is none of the job's.
        QVERIFY(QDir(path()).mkdir("other"));
        QCOMPARE(submit({"home.trap", "--folder", "other"}).code, 3);
        QCOMPARE(run(path(), QStringList{"new", "seed.trap", "--seed", "9"} + kQuick).code, 0);
        const Ran refused = submit({"seed.trap", "--folder", "home-job"});
        QVERIFY2(refused.code == 3 && refused.errors.contains("other settings"), refused.all());
    }

    // Whatever a folder's note says: nothing of it becomes an option of scancel, and nothing is broken off.
    void aDamagedNoteIsToldOf() {
        standInForSlurm();
        QCOMPARE(run(path(), QStringList{"new", "home.trap"} + kQuick).code, 0);
        QVERIFY(QDir(path()).mkdir("home-job"));
        for (const char* note : {"", "[]", R"({"study": "home.trap"})", R"({"study": "home.trap", "job": 7})",
                                 R"({"study": "home.trap", "job": "--user=root"})",
                                 R"({"study": "home.trap", "job": "7", "over": "no"})"}) {
            trapwright::test::write(path() + "/home-job/job.json", note);
            const Ran ran = submit({"home.trap"});
            QVERIFY2(ran.code == 3 && ran.errors.contains("job.json is damaged"), ran.all());
        }
        QVERIFY(read("cancelled").isEmpty());
    }

    void saysWhatSbatchSays() {
        standInForSlurm();
        QVERIFY(SlurmStandIn(path()).write("sbatch", kRefusing));
        QCOMPARE(run(path(), QStringList{"new", "home.trap"} + kQuick).code, 0);
        const Ran ran = submit({"home.trap"});
        QCOMPARE(ran.code, 6);
        QVERIFY2(ran.errors.contains("invalid partition specified: long"), ran.all());
        // The next one shall have other options.
        QVERIFY(!QDir(path()).exists("home-job"));
    }

 private:
    [[nodiscard]] QString path() const { return folder_->path(); }
    [[nodiscard]] QByteArray read(const QString& name) const { return SlurmStandIn(path()).read(name); }
    [[nodiscard]] QByteArray dump(const QString& study) const {
        const Ran ran = run(path(), {"dump", study});
        return ran.code == 0 ? ran.output : "failed: " + ran.all();
    }
    void standInForSlurm() {
        const SlurmStandIn slurm(path());
        QVERIFY(slurm.install());
        for (const auto& [name, value] : slurm.environment(environment_.value("PATH")))
            environment_.insert(name, value);
    }
    [[nodiscard]] std::unique_ptr<QProcess> startSubmit(const QStringList& arguments) const {
        auto process = std::make_unique<QProcess>();
        process->setWorkingDirectory(path());
        process->setProcessEnvironment(environment_);
        process->start(TRAPWRIGHT_PROGRAM, QStringList{"submit"} + arguments);
        process->waitForStarted(kPatience);
        return process;
    }
    [[nodiscard]] Ran submit(const QStringList& arguments) const { return finish(*startSubmit(arguments)); }

    std::unique_ptr<QTemporaryDir> folder_;
    QProcessEnvironment environment_;
};

QTEST_GUILESS_MAIN(SubmitTest)
#include "submit_test.moc"
