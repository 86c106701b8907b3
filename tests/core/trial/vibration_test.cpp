#include "core/trial/vibration.h"

#include <QtTest>

#include "core/trial/outcome.h"

using namespace trapwright;

class VibrationTest : public QObject {
    Q_OBJECT

 private slots:
    // decisions.md#drive: at 50 Hz and 12 degrees parts lift off from 0.478 mm.
    void liftsOffWhereTheDesignSays() {
        const trial::Vibration drive{50.0, 0.478e-3, 12.0 * base::kDegree};
        QVERIFY(std::abs(trial::calcThrowNumber(drive) - 1.0) < 1e-3);
    }
    void growsWithTheSquareOfTheFrequency() {
        const trial::Vibration slow{25.0, 0.8e-3, 12.0 * base::kDegree};
        const trial::Vibration fast{50.0, 0.8e-3, 12.0 * base::kDegree};
        QVERIFY(std::abs(trial::calcThrowNumber(fast) / trial::calcThrowNumber(slow) - 4.0) < 1e-12);
    }
    // A linear feeder's vibration tilts with it; a bowl's is told from the level.
    void aBowlsTrackClimbsTowardsTheVibration() {
        const trial::Vibration drive{50.0, 0.8e-3, 12.0 * base::kDegree};
        track::FeederShape shape;
        shape.slope = 3.0 * base::kDegree;
        QCOMPARE(trial::seenFromTrack(drive, shape).angle, drive.angle);
        shape.type = track::FeederType::bowl;
        QVERIFY(std::abs(trial::seenFromTrack(drive, shape).angle - 9.0 * base::kDegree) < 1e-15);
        QCOMPARE(trial::seenFromTrack(drive, shape).halfStroke, drive.halfStroke);
    }
    void stepsAreSharesOfThePeriod() {
        const auto longest = [](double frequency, double steps) {
            return trial::calcLongestStep({frequency, 0.8e-3, 0.2}, steps);
        };
        QCOMPARE(longest(50.0, 100.0), 0.2e-3);
        QCOMPARE(longest(100.0, 100.0), 0.1e-3);
        QCOMPARE(longest(60.0, 100.0), 0.16e-3);
        QCOMPARE(longest(50000.0, 100.0), 0.01e-3);
    }
    void endingsHaveNames() {
        using trial::Ending;
        QCOMPARE(trial::endingName(Ending::finished), std::string_view("finished"));
        QCOMPARE(trial::endingName(Ending::fellOff), std::string_view("fell off"));
        QCOMPARE(trial::endingName(Ending::stuck), std::string_view("stuck"));
        QCOMPARE(trial::endingName(Ending::timedOut), std::string_view("timed out"));
    }
};

QTEST_APPLESS_MAIN(VibrationTest)
#include "vibration_test.moc"
