#include <QMessageBox>
#include <QTreeWidget>
#include <optional>

#include "tests/ui/feeder/operator.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"

using namespace trapwright;
using namespace trapwright::feeder;

class CalibrateTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QVERIFY(study_.learn()); }

    // tan 20 deg = 0.36397.
    void aTiltTestSetsTheFriction() {
        Bench bench;
        const QString file = study_.file("fresh.trap");
        {
            auto made = session::StudySession::create(file.toStdString(), pages::lowHills(),
                                                      session::cuboid(), pages::nativeEnvironment());
            QVERIFY(made.ok());
        }
        Operator user(bench, file);
        read(user, 0, {{20.0}, {20.0}, {20.0}});
        QVERIFY(user.text("calibrate.result").startsWith("Static friction: 0.364"));
        const study::Settings before = user.session()->design().settings();
        user.click("calibrate.keep");
        QVERIFY(user.session()->design().settings() == before);
        QCOMPARE(user.session()->feeder().calibrations().size(), std::size_t(1));
        QVERIFY(user.text("calibrate.changes").contains("0.364"));
        user.click("calibrate.apply");
        QVERIFY(std::abs(user.session()->design().settings().simulation.contact.staticFriction - 0.36397) <
                1e-5);
        user.find<QAction>("edit.undo")->trigger();
        QVERIFY(user.session()->design().settings() == before);
    }

    void aStudyWithScoresIsForked() {
        Bench bench;
        Operator user(bench, study_.copy());
        read(user, 2, {{100.0, 25.0}, {100.0, 25.0}});
        QVERIFY(user.text("calibrate.result").startsWith("Restitution: 0.5"));
        user.click("calibrate.keep");
        auto* apply = user.find<QPushButton>("calibrate.apply");
        QCOMPARE(apply->text(), QString("Apply in a new study"));
        const auto path = user.session()->path();
        QTest::mouseClick(apply, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(user.session() != nullptr && user.session()->path() != path, kPatience);
        QVERIFY(user.session()->runs().summaries().empty());
        QTRY_COMPARE(user.session()->design().settings().simulation.contact.restitution, 0.5);
        // Readings that agree leave what a gauge is wrong by itself.
        QCOMPARE(user.session()->design().settings().box.restitution, 0.02);
    }

    // Speeds of a feeder whose half-stroke is 0.9 mm at full set-point, by the study's own simulation.
    void conveyingSpeedsGiveTheHalfStroke() {
        Bench bench;
        Operator user(bench, study_.copy());
        std::optional<calibration::SpeedTable> table;
        connect(&user.session()->feeder(), &session::StudyFeeder::speedTableReady, this,
                [&](const calibration::SpeedTable& ready) { table = ready; });
        user.find<QComboBox>("calibrate.method")->setCurrentIndex(4);
        QTRY_VERIFY_WITH_TIMEOUT(table.has_value(), kPatience);
        std::vector<std::vector<double>> readings;
        for (const double setPoint : {0.5, 0.65, 0.8}) {
            const double speed = speedAt(*table, 0.9e-3 * setPoint);
            for (int repetition = 0; repetition < 2; ++repetition)
                readings.push_back({100.0 * setPoint, 1e3 * 20.0 * speed, 20.0});
        }
        read(user, 4, readings);
        QVERIFY2(user.text("calibrate.result").startsWith("Half-stroke at full set-point: 0.9"),
                 qPrintable(user.text("calibrate.result") + user.text("calibrate.detail")));
        user.click("calibrate.keep");
        QCOMPARE(user.session()->feeder().calibrations().size(), std::size_t(1));
        QVERIFY(std::abs(user.session()->feeder().calibrations().front().result.value - 0.9e-3) < 0.005e-3);
    }

    void aReadingIsRemoved() {
        Bench bench;
        Operator user(bench, study_.copy());
        read(user, 1, {{20.0}, {25.0}});
        QCOMPARE(user.find<QTreeWidget>("calibrate.readings")->topLevelItemCount(), 2);
        user.find<QPushButton>("calibrate.remove")->click();
        QCOMPARE(user.find<QTreeWidget>("calibrate.readings")->topLevelItemCount(), 1);
        QVERIFY(!user.find<QPushButton>("calibrate.keep")->isEnabled());
    }

 private:
    /// Between the rows of a table in which speeds rise. [m/s]
    static double speedAt(const calibration::SpeedTable& table, double halfStroke) {
        for (std::size_t i = 1; i < table.halfStrokes.size(); ++i) {
            if (table.halfStrokes[i] < halfStroke) continue;
            const double share =
                (halfStroke - table.halfStrokes[i - 1]) / (table.halfStrokes[i] - table.halfStrokes[i - 1]);
            return table.speeds[i - 1] + share * (table.speeds[i] - table.speeds[i - 1]);
        }
        return 0.0;
    }

    static void read(Operator& user, int method, const std::vector<std::vector<double>>& readings) {
        user.find<QWidget>("dock.validate.calibrate")->raise();
        user.find<QComboBox>("calibrate.method")->setCurrentIndex(method);
        for (const std::vector<double>& reading : readings) {
            for (std::size_t i = 0; i < reading.size(); ++i)
                user.find<QDoubleSpinBox>(QString("calibrate.field.%1").arg(i + 1))->setValue(reading[i]);
            user.find<QPushButton>("calibrate.add")->click();
        }
    }

    pages::LearnedStudy study_{"calibrate_test"};
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    CalibrateTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "calibrate_test.moc"
