#pragma once

#include <filesystem>
#include <span>

#include "core/base/math.h"
#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::part {

/// Writes the solid between a polygon in the x-y plane and its copy at z = depth as a STEP file in
/// millimetres. [m] The file depends on the shape and OpenCASCADE's version only, not on the time. Error: it
/// cannot be written.
base::Status writeStepPrism(const std::filesystem::path& path, std::span<const base::Vec2> polygon,
                            double depth);

/// Writes a closed, oriented, manifold mesh as one solid of plane faces with common edges (a boundary
/// representation, AP214) as a STEP file in millimetres, whole or not at all. Triangles in one plane are one
/// face; the shape is the mesh's exactly, so that what is machined is what was simulated: a twisted quad of a
/// track's surface stays the two triangles that it was learned as. Errors: no such solid, or the file cannot
/// be written.
base::Status writeStepSolid(const std::filesystem::path& path, const geometry::TriangleMesh& solid);

/// What OpenCASCADE finds in a STEP file.
struct StepContents {
    int solids = 0;
    int faces = 0;
    bool valid = false;   // each shape passes OpenCASCADE's own check, and all shells are closed
    double volume = 0.0;  // of all solids [m^3]
    base::Vec3 size = base::Vec3::Zero();  // of the box around all corners [m]
};

/// Reads a STEP file to check it. Error: it cannot be read.
base::Result<StepContents> inspectStep(const std::filesystem::path& path);

}  // namespace trapwright::part
