#include "core/trial/engine.h"

#include <QtTest>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <string>
#include <thread>

#include "core/trial/batch_codec.h"
#include "core/trial/predicted_speed.h"
#include "core/verify/known_motions.h"
#include "tests/sim/engines/each_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;

namespace {

using Outcomes = std::vector<std::vector<trial::Outcome>>;

Outcomes simulate(const std::vector<trial::TrialBatch>& batches, unsigned threads) {
    base::RunControl control;
    const auto outcomes = testing::makeEngine({threads, 0.0})->run(batches, control);
    if (!outcomes) return {};
    std::int64_t trials = 0;
    for (const trial::TrialBatch& batch : batches)
        trials += static_cast<std::int64_t>(batch.trials.size());
    // Every finished trial is counted once.
    return control.done() == trials ? *outcomes : Outcomes{};
}

trial::TrialBatch makeEndless(int trials) {
    trial::TrialBatch batch = testing::makeRoughBatch(verify::makePaperCuboid(), 5, trials, 1e6);
    batch.drive.halfStroke = 0.0;
    return batch;
}

}  // namespace

class EngineTest : public QObject {
    Q_OBJECT

    trial::TrialBatch batch_ = testing::makeRoughBatch(verify::makePaperCuboid(), 1, 40, 0.25);
    std::vector<trial::Outcome> outcomes_;              // of batch_ ...
    std::map<std::string, Outcomes> outcomesByEngine_;  // ... which is simulated once by each

 private slots:
    void initTestCase_data() { testing::addEngines(); }

    void init() {
        Outcomes& outcomes = outcomesByEngine_[testing::makeEngine()->name()];
        if (outcomes.empty()) outcomes = simulate({batch_}, 1);
        QCOMPARE(outcomes.size(), 1U);
        outcomes_ = outcomes[0];
    }

    // Also beside batches that ask for none.
    void aBatchHasItsOwnStep() {
        trial::TrialBatch coarse = batch_;
        coarse.trials.resize(10);
        const auto expected = testing::makeEngine({1, 0.4e-3})->run({&coarse, 1}, {});
        QVERIFY(expected.ok());
        coarse.step = 0.4e-3;
        const Outcomes both = simulate({batch_, coarse}, 2);
        QCOMPARE(both.size(), std::size_t{2});
        QVERIFY(both[0] == outcomes_);
        QVERIFY(both[1] == expected->front());
        QVERIFY(both[1] != std::vector(outcomes_.begin(), outcomes_.begin() + 10));
        const auto replayed = testing::makeEngine()->replay(coarse, 3, 0.01, {});
        QVERIFY(replayed.ok());
        QVERIFY(replayed->outcome == both[1][3]);
    }

    // A hundred of them in a period, but never longer than at 50 Hz; what was asked for counts more.
    void stepsFollowTheDrive_data() {
        QTest::addColumn<double>("frequency");
        QTest::addColumn<double>("step");
        QTest::newRow("25 Hz") << 25.0 << 0.2e-3;
        QTest::newRow("50 Hz") << 50.0 << 0.2e-3;
        QTest::newRow("100 Hz") << 100.0 << 0.1e-3;
    }
    void stepsFollowTheDrive() {
        QFETCH(double, frequency);
        QFETCH(double, step);
        trial::TrialBatch batch = batch_;
        batch.trials.resize(6);
        batch.drive.frequency = frequency;
        const auto expected = testing::makeEngine({1, step})->run({&batch, 1}, {});
        const auto finer = testing::makeEngine({1, 0.5 * step})->run({&batch, 1}, {});
        QVERIFY(expected.ok() && finer.ok());
        const Outcomes both = simulate({batch_, batch}, 2);
        QVERIFY(both[0] == outcomes_);
        QVERIFY(both[1] == expected->front());
        QVERIFY(both[1] != finer->front());
    }

