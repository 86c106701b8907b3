#pragma once

#include "app/trapwright/console.h"
#include "app/trapwright/exit_codes.h"
#include "app/trapwright/options.h"
#include "core/part/materials.h"
#include "core/workflow/part_source.h"

namespace trapwright::app {

using workflow::LoadedPart;
using workflow::PartRequest;

/// Adds --units, --density, --material and --symmetry-tolerance to a command.
void addPartOptions(Command command, PartRequest& request);

/// The user's own folder of materials.
std::filesystem::path findOwnMaterials();

/// The pair of the part's material and this surface, of those that come with Trapwright and the user's.
Attempt<part::MaterialPair> findPair(const std::string& surface, const LoadedPart& loaded);

/// Imports and builds the part; shows how far it is where that takes a while. Ctrl-C stops it at once.
Attempt<LoadedPart> loadPart(const PartRequest& request, const Console& console);

}  // namespace trapwright::app
