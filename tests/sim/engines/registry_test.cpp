#include "sim/engines/registry.h"

#include <QtTest>

#include "core/study/presets.h"

using namespace trapwright;

class RegistryTest : public QObject {
    Q_OBJECT

 private slots:
    void enginesCallThemselvesAsTheyAreListed() {
        for (const trial::EngineKind& kind : engines::registry().kinds()) {
            QCOMPARE(kind.make({1, 0.0})->name(), kind.name);
            QVERIFY2(!kind.title.empty() && kind.freeMotionTolerance > 0.0, kind.name.c_str());
            QCOMPARE(kind.about.empty(), kind.role != trial::EngineRole::certifying);
        }
    }

    // What is written there is a text that knows no registry.
    void theSettingsThatAreThereFromTheBeginningNameEngines() {
        const study::Settings settings;
        for (const study::Settings& given : {settings, study::paperMode(settings)}) {
            const std::string& setting = given.simulation.engine;
            for (const trial::EngineUse use : {trial::EngineUse::learning, trial::EngineUse::judging})
                QVERIFY2(engines::registry().find(engines::registry().nameFor(setting, use)) != nullptr,
                         setting.c_str());
        }
        // The paper ran every trial in the engine that judged it.
        QCOMPARE(study::paperMode(settings).simulation.engine, engines::registry().reference().name);
    }
};

QTEST_APPLESS_MAIN(RegistryTest)
#include "registry_test.moc"
