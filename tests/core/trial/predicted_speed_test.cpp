#include "core/trial/predicted_speed.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;

namespace {

constexpr double kGravity = base::kStandardGravity;

/// slope [deg]
trial::ConveyingPrediction predict(double halfStroke, double friction = 0.5, double slope = 0.0) {
    trial::Vibration drive;
    drive.halfStroke = halfStroke;
    return trial::predictConveying(drive, {friction, friction, 0.0}, kGravity, slope * base::kDegree);
}

}  // namespace

class PredictedSpeedTest : public QObject {
    Q_OBJECT

 private slots:
    // decisions.md#drive: 1.0 at a half-stroke of 0.478 mm.
    void partsLiftOffAtThrowNumberOne() {
        QVERIFY(std::abs(predict(0.478e-3).throwNumber - 1.0) < 2e-3);
        QCOMPARE(predict(0.47e-3).conveyance, trial::Conveyance::slides);
        QCOMPARE(predict(0.49e-3).conveyance, trial::Conveyance::hops);
    }

    // The peak acceleration along the plane does not reach friction x gravity.
    void aWeakDriveMovesNothing() {
        const trial::ConveyingPrediction still = predict(0.02e-3);
        QCOMPARE(still.conveyance, trial::Conveyance::sticks);
        QVERIFY(std::abs(still.speed) < 1e-6);
    }

    void whatClimbsIsSlower() {
        double before = predict(0.45e-3, 0.5, -6.0).speed;
        for (const double slope : {-3.0, 0.0, 3.0, 6.0}) {
            const double speed = predict(0.45e-3, 0.5, slope).speed;
            QVERIFY(speed < before);
            before = speed;
        }
        // Steep enough, a weak drive lets everything come back.
        const trial::ConveyingPrediction back = predict(0.3e-3, 0.3, 10.0);
        QVERIFY(back.speed < 0.0);
        QCOMPARE(back.conveyance, trial::Conveyance::slides);
    }

    // Friction 0.2 holds up to 11.3 degrees.
    void nothingStaysOnTooSteepASlope() {
        QCOMPARE(predict(0.45e-3, 0.2, 11.0).conveyance, trial::Conveyance::slides);
        for (const double slope : {12.0, -12.0})
            QCOMPARE(predict(0.45e-3, 0.2, slope).conveyance, trial::Conveyance::slidesAway);
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