    // At 0.2 ms, which is right at 50 Hz, it would be up to 4 % off.
    void hopsRightlyAtMainsTwice() {
        for (const verify::KnownMotion& known : verify::makeHopping()) {
            trial::TrialBatch scene = known.batch;
            scene.drive.frequency *= 2.0;
            scene.drive.halfStroke *= 0.25;
            const double period = scene.drive.period();
            const auto trajectory = testing::makeEngine()->replay(scene, 0, period, {});
            QVERIFY(trajectory.ok());
            const auto x = [&](std::size_t i) { return trajectory->samples[i].parts[0].room.position.x(); };
            QVERIFY(trajectory->samples.size() > 100);
            const double speed = (x(100) - x(50)) / (50.0 * period);
            const double expected = trial::calcHoppingSpeed(scene.drive, scene.contact.kineticFriction,
                                                            scene.contact.restitution, scene.gravity, 50);
            QVERIFY2(std::abs(speed / expected - 1.0) < 0.02,
                     qPrintable(
                         QString("%1: %2 %").arg(known.name.c_str()).arg(100.0 * (speed / expected - 1.0))));
        }
    }

    // Otherwise comparing them below would mean nothing.
    void trialsDiffer() {
        QCOMPARE(outcomes_.size(), batch_.trials.size());
        for (std::size_t i = 1; i < outcomes_.size(); ++i)
            QVERIFY(!(outcomes_[i] == outcomes_[0]));
    }

    void threadsDoNotMatter() {
        for (const unsigned threads : {2U, 3U, 7U})
            QVERIFY(simulate({batch_}, threads) == Outcomes{outcomes_});
    }

    void theOrderOfTrialsDoesNotMatter() {
        trial::TrialBatch reversed = batch_;
        std::reverse(reversed.trials.begin(), reversed.trials.end());
        Outcomes outcomes = simulate({reversed}, 2);
        std::reverse(outcomes.at(0).begin(), outcomes.at(0).end());
        QVERIFY(outcomes[0] == outcomes_);
    }

    void theSizeOfBatchesDoesNotMatter_data() {
        QTest::addColumn<int>("size");
        QTest::newRow("one by one") << 1;
        QTest::newRow("three") << 3;
        QTest::newRow("seventeen") << 17;
    }
    void theSizeOfBatchesDoesNotMatter() {
        QFETCH(int, size);
        std::vector<trial::TrialBatch> batches;
        for (std::size_t i = 0; i < batch_.trials.size(); i += static_cast<std::size_t>(size)) {
            trial::TrialBatch& some = batches.emplace_back(batch_);
            const auto last = std::min(batch_.trials.size(), i + static_cast<std::size_t>(size));
            some.trials.assign(batch_.trials.begin() + static_cast<std::ptrdiff_t>(i),
                               batch_.trials.begin() + static_cast<std::ptrdiff_t>(last));
        }
        std::vector<trial::Outcome> joined;
        for (const auto& outcomes : simulate(batches, 2))
            joined.insert(joined.end(), outcomes.begin(), outcomes.end());
        QVERIFY(joined == outcomes_);
    }

    // Batches of several parts and tracks, on bowls and linear feeders, in one call give what each gives
    // alone.
    void batchesDoNotSeeEachOther() {
        const auto brick = verify::makeCuboid(Vec3(3, 6, 7) * base::kMillimetre, 8500.0);
        const trial::TrialBatch flat = testing::makeLyingOn({}, 0.3, 0.2);
        const trial::TrialBatch bowl = testing::makeLyingOn({track::FeederType::bowl, 0.175}, 0.3, 0.2);
        trial::TrialBatch few = batch_;
        few.trials.resize(5);
        const std::vector<trial::TrialBatch> batches = {few, testing::makeRoughBatch(brick, 2, 6, 0.2), flat,
                                                        bowl, testing::makeRoughBatch(brick, 3, 2, 0.1)};
        const Outcomes together = simulate(batches, 2);
        QCOMPARE(together.size(), batches.size());
        for (std::size_t b = 0; b < batches.size(); ++b)
            QVERIFY(simulate({batches[b]}, 1) == Outcomes{together[b]});
    }

    void nothingToDoIsDone() {
        QCOMPARE(simulate({}, 2).size(), 0U);
        trial::TrialBatch none = batch_;
        none.trials.clear();
        const Outcomes outcomes = simulate({none, batch_}, 1);
        QCOMPARE(outcomes.size(), 2U);
        QVERIFY(outcomes[0].empty());
        QVERIFY(outcomes[1] == outcomes_);
    }

