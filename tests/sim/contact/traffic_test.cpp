#include "sim/contact/traffic.h"

#include <QtTest>

#include "core/verify/scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Pose;
using base::Vec3;
using contact::Traffic;

namespace {

/// Cuboids 12 mm long that come at these times to the same place.
trial::TrialBatch makeArrivals(const std::vector<double>& times, double until) {
    trial::TrialBatch batch = verify::makeStillScene(
        verify::makeFlat(), verify::makeCuboid(Vec3(12, 8, 4) * kMillimetre, 1000.0), {}, 1e3);
    batch.termination.until = until;
    batch.termination.stuckTime = 1.5;
    batch.trials[0].parts.clear();
    for (const double time : times)
        batch.trials[0].parts.push_back(
            {0, {base::Quaternion::Identity(), Vec3(0.06, 0.0, 0.0171)}, Vec3::Zero(), Vec3::Zero(), time});
    return batch;
}

Pose at(double x) {
    return {base::Quaternion::Identity(), Vec3(x, 0.0, 0.0171)};
}

}  // namespace

class TrafficTest : public QObject {
    Q_OBJECT

 private slots:
    void eachWaitsForRoom() {
        const trial::TrialBatch batch = makeArrivals({0.0, 0.5, 0.6}, 0.0);
        Traffic traffic(batch, batch.trials[0]);
        auto entry = traffic.admit(0.0, {});
        QVERIFY(entry && entry->part == 0 && entry->slot == 0);
        std::vector<Pose> poses = {at(0.06)};
        QVERIFY(!traffic.admit(0.4, poses));  // not yet
        QVERIFY(!traffic.admit(0.5, poses));  // no room
        poses[0] = at(0.06 + 12.05 * kMillimetre);
        QVERIFY(!traffic.admit(0.6, poses));  // too near
        poses[0] = at(0.06 + 12.2 * kMillimetre);
        entry = traffic.admit(0.7, poses);
        QVERIFY(entry && entry->part == 1 && entry->slot == 1);
        poses.push_back(at(0.06));
        QVERIFY(!traffic.admit(0.7, poses));  // the next one finds the last in its way
        QVERIFY(!traffic.isOver(0.7));
    }

    void slotsAreUsedAgain() {
        const trial::TrialBatch batch = makeArrivals({0.0, 0.1, 0.2}, 0.0);
        Traffic traffic(batch, batch.trials[0]);
        QVERIFY(traffic.admit(0.0, {}));
        const std::vector<Pose> poses = {at(0.2), at(0.06)};
        QVERIFY(traffic.admit(0.1, std::span(poses).first(1)));
        QVERIFY(!traffic.hasEnded(1, 0.1, poses[1]));
        QVERIFY(traffic.hasEnded(0, 0.2, at(0.41)));
        traffic.leave(0);
        QVERIFY(!traffic.partOf(0));
        QVERIFY(!traffic.admit(0.2, poses));
        const std::vector<Pose> moved = {{}, at(0.1)};
        const auto entry = traffic.admit(0.2, moved);
        QVERIFY(entry && entry->part == 2 && entry->slot == 0);
        QCOMPARE(traffic.slotCount(), 2);
        QVERIFY(traffic.hasEnded(0, 0.3, at(0.41)) && traffic.hasEnded(1, 0.3, at(0.42)));
        QVERIFY(traffic.isOver(0.3));
        for (const trial::PartOutcome& part : traffic.progress().outcome().parts)
            QCOMPARE(part.ending, trial::Ending::finished);
    }

    // Of a stream: who stands still stays, and says so; who never found room never came.
    void aStreamLastsUntilItsTime() {
        const trial::TrialBatch batch = makeArrivals({0.0, 1.0, 2.0}, 5.0);
        Traffic traffic(batch, batch.trials[0]);
        QVERIFY(traffic.admit(0.0, {}));
        double x = 0.06;
        for (int i = 0; i <= 500; ++i) {
            const double time = 0.01 * i;
            // Stands from 1 s to 3 s, and on its way out at the end.
            if (time < 1.0 || (time > 3.0 && time < 3.3)) x += 0.05e-3;
            const std::vector<Pose> poses = {at(x)};
            QVERIFY(!traffic.admit(time, poses));
            QCOMPARE(traffic.hasEnded(0, time, poses[0]), i == 500);
            QCOMPARE(traffic.isOver(time), i == 500);
        }
        const trial::Outcome& outcome = traffic.progress().outcome();
        QCOMPARE(outcome.parts[0].ending, trial::Ending::timedOut);
        QCOMPARE(outcome.parts[0].entered, std::optional(0.0));
        QVERIFY(!outcome.parts[1].entered && !outcome.parts[2].entered);
        QCOMPARE(outcome.parts[2].ending, trial::Ending::timedOut);
        QCOMPARE(outcome.parts[2].time, 5.0);
        QCOMPARE(outcome.stops.size(), std::size_t{2});
        QVERIFY(std::abs(outcome.stops[0].from - 0.9) < 0.15 && std::abs(outcome.stops[0].to - 3.1) < 0.15);
        QVERIFY(outcome.stops[1].to == 5.0);
    }
};

QTEST_APPLESS_MAIN(TrafficTest)
#include "traffic_test.moc"
