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

Difference compare(const trial::Trajectory& a, const trial::Trajectory& b, std::size_t first, std::size_t last) {
    Difference difference;
    for (std::size_t i = first; i < last; ++i) {
        const base::Pose& p = a.samples[i].room;
        const base::Pose& q = b.samples[i].room;
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
        while (i < size() && simbody.samples[i].contacts == 0)
            ++i;
        return i;
    }
};

std::shared_ptr<const part::Part> makeBundled(const std::string& name) {
    const auto built = part::buildPart(part::makeBundledShape(name), {.name = name});
    return std::make_shared<const part::Part>(built.value().part);
}

FeederShape shapeOf(const QString& feeder) {
    if (feeder == "linear") return {};
    return {FeederType::bowl, 0.175, feeder == "clockwise" ? Conveying::clockwise : Conveying::anticlockwise};
}

}  // namespace

/// Both engines have one law in one source, yet their own stepping, detection and precision. Followed over a time so
/// short that chaos has not set in, the same trial must be the same in both: a difference between the laws would
/// show here long before it showed in outcomes.
class AgreementTest : public QObject {
    Q_OBJECT

 private slots:
    void aLyingPartIsConveyedAlike_data() {
        QTest::addColumn<QString>("feeder");
        QTest::addColumn<double>("halfStroke");
        QTest::addColumn<double>("heading");
        // Sticking and sliding; sliding all the time; hopping.
        for (const char* feeder : {"linear", "clockwise", "anticlockwise"})
            for (const double halfStroke : {0.3e-3, 0.45e-3, 0.8e-3})
                for (const double heading : {0.0, 0.3, 1.1})
                    QTest::addRow("%s, %g mm, %g rad", feeder, halfStroke * 1e3, heading)
                        << QString(feeder) << halfStroke << heading;
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
        for (const char* name : {"cuboid", "cone", "bracket", "cup"})
            for (const char* feeder : {"linear", "clockwise", "anticlockwise"})
                QTest::addRow("%s, %s", name, feeder) << QString(name) << QString(feeder);
    }
    void droppedPartsBounceAlike() {
        QFETCH(QString, name);
        QFETCH(QString, feeder);
        constexpr int kDrops = 60;
        trial::TrialBatch drops = testing::makeRoughBatch(makeBundled(name.toStdString()), 9, kDrops, 0.1);
        for (trial::TrialSpec& spec : drops.trials)
            spec.start.pose.position.z() += 2.0 * kMillimetre;
        const FeederShape shape = shapeOf(feeder);
        if (shape.type == FeederType::bowl) {
            drops.track = testing::makeLevelOn(shape, 0.5);
            for (trial::TrialSpec& spec : drops.trials) {
                const Vec3 place(spec.start.pose.position.x(), spec.start.pose.position.y(), 0.026);
                spec.start.pose.position = shape.toRoom(place);
            }
        }
        std::vector<double> f, t5, t10,t20,t30, r10;
        for (const trial::TrialSpec& spec : drops.trials) {
            trial::TrialBatch one = drops;
            one.trials = {spec};
            const Both both(one);
            const std::size_t touch = both.findTouch();
            Difference d = compare(both.simbody, both.native, 0, touch);
            f.push_back(d.way*1e6);
            for (auto* v : {&t5,&t10,&t20,&t30}) {
              int n = v==&t5?25: v==&t10?50:v==&t20?100:150;
              Difference e = compare(both.simbody, both.native, touch, std::min(both.size(), touch+n));
              v->push_back(e.way*1e6); if (n==50) r10.push_back(e.turn);
            }
            std::size_t tn=0; while (tn<both.size() && both.native.samples[tn].contacts==0) ++tn;
            if (touch<10||tn!=touch) qInfo("touch %d %d", (int)touch, (int)tn);
        }
        for (auto* v : {&f,&t5,&t10,&t20,&t30,&r10}) { std::sort(v->begin(), v->end()); auto&w=*v; qInfo("med %g 80%% %g 90%% %g 95%% %g max %g", w[30],w[48],w[54],w[57],w[59]); }
    }
};

QTEST_APPLESS_MAIN(AgreementTest)
#include "agreement_test.moc"
