#include "core/trial/predicted_speed.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace trapwright;

namespace {

constexpr double kGravity = base::kStandardGravity;

/// The same by many small implicit steps: the point is pulled to the plane's speed by no more than friction
/// can. Started far from the periodic motion, measured over the last of many periods.
double stepStickSlip(const trial::Vibration& drive, double friction, double start, double slope) {
    constexpr int kPeriods = 300;
    constexpr int kSteps = 40000;  // per period
    const double h = drive.period() / kSteps;
    const double w = drive.angularFrequency();
    const double along = drive.halfStroke * std::cos(drive.angle);
    const double up = drive.halfStroke * std::sin(drive.angle);
    std::vector<double> plane;
    std::vector<double> most;  // change of speed by friction
    for (int i = 0; i < kSteps; ++i) {
        plane.push_back(along * w * std::cos(w * h * (i + 1)));
        most.push_back(friction * (kGravity * std::cos(slope) - up * w * w * std::sin(w * h * (i + 0.5))) *
                       h);
    }
    const double back = kGravity * std::sin(slope) * h;
    double v = start;
    double last = 0.0;
    for (int p = 0; p < kPeriods; ++p) {
        last = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            v -= back;
            v += std::clamp(plane[i] - v, -most[i], most[i]);
            last += v * h;
        }
    }
    return last / drive.period();
}

trial::Vibration makeDrive(double halfStroke, double degrees) {
    trial::Vibration drive;
    drive.halfStroke = halfStroke;
    drive.angle = degrees * base::kDegree;
    return drive;
}

}  // namespace

class StickSlipTest : public QObject {
    Q_OBJECT

 private slots:
    void agreesWithSmallSteps_data() {
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("degrees");
        QTest::addColumn<double>("friction");
        QTest::addColumn<double>("slope");
        QTest::newRow("0.25 mm, 12 deg, 0.3") << 0.25e-3 << 12.0 << 0.3 << 0.0;
        QTest::newRow("0.35 mm, 12 deg, 0.5") << 0.35e-3 << 12.0 << 0.5 << 0.0;
        QTest::newRow("0.47 mm, 12 deg, 0.5") << 0.47e-3 << 12.0 << 0.5 << 0.0;
        QTest::newRow("0.15 mm, 35 deg, 0.8") << 0.15e-3 << 35.0 << 0.8 << 0.0;
        QTest::newRow("slides always: 0.45 mm, 10 deg, 0.05") << 0.45e-3 << 10.0 << 0.05 << 0.0;
        QTest::newRow("climbs by 3 deg: 0.35 mm, 12 deg, 0.5") << 0.35e-3 << 12.0 << 0.5 << 3.0;
        QTest::newRow("falls by 3 deg: 0.25 mm, 12 deg, 0.3") << 0.25e-3 << 12.0 << 0.3 << -3.0;
        QTest::newRow("falls by 10 deg: 0.15 mm, 30 deg, 0.4") << 0.15e-3 << 30.0 << 0.4 << -10.0;
    }
    void agreesWithSmallSteps() {
        QFETCH(double, halfStroke);
        QFETCH(double, degrees);
        QFETCH(double, friction);
        QFETCH(double, slope);
        const trial::Vibration drive = makeDrive(halfStroke, degrees);
        const double got = trial::calcStickSlipSpeed(drive, friction, kGravity, slope * base::kDegree);
        QVERIFY(got > 1e-3);
        for (const double start : {-0.05, 0.2}) {
            const double expected = stepStickSlip(drive, friction, start, slope * base::kDegree);
            // A step more or less before the slip turns shifts the mean by the last term.
            QVERIFY2(std::abs(got - expected) < 1e-3 * got + 2e-5,
                     qPrintable(QString("%1 instead of %2 m/s").arg(got).arg(expected)));
        }
    }

    // The plane's acceleration a = A w^2 sin(wt) asks for friction A cos w^2 <= mu (g - A sin w^2) at worst.
    // While that holds, what sticks goes on sticking and gets nowhere; past it, it moves.
    void nothingMovesBelowTheSlipLimit_data() {
        QTest::addColumn<double>("friction");
        for (const double friction : {0.1, 0.3, 0.5, 1.0})
            QTest::addRow("friction %g", friction) << friction;
    }
    void nothingMovesBelowTheSlipLimit() {
        QFETCH(double, friction);
        const double w = trial::Vibration{}.angularFrequency();
        const double angle = 12.0 * base::kDegree;
        const double limit = friction * kGravity / (w * w * (std::cos(angle) + friction * std::sin(angle)));
        const auto speed = [&](double halfStroke) {
            return trial::calcStickSlipSpeed(makeDrive(halfStroke, 12.0), friction, kGravity);
        };
        QVERIFY(std::abs(speed(0.5 * limit)) < 1e-9);
        QVERIFY(std::abs(speed(0.999 * limit)) < 1e-9);
        QVERIFY(speed(1.05 * limit) > 1e-6);
    }

    // Without a vertical part neither direction is better.
    void aHorizontalVibrationConveysNowhere() {
        for (const double halfStroke : {0.1e-3, 0.5e-3, 1.0e-3})
            QVERIFY(std::abs(trial::calcStickSlipSpeed(makeDrive(halfStroke, 0.0), 0.4, kGravity)) < 2e-4);
    }

    void theOppositeAngleConveysBackward() {
        const double forward = trial::calcStickSlipSpeed(makeDrive(0.4e-3, 12.0), 0.5, kGravity);
        const double backward = trial::calcStickSlipSpeed(makeDrive(0.4e-3, 168.0), 0.5, kGravity);
        QVERIFY(forward > 0.01);
        QVERIFY(std::abs(forward + backward) < 1e-3 * forward);
    }

    // At the same accelerations in half the period speeds are half as large.
    void speedScalesWithThePeriod() {
        trial::Vibration slow = makeDrive(0.4e-3, 12.0);
        trial::Vibration quick = makeDrive(0.1e-3, 12.0);
        quick.frequency = 2.0 * slow.frequency;
        const double ratio =
            trial::calcStickSlipSpeed(slow, 0.5, kGravity) / trial::calcStickSlipSpeed(quick, 0.5, kGravity);
        QVERIFY(std::abs(ratio - 2.0) < 1e-6);
    }
};

QTEST_APPLESS_MAIN(StickSlipTest)
#include "stick_slip_test.moc"
