#pragma once

#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

/// Of sheets that lie on each other back to back, with no solid between them.
enum class FacingSheets {
    belongApart,     // each to the solid behind it: two solids touch there
    belongTogether,  // to each other, even if they are connected elsewhere: one solid has a gap there
};

/// Takes apart what only touches: at edges and corners of several sheets each gets vertices of its own, so
/// that solids that stand on or beside each other come apart although they were welded. At an edge of more
/// than two triangles, two that are connected elsewhere belong together; else those that have solid between
/// them, by the way they face; of several that lie on each other, those that close shells. Edges that as many
/// triangles run along one way as the other are treated so, others stay. Triangles keep their order. `mesh`
/// must be welded.
TriangleMesh separateSheets(const TriangleMesh& mesh, FacingSheets facing = FacingSheets::belongApart);

}  // namespace trapwright::geometry
