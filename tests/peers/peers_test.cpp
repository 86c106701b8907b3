#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/geometry/convex_hull.h"
#include "core/part/specimen.h"
#include "core/track/track_solid.h"
#include "core/verify/scenes.h"
#include "core/verify/verify.h"
#include "tests/peers/bullet_engine.h"
#include "tests/peers/mujoco_engine.h"
#include "tests/peers/ode_engine.h"
#include "tests/peers/points_engine.h"
#include "tests/sim/engines/engine_scenes.h"

using namespace trapwright;
using base::Vec3;

namespace {

std::unique_ptr<trial::Engine> makeEngine(const QString& name, const trial::EngineOptions& options) {
    if (name == "ode") return std::make_unique<peers::OdeEngine>(options);
    if (name == "bullet") return std::make_unique<peers::BulletEngine>(options);
    if (name == "points") return std::make_unique<peers::PointsEngine>(options);
    return std::make_unique<peers::MujocoEngine>(options);
}

/// Whether this case of verification comes out right.
bool agrees(const QString& engine, double step, std::string_view name) {
    const trial::EngineKind kind{engine.toStdString(), [&](trial::EngineOptions options) {
                                     if (options.step == 0.0) options.step = step;
                                     return makeEngine(engine, options);
                                 }};
    const std::vector<verify::Case> cases = verify::allCases();
    const auto found = std::ranges::find(cases, name, &verify::Case::name);
    if (found == cases.end()) return false;
    bool passed = true;
    for (const verify::Row& row : found->run(kind, {})) {
        passed = passed && row.passed;
        if (!row.passed)
            qWarning("%s: expected %s, got %s", row.name.c_str(), row.expected.c_str(), row.got.c_str());
    }
    return passed;
}

void addEngines() {
    QTest::addColumn<QString>("engine");
    QTest::newRow("ode") << "ode";
    QTest::newRow("mujoco") << "mujoco";
    QTest::newRow("bullet") << "bullet";
    QTest::newRow("points") << "points";
}

}  // namespace

/// The other simulators do what they are told: the same start, the same moving track, the same endings.
class PeersTest : public QObject {
    Q_OBJECT

 private slots:
    /// A flying part knows nothing of the track's vibration, in whatever frame the simulator works.
    void flightIsAParabola_data() {
        QTest::addColumn<QString>("engine");
        QTest::addColumn<bool>("bowl");
        for (const char* engine : {"ode", "mujoco", "bullet", "points"})
            for (const bool bowl : {false, true})
                QTest::addRow("%s, %s", engine, bowl ? "bowl" : "linear") << engine << bowl;
    }
    void flightIsAParabola() {
        QFETCH(QString, engine);
        QFETCH(bool, bowl);
        track::FeederShape shape;
        if (bowl) shape.type = track::FeederType::bowl;
        trial::TrialBatch batch = testing::makeLyingOn(shape, 0.3, 0.08);
        trial::PartStart& start = batch.trials.front().parts.front();
        start.pose.position.z() += 0.06;
        start.velocity = Vec3(0.1, -0.05, 0.2);
        start.angularVelocity = Vec3(3.0, -8.0, 5.0);
        const double step = 1e-4;
        const auto replay = makeEngine(engine, {1, step})->replay(batch, 0, 0.01, {});
        QVERIFY2(replay.ok(), replay.ok() ? "" : replay.error().message.c_str());
        QVERIFY(replay->samples.size() >= 8);
        const base::Pose first = replay->samples.front().parts[0].room;
        const base::Mat3& inertia = batch.parts.front()->massProperties.inertia;
        const auto momentum = [&](const trial::TrajectorySample& sample) {
            const base::Mat3 rotation = sample.parts[0].room.rotation.toRotationMatrix();
            return Vec3(rotation * inertia * rotation.transpose() * sample.parts[0].angularVelocity);
        };
        for (const trial::TrajectorySample& sample : replay->samples) {
            QCOMPARE(sample.parts[0].contacts, 0);
            const Vec3 expected = first.position + sample.time * start.velocity -
                                  0.5 * batch.gravity * sample.time * sample.time * Vec3::UnitZ();
            // Semi-implicit steps of gravity fall short or far by half a step's worth of speed.
            const double error = 0.5 * batch.gravity * step * sample.time;
            QVERIFY2((sample.parts[0].room.position - expected).norm() < 1.1 * error + 1e-7,
                     qPrintable(QString::number((sample.parts[0].room.position - expected).norm())));
            const Vec3 before = momentum(replay->samples.front());
            QVERIFY((momentum(sample) - before).norm() < 0.01 * before.norm());
        }
    }

