#include <QtTest>
#include <cmath>

#include "core/trial/start.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

constexpr double kSlope = 14.0 * base::kDegree;

FeederShape tilted(double slope) {
    FeederShape shape;
    shape.slope = slope;
    return shape;
}

/// The same trial, of a part that comes to a stream.
trial::TrialBatch asStream(trial::TrialBatch batch, double until) {
    batch.termination.until = until;
    return batch;
}

/// How quickly the speed along x grows between these times. [m/s^2]
double measureSlide(const trial::TrialBatch& batch, double from, double to) {
    const trial::Trajectory trajectory = verify::replayScene(*testing::makeEngine(), batch, 1e-3, {});
    const auto at = [&](double time) {
        return trajectory.samples.at(static_cast<std::size_t>(std::lround(time / 1e-3)));
    };
    return (at(to).parts[0].velocity.x() - at(from).parts[0].velocity.x()) / (at(to).time - at(from).time);
}

}  // namespace

/// decisions.md#slope in both engines.
class SlopeTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    // The room of a tilted feeder is tilted with it.
    void partsFallPlumb_data() {
        QTest::addColumn<bool>("stream");
        QTest::newRow("one part") << false;
        QTest::newRow("stream") << true;
    }
    void partsFallPlumb() {
        QFETCH(bool, stream);
        for (const double slope : {kSlope, -kSlope}) {
            trial::TrialBatch batch = testing::makeLyingOn(tilted(slope), 0.2, 0.08);
            batch.trials[0].parts[0].pose.position.z() += 0.05;
            if (stream) batch = asStream(std::move(batch), 0.08);
            const trial::Trajectory fall = verify::replayScene(*testing::makeEngine(), batch, 1e-2, {});
            const Vec3 start = fall.samples.front().parts[0].room.position;
            for (const trial::TrajectorySample& sample : fall.samples) {
                const double t = sample.time;
                const Vec3 way = sample.parts[0].room.position - start;
                const Vec3 expected =
                    0.5 * t * t * base::kStandardGravity * Vec3(-std::sin(slope), 0.0, -std::cos(slope));
                QVERIFY2((way - expected).norm() < 2e-7,
                         qPrintable(QString::number((way - expected).norm())));
            }
        }
    }

    // A still track lets go what its friction does not hold: a = g (sin - mu cos).
    void partsSlideDown_data() { partsFallPlumb_data(); }
    void partsSlideDown() {
        QFETCH(bool, stream);
        const double expected = base::kStandardGravity * (std::sin(kSlope) - 0.2 * std::cos(kSlope));
        for (const double slope : {kSlope, -kSlope}) {
            trial::TrialBatch batch = testing::makeLyingOn(tilted(slope), 0.3, 0.5);
            batch.drive.halfStroke = 0.0;
            batch.contact = {0.2, 0.2, 0.0};
            if (stream) batch = asStream(std::move(batch), 0.5);
            const double got = measureSlide(batch, 0.1, 0.4) * (slope > 0.0 ? -1.0 : 1.0);
            QVERIFY2(std::abs(got / expected - 1.0) < 0.005,
                     qPrintable(QString::number(got / expected - 1.0)));
        }
    }

    // A bowl is upright, and its track climbs.
    void bowlsHaveNoTilt() {
        for (const Conveying conveying : {Conveying::clockwise, Conveying::anticlockwise}) {
            trial::TrialBatch batch =
                testing::makeLyingOn({FeederType::bowl, 0.175, conveying, 0.1}, 0.2, 0.08);
            batch.trials[0].parts[0].pose.position.z() += 0.05;
            const trial::Trajectory fall = verify::replayScene(*testing::makeEngine(), batch, 1e-2, {});
            const Vec3 way =
                fall.samples.back().parts[0].room.position - fall.samples.front().parts[0].room.position;
            const double t = fall.samples.back().time;
            QVERIFY((way + 0.5 * t * t * base::kStandardGravity * Vec3::UnitZ()).norm() < 2e-7);
        }
    }

    // What lies on a climbing bowl's track slides down it, in track coordinates back, and keeps its height
    // above it; its orientation is told in a frame that is tilted with it.
    void partsSlideDownAHelix_data() {
        QTest::addColumn<Conveying>("conveying");
        QTest::newRow("clockwise") << Conveying::clockwise;
        QTest::newRow("anticlockwise") << Conveying::anticlockwise;
    }
    void partsSlideDownAHelix() {
        QFETCH(Conveying, conveying);
        const FeederShape shape{FeederType::bowl, 2.0, conveying, kSlope};
        trial::TrialBatch batch = testing::makeLyingOn(shape, 0.0, 0.3);
        batch.drive.halfStroke = 0.0;
        batch.contact = {0.2, 0.2, 0.0};
        const trial::Trajectory slide = verify::replayScene(*testing::makeEngine(), batch, 1e-3, {});
        const auto at = [&](double time) {
            return slide.samples.at(static_cast<std::size_t>(std::lround(time / 1e-3)));
        };
        const double gained = at(0.25).parts[0].velocity.norm() - at(0.1).parts[0].velocity.norm();
        const double expected = base::kStandardGravity * (std::sin(kSlope) - 0.2 * std::cos(kSlope));
        const double error = gained / (at(0.25).time - at(0.1).time) / expected - 1.0;
        QVERIFY2(std::abs(error) < 0.02, qPrintable(QString::number(error)));
        const Vec3 first = at(0.05).parts[0].track.position;
        const Vec3 last = at(0.25).parts[0].track.position;
        QVERIFY(last.x() < first.x() - 8e-3);
        QVERIFY2(std::abs(last.z() - first.z()) < 0.1e-3, qPrintable(QString::number(last.z() - first.z())));
        const base::Quaternion lying = base::Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3::UnitZ());
        const Vec3 up = at(0.25).parts[0].track.rotation * lying.conjugate() * Vec3::UnitZ();
        QVERIFY2(up.z() > std::cos(0.5 * base::kDegree), qPrintable(QString::number(up.z())));
    }

    // Side by side, trials on feeders of unlike slopes are what they are alone.
    void unlikeSlopesKeepApart_data() { partsFallPlumb_data(); }
    void unlikeSlopesKeepApart() {
        QFETCH(bool, stream);
        std::vector<trial::TrialBatch> batches;
        const auto part = verify::makePaperCuboid();
        for (const double slope : {0.0, 0.2, -0.2}) {
            trial::TrialBatch batch = testing::makeLyingOn(tilted(slope), 0.4, 1.0);
            batch.parts = {part};
            batch.contact = {0.3, 0.3, 0.1};
            batches.push_back(stream ? asStream(batch, 1.0) : batch);
        }
        const auto engine = testing::makeEngine({.threads = 2});
        const auto together = engine->run(batches, {});
        QVERIFY(together.ok());
        for (std::size_t i = 0; i < batches.size(); ++i) {
            const auto alone = engine->run({&batches[i], 1}, {});
            QVERIFY(alone.ok());
            const trial::PartOutcome& a = together->at(i)[0].parts[0];
            const trial::PartOutcome& b = alone->at(0)[0].parts[0];
            QVERIFY(a.ending == b.ending && a.time == b.time && a.farthest == b.farthest);
        }
        QVERIFY(!(together->at(0)[0].parts[0].farthest == together->at(1)[0].parts[0].farthest));
    }

    // From a start that was drawn, a part comes to rest on a still helix that friction holds it on.
    void drawnPartsRestOnAHelix() {
        const FeederShape shape{FeederType::bowl, 0.175, Conveying::clockwise, 4.0 * base::kDegree};
        trial::TrialBatch batch = testing::makeLyingOn(shape, 0.0, 1.0);
        batch.drive.halfStroke = 0.0;
        batch.contact = {0.6, 0.6, 0.0};
        trial::StartPolicy policy;
        policy.nearPose = base::Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3::UnitZ());
        for (std::uint32_t i = 0; i < 5; ++i) {
            batch.trials = {
                trial::drawTrial(*batch.track, *batch.parts[0], policy, {1, 0, 0, i, base::Purpose::test})};
            const trial::Trajectory rest = verify::replayScene(*testing::makeEngine(), batch, 0.1, {});
            const trial::PartState& from = rest.samples.at(5).parts[0];
            const trial::PartState& to = rest.samples.at(9).parts[0];
            QVERIFY((from.room.position - to.room.position).norm() < 2e-6);
            QVERIFY((to.track.rotation * policy.nearPose->conjugate() * Vec3::UnitZ()).z() > 0.999);
        }
    }
};

QTEST_APPLESS_MAIN(SlopeTest)
#include "slope_test.moc"
