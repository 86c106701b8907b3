#include "core/trial/termination_monitor.h"

#include <QtTest>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/track/track_builder.h"

using namespace trapwright;
using trial::Ending;

namespace {

track::Track makeTrack() {
    track::Track track;
    track.sections = {{0.0, {}}, {0.5, {}}};
    track.start = 0.06;
    track.finish = 0.4;
    track.width = 0.06;
    return track;
}

base::Pose at(double x, double y = 0.0, double z = 0.02) {
    return {base::Quaternion::Identity(), {x, y, z}};
}

/// What of a part tells whether it is inside the track: boxes of 2 mm at these places of its frame.
std::shared_ptr<const part::Part> makePart(const std::vector<base::Vec3>& boxes) {
    part::Part part;
    for (const base::Vec3& middle : boxes) {
        geometry::ConvexPolytope box;
        for (unsigned corner = 0; corner < 8; ++corner)
            box.vertices.emplace_back(middle + 1e-3 * base::Vec3((corner & 1U) != 0 ? 1.0 : -1.0,
                                                                 (corner & 2U) != 0 ? 1.0 : -1.0,
                                                                 (corner & 4U) != 0 ? 1.0 : -1.0));
        part.pieces.push_back(box);
    }
    return std::make_shared<const part::Part>(std::move(part));
}

/// Of one trial of `count` parts of a kind.
trial::TrialBatch makeBatch(const track::Track& track, const trial::Termination& termination,
                            std::size_t count, const std::vector<base::Vec3>& boxes = {base::Vec3::Zero()}) {
    trial::TrialBatch batch;
    batch.track = std::make_shared<const track::Track>(track);
    batch.parts = {makePart(boxes)};
    batch.termination = termination;
    batch.trials.resize(1);
    batch.trials.front().parts.resize(count);
    return batch;
}

track::Track makeLevelTrack() {
    const track::CrossSection level{40e-3, {{-30e-3, 0.0}, {0.0, 0.0}, {30e-3, 0.0}}};
    return track::buildTrack({}, std::vector{level}).value();
}

}  // namespace

/// How single parts end is tested with the engines (endings_test).
class TerminationMonitorTest : public QObject {
    Q_OBJECT

 private slots:
    // Each part has its own progress and its own end; the trial is over with the last one.
    void partsEndOneByOne() {
        const track::Track track = makeTrack();
        const trial::TrialBatch batch = makeBatch(track, {2.0, 0.5, 1e-3}, 4);
        trial::TerminationMonitor monitor(batch, batch.trials.front());
        std::vector<std::optional<Ending>> endings(4);
        std::vector<double> times(4, 0.0);
        for (int step = 0; step <= 400 && !monitor.isOver(); ++step) {
            const double time = 0.01 * step;
            // One conveys, one falls at 0.3 s, one stands still, one creeps, and comes half a second later.
            const std::vector<base::Pose> poses = {at(0.06 + 0.4 * time),
                                                   at(0.06, 0.0, time < 0.3 ? 0.02 : -0.01), at(0.1),
                                                   at(0.06 + 0.01 * time)};
            for (std::size_t part = 0; part < 4; ++part) {
                if (endings[part] || (part == 3 && time < 0.495)) continue;
                endings[part] = monitor.update(part, time, poses[part]);
                times[part] = time;
            }
        }
        QVERIFY(monitor.isOver());
        const std::vector<trial::PartOutcome>& parts = monitor.outcome().parts;
        const std::vector expected{Ending::finished, Ending::fellOff, Ending::stuck, Ending::timedOut};
        const std::vector when{0.85, 0.3, 0.5, 2.5};
        for (std::size_t part = 0; part < 4; ++part) {
            QVERIFY(endings[part] == expected[part]);
            QCOMPARE(parts[part].ending, expected[part]);
            QCOMPARE(parts[part].time, times[part]);
            QVERIFY2(std::abs(times[part] - when[part]) < 0.011, qPrintable(QString::number(times[part])));
        }
        QVERIFY(parts[0].farthest.position.x() >= track.finish);
        QCOMPARE(parts[2].farthest.position.x(), 0.1);
        QVERIFY(std::abs(parts[3].initial.position.x() - 0.065) < 1e-12);
    }

    // Whoever looks at the outcome must see it.
    void aPoseThatIsNotANumberEndsIt() {
        const trial::TrialBatch batch = makeBatch(makeTrack(), {}, 1);
        trial::TerminationMonitor monitor(batch, batch.trials.front());
        QVERIFY(!monitor.update(0, 0.0, at(0.1)));
        QVERIFY(monitor.update(0, 0.1, at(std::nan(""))) == Ending::stuck);
        QVERIFY(monitor.isOver());
        QVERIFY(!trial::isFinite(monitor.outcome()));
    }

    // What falls beside the track falls off; what falls inside its outline went through the surface.
    void aFallThroughTheSurfaceIsTold() {
        const trial::TrialBatch batch = makeBatch(makeLevelTrack(), {}, 2);
        trial::TerminationMonitor monitor(batch, batch.trials.front());
        QVERIFY(!monitor.update(0, 0.0, at(0.1)));
        QVERIFY(!monitor.update(1, 0.0, at(0.1)));
        QVERIFY(monitor.update(0, 0.1, at(0.1, 0.031, -0.002)) == Ending::fellOff);
        QVERIFY(monitor.update(1, 0.1, at(0.1, 0.029, -0.002)) == Ending::fellOff);
        QVERIFY(!monitor.outcome().parts[0].throughSurface);
        QVERIFY(monitor.outcome().parts[1].throughSurface);
    }

    // A clip tips over the border with the track's edge in its hollow, where its centre of mass is; so does a
    // part with a limb that has come under the track's base.
    void whatHooksOverABorderFallsOff() {
        const track::Track track = makeLevelTrack();
        const double under = track.baseThickness + 2e-3;
        for (const auto& [boxes, through] : std::vector<std::pair<std::vector<base::Vec3>, bool>>{
                 {{{0.0, -3e-3, 20e-3}, {0.0, 4e-3, 1e-3}}, false},
                 {{{0.0, 4e-3, 1e-3}, {0.0, 0.0, -under}}, false},
                 {{{0.0, -3e-3, 20e-3}, {0.0, -3e-3, 0.0}}, true}}) {
            const trial::TrialBatch batch = makeBatch(track, {}, 1, boxes);
            trial::TerminationMonitor monitor(batch, batch.trials.front());
            QVERIFY(!monitor.update(0, 0.0, at(0.1)));
            QVERIFY(monitor.update(0, 0.1, at(0.1, 0.029, -0.0002)) == Ending::fellOff);
            QCOMPARE(monitor.outcome().parts[0].throughSurface, through);
        }
    }

    void itIsNotOverBeforeTheLastOne() {
        const trial::TrialBatch batch = makeBatch(makeTrack(), {}, 2);
        trial::TerminationMonitor monitor(batch, batch.trials.front());
        QVERIFY(!monitor.isOver());
        QVERIFY(monitor.update(0, 0.0, at(0.45)) == Ending::finished);
        QVERIFY(!monitor.isOver());
        QVERIFY(!monitor.update(1, 0.0, at(0.1)));
        QVERIFY(monitor.update(1, 0.1, at(0.41)) == Ending::finished);
        QVERIFY(monitor.isOver());
    }
};

QTEST_APPLESS_MAIN(TerminationMonitorTest)
#include "termination_monitor_test.moc"
