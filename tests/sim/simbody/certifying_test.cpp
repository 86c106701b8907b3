#include <QtTest>
#include <cmath>

#include "sim/contact/drive_motion.h"
#include "sim/simbody/certifying_engine.h"
#include "sim/simbody/certifying_trial.h"
#include "sim/simbody/simbody_engine.h"
#include "sim/simbody/trial_lane.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Quaternion;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

FeederShape shapeOf(int index) {
    if (index == 0) return {};
    return {FeederType::bowl, 0.175, index == 1 ? Conveying::clockwise : Conveying::anticlockwise};
}

/// The same scene by the continuous and by the discrete form.
struct Pair {
    trial::Trajectory continuous;
    trial::Trajectory discrete;
};

Pair replayBoth(const trial::TrialBatch& batch) {
    constexpr double kInterval = 1e-3;
    return {verify::replayScene(simbody::CertifyingEngine(), batch, kInterval, {}),
            verify::replayScene(simbody::SimbodyEngine(), batch, kInterval, {})};
}

/// The cuboid over the flat track on a corner or a face, so high that it hits at `speed`.
trial::TrialBatch makeDrop(const Quaternion& rotation, double speed, double restitution, double duration) {
    const auto part = verify::makePaperCuboid();
    double lowest = 0.0;
    for (const Vec3& vertex : part->hull.vertices)
        lowest = std::min(lowest, (rotation * vertex).z());
    const double drop = speed * speed / (2.0 * base::kStandardGravity);
    trial::TrialBatch batch = verify::makeStillScene(verify::makeFlat(), part,
                                                     {rotation, Vec3(0.1013, 0.0021, 0.015 - lowest + drop)},
                                                     speed / base::kStandardGravity + duration);
    batch.contact = {0.3, 0.3, restitution};
    return batch;
}

}  // namespace

/// The continuous form under Simbody's integrator and its mobilizers against ours.
class CertifyingTest : public QObject {
    Q_OBJECT

 private slots:
    void simbodysDriveIsOurs_data() {
        QTest::addColumn<int>("shape");
        QTest::newRow("linear") << 0;
        QTest::newRow("clockwise") << 1;
        QTest::newRow("anticlockwise") << 2;
    }
    // A part far above everything, to see the track's motion through.
    void simbodysDriveIsOurs() {
        QFETCH(int, shape);
        trial::TrialBatch batch = testing::makeLyingOn(shapeOf(shape), 0.0, 1.0);
        batch.drive.halfStroke = 1.1e-3;
        batch.drive.angle = 20.0 * base::kDegree;
        const double phase = 0.7;
        const simbody::Scene scene(batch, *batch.parts.front());
        const base::Pose start{Quaternion(0.9, 0.1, -0.3, 0.2).normalized(), Vec3(0.1, 0.05, 1.0)};
        simbody::CertifyingTrial running(
            {&scene.track, &scene.body, batch.track->shape, batch.drive, phase,
             batch.parts.front()->massProperties.mass, batch.parts.front()->massProperties.inertia,
             batch.gravityVector(), batch.contact},
            start, {Vec3(0.1, 0.2, 0.3), Vec3(3.0, -2.0, 5.0)});
        const contact::DriveMotion drive(batch.drive, batch.track->shape, phase);
        for (int i = 0; i <= 40; ++i) {
            const double time = 1.5e-3 * i;  // three periods
            running.advanceTo(time);
            const contact::TrackPlacement placement = drive.placement(time);
            const base::Pose expected = placement.toTrack(running.pose());
            const base::Pose got = running.poseInTrack();
            for (const Vec3& point : {Vec3(0.0, 0.0, 0.0), Vec3(0.1, 0.0, 0.0), Vec3(0.0, 0.1, 0.1)})
                QVERIFY((expected.apply(point) - got.apply(point)).norm() < 1e-9);
        }
        QVERIFY(running.forces().empty());
    }