    void trialsDependOnNoThread_data() { addEngines(); }
    void trialsDependOnNoThread() {
        QFETCH(QString, engine);
        const auto batch = testing::makeRoughBatch(verify::makePaperCuboid(), 3, 6, 0.3);
        const auto one = makeEngine(engine, {1, 0.0})->run(std::vector{batch}, {});
        const auto two = makeEngine(engine, {2, 0.0})->run(std::vector{batch}, {});
        QVERIFY2(one.ok() && two.ok(), one.ok() ? "" : one.error().message.c_str());
        QVERIFY(*one == *two);
        const auto replay = makeEngine(engine, {1, 0.0})->replay(batch, 2, 0.05, {});
        QVERIFY(replay.ok());
        QVERIFY(replay->outcome == one->front()[2]);
    }

    void theirCostsAreTold_data() { addEngines(); }
    void theirCostsAreTold() {
        QFETCH(QString, engine);
        const auto meter = std::make_shared<trial::CostMeter>();
        const auto batch = testing::makeLyingOn({}, 0.0, 0.3);
        QVERIFY(makeEngine(engine, {1, 0.0, meter})->run(std::vector{batch}, {}).ok());
        // Bullet does all in one call, and points do without contacts.
        QVERIFY(engine == "bullet" || engine == "points" || meter->read().detection > 0.0);
        QVERIFY(meter->read().law > 0.0);
    }

    // Friction and the vibrating track arrive in the simulator as they were meant. Steps and cases are those
    // in which each of them is known to be exact enough.
    void odeSlidesAndRests() {
        QVERIFY(agrees("ode", 1e-3, "slope"));
        QVERIFY(agrees("ode", 1e-3, "sliding"));
        QVERIFY(agrees("ode", 1e-3, "plastic-hop"));
    }
    void pointsSlideAndHop() {
        QVERIFY(agrees("points", 2e-6, "sliding"));
        QVERIFY(agrees("points", 2e-6, "plastic-hop"));
    }
    /// What lies on the cut between two pieces is no surface: a cuboid of two halves slides as one of one.
    void pointsTakePartsOfPieces() {
        auto batch = testing::makeLyingOn({}, 0.3, 0.1);
        batch.drive.halfStroke = 0.0;
        batch.trials.front().parts.front().velocity = Vec3(0.2, 0.05, 0.0);
        auto halves = std::make_shared<part::Part>(*batch.parts.front());
        std::vector<Vec3> low;
        std::vector<Vec3> high;
        for (const Vec3& vertex : halves->hull.vertices) {
            (vertex.x() < 0.0 ? low : high).push_back(vertex);
            low.emplace_back(0.0, vertex.y(), vertex.z());
            high.emplace_back(0.0, vertex.y(), vertex.z());
        }
        halves->pieces = {geometry::computeConvexHull(low).value(),
                          geometry::computeConvexHull(high).value()};
        const auto way = [&] {
            const auto outcomes = makeEngine("points", {1, 0.0})->run(std::vector{batch}, {});
            const trial::PartOutcome& outcome = outcomes.value().front().front().parts.front();
            return Vec3(outcome.farthest.position - outcome.initial.position);
        };
        const Vec3 whole = way();
        batch.parts = {halves};
        const Vec3 ofHalves = way();
        QVERIFY2(whole.norm() > 2e-3, qPrintable(QString::number(whole.norm())));
        QVERIFY2((ofHalves - whole).norm() < 0.01 * whole.norm(),
                 qPrintable(QString::number((ofHalves - whole).norm() / whole.norm())));
    }
    void bulletHops() { QVERIFY(agrees("bullet", 2.5e-4, "plastic-hop")); }
    void mujocoHops() { QVERIFY(agrees("mujoco", 2.5e-4, "plastic-hop")); }

