#pragma once

#include <CLI/App.hpp>

#include "app/trapwright/exit_codes.h"
#include "core/work/part_source.h"

namespace trapwright::app {

using work::LoadedPart;
using work::PartRequest;

/// Adds --units, --density, --material and --symmetry-tolerance to a command.
void addPartOptions(CLI::App& command, PartRequest& request);

/// Imports and builds the part.
Attempt<LoadedPart> loadPart(const PartRequest& request);

}  // namespace trapwright::app
