// A study that learns as a job of a cluster, as a user has it done in the window: with the real batch script
// and commands that stand for Slurm's.

#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QToolButton>

#include "sim/engines/registry.h"
#include "tests/app/program.h"
#include "tests/app/slurm_stand_in.h"
#include "tests/ui/window/user.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

using namespace trapwright;
using session::RunState;
using test::SlurmStandIn;

namespace {

constexpr int kPatience = 60000;  // [ms]

}  // namespace

class ClusterTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() {
        tests::useFolder(settings_, "cluster_test");
        path_ = QString::fromLocal8Bit(qgetenv("PATH"));
    }

    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        QVERIFY(folder_->isValid());
        const SlurmStandIn slurm(folder_->path());
        QVERIFY(slurm.install());
        for (const auto& [name, value] : slurm.environment(path_))
            qputenv(name.toLocal8Bit().constData(), value.toLocal8Bit());
    }

    void learnsWhatThisMachineLearns() {
        makeStudy("alone.trap", 5);
        QCOMPARE(test::run(folder_->path(), {"evolve", "alone.trap"}).code, 0);
        makeStudy("home.trap", 5);
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        auto& runs = window.desk().session()->runs();
        QSignalSpy saved(&runs, &session::StudyRuns::generationSaved);
        window.showPage("evolve");
        QVERIFY(find<QToolButton>(window, "evolve.cluster")->isVisible());
        QDialog* dialog = ask(window);
        QVERIFY(dialog != nullptr);
        dialog->findChild<QSpinBox*>("cluster.ranks")->setValue(2);
        dialog->findChild<QLineEdit*>("cluster.options")->setText("--partition=\"long one\"");
        QVERIFY(find<QLabel>(window, "cluster.time")->text().contains("home-job"));
        click(dialog, "cluster.submit");
        QTRY_VERIFY_WITH_TIMEOUT(runs.state() == RunState::following, kPatience);
        QTRY_COMPARE(find<QLabel>(window, "status.state")->text(), QString("Learning on a cluster"));
        QVERIFY(!action(window, "run.pause")->isEnabled() && !action(window, "run.start")->isEnabled());
        QTRY_VERIFY_WITH_TIMEOUT(window.findChild<QDialog*>("cluster") == nullptr, kPatience);
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), RunState::idle, kPatience);
        QCOMPARE(saved.count(), 5);
        QVERIFY2(notes("options").contains("--ntasks=2 --time=24:00:00 --job-name=home --partition=long one"),
                 notes("options"));
        QVERIFY2(messageOf(window).isEmpty(), qPrintable(messageOf(window)));
        QCOMPARE(dump("home.trap"), dump("alone.trap"));
    }

    // Nobody is asked: the job goes on, and is stopped from the window that finds it again.
    void aWindowThatClosesLeavesTheJob() {
        makeStudy("home.trap", 100000);
        {
            window::MainWindow window{environment()};
            QVERIFY(open(window));
            click(ask(window), "cluster.submit");
            auto& runs = window.desk().session()->runs();
            QTRY_VERIFY_WITH_TIMEOUT(!runs.summaries().empty(), kPatience);
            QVERIFY2(find<QLabel>(window, "evolve.detail")->text().contains("Job 7"),
                     qPrintable(find<QLabel>(window, "evolve.detail")->text()));
            window.close();
            QVERIFY(window.findChild<QMessageBox*>("dialog.running") == nullptr);
            QTRY_VERIFY_WITH_TIMEOUT(!window.isVisible(), kPatience);
        }
        QVERIFY2(notes("cancelled").isEmpty(), notes("cancelled"));
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        auto& runs = window.desk().session()->runs();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), RunState::following, kPatience);
        const std::size_t before = runs.summaries().size();
        QTRY_VERIFY_WITH_TIMEOUT(runs.summaries().size() > before, kPatience);
        action(window, "run.stopAfterGeneration")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), RunState::idle, kPatience);
        QVERIFY2(notes("cancelled").contains("--batch --signal=USR2 7"), notes("cancelled"));
        QVERIFY2(messageOf(window).isEmpty(), qPrintable(messageOf(window)));
        QCOMPARE(dump("home.trap"), dump("home-job/home.trap"));
        // It is over, and is not followed once more; what comes next has a folder of its own.
        runs.followLastJob();
        QCOMPARE(runs.state(), RunState::idle);
        QDialog* dialog = ask(window);
        QVERIFY(find<QLabel>(window, "cluster.time")->text().contains("home-job-2"));
        dialog->reject();
    }

    // A job that waits has no generation that could end: it goes from the queue.
    void tellsWhyAJobWaits() {
        QVERIFY(SlurmStandIn(folder_->path())
                    .write("squeue",
                           "#!/bin/sh\nif [ -e \"$SLURM_STANDIN/cancelled\" ]; then exit 0; fi\n"
                           "echo 'PENDING ReqNodeNotAvail, UnavailableNodes:v[1-2]'\n"));
        QVERIFY(SlurmStandIn(folder_->path())
                    .write("sbatch",
                           "#!/bin/sh\nsleep 2\nsleep 600 > /dev/null 2>&1 & echo $! > "
                           "\"$SLURM_STANDIN/process\"\necho 7\n"));
        makeStudy("home.trap", 3);
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        click(ask(window), "cluster.submit");
        QTRY_COMPARE_WITH_TIMEOUT(find<QLabel>(window, "evolve.state")->text(), QString("Writing the job"),
                                  kPatience);
        auto* detail = find<QLabel>(window, "evolve.detail");
        QTRY_VERIFY_WITH_TIMEOUT(detail->text().contains("ReqNodeNotAvail, UnavailableNodes:v[1-2]"),
                                 kPatience);
        QCOMPARE(find<QLabel>(window, "status.state")->text(), QString("Waiting for a cluster"));
        action(window, "run.stopAfterGeneration")->trigger();
        QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::idle, kPatience);
        QCOMPARE(notes("cancelled"), QByteArray("7\n"));
        QVERIFY2(messageOf(window).isEmpty(), qPrintable(messageOf(window)));
    }

    void tellsWhatSbatchSays() {
        QVERIFY(SlurmStandIn(folder_->path()).write("sbatch", test::kRefusing));
        makeStudy("home.trap", 3);
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        QDialog* dialog = ask(window);
        click(dialog, "cluster.submit");
        auto* said = dialog->findChild<QLabel*>("cluster.said");
        QTRY_VERIFY_WITH_TIMEOUT(said->text().contains("invalid partition specified: long"), kPatience);
        QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::idle, kPatience);
        QVERIFY(dialog->isVisible() && dialog->findChild<QPushButton*>("cluster.submit")->isEnabled());
        QVERIFY(!QDir(folder_->path()).exists("home-job"));
        dialog->reject();
    }

    // A job that dies is told of, with what it said; what it learned is kept.
    void tellsWhatAJobSaidLast() {
        QVERIFY(SlurmStandIn(folder_->path())
                    .write("sbatch",
                           "#!/bin/sh\necho 'disk quota exceeded' > slurm-7.out\n"
                           "echo 99999999 > \"$SLURM_STANDIN/process\"\necho 7\n"));
        makeStudy("home.trap", 3);
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        click(ask(window), "cluster.submit");
        QTRY_VERIFY_WITH_TIMEOUT(messageOf(window).contains("disk quota exceeded"), kPatience);
        QTRY_COMPARE_WITH_TIMEOUT(window.desk().session()->runs().state(), RunState::idle, kPatience);
    }

    void withoutABatchSystem() {
        qputenv("PATH", folder_->filePath("nothing").toLocal8Bit());
        makeStudy("home.trap", 3);
        window::MainWindow window{environment()};
        QVERIFY(open(window));
        window.showPage("evolve");
        QVERIFY(!find<QToolButton>(window, "evolve.cluster")->isVisible());
        QDialog* dialog = ask(window);
        QCOMPARE(dialog->findChild<QPushButton*>("cluster.submit")->text(), QString("Write the job"));
        QTest::keyClick(dialog, Qt::Key_Return);
        auto* command = dialog->findChild<QLineEdit*>("cluster.command");
        QTRY_VERIFY_WITH_TIMEOUT(command->isVisible(), kPatience);
        QCOMPARE(command->text(), QString("sh home-job/submit.sh"));
        auto& runs = window.desk().session()->runs();
        QTRY_COMPARE_WITH_TIMEOUT(runs.state(), RunState::idle, kPatience);
        auto* said = dialog->findChild<QLabel*>("cluster.said");
        click(dialog, "cluster.take");
        QTRY_COMPARE_WITH_TIMEOUT(said->text(), QString("There is nothing new in the folder."), kPatience);
        QCOMPARE(test::run(folder_->filePath("home-job"), {"evolve", "home.trap"}).code, 0);
        dialog->reject();
        // Another day.
        QTRY_VERIFY(window.findChild<QDialog*>("cluster") == nullptr);
        dialog = ask(window);
        said = dialog->findChild<QLabel*>("cluster.said");
        click(dialog, "cluster.take");
        QTRY_COMPARE_WITH_TIMEOUT(said->text(), QString("3 new generations were taken."), kPatience);
        QCOMPARE(runs.summaries().size(), std::size_t{3});
        QCOMPARE(dump("home.trap"), dump("home-job/home.trap"));
        dialog->reject();
    }

    // A draft has no place of its own that a job's folder could lie beside.
    void aDraftIsSavedFirst() {
        window::MainWindow window{environment()};
        window.show();
        window.openFile(tests::bundled("cuboid"));
        QTRY_VERIFY_WITH_TIMEOUT(window.desk().session() != nullptr, kPatience);
        QTRY_VERIFY_WITH_TIMEOUT(action(window, "run.cluster")->isEnabled(), kPatience);
        action(window, "run.cluster")->trigger();
        QVERIFY(window.findChild<QDialog*>("cluster") == nullptr);
        QVERIFY(window.findChild<QDialog*>("dialog.file") != nullptr);
    }

 private:
    static session::Environment environment() { return {engines::registry(), "trapwright test", {}}; }
    [[nodiscard]] QByteArray notes(const QString& name) const {
        return SlurmStandIn(folder_->path()).read(name);
    }
    void makeStudy(const QString& name, int generations) const {
        const test::Ran ran = test::run(
            folder_->path(), {"new", name, "--preset", "cuboid", "--population", "6", "--trials", "4",
                              "--engine", "native", "--generations", QString::number(generations)});
        QVERIFY2(ran.code == 0, ran.all());
    }
    [[nodiscard]] QByteArray dump(const QString& study) const {
        const test::Ran ran = test::run(folder_->path(), {"dump", study});
        return ran.code == 0 ? ran.output : "failed: " + ran.all();
    }
    bool open(window::MainWindow& window) const {
        window.show();
        window.openFile(folder_->filePath("home.trap").toStdString());
        return QTest::qWaitFor([&] { return window.desk().session() != nullptr; }, kPatience);
    }
    static QDialog* ask(window::MainWindow& window) {
        window.showPage("evolve");
        auto* button = find<QToolButton>(window, "evolve.cluster");
        if (button->isVisible()) {
            QTest::mouseClick(button, Qt::LeftButton);
        } else {
            action(window, "run.cluster")->trigger();
        }
        return window.findChild<QDialog*>("cluster");
    }
    static void click(QDialog* dialog, const char* name) {
        QVERIFY(dialog != nullptr);
        QTest::mouseClick(dialog->findChild<QPushButton*>(name), Qt::LeftButton);
    }
    static QAction* action(window::MainWindow& window, const char* name) {
        return window.findChild<QAction*>(name);
    }
    template <class Widget>
    static Widget* find(window::MainWindow& window, const char* name) {
        return window.findChild<Widget*>(name);
    }
    static QString messageOf(window::MainWindow& window) {
        return find<look::MessageBar>(window, "messageBar")->text();
    }

    QTemporaryDir settings_;
    QString path_;
    std::unique_ptr<QTemporaryDir> folder_;
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    ClusterTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "cluster_test.moc"