    void whatTheyCannotDoIsSaid_data() { addEngines(); }
    void whatTheyCannotDoIsSaid() {
        QFETCH(QString, engine);
        auto batch = testing::makeLyingOn({}, 0.0, 0.3);
        batch.contact.staticFriction = 0.7;
        const auto outcomes = makeEngine(engine, {1, 0.0})->run(std::vector{batch}, {});
        QVERIFY(!outcomes.ok());
        QVERIFY(outcomes.error().message.find("friction") != std::string::npos);
    }

    /// What a trial has of its own counts, and nothing else of its batch does.
    void trialsHaveTheirOwnContactDriveAndPart_data() { addEngines(); }
    void trialsHaveTheirOwnContactDriveAndPart() {
        QFETCH(QString, engine);
        const trial::TrialBatch batch = testing::makeLyingOn({}, 0.3, 0.3);
        const auto larger = std::make_shared<const part::Part>(
            part::makeSpecimen(*batch.parts.front(), {0.2e-3, Vec3::Zero()}));
        trial::TrialBatch varied = batch;
        varied.parts.push_back(larger);
        varied.trials.resize(4, batch.trials.front());
        varied.trials[1].contact = {0.3, 0.3, 0.3};
        varied.trials[2].drive = batch.drive;
        varied.trials[2].drive->halfStroke *= 1.1;
        varied.trials[3].parts.front().part = 1;
        // The same trials, each in a batch that has for all what they have of their own.
        std::vector<trial::TrialBatch> alone(4, batch);
        alone[1].contact = *varied.trials[1].contact;
        alone[2].drive = *varied.trials[2].drive;
        alone[3].parts = {larger};
        const auto outcomes = makeEngine(engine, {1, 0.0})->run(std::vector{varied}, {});
        const auto expected = makeEngine(engine, {1, 0.0})->run(alone, {});
        QVERIFY2(outcomes.ok() && expected.ok(), outcomes.ok() ? "" : outcomes.error().message.c_str());
        for (std::size_t i = 0; i < alone.size(); ++i) {
            QVERIFY(outcomes->front()[i] == (*expected)[i].front());
            QVERIFY(i == 0 || outcomes->front()[i] != outcomes->front()[0]);
        }
    }

    void overhangsAreRefused_data() {
        QTest::addColumn<QString>("engine");
        for (const char* engine : {"mujoco", "points"})
            QTest::newRow(engine) << engine;
    }
    void overhangsAreRefused() {
        QFETCH(QString, engine);
        auto batch = testing::makeLyingOn({}, 0.0, 0.3);
        auto overhanging = std::make_shared<track::Track>(*batch.track);
        for (track::CrossSection& section : overhanging->sections)
            section.points = {{-0.03, 0.015}, {0.01, 0.015}, {0.0, 0.025}, {0.03, 0.025}};
        const track::TrackSolid solid =
            track::buildTrackSolid(overhanging->shape, overhanging->sections, 3e-3);
        overhanging->solid = solid.mesh;
        overhanging->surfaceTriangles = solid.surfaceTriangles;
        batch.track = overhanging;
        const auto outcomes = makeEngine(engine, {1, 0.0})->run(std::vector{batch}, {});
        QVERIFY(!outcomes.ok());
        QVERIFY(outcomes.error().message.find("overhangs") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(PeersTest)
#include "peers_test.moc"
