// The program as a job of several ranks, started by the real mpirun.

#include <signal.h>

#include <QDir>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.h"

using namespace trapwright::test;

namespace {

/// Starts the program on so many ranks, more than there are processors maybe.
std::unique_ptr<QProcess> startJob(const QString& folder, int ranks, const QStringList& arguments) {
    auto process = std::make_unique<QProcess>();
    process->setWorkingDirectory(folder);
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT", "1");
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    process->setProcessEnvironment(environment);
    process->start(
        MPIRUN, QStringList{"--oversubscribe", "-n", QString::number(ranks), TRAPWRIGHT_PROGRAM} + arguments);
    process->waitForStarted(kPatience);
    return process;
}

Ran runJob(const QString& folder, int ranks, const QStringList& arguments) {
    return finish(*startJob(folder, ranks, arguments));
}

/// The process of a rank, by what mpirun gave it; 0: there is none.
pid_t findRank(qint64 mpirun, int rank) {
    const QString tasks = QString("/proc/%1/task/%1/children").arg(mpirun);
    QFile children(tasks);
    if (!children.open(QIODevice::ReadOnly)) return 0;
    for (const QByteArray& child : children.readAll().split(' ')) {
        QFile environment("/proc/" + child + "/environ");
        if (!environment.open(QIODevice::ReadOnly)) continue;
        if (environment.readAll().split('\0').contains("OMPI_COMM_WORLD_RANK=" + QByteArray::number(rank)))
            return child.toInt();
    }
    return 0;
}

/// Waits until the study's first `count` generations are there, as the job says. What it said is added.
bool waitForGenerations(QProcess& job, int count, QByteArray& said) {
    QElapsedTimer timer;
    timer.start();
    while (timer.elapsed() < kPatience && job.state() != QProcess::NotRunning) {
        said += job.readAllStandardOutput();
        if (said.contains("\n" + QByteArray::number(count - 1).rightJustified(10) + " ")) return true;
        job.waitForReadyRead(20);
    }
    return false;
}

const QStringList kQuick = {"--preset", "cuboid", "--population", "8", "--trials", "8"};

QByteArray dump(const QString& folder, const QString& study) {
    const Ran ran = run(folder, {"dump", study});
    return ran.code == 0 ? ran.output : "failed: " + ran.all();
}

}  // namespace

class MpiJobTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
    }

    // Learning with its checks, selection and validation, in both engines.
    void sameBitsAsOneProcess() {
        const QStringList learn = QStringList{"--generations", "3"} + kQuick;
        QCOMPARE(run(path(), QStringList{"evolve", "alone.trap"} + learn).code, 0);
        const Ran job = runJob(path(), 3, QStringList{"evolve", "job.trap"} + learn);
        QVERIFY2(job.code == 0, job.all());
        QVERIFY2(job.errors.contains("3 ranks on one machine"), job.errors);
        QCOMPARE(dump(path(), "job.trap"), dump(path(), "alone.trap"));
        const QStringList select = {"--winners", "2", "--trials", "20", "--corner-trials", "8", "--json"};
        const Ran chosenAlone = run(path(), QStringList{"select", "alone.trap"} + select);
        const Ran chosen = runJob(path(), 3, QStringList{"select", "job.trap"} + select);
        QVERIFY2(chosen.code == 0, chosen.all());
        QCOMPARE(QByteArray(chosen.output).replace("job.trap", "alone.trap"), chosenAlone.output);
    }

    // As a batch system says that the time is nearly over: the generation is finished; and goes on exactly.
    void stopsAfterTheGeneration() {
        const QStringList learn = QStringList{"--generations", "6", "--engine", "native"} + kQuick;
        QCOMPARE(run(path(), QStringList{"evolve", "alone.trap"} + learn).code, 0);
        const auto job = startJob(path(), 2, QStringList{"evolve", "job.trap"} + learn);
        QByteArray said;
        QVERIFY2(waitForGenerations(*job, 1, said), said);
        ::kill(static_cast<pid_t>(job->processId()), SIGUSR1);
        const Ran stopped = finish(*job);
        QVERIFY2(stopped.code == 130, stopped.all());
        QVERIFY(dump(path(), "job.trap") != dump(path(), "alone.trap"));
        const Ran resumed = runJob(path(), 3, {"evolve", "job.trap", "--resume", "--generations", "6"});
        QVERIFY2(resumed.code == 0, resumed.all());
        QCOMPARE(dump(path(), "job.trap"), dump(path(), "alone.trap"));
    }

    void losesNothingWithARank_data() {
        QTest::addColumn<int>("rank");
        QTest::addColumn<int>("signal");
        QTest::newRow("killed") << 1 << SIGKILL;
        QTest::newRow("rank 0 killed") << 0 << SIGKILL;
        QTest::newRow("hangs") << 2 << SIGSTOP;
    }
    void losesNothingWithARank() {
        QFETCH(int, rank);
        QFETCH(int, signal);
        const QStringList learn = QStringList{"--engine", "native"} + kQuick;
        const auto job =
            startJob(path(), 3, QStringList{"evolve", "job.trap", "--generations", "10000"} + learn);
        QByteArray said;
        QVERIFY2(waitForGenerations(*job, 2, said), said);
        const pid_t process = findRank(job->processId(), rank);
        QVERIFY(process != 0);
        QElapsedTimer timer;
        timer.start();
        ::kill(process, signal);
        const Ran ended = finish(*job);
        // 15 s of silence, and what a busy machine takes besides.
        QVERIFY2(timer.elapsed() < 90000, "It took longer than 90 s.");
        QVERIFY2(ended.code != 0, ended.all());
        if (signal == SIGSTOP) QVERIFY2(ended.errors.contains("Rank 2 on "), ended.errors);
        // What the job had saved is what one process learns, and it goes on.
        const int saved = 1 + lastGeneration(dump(path(), "job.trap"));
        QVERIFY(saved >= 2);
        const QString more = QString::number(saved + 1);
        const Ran resumed = run(path(), {"evolve", "job.trap", "--resume", "--generations", more});
        QVERIFY2(resumed.code == 0, resumed.all());
        QCOMPARE(run(path(), QStringList{"evolve", "alone.trap", "--generations", more} + learn).code, 0);
        QCOMPARE(dump(path(), "job.trap"), dump(path(), "alone.trap"));
    }

    void refusesRanksThatKnowNothingOfEachOther() {
        QProcess process;
        process.setWorkingDirectory(path());
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("SLURM_STEP_NUM_TASKS", "4");
        process.setProcessEnvironment(environment);
        process.start(TRAPWRIGHT_PROGRAM, QStringList{"evolve", "a.trap"} + kQuick);
        const Ran ran = finish(process);
        QCOMPARE(ran.code, 2);
        QVERIFY2(ran.errors.contains("one of 4 tasks that know nothing of each other"), ran.errors);
        QVERIFY(!QFile::exists(path() + "/a.trap"));
    }

    void saysWhatIsWrongOnce() {
        const Ran ran = runJob(path(), 3, {"evolve", "a.trap", "--preset", "cube"});
        QCOMPARE(ran.code, 2);
        QCOMPARE(ran.errors.count("cuboid"), 1);
    }

 private:
    [[nodiscard]] QString path() const { return folder_->path(); }

    /// Of what dump prints: the first number of its last line.
    static int lastGeneration(const QByteArray& dumped) {
        return dumped.trimmed().split('\n').last().split(' ').first().toInt();
    }

    std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_GUILESS_MAIN(MpiJobTest)
#include "mpi_job_test.moc"
