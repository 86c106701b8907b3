#include <QtTest>
#include <chrono>

#include "core/bench/bench_scenes.h"
#include "tests/sim/engines/each_engine.h"

using namespace trapwright;

/// The benchmark's scenes, and where an engine's time goes.
class CostsTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase_data() { testing::addEngines(); }
    void initTestCase() {
        auto scenes = bench::makeScenes();
        QVERIFY2(scenes.ok(), scenes.ok() ? "" : scenes.error().message.c_str());
        scenes_ = std::move(scenes).value();
    }

    void everySceneRuns() {
        for (const bench::Scene& scene : scenes_) {
            const trial::TrialBatch batch = bench::makeBatch(scene, 1);
            const auto outcomes = testing::makeEngine({1, 0.0})->run(std::vector{batch}, {});
            QVERIFY2(outcomes.ok(), scene.name.c_str());
            const trial::PartOutcome& outcome = outcomes->front().front().parts.front();
            QVERIFY2(outcome.time > 0.1 && outcome.ending != trial::Ending::fellOff, scene.name.c_str());
        }
    }

    // Nothing is left out and nothing counted twice.
    void theyAddUpToTheWholeRun() {
        const trial::TrialBatch batch = bench::makeBatch(scenes_.front(), 4);
        const auto meter = std::make_shared<trial::CostMeter>();
        const auto engine = testing::makeEngine({1, 0.0, meter});
        const auto begin = std::chrono::steady_clock::now();
        QVERIFY(engine->run(std::vector{batch}, {}).ok());
        const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const trial::Costs costs = meter->read();
        QVERIFY(costs.detection > 0.0 && costs.law > 0.0 && costs.integration > 0.0);
        QVERIFY2(costs.total() <= whole && costs.total() > 0.9 * whole,
                 qPrintable(QString("%1 of %2 s").arg(costs.total()).arg(whole)));
    }

    void measuringChangesNoOutcome() {
        const trial::TrialBatch batch = bench::makeBatch(scenes_.front(), 4);
        const auto meter = std::make_shared<trial::CostMeter>();
        const auto measured = testing::makeEngine({2, 0.0, meter})->run(std::vector{batch}, {});
        const auto plain = testing::makeEngine({1, 0.0})->run(std::vector{batch}, {});
        QVERIFY(measured.ok() && plain.ok());
        QVERIFY(*measured == *plain);
    }

 private:
    std::vector<bench::Scene> scenes_;
};

QTEST_APPLESS_MAIN(CostsTest)
#include "costs_test.moc"
