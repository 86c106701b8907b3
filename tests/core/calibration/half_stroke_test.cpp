#include "core/calibration/half_stroke.h"

#include <QtTest>
#include <cmath>
#include <vector>

#include "core/trial/predicted_speed.h"

using namespace trapwright;
using calibration::SpeedTable;
using calibration::TimedRun;

namespace {

/// Stands up to 0.2 mm, then 100 mm/s for each further millimetre.
SpeedTable straightTable() {
    return {{0.2e-3, 0.6e-3, 1.2e-3}, {0.0, 0.04, 0.10}};
}

/// Two readings around the speed at which this half-stroke conveys by the table above.
void addReadings(std::vector<TimedRun>& readings, double setPoint, double halfStroke) {
    const double speed = 100.0 * (halfStroke - 0.2e-3);
    for (const double deviation : {-0.01, 0.01})
        readings.push_back({setPoint, 0.2, 0.2 / (speed * (1.0 + deviation))});
}

QString messageOf(const base::Result<calibration::StrokeEstimate>& result) {
    return QString::fromStdString(result.ok() ? std::string("(no error)") : result.error().message);
}

}  // namespace

class HalfStrokeTest : public QObject {
    Q_OBJECT

 private slots:
    void invertsBetweenTheRows() {
        const SpeedTable table = straightTable();
        for (const double halfStroke : {0.2e-3, 0.3e-3, 0.6e-3, 0.77e-3, 1.2e-3}) {
            const auto found = calibration::findHalfStroke(table, 100.0 * (halfStroke - 0.2e-3));
            QVERIFY(found.ok());
            QVERIFY(std::abs(*found - halfStroke) < 1e-12);
        }
        QVERIFY(!calibration::findHalfStroke(table, -0.01).ok());
        QVERIFY(!calibration::findHalfStroke(table, 0.11).ok());
        QVERIFY(!calibration::findHalfStroke({}, 0.0).ok());
    }

    void onlyTheRisingPartIsInverted() {
        const SpeedTable whole = {{1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 7e-4, 8e-4},
                                  {0.0, 0.0, 0.01, 0.03, 0.0295, 0.05, 0.03, 0.08}};
        const SpeedTable rising = calibration::risingPart(whole);
        QCOMPARE(rising.halfStrokes, (std::vector<double>{2e-4, 3e-4, 4e-4, 6e-4}));
        QCOMPARE(rising.speeds, (std::vector<double>{0.0, 0.01, 0.03, 0.05}));
    }

    void proportionalDriveIsFound() {
        std::vector<TimedRun> readings;
        addReadings(readings, 0.9, 0.9e-3);  // in any order
        addReadings(readings, 0.5, 0.5e-3);
        addReadings(readings, 0.7, 0.7e-3);
        const auto estimate = calibration::estimateHalfStroke(readings, straightTable());
        QVERIFY2(estimate.ok(), qPrintable(messageOf(estimate)));
        QCOMPARE(estimate->setPoints.size(), std::size_t{3});
        QCOMPARE(estimate->setPoints.front().setPoint, 0.5);
        QCOMPARE(estimate->setPoints.front().readings, 2);
        for (const calibration::SetPointStroke& one : estimate->setPoints) {
            QVERIFY(std::abs(one.halfStroke.value - one.setPoint * 1e-3) < 1e-6);
            QVERIFY(one.halfStroke.low < one.halfStroke.value && one.halfStroke.value < one.halfStroke.high);
            QVERIFY(one.speed.low < one.speed.value && one.speed.value < one.speed.high);
        }
        QVERIFY(std::abs(estimate->fullHalfStroke.value - 1e-3) < 1e-6);
        QVERIFY(estimate->fullHalfStroke.high - estimate->fullHalfStroke.low < 1e-5);
    }

    void driveOutOfProportionShowsUp() {
        std::vector<TimedRun> readings;
        addReadings(readings, 0.4, 0.6e-3);
        addReadings(readings, 0.6, 0.7e-3);
        addReadings(readings, 0.8, 0.8e-3);
        const auto estimate = calibration::estimateHalfStroke(readings, straightTable());
        QVERIFY(estimate.ok());
        QVERIFY(estimate->fullHalfStroke.high - estimate->fullHalfStroke.low > 0.5e-3);
    }

    void saysWhatIsMissing() {
        std::vector<TimedRun> readings;
        addReadings(readings, 0.5, 0.5e-3);
        addReadings(readings, 0.7, 0.7e-3);
        QVERIFY(
            messageOf(calibration::estimateHalfStroke(readings, straightTable())).contains("three or more"));
        readings.push_back({0.9, 0.2, 2.0});
        QVERIFY(
            messageOf(calibration::estimateHalfStroke(readings, straightTable())).contains("one reading"));
        readings.push_back({0.9, 0.2, 0.1});  // 1 m/s on the mean
        const QString fast = messageOf(calibration::estimateHalfStroke(readings, straightTable()));
        QVERIFY2(fast.contains("Set-point 90 %") && fast.contains("outside"), qPrintable(fast));
        readings.push_back({1.2, 0.2, 0.1});
        QVERIFY(messageOf(calibration::estimateHalfStroke(readings, straightTable())).contains("Reading 7"));
    }

    // What is predicted for a half-stroke gives that half-stroke back.
    void predictionIsInverted() {
        const trial::Vibration drive;
        const trial::ContactParameters contact{0.4, 0.4, 0.0};
        SpeedTable predicted;
        for (int row = 1; row <= 32; ++row) {
            trial::Vibration one = drive;
            one.halfStroke = 0.05e-3 * row;
            predicted.halfStrokes.push_back(one.halfStroke);
            predicted.speeds.push_back(trial::predictConveying(one, contact, base::kStandardGravity).speed);
        }
        const SpeedTable table = calibration::risingPart(predicted);
        QVERIFY(table.speeds.size() >= 8);
        QVERIFY(table.halfStrokes.back() > 0.7e-3);
        for (const double halfStroke : {0.25e-3, 0.4e-3, 0.6e-3}) {
            trial::Vibration one;
            one.halfStroke = halfStroke;
            const double speed = trial::predictConveying(one, contact, base::kStandardGravity).speed;
            const auto found = calibration::findHalfStroke(table, speed);
            QVERIFY(found.ok());
            QVERIFY2(std::abs(*found / halfStroke - 1.0) < 0.03, qPrintable(QString::number(*found * 1e3)));
        }
    }
};

QTEST_APPLESS_MAIN(HalfStrokeTest)
#include "half_stroke_test.moc"
