#pragma once

#include <QtTest>
#include <memory>

#include "sim/engines/registry.h"

/// For tests of what every engine must do that can learn: initTestCase_data() calls addEngines(), and so each
/// test function is run with each engine.
namespace trapwright::testing {

inline void addEngines() {
    QTest::addColumn<QString>("engine");
    for (const trial::EngineKind& kind : engines::registry().kinds())
        if (kind.role != trial::EngineRole::certifying)
            QTest::newRow(kind.name.c_str()) << QString::fromStdString(kind.name);
}

/// The engine that the running test function is for.
inline const trial::EngineKind& engineKind() {
    QFETCH_GLOBAL(QString, engine);
    return *engines::registry().find(engine.toStdString());
}

/// The same, made with these options.
inline std::unique_ptr<trial::Engine> makeEngine(const trial::EngineOptions& options = {}) {
    return engineKind().make(options);
}

}  // namespace trapwright::testing
