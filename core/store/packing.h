#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace trapwright::store {

/// How values lie in the blobs of a study file: little-endian, on every machine.

/// Doubles, one after the other.
std::string packNumbers(std::span<const double> numbers);
/// None if the size is wrong.
std::optional<std::vector<double>> unpackNumbers(std::string_view blob);

/// x, y, z of every vertex as doubles. [m]
std::string packVertices(const std::vector<base::Vec3>& vertices);
std::optional<std::vector<base::Vec3>> unpackVertices(std::string_view blob);

/// Three 32-bit indices for every triangle.
std::string packTriangles(const std::vector<geometry::Triangle>& triangles);
/// None if the size is wrong or an index is not below vertexCount.
std::optional<std::vector<geometry::Triangle>> unpackTriangles(std::string_view blob,
                                                               std::size_t vertexCount);

}  // namespace trapwright::store
