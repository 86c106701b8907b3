#include "sim/native/trial_lanes.h"

#include <QtTest>
#include <array>
#include <cmath>

#include "sim/native/kernel.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using native::TrialLanes;

namespace {

/// What a group needs to stand on: a part, a track, and trials with a start of their own.
struct Scene {
    trial::TrialBatch batch = testing::makeRoughBatch(verify::makePaperCuboid(), 3, 40, 1.0);
    native::PackedBody body{contact::prepareBody(batch.parts.front()->pieces)};
    native::PackedTrack track{contact::prepareTrack(batch.track->solid)};
    native::LaneModel model{*batch.parts.front(), body, batch.gravityVector(), 2e-4, false};

    void add(TrialLanes& group, std::size_t trial) const { group.add(track, batch, batch.trials[trial]); }
};

void step(TrialLanes& group, int steps) {
    for (int i = 0; i < steps; ++i) {
        native::beginStep(group);
        native::finishStep(group);
    }
}

bool areSame(const base::Pose& a, const base::Pose& b) {
    return a.position == b.position && a.rotation.coeffs() == b.rotation.coeffs();
}

}  // namespace

class TrialLanesTest : public QObject {
    Q_OBJECT

    Scene scene_;

 private slots:
    // A batch says where the part starts on a track that rests; the drive's phase carries both along.
    void trialsStartWhereTheySay() {
        TrialLanes group(scene_.model, 5);
        for (std::size_t i = 0; i < 5; ++i)
            scene_.add(group, i);
        QCOMPARE(group.count(), 5);
        for (int lane = 0; lane < 5; ++lane) {
            const base::Pose& start = scene_.batch.trials[static_cast<std::size_t>(lane)].parts[0].pose;
            const base::Pose got = group.poseInTrack(lane);
            QVERIFY((got.position - start.position).norm() < 1e-9);
            QVERIFY(got.rotation.angularDistance(start.rotation) < 1e-6);
        }
    }

    // Where a trial runs and what runs beside it does not show in a single bit, also after others have ended
    // and the lane has moved.
    void lanesKnowNothingOfEachOther() {
        constexpr int kSteps = 250;
        TrialLanes crowd(scene_.model, 40);
        for (std::size_t i = 0; i < 40; ++i)
            scene_.add(crowd, i);
        step(crowd, kSteps);
        // The last moves to the first lane and so on.
        for (const int lane : {0, 7, 8})
            crowd.remove(lane);
        QCOMPARE(crowd.count(), 37);
        step(crowd, kSteps);
        const std::array<std::pair<int, std::size_t>, 5> followed = {
            {{0, 39}, {7, 38}, {8, 37}, {1, 1}, {36, 36}}};
        for (const auto& [lane, trial] : followed) {
            TrialLanes alone(scene_.model, 1);
            scene_.add(alone, trial);
            step(alone, 2 * kSteps);
            QVERIFY(areSame(alone.poseInRoom(0), crowd.poseInRoom(lane)));
        }
    }

    // A lane that is taken again remembers nothing of the trial before.
    void aLaneBeginsAfresh() {
        TrialLanes used(scene_.model, 3);
        for (std::size_t i = 0; i < 3; ++i)
            scene_.add(used, i);
        step(used, 400);
        used.remove(2);
        scene_.add(used, 11);
        TrialLanes fresh(scene_.model, 1);
        scene_.add(fresh, 11);
        step(used, 400);
        step(fresh, 400);
        QVERIFY(fresh.pairsOf(0).vertices.rows() > 0);  // it has come near the track
        QVERIFY(areSame(used.poseInRoom(2), fresh.poseInRoom(0)));
    }

    // Rotations stay rotations in floats.
    void rotationsStayUnit() {
        TrialLanes group(scene_.model, 16);
        for (std::size_t i = 0; i < 16; ++i)
            scene_.add(group, i);
        step(group, 3000);
        for (int lane = 0; lane < 16; ++lane)
            QVERIFY(std::abs(group.poseInRoom(lane).rotation.norm() - 1.0) < 1e-6);
    }

    void fewContactsAreLeftOfMany() {
        native::ContactList found;
        found.reserve(40);
        for (int i = 0; i < 40; ++i) {
            const float angle = 0.157F * static_cast<float>(i);
            found.next() = {
                {5e-3F * std::cos(angle), 5e-3F * std::sin(angle), -2e-3F, 0.0F, 0.0F, 1.0F, 1e-6F},
                static_cast<std::uint64_t>(i)};
            found.keepIf(true);
        }
        native::reduceContacts(found);
        QVERIFY(found.size() > 2 && found.size() <= static_cast<std::size_t>(native::WarmStartCache::kMost));
        // Those that are left are some of them, in order.
        for (std::size_t i = 0; i + 1 < found.size(); ++i)
            QVERIFY(found[i].feature < found[i + 1].feature);
    }
};

QTEST_APPLESS_MAIN(TrialLanesTest)
#include "trial_lanes_test.moc"
