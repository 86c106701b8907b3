#include <QtTest>
#include <algorithm>

#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Vec3;

namespace {

/// Cuboids that come one after the other onto the start of a level track that conveys them, anyhow.
trial::TrialBatch makeStream(int trials, int parts, double spacing, double until) {
    trial::TrialBatch batch =
        verify::makeStillScene(verify::makeFlat(), verify::makePaperCuboid(), {}, until);
    batch.drive.halfStroke = 0.8e-3;
    batch.partsContact = {0.4, 0.4, 0.2};
    batch.termination.until = until;
    batch.termination.stuckTime = 1.5;
    batch.trials.clear();
    for (int i = 0; i < trials; ++i) {
        trial::TrialSpec& spec = batch.trials.emplace_back();
        spec.stream = {7, 0, 0, static_cast<std::uint32_t>(i), base::Purpose::test};
        base::Random random(spec.stream);
        spec.phase = random.uniform(0.0, 2.0 * base::kPi);
        for (int k = 0; k < parts; ++k)
            spec.parts.push_back({0,
                                  {random.rotation(), Vec3(0.06, random.uniform(-5e-3, 5e-3), 0.024)},
                                  Vec3::Zero(),
                                  Vec3::Zero(),
                                  k * spacing});
    }
    return batch;
}

std::vector<trial::Outcome> simulate(const trial::TrialBatch& batch, unsigned threads) {
    base::RunControl control;
    const auto outcomes = testing::makeEngine({threads, 0.0})->run({&batch, 1}, control);
    if (!outcomes || control.done() != static_cast<std::int64_t>(batch.trials.size())) return {};
    return outcomes->front();
}

}  // namespace

class StreamsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }
    void init() {
        if (!testing::engineKind().takesStreams) QSKIP("It simulates no streams.");
    }

    // The same bits for any number of threads, in any company, and in a replay.
    void sameBits() {
        const trial::TrialBatch stream = makeStream(3, 8, 0.3, 4.0);
        const std::vector<trial::Outcome> alone = simulate(stream, 1);
        QCOMPARE(alone.size(), std::size_t{3});
        QVERIFY(simulate(stream, 2) == alone);
        trial::TrialBatch single = testing::makeRoughBatch(verify::makePaperCuboid(), 3, 5, 0.3);
        const std::vector<trial::Outcome> singles = simulate(single, 1);
        const std::vector<trial::TrialBatch> both = {single, stream};
        const auto together = testing::makeEngine({2, 0.0})->run(both, {});
        QVERIFY(together.ok());
        QVERIFY((*together)[0] == singles && (*together)[1] == alone);
        const auto replayed = testing::makeEngine()->replay(stream, 1, 0.05, {});
        QVERIFY(replayed.ok());
        QVERIFY(replayed->outcome == alone[1]);
    }

    // The same with two kinds of parts, in a bowl, on a rough surface: a kind of part has lanes or bodies of
    // its own.
    void sameBitsOfSeveralKinds() {
        trial::TrialBatch stream = makeStream(3, 8, 0.1, 1.2);
        const track::FeederShape shape{track::FeederType::bowl, 0.175, track::Conveying::clockwise};
        stream.track = testing::makeLevelOn(shape, 0.5);
        stream.parts.push_back(verify::makeCuboid(Vec3(10, 10, 3) * kMillimetre, 2700.0));
        stream.contact.roughness = 0.1;
        for (trial::TrialSpec& spec : stream.trials) {
            for (std::size_t i = 0; i < spec.parts.size(); ++i) {
                trial::PartStart& start = spec.parts[i];
                start.part = i % 2;
                start.pose.position = shape.toRoom(start.pose.position);
            }
        }
        const std::vector<trial::Outcome> together = simulate(stream, 1);
        QCOMPARE(together.size(), std::size_t{3});
        QVERIFY(simulate(stream, 2) == together);
        trial::TrialBatch last = stream;
        last.trials.erase(last.trials.begin(), last.trials.begin() + 2);
        QVERIFY(simulate(last, 1).front() == together[2]);
        const auto replayed = testing::makeEngine()->replay(stream, 2, 0.01, {});
        QVERIFY(replayed.ok());
        QVERIFY(replayed->outcome == together[2]);
        const bool touched = std::ranges::any_of(replayed->samples, [](const auto& sample) {
            return std::ranges::any_of(sample.forces,
                                       [](const auto& force) { return force.bodyA != trial::kTrack; });
        });
        QVERIFY(touched);
    }

    // A part that lies on the track and is hit hard is not driven into it, nor is one below it.
    void aBlowFromAboveDrivesNothingIntoTheTrack() {
        trial::TrialBatch scene = verify::makeStillScene(verify::makeFlat(), nullptr, {}, 0.2);
        const auto plate = verify::makeCuboid(Vec3(12, 12, 2) * kMillimetre, 1000.0);
        scene.parts = {plate, verify::makeCuboid(Vec3(12, 12, 6) * kMillimetre, 1000.0)};
        const auto place = [](double z) {
            return base::Pose{base::Quaternion::Identity(), Vec3(0.1, 0.0, 15.0 * kMillimetre + z)};
        };
        scene.trials[0].parts = {{0, place(1.0 * kMillimetre + 1e-8)},
                                 {0, place(3.0 * kMillimetre + 2e-8)},
                                 {1, place(8.0 * kMillimetre), Vec3(0.0, 0.0, -1.0)}};
        const trial::Trajectory film = verify::replayScene(*testing::makeEngine(), scene, 2e-4, {});
        double lowest = 1.0;
        bool hit = false;
        for (const trial::TrajectorySample& sample : film.samples) {
            hit = hit || sample.parts[2].velocity.z() > -0.5;
            for (const trial::PartState& state : sample.parts)
                for (const Vec3& vertex : scene.parts[state.part / 2]->hull.vertices)
                    lowest = std::min(lowest, state.room.apply(vertex).z());
        }
        QVERIFY(hit);
        QVERIFY2(lowest > 14.9 * kMillimetre, qPrintable(QString::number(lowest)));
    }

    // Parts that never come near each other move as if each were alone, bit for bit.
    void partsFarApartAreAlone() {
        trial::TrialBatch singles = testing::makeRoughBatch(verify::makePaperCuboid(), 11, 4, 0.3);
        trial::TrialBatch together = singles;
        together.trials.resize(1);
        for (std::size_t i = 0; i < singles.trials.size(); ++i) {
            trial::TrialSpec& spec = singles.trials[i];
            spec.contact.reset();
            spec.phase = 1.0;
            spec.parts[0].pose.position.x() = 0.05 + 0.08 * static_cast<double>(i);
        }
        together.trials[0] = singles.trials[0];
        for (std::size_t i = 1; i < singles.trials.size(); ++i)
            together.trials[0].parts.push_back(singles.trials[i].parts[0]);
        const std::vector<trial::Outcome> apart = simulate(singles, 1);
        const std::vector<trial::Outcome> one = simulate(together, 1);
        QCOMPARE(one.size(), std::size_t{1});
        QCOMPARE(one[0].parts.size(), apart.size());
        for (std::size_t i = 0; i < apart.size(); ++i)
            QVERIFY2(one[0].parts[i] == apart[i].parts[0], qPrintable(QString::number(i)));
    }

    // Sooner or later each arrives; in a flat, wide channel nobody is in the way for ever.
    void allArrive() {
        const trial::TrialBatch stream = makeStream(2, 10, 0.25, 12.0);
        for (const trial::Outcome& outcome : simulate(stream, 2)) {
            QCOMPARE(outcome.parts.size(), std::size_t{10});
            double last = 0.0;
            for (std::size_t i = 0; i < outcome.parts.size(); ++i) {
                const trial::PartOutcome& part = outcome.parts[i];
                QVERIFY2(part.ending == trial::Ending::finished || part.ending == trial::Ending::fellOff,
                         qPrintable(QString::number(i)));
                QVERIFY(part.entered && *part.entered >= stream.trials[0].parts[i].time - 1e-9);
                QVERIFY(*part.entered >= last);
                last = *part.entered;
                QVERIFY(part.time > *part.entered);
            }
        }
    }

    // They push each other, and a film shows who is there when.
    void aFilmShowsWhoIsThere() {
        const trial::TrialBatch stream = makeStream(1, 6, 0.1, 8.0);
        const auto film = testing::makeEngine()->replay(stream, 0, 0.01, {});
        QVERIFY(film.ok());
        bool touched = false;
        for (std::size_t i = 0; i + 1 < film->samples.size(); ++i) {
            const trial::TrajectorySample& sample = film->samples[i];
            for (std::size_t k = 0; k < sample.parts.size(); ++k) {
                const trial::PartOutcome& part = film->outcome.parts[sample.parts[k].part];
                QVERIFY(k == 0 || sample.parts[k].part > sample.parts[k - 1].part);
                QVERIFY(sample.time >= *part.entered - 1e-9 && sample.time <= part.time + 1e-9);
            }
            for (const trial::ContactForce& force : sample.forces) {
                const auto isHere = [&](trial::Body body) {
                    return body == trial::kTrack ||
                           std::ranges::any_of(sample.parts, [&](const trial::PartState& state) {
                               return state.part == static_cast<std::size_t>(body);
                           });
                };
                QVERIFY(isHere(force.bodyA) && isHere(force.bodyB) && force.bodyB != trial::kTrack);
                touched = touched || force.bodyA != trial::kTrack;
            }
        }
        QVERIFY(touched);
    }

    void cancelled() {
        base::RunControl control;
        control.cancel();
        const trial::TrialBatch stream = makeStream(2, 10, 0.25, 1000.0);
        QVERIFY(!testing::makeEngine()->run({&stream, 1}, control).ok());
        QVERIFY(!testing::makeEngine()->replay(stream, 0, 0.1, control).ok());
    }
};

QTEST_APPLESS_MAIN(StreamsTest)
#include "streams_test.moc"
