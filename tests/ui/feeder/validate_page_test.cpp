#include "ui/feeder/validate_page.h"

#include <QDir>
#include <QProcess>
#include <QTableView>

#include "tests/ui/feeder/operator.h"
#include "ui/feeder/report_card.h"

using namespace trapwright;
using namespace trapwright::feeder;

class ValidatePageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(study_.learn()); }

    // 6 poses x 10 trials: started, told, taken back, noted, paused and gone on with another day, by keys
    // alone.
    void aWholeValidationOfTheCuboid() {
        Bench bench;
        const QString file = study_.copy();
        {
            Operator user(bench, file);
            QVERIFY(user.reach());
            user.setSetPoint(60);
            user.plan(10, true);
            QCOMPARE(user.guide().total(), 60);
            QVERIFY(user.text("guide.sentence").startsWith("Trial 1 of 60. Place the part like this: pose "));
            QVERIFY(bench.feeder->isAtRest());

            user.press(Qt::Key_Space);
            QVERIFY(bench.moves());
            user.press(Qt::Key_S);
            QCOMPARE(user.trials().size(), std::size_t(1));
            QCOMPARE(user.trials().front().setPoint, 0.6);
            QVERIFY(user.trials().front().seconds > 0.0);

            makeTrials(user, 20);
            user.press(Qt::Key_Space);
            user.press(Qt::Key_3);
            user.press(Qt::Key_U);
            QCOMPARE(user.trials().size(), std::size_t(20));
            user.press(Qt::Key_N);
            QTest::keyClicks(user.find<QLineEdit>("guide.note"), "S3 stayed u");
            QCOMPARE(user.trials().size(), std::size_t(20));
            QTest::keyClick(user.find<QLineEdit>("guide.note"), Qt::Key_Return);
            QCOMPARE(user.trials().back().note, std::string("S3 stayed u"));

            user.press(Qt::Key_P);
            QVERIFY(bench.rests());
            QVERIFY(user.text("guide.sentence").startsWith("Paused."));
            QTRY_COMPARE_WITH_TIMEOUT(user.page().link().snapshot().state, drive::State::idle, kPatience);
            user.press(Qt::Key_Space);
            QVERIFY(bench.moves());
            user.press(Qt::Key_2);
            QCOMPARE(user.trials().size(), std::size_t(21));
        }
        QVERIFY(bench.rests());

        Operator user(bench, file);
        QCOMPARE(user.trials().size(), std::size_t(21));
        QCOMPARE(user.trials()[19].note, std::string("S3 stayed u"));
        QCOMPARE(user.guide().stage(), Stage::paused);
        QVERIFY(user.reach());
        user.setSetPoint(60);
        makeTrials(user, 60);
        QCOMPARE(user.text("guide.sentence"), QString("All 60 trials are done."));
        QVERIFY(bench.rests());
        std::vector<int> ofPose(6, 0);
        for (const study::PhysicalTrial& trial : user.trials())
            ++ofPose[static_cast<std::size_t>(trial.pose)];
        QCOMPARE(ofPose, std::vector<int>(6, 10));
        checkTable(user);
        checkReport(user);
    }

    void theSceneShowsHowToPlaceThePart() {
        Bench bench;
        Operator user(bench, study_.copy());
        user.plan(2, false);
        const auto& scene = user.find<scene::SceneView>("scene")->contents();
        QTRY_VERIFY_WITH_TIMEOUT(scene.track != nullptr && scene.partPoses.size() == 1, kPatience);
        const base::Pose first = scene.partPoses.front();
        // At the start, lying: the pose's own up stays up.
        QVERIFY((scene.track->shape.toTrack(first.position, 0.0).x() - scene.track->start) < 1e-9);
        const base::Quaternion lying = user.session()->part()->stablePoses.front().rotation;
        const base::Vec3 up = (first.rotation * lying.conjugate()) * base::Vec3::UnitZ();
        QVERIFY(up.z() > 1.0 - 1e-9);
        user.press(Qt::Key_Space);
        user.press(Qt::Key_S);
        QTRY_VERIFY(!(scene.partPoses.front().rotation.coeffs() == first.rotation.coeffs()));
        QCOMPARE(user.trials().size(), std::size_t(1));
        // Without a drive here nothing is known of it.
        QCOMPARE(user.trials().front().setPoint, 0.0);
    }

    void theScenesDigitsAreBackOnOtherPages() {
        Bench bench;
        Operator user(bench, study_.copy());
        const auto shortcuts = [&] {
            QStringList keys;
            for (const QAction* action : user.find<scene::SceneView>("scene")->viewActions())
                keys << action->shortcut().toString();
            return keys;
        };
        QVERIFY(!shortcuts().contains("1"));
        user.window.showPage("part");
        QVERIFY(shortcuts().contains("1") && shortcuts().contains("2") && shortcuts().contains("3"));
    }

    void theLimitOfTheStudyHolds() {
        Bench bench;
        const QString file = study_.copy();
        {
            Operator user(bench, file);
            user.find<QDoubleSpinBox>("feeder.highest")->setValue(40);
            QCOMPARE(user.session()->settings().feeder.highestSetPoint, 0.4);
            QVERIFY(user.reach());
            user.setSetPoint(90);
            QCOMPARE(user.page().link().target(), 0.4);
            user.click("feeder.start");
            QVERIFY(QTest::qWaitFor([&] { return bench.feeder->command().setPoint > 0.39; }, kPatience));
            QTest::qWait(500);
            QCOMPARE(bench.feeder->command().setPoint, 0.4);
        }
        Operator user(bench, file);
        QCOMPARE(user.session()->settings().feeder.highestSetPoint, 0.4);
    }

    void theLogIsInTheStudy() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(user.reach());
        user.setSetPoint(30);
        user.click("feeder.start");
        // The ramp of 50 %/s takes several heartbeats.
        QTRY_COMPARE_WITH_TIMEOUT(user.page().link().snapshot().state, drive::State::running, kPatience);
        user.click("feeder.stop.button");
        QVERIFY(bench.rests());
        user.click("feeder.connect");
        std::vector<drive::LogEntry> log;
        QTRY_VERIFY_WITH_TIMEOUT((log = user.session()->loadDriveLog(0.0, 1e12).value(),
                                  std::any_of(log.begin(), log.end(),
                                              [](const drive::LogEntry& entry) {
                                                  return entry.kind == drive::LogKind::disconnected;
                                              })),
                                 kPatience);
        int commands = 0;
        int readings = 0;
        for (const drive::LogEntry& entry : log) {
            commands += entry.kind == drive::LogKind::command ? 1 : 0;
            readings += entry.kind == drive::LogKind::reading ? 1 : 0;
        }
        QVERIFY(commands > 3 && readings > 3);
    }

 private:
    static void makeTrials(Operator& user, std::size_t until) {
        const Qt::Key outcomes[] = {Qt::Key_S, Qt::Key_S, Qt::Key_S, Qt::Key_1, Qt::Key_S,
                                    Qt::Key_S, Qt::Key_2, Qt::Key_S, Qt::Key_S, Qt::Key_3};
        while (user.trials().size() < until) {
            const std::size_t before = user.trials().size();
            user.press(Qt::Key_Space);
            QCOMPARE(user.guide().stage(), Stage::running);
            user.press(outcomes[before % std::size(outcomes)]);
            QCOMPARE(user.trials().size(), before + 1);
        }
    }

    static void checkTable(Operator& user) {
        const auto* view = user.find<QTableView>("validate.results.table");
        const QAbstractItemModel& model = *view->model();
        QCOMPARE(model.rowCount(), 7);
        int failures = 0;
        for (const study::PhysicalTrial& trial : user.trials())
            failures += trial.outcome == study::PhysicalOutcome::success ? 0 : 1;
        QCOMPARE(model.index(6, PhysicalModel::Trials).data().toInt(), 60);
        QCOMPARE(model.index(6, PhysicalModel::Planned).data().toInt(), 60);
        QCOMPARE(model.index(6, PhysicalModel::Failures).data().toInt(), failures);
    }

    void checkReport(Operator& user) {
        const QString pdf = study_.file("report.pdf");
        user.window.findChild<ReportCard*>()->write(pdf.toStdString());
        QVERIFY(QFile::exists(pdf));
        QProcess reader;
        reader.start("pdftotext", {"-layout", pdf, "-"});
        QVERIFY2(reader.waitForFinished() && reader.exitCode() == 0, "pdftotext of poppler-utils is needed");
        const QString text = QString::fromUtf8(reader.readAllStandardOutput());
        for (const char* told : {"Validation on the real feeder: cuboid", "Grace Hopper", "PA12, as printed",
                                 "60.0 %", "S3 stayed u", "trapwright test", "Page 1 of"})
            QVERIFY2(text.contains(told), told);
        QFile trials(study_.file("report-trials.csv"));
        QVERIFY(trials.open(QIODevice::ReadOnly));
        QCOMPARE(trials.readAll().count('\n'), 61);
        QVERIFY(QFile::exists(study_.file("report-table.csv")));
        const QString keep = qEnvironmentVariable("TRAPWRIGHT_KEEP");
        if (!keep.isEmpty()) QVERIFY(QFile::copy(pdf, QDir(keep).filePath("report.pdf")));
    }

    pages::LearnedStudy study_{"validate_page_test"};
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    ValidatePageTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "validate_page_test.moc"
