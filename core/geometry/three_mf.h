#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Writes a 3MF package with one object in millimetres, whole or not at all, through lib3mf. `name` is what a
/// slicer shows. Errors: no triangles, a mesh that 3MF cannot hold, and whatever keeps the file from being
/// written.
base::Status write3mf(const std::filesystem::path& path, const TriangleMesh& mesh, const std::string& name);

/// Reads all meshes of a 3MF package's build, placed as the package says and in its unit, as one mesh.
/// Errors name the file and what is wrong with it.
base::Result<TriangleMesh> read3mf(const std::filesystem::path& path);

/// A package's mesh, and the unit that its numbers were in.
struct PackagedMesh {
    TriangleMesh mesh;
    double unit;  // [m]
};

/// The same for who must know the unit.
base::Result<PackagedMesh> read3mfWithUnit(const std::filesystem::path& path);

}  // namespace trapwright::geometry