    void aBounceAgrees_data() {
        QTest::addColumn<bool>("onCorner");
        QTest::addColumn<double>("restitution");
        QTest::newRow("on a corner, e = 0") << true << 0.0;
        QTest::newRow("on a corner, e = 0.3") << true << 0.3;
        QTest::newRow("on a corner, e = 0.6") << true << 0.6;
        QTest::newRow("on a face, e = 0.3") << false << 0.3;
    }
    // 0.1 m/s, up to 15 ms after the impact. The contact of the continuous form lasts some 0.2 ms and gives
    // way by some 10 micrometres, that of the discrete form takes no time.
    void aBounceAgrees() {
        QFETCH(bool, onCorner);
        QFETCH(double, restitution);
        const Quaternion rotation =
            onCorner ? Quaternion::FromTwoVectors(Vec3(2, 4, 6), -Vec3::UnitZ()) : Quaternion::Identity();
        const Pair both = replayBoth(makeDrop(rotation, 0.1, restitution, 0.6 * 0.1 / 4.9));
        QCOMPARE(both.continuous.samples.size(), both.discrete.samples.size());
        for (std::size_t i = 0; i + 1 < both.continuous.samples.size(); ++i) {
            const auto& a = both.continuous.samples[i];
            const auto& b = both.discrete.samples[i];
            QVERIFY(std::abs(a.time - b.time) < 1e-9);
            QVERIFY2((a.parts[0].room.position - b.parts[0].room.position).norm() < 30e-6,
                     qPrintable(QString("%1 um apart at %2 ms")
                                    .arg((a.parts[0].room.position - b.parts[0].room.position).norm() * 1e6)
                                    .arg(a.time * 1e3)));
        }
        const Vec3& rebound = both.continuous.samples.back().parts[0].velocity;
        QVERIFY((rebound - both.discrete.samples.back().parts[0].velocity).norm() < 4e-3);
    }

    // Thrown once by the vibrating track: flight and landing.
    void aHopAgrees() {
        trial::TrialBatch batch = testing::makeLyingOn({}, 0.0, 0.04);
        batch.drive.halfStroke = 0.8e-3;
        batch.contact = {0.5, 0.5, 0.0};
        batch.trials[0].phase = -0.5 * base::kPi;  // at rest, like the part
        const Pair both = replayBoth(batch);
        double highest = 0.0;
        for (std::size_t i = 0; i + 1 < both.continuous.samples.size(); ++i) {
            const auto& a = both.continuous.samples[i];
            const auto& b = both.discrete.samples[i];
            QVERIFY2((a.parts[0].track.position - b.parts[0].track.position).norm() < 30e-6,
                     qPrintable(QString("%1 um apart at %2 ms")
                                    .arg((a.parts[0].track.position - b.parts[0].track.position).norm() * 1e6)
                                    .arg(a.time * 1e3)));
            highest = std::max(highest, a.parts[0].track.position.z() - 0.017);
        }
        QVERIFY(highest > 50e-6);  // it did fly
    }

    void refusesWhatItCannotSimulate() {
        const simbody::CertifyingEngine engine;
        trial::TrialBatch batch = testing::makeLyingOn({}, 0.0, 0.01);
        QVERIFY(!engine.replay(batch, 1, 0.01, {}).ok());
        base::RunControl cancelled;
        cancelled.cancel();
        QVERIFY(!engine.run(std::vector{batch}, cancelled).ok());
        batch.track = nullptr;
        QVERIFY(!engine.run(std::vector{batch}, {}).ok());
    }

    void runGivesTheReplaysOutcome() {
        const trial::TrialBatch batch = testing::makeLyingOn({}, 0.3, 0.02);
        const simbody::CertifyingEngine engine({2, 0.0});
        base::RunControl control;
        const auto outcomes = engine.run(std::vector{batch}, control);
        QVERIFY(outcomes.ok());
        QCOMPARE((*outcomes)[0].size(), 1U);
        QCOMPARE((*outcomes)[0][0].parts[0].ending, trial::Ending::timedOut);
        QVERIFY(control.done() == 1);
        // The integrator's steps differ with the samples; the motion does not.
        const auto replay = engine.replay(batch, 0, 5e-3, {});
        QVERIFY(replay.ok());
        QVERIFY((replay->outcome.parts[0].farthest.position - (*outcomes)[0][0].parts[0].farthest.position)
                    .norm() < 1e-6);
    }

    // Parts do not touch each other in it: it says so instead of leaving all but one out.
    void severalPartsAreRefused() {
        const simbody::CertifyingEngine engine;
        const trial::TrialBatch one = makeDrop(Quaternion::Identity(), 0.1, 0.3, 0.01);
        const auto refused = [&](const trial::TrialBatch& batch, std::string why) {
            why = "The engine '" + engine.name() + "' simulates " + why;
            const auto result = engine.run(std::vector{one, batch}, {});
            const auto replay = engine.replay(batch, 0, 0.01, {});
            return !result.ok() && result.error().message.starts_with(why) && !replay.ok() &&
                   replay.error().message.starts_with(why);
        };
        trial::TrialBatch two = one;
        two.trials[0].parts.push_back(two.trials[0].parts[0]);
        QVERIFY(refused(two, "one part at a time, and trial 0 has 2."));
        trial::TrialBatch later = one;
        later.trials[0].parts[0].time = 0.5;
        QVERIFY(
            refused(later, "parts that are there from the begin on, and that of trial 0 comes after 0.5"));
        trial::TrialBatch stream = one;
        stream.termination.until = 1.0;
        QVERIFY(refused(stream, "no streams."));
    }
};

QTEST_APPLESS_MAIN(CertifyingTest)
#include "certifying_test.moc"
