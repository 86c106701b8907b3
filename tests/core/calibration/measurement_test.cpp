#include "core/calibration/measurement.h"

#include <QtTest>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/math.h"

using namespace trapwright;
using calibration::Method;

namespace {

QString messageOf(const base::Result<calibration::Estimate>& result) {
    return QString::fromStdString(result.ok() ? std::string("(no error)") : result.error().message);
}

}  // namespace

class MeasurementTest : public QObject {
    Q_OBJECT

 private slots:
    void methodsHaveNames() {
        for (const Method method : {Method::tiltUntilSliding, Method::tiltWhileSliding, Method::bounceHeight,
                                    Method::bounceTime, Method::conveyingSpeed}) {
            QVERIFY(!calibration::nameOf(method).empty());
            QVERIFY(calibration::methodOf(calibration::nameOf(method)) == method);
        }
        QVERIFY(!calibration::methodOf("thumb"));
    }

    void readingsAreKeptAsNumbers() {
        for (const Method method : {Method::tiltUntilSliding, Method::tiltWhileSliding, Method::bounceHeight,
                                    Method::bounceTime, Method::conveyingSpeed}) {
            calibration::Readings readings = calibration::emptyReadings(method);
            QCOMPARE(calibration::countReadings(readings), std::size_t{0});
            for (const double first : {0.1, 0.2, 0.3})
                calibration::addReading(readings, std::array{first, 2.0 * first, 3.0 * first});
            calibration::removeReading(readings, 1);
            const auto rows = calibration::numbersOf(readings);
            QCOMPARE(calibration::countReadings(readings), std::size_t{2});
            calibration::Readings again = calibration::emptyReadings(method);
            for (const std::vector<double>& row : rows)
                calibration::addReading(again, row);
            QVERIFY(again == readings);
            for (std::size_t i = 0; i < rows[1].size(); ++i)
                QCOMPARE(rows[1][i], 0.3 * static_cast<double>(i + 1));
        }
        calibration::Readings runs = calibration::emptyReadings(Method::conveyingSpeed);
        calibration::addReading(runs, std::array{0.5, 0.2, 3.1});
        QVERIFY(runs == calibration::Readings(std::vector<calibration::TimedRun>{{0.5, 0.2, 3.1}}));
    }

    // tan 45 degrees is 1; of 1/2, 3/4 and 1 the mean is 3/4 and half the interval t(2) x 0.25 / sqrt(3).
    void tiltGivesFriction() {
        std::vector<calibration::Tilt> readings;
        for (const double friction : {0.5, 0.75, 1.0})
            readings.push_back({std::atan(friction)});
        const auto friction = calibration::estimateFriction(readings);
        QVERIFY(friction.ok());
        QVERIFY(std::abs(friction->value - 0.75) < 1e-12);
        QVERIFY(std::abs(friction->high - (0.75 + 4.302653 * 0.25 / std::sqrt(3.0))) < 1e-6);
        QVERIFY(std::abs(friction->low - (0.75 - 4.302653 * 0.25 / std::sqrt(3.0))) < 1e-6);
    }

    // e = sqrt(h1 / h0): from 100 mm to 9 and 16 mm is 0.3 and 0.4. The interval ends at 0.
    void bounceGivesRestitution() {
        const auto heights = calibration::estimateRestitutionFromHeights(
            std::vector<calibration::BounceHeights>{{0.1, 0.009}, {0.1, 0.016}});
        QVERIFY(heights.ok());
        QVERIFY(std::abs(heights->value - 0.35) < 1e-12);
        QCOMPARE(heights->low, 0.0);
        // The same fall: first flight after v1 = e v0 takes 2 v1 / g, the second e times as long.
        const double impact = std::sqrt(2.0 * base::kStandardGravity * 0.1);
        std::vector<calibration::BounceTimes> times;
        for (const double e : {0.29, 0.30, 0.31}) {
            const double first = 2.0 * e * impact / base::kStandardGravity;
            times.push_back({first, e * first});
        }
        const auto restitution = calibration::estimateRestitutionFromTimes(times);
        QVERIFY(restitution.ok());
        QVERIFY(std::abs(restitution->value - 0.3) < 1e-12);
        QVERIFY(restitution->low > 0.27 && restitution->high < 0.33);
    }

    void saysWhichReadingCannotBe() {
        QVERIFY(messageOf(calibration::estimateFriction(std::vector<calibration::Tilt>{{0.4}}))
                    .contains("at least two"));
        const QString steep =
            messageOf(calibration::estimateFriction(std::vector<calibration::Tilt>{{0.4}, {1.6}}));
        QVERIFY2(steep.contains("Reading 2") && steep.contains("90"), qPrintable(steep));
        const QString high = messageOf(calibration::estimateRestitutionFromHeights(
            std::vector<calibration::BounceHeights>{{0.1, 0.2}, {0.1, 0.01}}));
        QVERIFY2(high.contains("Reading 1") && high.contains("200 mm"), qPrintable(high));
        QVERIFY(!calibration::estimateRestitutionFromTimes(
                     std::vector<calibration::BounceTimes>{{0.1, 0.05}, {0.0, 0.0}})
                     .ok());
        QVERIFY(!calibration::estimateFriction(std::vector<calibration::Tilt>{{std::nan("")}, {0.3}}).ok());
    }
};

QTEST_APPLESS_MAIN(MeasurementTest)
#include "measurement_test.moc"
