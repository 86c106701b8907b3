#include <QDialog>
#include <QLabel>
#include <QMessageBox>
#include <QTreeWidget>

#include <algorithm>
#include <csignal>

#include "tests/ui/feeder/operator.h"
#include "tests/ui/session/event_loop_probe.h"
#include "ui/session/study_feeder.h"
#include "ui/window/end_signals.h"

using namespace trapwright;
using namespace trapwright::feeder;
using transports::Trouble;

/// However it comes about: the feeder rests.
class StoppingTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(study_.learn()); }

    void escStopsOnThePage() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.press(Qt::Key_Escape);
        QVERIFY(bench.rests());
        QVERIFY(!bench.feeder->command().enable);
    }

    void escStopsInAField() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.find<QDoubleSpinBox>("feeder.setPoint")->setFocus();
        user.press(Qt::Key_Escape);
        QVERIFY(bench.rests());
    }

    void escStopsOnAnotherPage() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.window.showPage("evolve");
        QTest::keyClick(user.find<scene::SceneView>("scene"), Qt::Key_Escape);
        QVERIFY(bench.rests());
    }

    void escStopsInADialog() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.find<QAction>("help.shortcuts")->trigger();
        auto* list = user.find<QTreeWidget>("shortcuts.list");
        QVERIFY(list != nullptr && QTest::qWaitForWindowExposed(list->window()));
        QTest::keyClick(list, Qt::Key_Escape);
        QVERIFY(bench.rests());
    }

    // The other protocol: frames of the REO interface over a pseudo-terminal.
    void escStopsADriveOnASerialLine() {
        Bench bench;
        Operator user(bench, study_.copy());
        auto* profiles = user.find<QComboBox>("feeder.profile");
        const int reo = profiles->findData("virtual-reo");
        QVERIFY(reo >= 0);
        profiles->setCurrentIndex(reo);
        QVERIFY(run(user));
        QTRY_COMPARE_WITH_TIMEOUT(user.page().link().snapshot().state, drive::State::running, kPatience);
        QVERIFY(user.page().link().snapshot().reading.acceleration.value_or(0.0) > 0.0);
        user.press(Qt::Key_Escape);
        QVERIFY(bench.rests());
    }

    void aDriveWithoutAWatchdogIsWarnedOf() {
        Bench bench;
        Operator user(bench, study_.copy());
        auto* profiles = user.find<QComboBox>("feeder.profile");
        for (const auto& [name, warned] : {std::pair("adam-6024", true), std::pair("wago-750", false)}) {
            const int index = profiles->findData(name);
            QVERIFY(index >= 0);
            profiles->setCurrentIndex(index);
            QCOMPARE(user.text("feeder.profile.about").contains("watchdog, and keep a switch"), warned);
        }
    }

    void theRedButtonStops() {
        Bench bench;
        Operator user(bench, study_.copy());
        auto* button = user.find<QPushButton>("feeder.stop.button");
        QCOMPARE(button->text(), QString("Stop (Esc) - this is no emergency stop"));
        QVERIFY(run(user));
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(bench.rests());
    }

    void disconnectingStops() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.click("feeder.connect");
        QVERIFY(bench.rests());
        QTRY_VERIFY(!user.page().link().linked());
    }

    // A drive that moves and does not answer takes its time to be left; the window does not wait for it.
    void disconnectingDoesNotHoldTheWindow() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        QSignalSpy told(&user.page().link(), &DriveLink::failed);
        bench.feeder->setTrouble(Trouble::silent);
        user.page().link().leaveDrive();
        QVERIFY(user.page().link().linked());
        QTRY_VERIFY_WITH_TIMEOUT(!user.page().link().linked(), kPatience);
        // Nobody has heard that it rests.
        QCOMPARE(told.size(), 1);
        QVERIFY(told[0][1].toString().contains("switch it off by hand"));
        QVERIFY(bench.rests());
    }

    void aDriveThatFallsSilentMayStillMove() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        bench.feeder->setTrouble(Trouble::silent);
        auto* state = user.find<QLabel>("feeder.state");
        QTRY_COMPARE_WITH_TIMEOUT(state->text(), QString("May still be moving"), kPatience);
        QVERIFY(user.find<QLabel>("feeder.fault.text")->text().contains("switch it off by hand"));
        // It is told to rest as soon as it hears again, and then nothing is to be warned of.
        bench.feeder->setTrouble(Trouble::none);
        QTRY_COMPARE_WITH_TIMEOUT(state->text(), QString("Stopped by a fault"), kPatience);
        QVERIFY(bench.rests());
    }

    void closingTheStudyStops() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.find<QAction>("file.close")->trigger();
        QTRY_VERIFY(user.session() == nullptr);
        QVERIFY(bench.rests());
        QVERIFY(!bench.feeder->watchdogActed());
    }

    void closingTheWindowStops() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        user.window.close();
        QTRY_VERIFY(!user.window.isVisible());
        QVERIFY(bench.rests());
        // It was told to, and did not have to notice by itself.
        QVERIFY(!bench.feeder->watchdogActed());
        QVERIFY(!user.page().link().linked());
    }

    // However silent the drive, and however often it is asked: the window lives on, says what it waits for,
    // and what is logged of the end is in the study that it belongs to.
    void leavingAStudyDoesNotHoldTheWindow_data() {
        QTest::addColumn<bool>("exchanged");
        QTest::newRow("closed") << false;
        QTest::newRow("exchanged for another") << true;
    }
    void leavingAStudyDoesNotHoldTheWindow() {
        QFETCH(bool, exchanged);
        Bench bench;
        const QString study = study_.copy();
        const QString next = study_.copy();
        Operator user(bench, study);
        QVERIFY(run(user));
        bench.feeder->setTrouble(Trouble::silent);
        const session::StudySession* before = user.session();
        session::LateEvents late;
        late.start();
        if (exchanged) {
            user.window.openFile(next.toStdString());
        } else {
            user.find<QAction>("file.close")->trigger();
        }
        QVERIFY(saysFarewell(user));
        QCOMPARE(user.session(), before);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != before, kPatience);
        QVERIFY(user.find<QDialog>("dialog.farewell") == nullptr);
        QVERIFY(!user.page().link().linked());
        const double worst = late.stop();
        QVERIFY2(worst < kLatest, qPrintable(QString::number(worst)));
        QVERIFY(bench.rests());
        // Nobody has heard that it rests, and that is told beside whatever is open now.
        QPointer<QMessageBox> warning;
        QTRY_VERIFY((warning = user.find<QMessageBox>("dialog.farewell.warning")) != nullptr);
        QVERIFY(warning->isVisible() && warning->informativeText().contains("switch it off by hand"));
        warning->close();

        QVERIFY(user.open(study.toStdString(), "validate"));
        QTRY_COMPARE(QString::fromStdString(user.session()->path().string()), study);
        const auto log = user.session()->feeder().loadDriveLog(0.0, 1e12);
        QVERIFY(log.ok());
        const auto tells = [&](const std::string& text) {
            return std::ranges::any_of(*log, [&](const drive::LogEntry& entry) {
                return entry.text.find(text) != std::string::npos;
            });
        };
        QVERIFY(tells("switch it off by hand"));
        QVERIFY(tells(std::string(drive::nameOf(drive::State::disconnected))));
    }

    void closingDoesNotHoldTheWindow() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(run(user));
        bench.feeder->setTrouble(Trouble::silent);
        session::LateEvents late;
        late.start();
        QElapsedTimer clock;
        clock.start();
        user.window.close();
        QVERIFY(saysFarewell(user));
        // Who is impatient neither cuts it short nor makes it longer.
        user.window.close();
        user.find<QDialog>("dialog.farewell")->close();
        QVERIFY(saysFarewell(user));
        QVERIFY(user.window.isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(!user.window.isVisible(), kPatience);
        QVERIFY(!user.page().link().linked());
        QVERIFY(clock.elapsed() < 1e3 * user.page().link().longestFarewell() + kLatest);
        const double worst = late.stop();
        QVERIFY2(worst < kLatest, qPrintable(QString::number(worst)));
        QVERIFY(bench.rests());
    }

    void aSignalStops() {
        Bench bench;
        Operator user(bench, study_.copy());
        const window::EndSignals ends;
        connect(&ends, &window::EndSignals::asked, &user.window, &window::MainWindow::closeUnasked);
        for (const int signal : {SIGTERM, SIGHUP}) {
            user.window.show();
            QVERIFY(run(user));
            QCOMPARE(::raise(signal), 0);
            QTRY_VERIFY(!user.window.isVisible());
            QVERIFY(bench.rests());
            QVERIFY(!bench.feeder->watchdogActed());
            QVERIFY(!user.page().link().linked());
        }
    }

    // A drive that was connected while the next study was read belongs to the one before.
    void aDriveThatIsConnectedMeanwhileIsLeft() {
        Bench bench;
        Operator user(bench, study_.copy());
        const QString next = study_.copy();
        user.window.openFile(next.toStdString());
        user.click("feeder.connect");
        QVERIFY(user.page().link().linked());
        QTRY_COMPARE_WITH_TIMEOUT(QString::fromStdString(user.session()->path().string()), next, kPatience);
        QVERIFY(!user.page().link().linked());
    }

    void aFaultInMidTrial() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(isInTrial(user));
        bench.feeder->setTrouble(Trouble::fault);
        QTRY_COMPARE_WITH_TIMEOUT(user.guide().stage(), Stage::placing, kPatience);
        QVERIFY(bench.rests());
        QVERIFY(user.trials().empty());
        QVERIFY(user.text("guide.trouble").startsWith("The trial does not count"));
        QVERIFY(user.find<QWidget>("feeder.fault")->isVisible());

        // Nothing moves before the fault is acknowledged.
        bench.feeder->setTrouble(Trouble::none);
        user.press(Qt::Key_Space);
        QCOMPARE(user.guide().stage(), Stage::placing);
        QVERIFY(user.text("guide.trouble").contains("Acknowledge"));
        const auto& link = user.page().link();
        QTRY_VERIFY_WITH_TIMEOUT(
            (user.click("feeder.acknowledge"), link.snapshot().state == drive::State::idle), kPatience);
        QVERIFY(bench.feeder->isAtRest());
        user.press(Qt::Key_Space);
        QVERIFY(bench.moves());
        user.press(Qt::Key_S);
        QCOMPARE(user.trials().size(), std::size_t(1));
    }

    void aCutCableInMidTrial() {
        Bench bench;
        Operator user(bench, study_.copy());
        QVERIFY(isInTrial(user));
        bench.feeder->cut();
        QVERIFY(bench.rests());
        QTRY_COMPARE_WITH_TIMEOUT(user.guide().stage(), Stage::placing, kPatience);
        QVERIFY(user.trials().empty());
    }

 private:
    static constexpr double kLatest = 500.0;  // [ms] of an event on a busy machine; it was 4.3 s

    static bool saysFarewell(Operator& user) {
        return QTest::qWaitFor(
            [&] {
                const auto* dialog = user.find<QDialog>("dialog.farewell");
                return dialog != nullptr && dialog->isVisible() &&
                       user.text("farewell.what") == "The drive is being stopped..." &&
                       !user.text("farewell.state").isEmpty();
            },
            2000);
    }

    static bool run(Operator& user) {
        if (!user.reach()) return false;
        user.setSetPoint(60);
        user.click("feeder.start");
        return user.bench.moves();
    }

    static bool isInTrial(Operator& user) {
        if (!user.reach()) return false;
        user.setSetPoint(60);
        user.plan(2, false);
        user.press(Qt::Key_Space);
        return user.bench.moves();
    }

    pages::LearnedStudy study_{"stopping_test"};
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    StoppingTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "stopping_test.moc"
