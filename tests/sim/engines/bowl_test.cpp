#include <QtTest>
#include <cmath>

#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Quaternion;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

trial::Trajectory replay(const trial::TrialBatch& batch, double interval) {
    return verify::replayScene(*testing::makeEngine(), batch, interval, {});
}

/// Along the track, over whole periods after the first tenth of a second. [m/s]
double measureSpeed(const trial::TrialBatch& batch) {
    const double period = batch.drive.period();
    const trial::Trajectory trajectory = replay(batch, period);
    const std::size_t last = trajectory.samples.size() - 2;
    return (trajectory.samples[last].parts[0].track.position.x() -
            trajectory.samples[5].parts[0].track.position.x()) /
           (static_cast<double>(last - 5) * period);
}

}  // namespace

class BowlTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    void aHugeBowlIsALinearFeeder_data() {
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<int>("conveying");
        for (const double halfStroke : {0.4e-3, 0.7e-3}) {
            QTest::addRow("%g mm, clockwise", halfStroke * 1e3) << halfStroke << 0;
            QTest::addRow("%g mm, anticlockwise", halfStroke * 1e3) << halfStroke << 1;
        }
    }
    void aHugeBowlIsALinearFeeder() {
        QFETCH(double, halfStroke);
        QFETCH(int, conveying);
        const FeederShape bowl{FeederType::bowl, 50.0,
                               conveying == 0 ? Conveying::clockwise : Conveying::anticlockwise};
        const auto speedOn = [&](const FeederShape& shape) {
            trial::TrialBatch batch = testing::makeLyingOn(shape, 0.0, 1.5);
            batch.drive.halfStroke = halfStroke;
            return measureSpeed(batch);
        };
        const double linear = speedOn({});
        QVERIFY(linear > 0.01);
        const double turned = speedOn(bowl);
        QVERIFY2(std::abs(turned / linear - 1.0) < 0.01,
                 qPrintable(QString("%1 and %2 mm/s").arg(linear * 1e3).arg(turned * 1e3)));
    }

    // On a bowl of the usual size, too, the part is carried along the track, not across the bowl.
    void aBowlConveysAroundItsAxis_data() {
        QTest::addColumn<int>("conveying");
        QTest::newRow("clockwise") << 0;
        QTest::newRow("anticlockwise") << 1;
    }
    void aBowlConveysAroundItsAxis() {
        QFETCH(int, conveying);
        const FeederShape bowl{FeederType::bowl, 0.175,
                               conveying == 0 ? Conveying::clockwise : Conveying::anticlockwise};
        trial::TrialBatch batch = testing::makeLyingOn(bowl, 0.0, 1.0);
        batch.drive.halfStroke = 0.45e-3;
        const trial::Trajectory trajectory = replay(batch, 0.02);
        const auto& first = trajectory.samples.front().parts[0];
        const auto& last = trajectory.samples.back().parts[0];
        QVERIFY(last.track.position.x() > first.track.position.x() + 0.02);
        QVERIFY(std::abs(last.track.position.y() - first.track.position.y()) < 1e-3);
        // Seen from above: the polar angle falls when conveying clockwise.
        const double angle = std::atan2(last.room.position.y(), last.room.position.x());
        QVERIFY(conveying == 0 ? angle < -0.1 : angle > 0.1);
    }

    // Mirroring the scene at the plane y = 0 mirrors the motion. Contacts come in another order, so only to
    // the solver's tolerance.
    void anticlockwiseMirrorsClockwise() {
        const auto sceneOn = [](Conveying conveying) {
            trial::TrialBatch batch = testing::makeLyingOn({FeederType::bowl, 0.175, conveying}, 0.0, 0.25);
            batch.drive.halfStroke = 0.45e-3;
            return batch;
        };
        const trial::TrialBatch clockwise = sceneOn(Conveying::clockwise);
        trial::TrialBatch mirrored = sceneOn(Conveying::anticlockwise);
        const base::Pose& pose = clockwise.trials[0].parts[0].pose;
        const Quaternion& r = pose.rotation;
        mirrored.trials[0].parts[0].pose = {Quaternion(r.w(), -r.x(), r.y(), -r.z()),
                                            {pose.position.x(), -pose.position.y(), pose.position.z()}};
        const trial::Trajectory a = replay(clockwise, 0.01);
        const trial::Trajectory b = replay(mirrored, 0.01);
        QCOMPARE(a.samples.size(), b.samples.size());
        QVERIFY(a.samples.back().parts[0].track.position.x() >
                a.samples.front().parts[0].track.position.x() + 3e-3);
        for (std::size_t i = 0; i < a.samples.size(); ++i) {
            const Vec3& p = a.samples[i].parts[0].room.position;
            QVERIFY((Vec3(p.x(), -p.y(), p.z()) - b.samples[i].parts[0].room.position).norm() < 2e-6);
            QVERIFY((a.samples[i].parts[0].track.position.head<1>() -
                     b.samples[i].parts[0].track.position.head<1>())
                        .norm() < 2e-6);
        }
    }
};

QTEST_APPLESS_MAIN(BowlTest)
#include "bowl_test.moc"
