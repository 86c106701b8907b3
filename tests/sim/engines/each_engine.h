#pragma once

#include <QtTest>
#include <memory>

#include "sim/native/native_engine.h"
#include "sim/simbody/simbody_engine.h"

/// For tests of what every engine must do: initTestCase_data() calls addEngines(), and so each test function
/// is run with each engine.
namespace trapwright::testing {

inline void addEngines() {
    QTest::addColumn<bool>("native");
    QTest::newRow("simbody") << false;
    QTest::newRow("native") << true;
}

/// The engine that the running test function is for.
inline std::unique_ptr<trial::Engine> makeEngine(const trial::EngineOptions& options = {}) {
    QFETCH_GLOBAL(bool, native);
    if (native) return std::make_unique<native::NativeEngine>(options);
    return std::make_unique<simbody::SimbodyEngine>(options);
}

}  // namespace trapwright::testing