    // As it is sent to another process or machine, which puts track and parts in again.
    void aBatchThatTravelledAsBytesGivesTheSameBits() {
        const trial::TrialBatch bowl =
            testing::makeLyingOn({track::FeederType::bowl, 0.175, track::Conveying::anticlockwise}, 0.3, 0.2);
        const std::vector<trial::TrialBatch> batches = {batch_, bowl};
        const Outcomes here = simulate(batches, 1);
        std::vector<trial::TrialBatch> there;
        for (const trial::TrialBatch& batch : batches) {
            auto decoded = trial::decodeBatch(trial::encode(batch));
            QVERIFY2(decoded.ok(), decoded.ok() ? "" : decoded.error().message.c_str());
            decoded->track =
                std::make_shared<const track::Track>(trial::decodeTrack(trial::encode(*batch.track)).value());
            decoded->parts = {std::make_shared<const part::Part>(
                trial::decodePart(trial::encode(*batch.parts.front())).value())};
            there.push_back(std::move(*decoded));
        }
        const Outcomes outcomes = simulate(there, 2);
        QCOMPARE(outcomes.size(), here.size());
        for (std::size_t b = 0; b < here.size(); ++b) {
            QVERIFY(!here[b].empty());
            QVERIFY(trial::decodeOutcomes(trial::encode(outcomes[b])).value() == here[b]);
        }
    }

    void replayIsTheTrialBitForBit() {
        for (const std::size_t index : {std::size_t{0}, std::size_t{17}, batch_.trials.size() - 1}) {
            const auto replay = testing::makeEngine()->replay(batch_, index, 0.01, {});
            QVERIFY(replay.ok());
            QVERIFY(replay->outcome == outcomes_[index]);
            // A sample every 10 ms, the first at the start and the last at the end.
            const auto& samples = replay->samples;
            QCOMPARE(samples.front().time, 0.0);
            QVERIFY(samples.front().parts[0].track == outcomes_[index].parts[0].initial);
            QVERIFY(std::abs(samples.back().time - outcomes_[index].parts[0].time) < 1e-12);
            for (std::size_t i = 0; i + 1 < samples.size(); ++i)
                QVERIFY(std::abs(samples[i].time - 0.01 * static_cast<double>(i)) < 1.001e-4);
        }
    }

    void aFinerStepIsUsed() {
        const auto fine = testing::makeEngine({1, 1e-4})->run(std::vector{batch_}, {});
        QVERIFY(fine.ok());
        QVERIFY((*fine)[0] != outcomes_);
    }

    // Design: within 0.2 s; the rest is for a loaded machine.
    void cancelTakesEffectSoon() {
        for (const unsigned threads : {1U, 2U}) {
            const std::vector batches = {makeEndless(48)};
            base::RunControl control;
            const auto engine = testing::makeEngine({threads, 0.0});
            auto running = std::async(std::launch::async, [&] { return engine->run(batches, control); });
            std::this_thread::sleep_for(std::chrono::milliseconds(150));
            const auto asked = std::chrono::steady_clock::now();
            control.cancel();
            const auto result = running.get();
            const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - asked;
            QVERIFY(!result.ok());
            QVERIFY(result.error().message.find("cancelled") != std::string::npos);
            qInfo("cancelled after %.3f s with %u threads", waited.count(), threads);
            QVERIFY(waited.count() < 1.0);
        }
    }

