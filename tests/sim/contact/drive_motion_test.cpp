#include "sim/contact/drive_motion.h"

#include <QtTest>
#include <cmath>

#include "core/base/random.h"

using namespace trapwright;
using base::Vec3;

namespace {

track::FeederShape shapeOf(int index) {
    if (index == 0) return {};
    return {track::FeederType::bowl, 0.175,
            index == 1 ? track::Conveying::clockwise : track::Conveying::anticlockwise};
}

void addShapes() {
    QTest::addColumn<int>("shape");
    QTest::newRow("linear") << 0;
    QTest::newRow("clockwise") << 1;
    QTest::newRow("anticlockwise") << 2;
}

}  // namespace

class DriveMotionTest : public QObject {
    Q_OBJECT

 private slots:
    // Whichever way the feeder conveys: forward and up together, along the vibration line.
    void movesAlongTheVibrationLine_data() { addShapes(); }
    void movesAlongTheVibrationLine() {
        QFETCH(int, shape);
        const track::FeederShape feeder = shapeOf(shape);
        trial::Vibration drive;
        drive.frequency = 60.0;
        drive.halfStroke = 0.7e-3;
        drive.angle = 15.0 * base::kDegree;
        const double phase = 0.4;
        const contact::DriveMotion motion(drive, feeder, phase);
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 300; ++i) {
            const double time = random.uniform(0.0, 5.0 * drive.period());
            const double stroke = drive.halfStroke * std::sin(2.0 * base::kPi * 60.0 * time + phase);
            const Vec3 place(random.uniform(0.0, 0.4), 0.0, random.uniform(0.0, 0.03));
            const Vec3 moved = feeder.toTrack(motion.placement(time).toRoom(feeder.toRoom(place)), place.x());
            const Vec3 expected = stroke * Vec3(std::cos(drive.angle), 0.0, std::sin(drive.angle));
            QVERIFY((moved - place - expected).norm() < 1e-14);
            QVERIFY((motion.displacement(time) - expected).norm() < 1e-15);
            // On the room's straight lines too, but for the arc's height of half-stroke^2 / (2 x 175 mm).
            const Vec3 straight =
                feeder.tangentFrame(place.x()).transpose() *
                (motion.placement(time).toRoom(feeder.toRoom(place)) - feeder.toRoom(place));
            QVERIFY((straight - expected).norm() < 1.5e-6);
        }
    }

    // A bowl is rigid: all of it turns by one angle and is lifted by one height.
    void movesAsARigidBody_data() { addShapes(); }
    void movesAsARigidBody() {
        QFETCH(int, shape);
        const contact::DriveMotion motion(trial::Vibration{}, shapeOf(shape), 1.0);
        base::Random random({2, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 100; ++i) {
            const contact::TrackPlacement placement = motion.placement(random.uniform(0.0, 0.1));
            const Vec3 a(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0.0, 0.03));
            const Vec3 b(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0.0, 0.03));
            const double distance = (placement.toRoom(a) - placement.toRoom(b)).norm();
            QVERIFY(std::abs(distance - (a - b).norm()) < 1e-15);
        }
    }

    void roomAndTrackAreInverse_data() { addShapes(); }
    void roomAndTrackAreInverse() {
        QFETCH(int, shape);
        const contact::DriveMotion motion(trial::Vibration{}, shapeOf(shape), 2.0);
        base::Random random({3, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 100; ++i) {
            const contact::TrackPlacement placement = motion.placement(random.uniform(0.0, 0.1));
            const base::Pose pose{random.rotation(), {random.uniform(), random.uniform(), random.uniform()}};
            const Vec3 corner(4e-3, -2e-3, 6e-3);
            const base::Pose there = placement.toRoom(pose);
            // A pose moves like every one of its points.
            QVERIFY((there.apply(corner) - placement.toRoom(pose.apply(corner))).norm() < 1e-14);
            const base::Pose back = placement.toTrack(there);
            QVERIFY((back.position - pose.position).norm() < 1e-14);
            QVERIFY(back.rotation.angularDistance(pose.rotation) < 1e-7);
            QVERIFY((placement.turnBack(placement.turn(corner)) - corner).norm() < 1e-16);
        }
    }

    void standsStillWithoutAStroke_data() { addShapes(); }
    void standsStillWithoutAStroke() {
        QFETCH(int, shape);
        trial::Vibration drive;
        drive.halfStroke = 0.0;
        const contact::DriveMotion motion(drive, shapeOf(shape), 0.3);
        const Vec3 place(0.1, 0.2, 0.3);
        QCOMPARE(motion.placement(0.123).toRoom(place), place);
    }
};

QTEST_APPLESS_MAIN(DriveMotionTest)
#include "drive_motion_test.moc"
