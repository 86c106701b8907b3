#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "app/trapwright/exit_codes.h"
#include "core/geometry/triangle_mesh.h"
#include "core/part/part_builder.h"

namespace trapwright::app {

/// How the user names a part and tells what its file does not.
struct PartRequest {
    std::string part;                  // bundled name or file
    std::optional<std::string> units;  // of the file
    std::optional<double> density;     // [kg/m^3]
    std::optional<std::string> material;
    std::optional<double> tolerance;  // of the symmetry, as a share of the part's size
};

/// Adds --units, --density, --material and --symmetry-tolerance to a command.
void addPartOptions(CLI::App& command, PartRequest& request);

/// A part as it came in and as it is used.
struct LoadedPart {
    geometry::TriangleMesh mesh;  // as imported [m]
    std::string units;            // that the file was taken to be in
    std::string file;             // bundled name, or absolute path
    bool bundled = false;
    part::PartOptions options;  // what it was built with
    part::Part part;
    std::vector<std::string> notes;  // found and mended
};

/// Imports and builds the part. What the request leaves open: a bundled part's material, otherwise
/// `defaultDensity` [kg/m^3].
Attempt<LoadedPart> loadPart(const PartRequest& request, double defaultDensity);

}  // namespace trapwright::app
