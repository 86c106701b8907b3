#include "core/trial/predicted_speed.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

using namespace trapwright;

namespace {

constexpr double kGravity = base::kStandardGravity;

trial::Vibration makeDrive(double halfStroke, double degrees) {
    trial::Vibration drive;
    drive.halfStroke = halfStroke;
    drive.angle = degrees * base::kDegree;
    return drive;
}

/// The plastic case by many small steps: in flight a parabola, on the plane friction at most friction x the
/// plane's push, at a landing at most friction x the speed that it takes away.
double stepPlasticHopping(const trial::Vibration& drive, double friction, int periods, double slope) {
    constexpr int kSteps = 20000;  // per period
    const double h = drive.period() / kSteps;
    const double w = drive.angularFrequency();
    const double along = drive.halfStroke * std::cos(drive.angle);
    const double up = drive.halfStroke * std::sin(drive.angle);
    double z = 0.0;
    double vz = up * w;
    double vx = 0.0;
    double x = 0.0;
    double mark = 0.0;
    for (int p = 0; p < 2 * periods; ++p) {
        if (p == periods) mark = x;
        for (int i = 1; i <= kSteps; ++i) {
            const double planeZ = up * std::sin(w * h * i);
            const double planeVz = up * w * std::cos(w * h * i);
            const double planeVx = along * w * std::cos(w * h * i);
            vz -= kGravity * std::cos(slope) * h;
            vx -= kGravity * std::sin(slope) * h;
            z += vz * h;
            if (z <= planeZ) {
                const double push = std::max(0.0, planeVz - vz);
                z = planeZ;
                vz = std::max(vz, planeVz);
                vx += std::clamp(planeVx - vx, -friction * push, friction * push);
            }
            x += vx * h;
        }
    }
    return (x - mark) / (periods * drive.period());
}

}  // namespace

class HoppingTest : public QObject {
    Q_OBJECT

 private slots:
    // What never lifts off sticks and slips: another solution, told by other events.
    void belowLiftOffItIsStickSlip_data() {
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("friction");
        QTest::addColumn<double>("slope");
        for (const double slope : {0.0, 3.0, -8.0})
            for (const double halfStroke : {0.25e-3, 0.45e-3})
                for (const double friction : {0.3, 0.6})
                    QTest::addRow("%g mm, friction %g, %g deg", halfStroke * 1e3, friction, slope)
                        << halfStroke << friction << slope * base::kDegree;
    }
    void belowLiftOffItIsStickSlip() {
        QFETCH(double, halfStroke);
        QFETCH(double, friction);
        QFETCH(double, slope);
        const trial::Vibration drive = makeDrive(halfStroke, 12.0);
        const double expected = trial::calcStickSlipSpeed(drive, friction, kGravity, slope);
        const double got = trial::calcHoppingSpeed(drive, friction, 0.3, kGravity, 100, slope);
        QVERIFY2(std::abs(got - expected) < 2e-3 * std::abs(expected) + (slope != 0.0 ? 2e-5 : 0.0),
                 qPrintable(QString("%1 instead of %2 m/s").arg(got).arg(expected)));
    }

    void plasticHopsAgreeWithSmallSteps_data() {
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("degrees");
        QTest::addColumn<double>("slope");
        QTest::newRow("just off the plane") << 0.55e-3 << 12.0 << 0.0;
        QTest::newRow("one hop a period") << 0.8e-3 << 12.0 << 0.0;
        QTest::newRow("long hops") << 0.8e-3 << 25.0 << 0.0;
        QTest::newRow("one hop a period, climbs") << 0.8e-3 << 12.0 << 3.0;
        QTest::newRow("one hop a period, falls") << 0.8e-3 << 12.0 << -5.0;
    }
    void plasticHopsAgreeWithSmallSteps() {
        QFETCH(double, halfStroke);
        QFETCH(double, degrees);
        QFETCH(double, slope);
        const trial::Vibration drive = makeDrive(halfStroke, degrees);
        const double expected = stepPlasticHopping(drive, 0.4, 40, slope * base::kDegree);
        const double got = trial::calcHoppingSpeed(drive, 0.4, 0.0, kGravity, 40, slope * base::kDegree);
        QVERIFY(expected > 0.02);
        QVERIFY2(std::abs(got / expected - 1.0) < 0.01,
                 qPrintable(QString("%1 instead of %2 m/s").arg(got).arg(expected)));
    }
};

QTEST_APPLESS_MAIN(HoppingTest)
#include "hopping_test.moc"
