#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/geometry/polygon_soup.h"

namespace trapwright::geometry {

/// The polygons of a PLY file (Turk, The PLY Polygon File Format, 1994): text or binary of either byte order,
/// any types of number, other elements and properties passed over. Faces are `vertex_indices` or
/// `vertex_index` of the element face, or `tristrips`. What is announced is held against the size of the file
/// before memory is taken for it. Errors are the reason only.
base::Result<PolygonSoup> parsePly(std::string_view bytes);

}  // namespace trapwright::geometry
