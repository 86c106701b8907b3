#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/child_process.h"
#include "core/base/run_control.h"
#include "core/workflow/part_source.h"

/// A part that is imported in a process of its own: no file ends, stops or swells the program that asked.
namespace trapwright::workflow {

/// importPart in the program trapwright-import, with the same result bit for bit. Failures besides
/// importPart's, all of the kind `reading`: what reads the file crashed, or needs more time or memory than
/// `limits` grant, and at which stage; the program is missing. Cancelling ends it at once (kind `cancelled`).
base::Result<LoadedPart, PartFailure> importPartApart(
    const PartRequest& request, const base::RunControl& control = {},
    const std::function<void(std::string_view)>& tellStage = {}, const base::ChildLimits& limits = {});

/// What that program does from beginning to end; its exit code.
int serveImport(int count, char** arguments);

}  // namespace trapwright::workflow
