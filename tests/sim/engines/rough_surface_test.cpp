#include <QtTest>
#include <cmath>

#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;

namespace {

constexpr double kRoughness = 6.0 * base::kDegree;
constexpr double kFriction = 0.5;
constexpr double kSpeed = 0.3;  // [m/s]
constexpr int kSurfaces = 40;

/// The cuboid pushed along a level track that stands still, on another surface in each trial.
trial::TrialBatch makePushed(double speed, double roughness, double duration) {
    trial::TrialBatch batch = testing::makeLyingOn({}, 0.0, duration);
    batch.drive.halfStroke = 0.0;
    const trial::TrialSpec first = batch.trials.front();
    batch.trials.clear();
    for (int i = 0; i < kSurfaces; ++i) {
        trial::TrialSpec& spec = batch.trials.emplace_back(first);
        spec.stream.trial = static_cast<std::uint32_t>(i);
        spec.parts.front().velocity = {speed, 0.0, 0.0};
        spec.contact =
            trial::ContactParameters{kFriction, kFriction, 0.0, roughness, static_cast<std::uint64_t>(i)};
    }
    return batch;
}

/// How far its parts come along the track, on average. [m]
double meanWay(const trial::TrialBatch& batch) {
    const auto outcomes = testing::makeEngine({1, 0.0})->run({&batch, 1}, {});
    double sum = 0.0;
    for (const trial::Outcome& outcome : outcomes.value().front())
        sum += outcome.parts.front().farthest.position.x() - outcome.parts.front().initial.position.x();
    return sum / kSurfaces;
}

}  // namespace

/// A track whose surface leans another way in each grain.
class RoughSurfaceTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    // v^2 / (2 mu g) on a smooth one. On a rough one no energy comes from nowhere: what carries a part is the
    // grain that leans against its way most, as if friction's angle were up to so much larger.
    void itBrakesNoLessThanASmoothOne() {
        const double smooth = meanWay(makePushed(kSpeed, 0.0, 0.3));
        const double expected = kSpeed * kSpeed / (2.0 * kFriction * base::kStandardGravity);
        QVERIFY2(std::abs(smooth / expected - 1.0) < 0.02, qPrintable(QString::number(smooth / expected)));
        const double rough = meanWay(makePushed(kSpeed, kRoughness, 0.3));
        const double least =
            kSpeed * kSpeed / 2.0 / base::kStandardGravity / std::tan(std::atan(kFriction) + kRoughness);
        QVERIFY2(rough > least && rough < 0.99 * smooth,
                 qPrintable(QString("%1 of %2").arg(rough).arg(expected)));
    }

    // Less steep than friction can hold, everywhere: whoever lies stays where he is, up to the settling.
    void whatLiesOnItStays() {
        const trial::TrialBatch batch = makePushed(0.0, kRoughness, 1.0);
        const auto engine = testing::makeEngine({1, 0.0});
        for (std::size_t i = 0; i < 5; ++i) {
            const auto motion = engine->replay(batch, i, 0.1, {});
            QVERIFY(motion.ok());
            const base::Vec3 soon = motion->samples[2].parts.front().room.position;
            const base::Vec3 late = motion->samples.back().parts.front().room.position;
            QVERIFY2((late - soon).norm() < 5e-6, qPrintable(QString::number((late - soon).norm())));
        }
    }
};

QTEST_GUILESS_MAIN(RoughSurfaceTest)
#include "rough_surface_test.moc"