    void aReplayCanBeCancelled() {
        const trial::TrialBatch batch = makeEndless(1);
        base::RunControl control;
        const auto engine = testing::makeEngine();
        auto running =
            std::async(std::launch::async, [&] { return engine->replay(batch, 0, 1.0, control).ok(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        control.cancel();
        QVERIFY(running.wait_for(std::chrono::seconds(1)) == std::future_status::ready);
        QVERIFY(!running.get());
    }

    void aReplayStandsStillWhilePaused() {
        base::RunControl control;
        control.pause();
        const auto engine = testing::makeEngine();
        auto running =
            std::async(std::launch::async, [&] { return engine->replay(batch_, 0, 1e-3, control); });
        QVERIFY(running.wait_for(std::chrono::milliseconds(300)) == std::future_status::timeout);
        control.resume();
        const auto paused = running.get();
        const auto straight = engine->replay(batch_, 0, 1e-3, {});
        QVERIFY(paused.ok() && straight.ok());
        QVERIFY(paused->outcome == straight->outcome);
        QCOMPARE(paused->samples.size(), straight->samples.size());
    }

    void whatCannotBeSimulatedIsRefused() {
        const auto engine = testing::makeEngine();
        const auto message = [&](const trial::TrialBatch& batch) {
            const auto result = engine->run(std::vector{batch_, batch}, {});
            return result.ok() ? std::string() : result.error().message;
        };
        trial::TrialBatch noPieces = batch_;
        auto hollow = std::make_shared<part::Part>(*batch_.parts[0]);
        hollow->name = "ghost";
        hollow->pieces.clear();
        noPieces.parts = {hollow};
        QVERIFY(message(noPieces).find("'ghost' has no convex pieces") != std::string::npos);

        trial::TrialBatch noMass = batch_;
        auto light = std::make_shared<part::Part>(*batch_.parts[0]);
        light->massProperties.mass = 0.0;
        noMass.parts = {light};
        QVERIFY(message(noMass).find("has no mass") != std::string::npos);

        trial::TrialBatch noTrack = batch_;
        noTrack.track = nullptr;
        QVERIFY(message(noTrack).find("no track") != std::string::npos);

        trial::TrialBatch noPart = batch_;
        noPart.trials[3].parts.clear();
        QVERIFY(message(noPart).find("Trial 3 of the batch has no part") != std::string::npos);

        trial::TrialBatch unknown = batch_;
        unknown.trials[3].parts[0].part = 1;
        QVERIFY(message(unknown).find("Trial 3 places a part that is not among the 1") != std::string::npos);

        const auto beyond = engine->replay(batch_, 40, 0.01, {});
        QVERIFY(!beyond.ok());
        QVERIFY(beyond.error().message.find("There is no trial 40: the batch has 40") != std::string::npos);
    }

    // Kinds of parts, materials and drives trial by trial: each trial ends as it does in a batch where all is
    // of this kind, bit for bit.
    void trialsOfTheirOwnKindOfPartMaterialAndDrive() {
        const auto engine = testing::makeEngine();
        trial::TrialBatch mixed = batch_;
        auto smaller = std::make_shared<part::Part>(*mixed.parts[0]);
        for (geometry::ConvexPolytope& piece : smaller->pieces) {
            for (base::Vec3& vertex : piece.vertices)
                vertex *= 0.9;
            for (geometry::PolytopeFace& face : piece.faces)
                face.offset *= 0.9;
        }
        smaller->massProperties.inertia *= 0.81;
        mixed.parts.push_back(smaller);
        trial::TrialBatch uniform = mixed;
        uniform.parts = {smaller};
        uniform.contact = {0.3, 0.25, 0.4};
        uniform.drive = {51.0, 0.7e-3, 13.0 * base::kDegree};
        for (std::size_t i = 0; i < mixed.trials.size(); ++i) {
            uniform.trials[i].contact.reset();
            if (i % 2 == 0) continue;
            mixed.trials[i].parts[0].part = 1;
            mixed.trials[i].contact = uniform.contact;
            mixed.trials[i].drive = uniform.drive;
        }
        trial::TrialBatch plain = batch_;
        plain.step = uniform.step = mixed.step = 0.2e-3;  // whatever the drive is
        const auto without = engine->run(std::vector{plain}, {});
        const auto own = engine->run(std::vector{mixed}, {});
        const auto alike = engine->run(std::vector{uniform}, {});
        QVERIFY(without.ok() && own.ok() && alike.ok());
        for (std::size_t i = 0; i < mixed.trials.size(); ++i) {
            const trial::PartOutcome& expected = (i % 2 == 0 ? *without : *alike)[0][i].parts[0];
            const trial::PartOutcome& got = (*own)[0][i].parts[0];
            QCOMPARE(got.time, expected.time);
            QVERIFY(got.ending == expected.ending);
            QVERIFY(got.farthest.position == expected.farthest.position);
            QVERIFY(got.farthest.rotation.coeffs() == expected.farthest.rotation.coeffs());
        }
        const auto replay = engine->replay(mixed, 3, 0.01, {});
        QVERIFY(replay.ok());
        QVERIFY(replay->outcome.parts[0].farthest.position == (*own)[0][3].parts[0].farthest.position);
    }
};

QTEST_APPLESS_MAIN(EngineTest)
#include "engine_test.moc"
