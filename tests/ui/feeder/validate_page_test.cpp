#include "ui/feeder/validate_page.h"

#include <QDir>
#include <QProcess>
#include <QTableView>

#include "tests/ui/feeder/operator.h"
#include "tests/ui/scene/scene_samples.h"
#include "ui/feeder/expected_pose.h"
#include "ui/feeder/report_card.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::feeder;

class ValidatePageTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(study_.learn()); }

    // 3 kinds of poses x 20 trials: started, told, taken back, noted, paused and gone on with another day, by
    // keys alone.
    void aWholeValidationOfTheCuboid() {
        Bench bench;
        const QString file = study_.copy();
        {
            Operator user(bench, file);
            QVERIFY(user.reach());
            user.setSetPoint(60);
            user.plan(20, true);
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
        QCOMPARE(ofPose, (std::vector<int>{20, 0, 20, 0, 20, 0}));  // opposite faces look the same
        checkTable(user);
        checkReport(user);
    }

    // With the keyboard alone: what follows the set-point is the first trial.
    void theKeysBelongToTheTrialsAfterASetPoint() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(user.reach());
        user.plan(1, false);
        auto* setPoint = user.find<QDoubleSpinBox>("feeder.setPoint");
        setPoint->setFocus();
        setPoint->selectAll();
        QTest::keyClicks(setPoint, "60");
        user.press(Qt::Key_Return);
        user.press(Qt::Key_Space);
        QCOMPARE(user.guide().stage(), Stage::running);
        QVERIFY(bench.moves());
        user.press(Qt::Key_S);
        QCOMPARE(user.trials().size(), std::size_t(1));
        QCOMPARE(user.trials().front().setPoint, 0.6);
    }

    void theSceneShowsHowToPlaceThePart() {
        Bench bench;
        Operator user(bench, study_.copy());
        user.plan(2, false);
        const auto& scene = user.find<scene::SceneView>("scene")->contents();
        QTRY_VERIFY_WITH_TIMEOUT(scene.track != nullptr && scene.parts.size() == 1, kPatience);
        const base::Pose first = scene.parts.front().pose;
        // At the start, lying: the pose's own up stays up.
        QVERIFY((scene.track->shape.toTrack(first.position, 0.0).x() - scene.track->start) < 1e-9);
        const base::Quaternion lying = user.session()->design().part()->stablePoses.front().rotation;
        const base::Vec3 up = (first.rotation * lying.conjugate()) * base::Vec3::UnitZ();
        QVERIFY(up.z() > 1.0 - 1e-9);
        user.press(Qt::Key_Space);
        user.press(Qt::Key_S);
        QTRY_VERIFY(!(scene.parts.front().pose.rotation.coeffs() == first.rotation.coeffs()));
        QCOMPARE(user.trials().size(), std::size_t(1));
        // Without a drive here nothing is known of it.
        QCOMPARE(user.trials().front().setPoint, 0.0);
    }

    // Whoever judges sees what right looks like: large, and beside the buttons.
    void theTrialCardShowsWhatSuccessLooksLike() {
        Bench bench;
        Operator user(bench, study_.copy());
        auto& card = *user.find<ExpectedPose>("guide.expected");
        user.plan(2, false);
        QTRY_VERIFY_WITH_TIMEOUT(card.shown().track != nullptr, kPatience);
        // Nothing is made up.
        QVERIFY(!card.shown().known());
        QVERIFY(user.text("guide.expected.text").contains("validated in simulation"));
        user.session()->runs().startValidation(*user.session()->runs().chosen());
        QTRY_VERIFY_WITH_TIMEOUT(!card.picture().isNull(), kPatience);
        const study::ValidationRecord& simulated = user.session()->runs().validations().back();
        QVERIFY(*card.shown().goal == simulated.goal);
        QVERIFY2(card.picture().deviceIndependentSize().width() >= 200 &&
                     card.picture().deviceIndependentSize().height() >= 96,
                 qPrintable(QString("%1 x %2").arg(card.picture().width()).arg(card.picture().height())));
        // The cuboid's group is D2.
        QVERIFY(user.text("guide.expected.text").contains("same in 4 orientations"));
        QVERIFY(samples::shareOfHue(card.picture(), scene::SceneTheme::light().part) > 0.05 ||
                samples::shareOfHue(card.picture(), scene::SceneTheme::dark().part) > 0.05);
        QTRY_VERIFY_WITH_TIMEOUT(!user.find<ExpectedPose>("plan.expected")->picture().isNull(), kPatience);
    }

    void aDriveThatDiffersFromTheStudyIsTold() {
        Bench bench;
        Operator user(bench, study_.copy());
        QCOMPARE(user.session()->design().settings().simulation.drive.halfStroke, 0.8e-3);
        QVERIFY(user.reach());
        const auto* warning = user.find<QFrame>("feeder.match.warning");
        user.setSetPoint(82);
        QVERIFY(warning->isHidden());
        user.setSetPoint(60);
        QVERIFY(!warning->isHidden());
        const QString text = user.text("feeder.match.text").simplified();
        QVERIFY2(text.contains("0.60 mm") && text.contains("0.80 mm") && text.contains("25 % less"),
                 qPrintable(text));
        QCOMPARE(user.text("feeder.match.halfStroke.difference"), QString("−25 %"));
        // Dismissed, it is away until something is another; and nothing is ever blocked.
        user.find<QPushButton>("feeder.match.dismiss")->click();
        QVERIFY(warning->isHidden());
        QVERIFY(user.find<QPushButton>("feeder.start")->isEnabled());
        user.setSetPoint(61);
        QVERIFY(!warning->isHidden());
        user.find<QPushButton>("feeder.match.set")->click();
        QCOMPARE(user.page().link().target(), 0.8);
        QVERIFY(warning->isHidden());
    }

    void virtualAndRealTrialsAreNotMixed() {
        Bench bench;
        Operator user(bench, study_.copy());
        user.plan(2, false);
        user.press(Qt::Key_Space);
        user.press(Qt::Key_S);
        QCOMPARE(user.trials().size(), std::size_t(1));
        QVERIFY(user.trials().back().feeder == study::FeederKind::unconnected);
        QVERIFY(user.reach());
        user.setSetPoint(60);
        user.press(Qt::Key_Space);
        QCOMPARE(user.guide().stage(), Stage::placing);
        QVERIFY2(user.text("guide.trouble").contains("Plan another one"),
                 qPrintable(user.text("guide.trouble")));
        QVERIFY(bench.feeder->isAtRest());
        user.plan(2, false);
        user.press(Qt::Key_Space);
        user.press(Qt::Key_S);
        QCOMPARE(user.trials().size(), std::size_t(1));
        QVERIFY(user.trials().back().feeder == study::FeederKind::virtualFeeder);
        QCOMPARE(user.trials().back().drive, std::string("Virtual feeder over Modbus TCP"));
        QVERIFY(user.trials().back().halfStroke > 0.0);
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
            QCOMPARE(user.session()->design().settings().feeder.highestSetPoint, 0.4);
            QVERIFY(user.reach());
            user.setSetPoint(90);
            QCOMPARE(user.page().link().target(), 0.4);
            user.click("feeder.start");
            QVERIFY(QTest::qWaitFor([&] { return bench.feeder->command().setPoint > 0.39; }, kPatience));
            QTest::qWait(500);
            QCOMPARE(bench.feeder->command().setPoint, 0.4);
        }
        Operator user(bench, file);
        QCOMPARE(user.session()->design().settings().feeder.highestSetPoint, 0.4);
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
        QTRY_VERIFY_WITH_TIMEOUT((log = user.session()->feeder().loadDriveLog(0.0, 1e12).value(),
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
        QCOMPARE(model.rowCount(), 5);
        // The totals are in sight, below the others.
        const auto* totals = user.find<QTableView>("validate.results.totals");
        QVERIFY(totals->isVisible() &&
                totals->visualRect(model.index(4, 0)).bottom() <= totals->viewport()->height());
        QVERIFY(view->isRowHidden(4) && totals->isRowHidden(0) && !totals->isRowHidden(3));
        int failures = 0;
        for (const study::PhysicalTrial& trial : user.trials())
            failures += trial.outcome == trial::Verdict::success ? 0 : 1;
        QCOMPARE(model.index(4, PhysicalModel::Trials).data().toInt(), 60);
        QCOMPARE(model.index(4, PhysicalModel::Planned).data().toInt(), 60);
        QCOMPARE(model.index(4, PhysicalModel::Failures).data().toInt(), failures);
    }

    void checkReport(Operator& user) {
        const QString pdf = study_.file("report.pdf");
        user.window.findChild<ReportCard*>()->write(pdf.toStdString());
        QVERIFY(QFile::exists(pdf));
        QProcess reader;
        reader.start("pdftotext", {"-layout", pdf, "-"});
        QVERIFY2(reader.waitForFinished() && reader.exitCode() == 0, "pdftotext of poppler-utils is needed");
        const QString text = QString::fromUtf8(reader.readAllStandardOutput());
        // Lines are broken anywhere.
        const QString flowing = text.simplified();
        for (const char* told : {"Training with the virtual feeder: cuboid", "no real part moved",
                                 "Grace Hopper", "PA12, as printed", "60.0 %", "S3 stayed u",
                                 "trapwright test", "Virtual feeder over Modbus TCP", "Drive and simulation",
                                 "0.60 mm; the study simulated 0.80 mm (25 % less)", "Released by"})
            QVERIFY2(flowing.contains(told), qPrintable(QString("%1 in: %2").arg(told, flowing)));
        QVERIFY(!text.contains("real feeder:"));
        // A page alone tells it as well.
        const QStringList pages = text.split('\f', Qt::SkipEmptyParts);
        QVERIFY(pages.size() > 1);
        for (int i = 0; i < pages.size(); ++i) {
            QVERIFY2(pages[i].contains("VIRTUAL FEEDER"), qPrintable(pages[i]));
            QVERIFY2(pages[i].contains(QString("Page %1 of %2").arg(i + 1).arg(pages.size())),
                     qPrintable(pages[i]));
        }
        QFile trials(study_.file("report-trials.csv"));
        QVERIFY(trials.open(QIODevice::ReadOnly));
        const QByteArray lines = trials.readAll();
        QCOMPARE(lines.count('\n'), 61);
        QCOMPARE(lines.count(",virtual,"), 60);
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
