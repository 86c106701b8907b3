#include <QtTest>
#include <cmath>

#include "core/track/track_builder.h"
#include "core/trial/start.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

void addShapes() {
    QTest::addColumn<FeederShape>("shape");
    QTest::newRow("linear") << FeederShape{};
    QTest::newRow("clockwise") << FeederShape{FeederType::bowl, 0.175, Conveying::clockwise};
    QTest::newRow("anticlockwise") << FeederShape{FeederType::bowl, 0.175, Conveying::anticlockwise};
}

/// Paper's cuboids on their largest face, of any heading, on a track whose trap is 0.1 m of its lead-in going
/// on, in the standard drive.
trial::TrialBatch makeLying(const track::TrackParameters& parameters, int trials) {
    track::CrossSection section = track::makeLeadIn(parameters, 0.1, 8);
    auto track = std::make_shared<track::Track>(track::buildTrack(parameters, {{section}}).value());
    auto part = verify::makePaperCuboid();
    trial::TrialBatch batch = verify::makeStillScene(track, part, {}, 20.0);
    batch.drive = {};
    batch.termination = {};
    batch.trials.clear();
    trial::StartPolicy policy;
    policy.nearPose = base::Quaternion::FromTwoVectors(base::Vec3::UnitX(), base::Vec3::UnitZ());
    for (int i = 0; i < trials; ++i) {
        const base::StreamKey key{5, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::test};
        batch.trials.push_back(trial::drawTrial(*track, *part, policy, key));
    }
    return batch;
}

std::vector<trial::PartOutcome> run(const trial::TrialBatch& batch) {
    std::vector<trial::PartOutcome> parts;
    const auto outcomes = testing::makeEngine()->run({&batch, 1}, {});
    for (const trial::Outcome& outcome : outcomes.value()[0])
        parts.push_back(outcome.parts[0]);
    return parts;
}

}  // namespace

/// What parts come by and leave by (decisions.md#spiral, #chute) in both engines.
class EndsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    // They come along the wall, and lie on the ledge as they were put.
    void partsComeAlongTheWall_data() { addShapes(); }
    void partsComeAlongTheWall() {
        QFETCH(FeederShape, shape);
        track::TrackParameters parameters;
        parameters.shape = shape;
        parameters.spiral = {24e-3, 10e-3, 12.0 * base::kDegree};
        const double side = shape.conveying == Conveying::anticlockwise ? -1.0 : 1.0;
        for (const trial::PartOutcome& part : run(makeLying(parameters, 12))) {
            QVERIFY(part.ending == trial::Ending::finished);
            const base::Pose& end = part.farthest;
            const base::Vec3 up = end.rotation * base::Vec3::UnitX();
            QVERIFY2(std::abs(up.y() - side * std::sin(12.0 * base::kDegree)) < 0.1,
                     qPrintable(QString::number(up.y())));
            // The cuboid's half sides are 4 and 6 mm, the wall is at 12.
            QVERIFY2(end.position.y() > 2e-3 && end.position.y() < 8.5e-3,
                     qPrintable(QString::number(end.position.y())));
        }
    }

    // Lying as they did before it, and not counted as fallen where it is lower than the track.
    void partsLieOnTheChute_data() { addShapes(); }
    void partsLieOnTheChute() {
        QFETCH(FeederShape, shape);
        track::TrackParameters parameters;
        parameters.shape = shape;
        parameters.chute = {90e-3, 25.0 * base::kDegree};
        constexpr int kTrials = 24;
        base::Vec3 mean = base::Vec3::Zero();
        for (const trial::PartOutcome& part : run(makeLying(parameters, kTrials))) {
            QVERIFY(part.ending == trial::Ending::finished);
            // On the track they are at 2 mm; on the chute they hop.
            QVERIFY2(part.farthest.position.z() < 1e-3,
                     qPrintable(QString::number(part.farthest.position.z())));
            mean += part.farthest.rotation * base::Vec3::UnitX();
        }
        // They hop on it, but lean neither forward nor back on average; sin 25 deg is 0.42.
        mean /= kTrials;
        QVERIFY2(std::abs(mean.x()) < 0.1 && mean.z() > 0.95, qPrintable(QString::number(mean.x())));
    }
};

QTEST_APPLESS_MAIN(EndsTest)
#include "ends_test.moc"
