#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/geometry/polygon_soup.h"

namespace trapwright::geometry {

/// The triangles of an STL file, text or binary (3D Systems, StereoLithography Interface Specification,
/// 1988), three points of its own to each. A binary file is known by its size, because headers begin with
/// "solid", too; a few bytes behind the last triangle and stray ones in a text are passed over. Text may hold
/// several solids. Errors are the reason only.
base::Result<PolygonSoup> parseStl(std::string_view bytes);

}  // namespace trapwright::geometry
