#include "core/calibration/drive_setting.h"

#include <QtTest>

using namespace trapwright;
using namespace trapwright::calibration;

namespace {

Calibration strokeAt(double frequency, double full) {
    Calibration calibration;
    calibration.method = Method::conveyingSpeed;
    calibration.frequency = frequency;
    calibration.result = {full, 0.9 * full, 1.1 * full};
    return calibration;
}

}  // namespace

Q_DECLARE_METATYPE(StrokeSource)

class DriveSettingTest : public QObject {
    Q_OBJECT

 private slots:
    void halfStrokeIsOfWhatIsKnownBest_data() {
        QTest::addColumn<double>("measured");      // [mm]; 0: not
        QTest::addColumn<double>("calibratedAt");  // [Hz]; 0: not calibrated
        QTest::addColumn<double>("profile");       // [mm] at full; 0: not known
        QTest::addColumn<double>("setPoint");
        QTest::addColumn<double>("halfStroke");  // [mm]; 0: not known
        QTest::addColumn<StrokeSource>("source");
        QTest::newRow("nothing") << 0.0 << 0.0 << 0.0 << 0.5 << 0.0 << StrokeSource::unknown;
        QTest::newRow("profile") << 0.0 << 0.0 << 1.2 << 0.5 << 0.6 << StrokeSource::profile;
        QTest::newRow("calibrated") << 0.0 << 50.0 << 1.2 << 0.5 << 0.4 << StrokeSource::calibrated;
        QTest::newRow("calibrated nearby") << 0.0 << 50.9 << 0.0 << 0.5 << 0.4 << StrokeSource::calibrated;
        QTest::newRow("elsewhere") << 0.0 << 60.0 << 1.2 << 0.5 << 0.0 << StrokeSource::otherFrequency;
        QTest::newRow("measured") << 0.7 << 60.0 << 1.2 << 0.5 << 0.7 << StrokeSource::measured;
        QTest::newRow("at rest") << 0.0 << 0.0 << 1.2 << 0.0 << 0.0 << StrokeSource::profile;
    }
    void halfStrokeIsOfWhatIsKnownBest() {
        QFETCH(double, measured);
        QFETCH(double, calibratedAt);
        QFETCH(double, profile);
        QFETCH(double, setPoint);
        QFETCH(double, halfStroke);
        QFETCH(StrokeSource, source);
        DriveState state;
        state.setPoint = setPoint;
        state.frequency = 50.0;
        if (measured > 0.0) state.halfStroke = 1e-3 * measured;
        if (profile > 0.0) state.fullHalfStroke = 1e-3 * profile;
        std::vector<Calibration> calibrations;
        if (calibratedAt > 0.0) calibrations = {strokeAt(calibratedAt, 5e-3), strokeAt(calibratedAt, 0.8e-3)};
        const DriveSetting setting = findDriveSetting(state, calibrations);
        QCOMPARE(setting.halfStroke.value_or(0.0), 1e-3 * halfStroke);
        QVERIFY(setting.source == source);
        QCOMPARE(setting.frequency.value_or(0.0), 50.0);
    }

    void moreThanFivePercentIsLarge_data() {
        QTest::addColumn<double>("setPoint");
        QTest::addColumn<double>("frequency");
        QTest::addColumn<bool>("differs");
        QTest::newRow("same") << 0.8 << 50.0 << false;
        QTest::newRow("just") << 0.84 << 52.5 << false;
        QTest::newRow("stroke") << 0.841 << 50.0 << true;
        QTest::newRow("less") << 0.759 << 50.0 << true;
        QTest::newRow("frequency") << 0.8 << 52.6 << true;
        QTest::newRow("frequency is not known") << 0.8 << 0.0 << false;
    }
    void moreThanFivePercentIsLarge() {
        QFETCH(double, setPoint);
        QFETCH(double, frequency);
        QFETCH(bool, differs);
        DriveState state;
        state.setPoint = setPoint;
        state.fullHalfStroke = 1e-3;
        if (frequency > 0.0) state.frequency = frequency;
        const trial::Vibration simulated{50.0, 0.8e-3, 0.2};
        const DriveSetting setting = findDriveSetting(state, {});
        const DriveComparison comparison = compareDrive(setting, simulated);
        QCOMPARE(comparison.differs(), differs);
        QCOMPARE(comparison.frequency.has_value(), frequency > 0.0);
        QCOMPARE(comparison.halfStroke.value().share(), setPoint / 0.8 - 1.0);
        // In proportion, and the answer is the one that agrees.
        QCOMPARE(setting.setPointFor(simulated.halfStroke).value(), 0.8);
    }

    void whatIsNotKnownDoesNotDiffer() {
        DriveState state;
        state.setPoint = 0.5;
        const DriveSetting setting = findDriveSetting(state, {});
        const DriveComparison comparison = compareDrive(setting, {});
        QVERIFY(!comparison.halfStroke && !comparison.frequency && !comparison.differs());
        QVERIFY(!setting.setPointFor(1e-3));
    }
};

QTEST_APPLESS_MAIN(DriveSettingTest)
#include "drive_setting_test.moc"
