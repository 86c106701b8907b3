#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Writes a 3MF package in millimetres, an object for each mesh, whole or not at all, through lib3mf. `name`
/// is what a slicer shows; of several meshes with "piece 1 of 2" behind it. Errors: no triangles, a mesh that
/// 3MF cannot hold, and whatever keeps the file from being written.
base::Status write3mf(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                      const std::string& name);

/// Reads all meshes of a 3MF package's build, placed as the package says and in its unit, as one mesh.
/// Errors name the file and what is wrong with it.
base::Result<TriangleMesh> read3mf(const std::filesystem::path& path);

/// Each mesh object of a package by itself, in its own coordinates. [m] Errors as above.
base::Result<std::vector<TriangleMesh>> read3mfObjects(const std::filesystem::path& path);

/// A package's mesh, and the unit that its numbers were in.
struct PackagedMesh {
    TriangleMesh mesh;
    double unit;  // [m]
};

/// The same for who must know the unit.
base::Result<PackagedMesh> read3mfWithUnit(const std::filesystem::path& path);

/// Whether a zip package unpacks to a size that is safe to read: at most 512 MiB in all, and none of its
/// files to more than it says. Refuses packages made to fill the memory ("zip bombs") before anything is
/// unpacked into it. Errors are the reason only.
base::Status checkPackageSize(std::string_view package);

}  // namespace trapwright::geometry
