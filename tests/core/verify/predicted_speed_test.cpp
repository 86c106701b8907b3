#include "core/verify/predicted_speed.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;

namespace {

constexpr double kGravity = base::kStandardGravity;

verify::ConveyingPrediction predict(double halfStroke, double friction = 0.5) {
    trial::Vibration drive;
    drive.halfStroke = halfStroke;
    return verify::predictConveying(drive, {friction, friction, 0.0}, kGravity);
}

}  // namespace

class PredictedSpeedTest : public QObject {
    Q_OBJECT

 private slots:
    // decisions.md#drive: 1.0 at a half-stroke of 0.478 mm.
    void partsLiftOffAtThrowNumberOne() {
        QVERIFY(std::abs(predict(0.478e-3).throwNumber - 1.0) < 2e-3);
        QCOMPARE(predict(0.47e-3).conveyance, verify::Conveyance::slides);
        QCOMPARE(predict(0.49e-3).conveyance, verify::Conveyance::hops);
    }

    // The peak acceleration along the plane does not reach friction x gravity.
    void aWeakDriveMovesNothing() {
        const verify::ConveyingPrediction still = predict(0.02e-3);
        QCOMPARE(still.conveyance, verify::Conveyance::sticks);
        QVERIFY(std::abs(still.speed) < 1e-6);
    }

    // No part is conveyed faster than the track moves along itself at its quickest.
    void noPartOvertakesTheTrack() {
        for (const double halfStroke : {0.2e-3, 0.45e-3, 0.8e-3, 1.5e-3}) {
            trial::Vibration drive;
            const double limit = halfStroke * std::cos(drive.angle) * drive.angularFrequency();
            const double speed = predict(halfStroke).speed;
            QVERIFY2(speed > 0.0 && speed < limit, qPrintable(QString::number(speed)));
        }
    }
};

QTEST_APPLESS_MAIN(PredictedSpeedTest)
#include "predicted_speed_test.moc"
