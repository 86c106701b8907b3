#include "core/trial/recorded_motion.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;
using namespace trapwright::trial;
using base::Vec3;

namespace {

/// A part that rides on a vibrating track without moving on it, as it is seen in the room.
Trajectory makeRide(const track::FeederShape& shape, const base::Pose& onTrack) {
    Trajectory ride;
    for (int i = 0; i <= 40; ++i) {
        TrajectorySample sample;
        sample.time = 1e-3 * i;
        const double sine = std::sin(2.0 * base::kPi * 50.0 * sample.time);
        sample.drive = Vec3(0.8e-3 * sine, 0.0, 0.2e-3 * sine);
        base::Quaternion turn = base::Quaternion::Identity();
        Vec3 shift = sample.drive;
        if (shape.type == track::FeederType::bowl) {
            const double sense = shape.conveying == track::Conveying::clockwise ? -1.0 : 1.0;
            turn = Eigen::AngleAxisd(sense * sample.drive.x() / shape.bowlRadius, Vec3::UnitZ());
            shift = Vec3(0.0, 0.0, sample.drive.z());
        }
        // A second one rides with it, turned half about.
        for (const double angle : {0.0, base::kPi}) {
            const base::Quaternion half(Eigen::AngleAxisd(angle, Vec3::UnitX()));
            PartState& part = sample.parts.emplace_back();
            part.room = {turn * onTrack.rotation * half, turn * onTrack.position + shift};
            part.part = sample.parts.size() - 1;
        }
        sample.forces.resize(static_cast<std::size_t>(i));
        ride.samples.push_back(sample);
    }
    ride.outcome.parts.resize(2);
    return ride;
}

}  // namespace

class RecordedMotionTest : public QObject {
    Q_OBJECT

 private slots:
    void whatRidesOnTheTrackStandsStill_data() {
        QTest::addColumn<int>("type");
        QTest::addColumn<int>("conveying");
        QTest::newRow("linear") << 0 << 0;
        QTest::newRow("clockwise bowl") << 1 << 0;
        QTest::newRow("anticlockwise bowl") << 1 << 1;
    }

    void whatRidesOnTheTrackStandsStill() {
        QFETCH(int, type);
        QFETCH(int, conveying);
        const track::FeederShape shape{static_cast<track::FeederType>(type), 0.175,
                                       static_cast<track::Conveying>(conveying)};
        const base::Pose rest{base::Quaternion(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())),
                              shape.toRoom({0.05, 0.01, 0.02})};
        const RecordedMotion motion(makeRide(shape, rest), shape);
        QCOMPARE(motion.duration(), 0.04);
        for (const double time : {-1.0, 0.0, 0.0053, 0.02, 0.0399, 9.0}) {
            for (const std::size_t part : {0U, 1U}) {
                const base::Pose pose = motion.poseAt(part, time);
                const double turned = pose.rotation.angularDistance(rest.rotation);
                QVERIFY((pose.position - rest.position).norm() < 1e-12);
                QVERIFY(std::abs(turned - (part == 0 ? 0.0 : base::kPi)) < 1e-7);
            }
        }
        QCOMPARE(motion.parts(), std::size_t{2});
        QCOMPARE(motion.path(0, 1e-6).size(), std::size_t{1});
    }

    void posesBetweenSamplesAreInterpolated() {
        Trajectory trajectory;
        trajectory.samples.resize(2, {0.0, Vec3::Zero(), {PartState()}, {}});
        trajectory.outcome.parts.resize(1);
        trajectory.samples[1].time = 0.5;
        trajectory.samples[1].parts[0].room = {base::Quaternion(Eigen::AngleAxisd(1.0, Vec3::UnitX())),
                                               {0.0, 4.0, 0.0}};
        trajectory.samples[1].forces.resize(1);
        const RecordedMotion motion(trajectory, {});
        const base::Pose pose = motion.poseAt(0, 0.125);
        QVERIFY((pose.position - Vec3(0.0, 1.0, 0.0)).norm() < 1e-12);
        QVERIFY(std::abs(pose.rotation.angularDistance(base::Quaternion::Identity()) - 0.25) < 1e-7);
        QVERIFY(motion.forcesAt(0.49).empty());
        QCOMPARE(motion.forcesAt(0.5).size(), std::size_t{1});
        QCOMPARE(motion.path(0, 0.1).size(), std::size_t{2});
    }

    // Of a stream: one comes at the second sample and is gone after the third, one never comes.
    void partsComeAndGo() {
        Trajectory stream;
        stream.outcome.parts.resize(3);
        for (int i = 0; i < 5; ++i) {
            TrajectorySample& sample = stream.samples.emplace_back();
            sample.time = i;
            PartState state;
            state.room.position = Vec3(i, 0.0, 0.0);
            sample.parts.push_back(state);
            state.part = 2;
            state.room.position = Vec3(10.0 + i, 0.0, 0.0);
            if (i == 1 || i == 2) sample.parts.push_back(state);
        }
        const RecordedMotion motion(stream, {});
        const auto x = [&](std::size_t part, double time) { return motion.poseAt(part, time).position.x(); };
        QVERIFY(motion.isThere(0, 0.0) && motion.isThere(0, 4.0));
        QVERIFY(!motion.isThere(2, 0.9) && motion.isThere(2, 1.0) && motion.isThere(2, 2.9));
        QVERIFY(!motion.isThere(2, 3.0));
        QVERIFY(!motion.isThere(1, 2.0) && motion.poseAt(1, 2.0) == base::Pose());
        QCOMPARE(x(0, 3.5), 3.5);
        QCOMPARE(x(2, 0.0), 11.0);
        QCOMPARE(x(2, 1.5), 11.5);
        QCOMPARE(x(2, 4.0), 12.0);
        QCOMPARE(motion.path(2, 0.1).size(), std::size_t{2});
    }

    void nothingIsNoMotion() {
        const RecordedMotion motion({}, {});
        QCOMPARE(motion.duration(), 0.0);
        QCOMPARE(motion.parts(), std::size_t{0});
        QVERIFY(motion.poseAt(0, 1.0) == base::Pose());
        QVERIFY(motion.forcesAt(1.0).empty());
    }
};

QTEST_GUILESS_MAIN(RecordedMotionTest)
#include "recorded_motion_test.moc"
