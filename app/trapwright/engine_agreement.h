#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/trapwright/console.h"
#include "app/trapwright/exit_codes.h"
#include "core/trial/engine_registry.h"

namespace trapwright::app {

struct AgreementOptions {
    int trials = 1000;     // of each part on each track, in each engine
    unsigned threads = 0;  // 0: all processors
};

/// Runs this engine and the reference on the same trials (core/verify/agreement.h) with progress and Ctrl-C,
/// prints the table, and returns it as --json shows it, with "passed" for the table as a whole.
Attempt<nlohmann::ordered_json> runAgreement(const trial::EngineKind& kind, const AgreementOptions& options,
                                             const Console& console);

}  // namespace trapwright::app
