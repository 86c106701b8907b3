#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "sim/native/native_engine.h"
#include "sim/simbody/simbody_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Vec3;
using track::Conveying;
using track::FeederShape;
using track::FeederType;

namespace {

constexpr double kMicrometre = 1e-6;
constexpr double kStep = simbody::SimbodyEngine::kDefaultStep;
static_assert(kStep == native::NativeEngine::kDefaultStep);

/// How far two engines' replays of one trial are apart.
struct Difference {
    double way = 0.0;   // greatest distance of the centres [m]
    double turn = 0.0;  // greatest angle [rad]
};

Difference compare(const trial::Trajectory& a, const trial::Trajectory& b, std::size_t first,
                   std::size_t last) {
    Difference difference;
    for (std::size_t i = first; i < last; ++i) {
        const base::Pose& p = a.samples[i].parts[0].room;
        const base::Pose& q = b.samples[i].parts[0].room;
        difference.way = std::max(difference.way, (p.position - q.position).norm());
        difference.turn = std::max(difference.turn, p.rotation.angularDistance(q.rotation));
    }
    return difference;
}

QByteArray describe(const Difference& difference) {
    return QString("%1 nm and %2 rad apart").arg(difference.way * 1e9).arg(difference.turn).toLatin1();
}

/// The same trial by both engines, every step.
struct Both {
    trial::Trajectory simbody, native;

    explicit Both(const trial::TrialBatch& batch)
        : simbody(verify::replayScene(simbody::SimbodyEngine(), batch, kStep, {})),
          native(verify::replayScene(native::NativeEngine({}), batch, kStep, {})) {}

    [[nodiscard]] std::size_t size() const { return std::min(simbody.samples.size(), native.samples.size()); }
    /// The first sample after an impulse; size() if there is none.
    [[nodiscard]] std::size_t findTouch() const {
        std::size_t i = 0;
        while (i < size() && simbody.samples[i].parts[0].contacts == 0)
            ++i;
        return i;
    }
};

std::shared_ptr<const part::Part> makeBundled(const std::string& name) {
    const auto built = part::buildPart(part::makeBundledShape(name), {.name = name});
    return std::make_shared<const part::Part>(built.value().part);
}

FeederShape shapeOf(const QString& feeder) {
    const double slope = feeder.endsWith("climbs") ? 3.0 : feeder.endsWith("falls") ? -3.0 : 0.0;
    FeederShape shape{FeederType::bowl, 0.175, Conveying::clockwise, slope * base::kDegree};
    if (feeder.startsWith("linear")) shape.type = FeederType::linear;
    if (feeder.startsWith("anticlockwise")) shape.conveying = Conveying::anticlockwise;
    return shape;
}

}  // namespace

/// Both engines have one law in one source, yet their own stepping, detection and precision. Followed over a
/// time so short that chaos has not set in, the same trial must be the same in both: a difference between the
/// laws would show here long before it showed in outcomes.
class AgreementTest : public QObject {
    Q_OBJECT

 private slots:
    void aLyingPartIsConveyedAlike_data() {
        QTest::addColumn<QString>("feeder");
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("heading");
        // Sticking and sliding; sliding all the time; hopping, which on the facets of a helix is chaotic.
        for (const char* feeder :
             {"linear", "clockwise", "anticlockwise", "linear, climbs", "linear, falls", "clockwise, climbs"})
            for (const double halfStroke : {0.3e-3, 0.45e-3, 0.8e-3})
                for (const double heading : {0.0, 0.3, 1.1}) {
                    if (halfStroke > 0.5e-3 && QString(feeder) == "clockwise, climbs") continue;
                    QTest::addRow("%s, %g mm, %g rad", feeder, halfStroke * 1e3, heading)
                        << QString(feeder) << halfStroke << heading;
                }
    }
    void aLyingPartIsConveyedAlike() {
        QFETCH(QString, feeder);
        QFETCH(double, halfStroke);
        QFETCH(double, heading);
        trial::TrialBatch batch = testing::makeLyingOn(shapeOf(feeder), heading, 0.1);
        batch.drive.halfStroke = halfStroke;
        const Both both(batch);
        QVERIFY(both.findTouch() < 100);
        const Difference difference = compare(both.simbody, both.native, 0, both.size());
        QVERIFY2(difference.way < kMicrometre && difference.turn < 1e-4, describe(difference));
    }

    void droppedPartsBounceAlike_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("feeder");
        QTest::addColumn<int>("alike");
        for (const char* feeder : {"linear", "clockwise", "anticlockwise"}) {
            for (const char* name : {"cuboid", "cone", "bracket"})
                QTest::addRow("%s, %s", name, feeder) << QString(name) << QString(feeder) << 57;
            // Corners of its rim hit two at a time, and then what comes out hangs on which is solved first.
            QTest::addRow("cup, %s", feeder) << QString("cup") << QString(feeder) << 36;
        }
        for (const char* feeder : {"linear, climbs", "anticlockwise, falls"})
            QTest::addRow("cuboid, %s", feeder) << QString("cuboid") << QString(feeder) << 57;
    }
    // Of 60 drops onto the rough linear track or a level bowl at least so many are alike until 10 ms after
    // the first impact; in flight all are.
    void droppedPartsBounceAlike() {
        QFETCH(QString, name);
        QFETCH(QString, feeder);
        QFETCH(int, alike);
        constexpr int kDrops = 60;
        constexpr std::size_t kFollowed = 50;  // steps
        trial::TrialBatch drops = testing::makeRoughBatch(makeBundled(name.toStdString()), 9, kDrops, 0.1);
        const FeederShape shape = shapeOf(feeder);
        if (shape.type == FeederType::bowl) {
            drops.track = testing::makeLevelOn(shape, 0.5);
        } else {
            track::Track tilted = *drops.track;
            tilted.shape = shape;
            drops.track = std::make_shared<const track::Track>(std::move(tilted));
        }
        int count = 0;
        for (const trial::TrialSpec& spec : drops.trials) {
            trial::TrialBatch one = drops;
            one.trials = {spec};
            Vec3& position = one.trials[0].parts[0].pose.position;
            // No part is that long.
            if (shape.type == FeederType::bowl)
                position = shape.toRoom({position.x(), position.y(), 26.0 * kMillimetre});
            else
                position.z() += 2.0 * kMillimetre;
            const Both both(one);
            const std::size_t touch = both.findTouch();
            QVERIFY(touch > 5 && touch + kFollowed < both.size());
            const Difference inFlight = compare(both.simbody, both.native, 0, touch);
            QVERIFY2(inFlight.way < 2e-8 && inFlight.turn < 1e-6, describe(inFlight));
            const Difference after = compare(both.simbody, both.native, touch, touch + kFollowed);
            count += after.way < 0.1 * kMicrometre && after.turn < 2e-5 ? 1 : 0;
        }
        QVERIFY2(count >= alike, qPrintable(QString("%1 of %2").arg(count).arg(kDrops)));
    }
};

QTEST_APPLESS_MAIN(AgreementTest)
#include "agreement_test.moc"
