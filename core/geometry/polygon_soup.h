#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/math.h"
#include "core/base/result.h"

namespace trapwright::geometry {

/// Points and polygons as a mesh file lists them, in the unit of the file. Corners are numbers of points that
/// are there; coordinates need not be finite.
struct PolygonSoup {
    std::vector<base::Vec3> points;
    std::vector<int> corners;       // of all polygons, one polygon after the other
    std::vector<std::size_t> ends;  // behind each polygon's last corner

    [[nodiscard]] std::span<const int> polygon(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, ends[i] - begin};
    }
};

// Readers of the formats. Errors are the reason only, with the line in a text.

/// The triangles of an STL file, text or binary (3D Systems, StereoLithography Interface Specification,
/// 1988), three points of its own to each. A binary file is known by its size, because headers begin with
/// "solid", too; a few bytes behind the last triangle and stray ones in a text are passed over. Text may hold
/// several solids.
base::Result<PolygonSoup> parseStl(std::string_view bytes);

/// The polygons of a Wavefront OBJ text (Wavefront, Advanced Visualizer, appendix B1): `v` and `f` with
/// numbers from either end, `fo` as `f`, lines continued with a backslash. Normals, texture coordinates,
/// groups, lines, points and materials are passed over; no other file is opened.
base::Result<PolygonSoup> parseObj(std::string_view text);

/// The polygons of an OFF text (Geomview's manual, section 4.2.5): vertices with normals and colours
/// (COFF, NOFF, STOFF), faces with colours, comments, with or without the number of edges.
base::Result<PolygonSoup> parseOff(std::string_view text);

/// The polygons of a PLY file (Turk, The PLY Polygon File Format, 1994): text or binary of either byte order,
/// any types of number, other elements and properties passed over. Faces are `vertex_indices` or
/// `vertex_index` of the element face, or `tristrips`. What is announced is held against the size of the file
/// before memory is taken for it.
base::Result<PolygonSoup> parsePly(std::string_view bytes);

}  // namespace trapwright::geometry
