#include <QtTest>
#include <cmath>

#include "core/track/track_builder.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

std::shared_ptr<const track::Track> makeFlat(const FeederShape& shape, const track::Walls& walls) {
    track::TrackParameters parameters;
    parameters.shape = shape;
    parameters.walls = walls;
    const track::CrossSection section{0.2, {{-0.03, 0.015}, {-0.01, 0.015}, {0.01, 0.015}, {0.03, 0.015}}};
    return std::make_shared<const track::Track>(track::buildTrack(parameters, {{section}}).value());
}

/// The paper's cuboid, thrown level towards a side from the middle of a still, slippery track. [m/s]
trial::TrialBatch makeThrown(std::shared_ptr<const track::Track> track, double outward) {
    const FeederShape shape = track->shape;
    trial::TrialBatch batch = testing::makeLyingOn(shape, 0.2, 0.6);
    const Vec3 across = (shape.toRoom({0.1, 0.003, 0.0}) - shape.toRoom({0.1, 0.002, 0.0})).normalized();
    batch.track = std::move(track);
    batch.drive.halfStroke = 0.0;
    batch.contact = {0.05, 0.05, 0.3};
    batch.trials[0].parts[0].velocity = outward * across;
    return batch;
}

trial::PartOutcome run(const trial::TrialBatch& batch) {
    const auto outcomes = testing::makeEngine()->run({&batch, 1}, {});
    return outcomes.value()[0][0].parts[0];
}

}  // namespace

/// decisions.md#walls in both engines.
class WallsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    void wallsKeepPartsOnTheTrack_data() {
        QTest::addColumn<FeederShape>("shape");
        QTest::addColumn<double>("outward");
        const std::pair<const char*, FeederShape> shapes[] = {
            {"linear", {}},
            {"clockwise", {FeederType::bowl, 0.175, Conveying::clockwise}},
            {"anticlockwise", {FeederType::bowl, 0.175, Conveying::anticlockwise}}};
        for (const auto& [name, shape] : shapes) {
            QTest::addRow("%s, outward", name) << shape << 0.5;
            QTest::addRow("%s, inward", name) << shape << -0.5;
        }
    }
    void wallsKeepPartsOnTheTrack() {
        QFETCH(FeederShape, shape);
        QFETCH(double, outward);
        const track::Walls wall = outward > 0.0 ? track::Walls{0.0, 10e-3} : track::Walls{10e-3, 0.0};
        const track::Walls other = outward > 0.0 ? track::Walls{10e-3, 0.0} : track::Walls{0.0, 10e-3};
        QCOMPARE(run(makeThrown(makeFlat(shape, {}), outward)).ending, trial::Ending::fellOff);
        QCOMPARE(run(makeThrown(makeFlat(shape, other), outward)).ending, trial::Ending::fellOff);
        const trial::TrialBatch kept = makeThrown(makeFlat(shape, wall), outward);
        QVERIFY(run(kept).ending != trial::Ending::fellOff);
        // It goes as far as the wall lets it, and not into it: its centre is 4 mm from its sides at least.
        const trial::Trajectory way = verify::replayScene(*testing::makeEngine(), kept, 1e-3, {});
        double farthest = 0.0;
        for (const trial::TrajectorySample& sample : way.samples) {
            const double y = sample.parts[0].track.position.y() * (outward > 0.0 ? 1.0 : -1.0);
            farthest = std::max(farthest, y);
            QVERIFY(sample.parts[0].track.position.z() > 0.015);
        }
        QVERIFY2(farthest > 20e-3 && farthest < 26.1e-3, qPrintable(QString::number(farthest)));
    }
};

QTEST_APPLESS_MAIN(WallsTest)
#include "walls_test.moc"
