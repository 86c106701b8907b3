#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/geometry/polygon_soup.h"

namespace trapwright::geometry {

/// The polygons of a Wavefront OBJ text (Wavefront, Advanced Visualizer, appendix B1): `v` and `f` with
/// numbers from either end, `fo` as `f`, lines continued with a backslash. Normals, texture coordinates,
/// groups, lines, points and materials are passed over; no other file is opened.
/// Errors are the reason only, with the line.
base::Result<PolygonSoup> parseObj(std::string_view text);

/// The polygons of an OFF text (Geomview's manual, section 4.2.5): vertices with normals and colours
/// (COFF, NOFF, STOFF), faces with colours, comments, with or without the number of edges. Errors as above.
base::Result<PolygonSoup> parseOff(std::string_view text);

}  // namespace trapwright::geometry
