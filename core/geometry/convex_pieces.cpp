#include "core/geometry/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "core/geometry/convex_cell.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/self_overlap.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

namespace {

// Relative to the diagonal of the box around the mesh:
constexpr double kPlaneTolerance = 1e-6;  // triangles this near to a plane belong to it
constexpr double kOnTolerance = 4e-6;     // corners this near to a cut are on it; above kPlaneTolerance
constexpr double kCellTolerance = 1e-9;
// How far surface may be in front of a face of its own piece. Too many pieces: take the next greater; too
// much of the volume lost: the next smaller.
constexpr std::array<double, 5> kDepths = {2e-5, 1e-4, 5e-4, 2e-3, 5e-3};
constexpr std::size_t kFirstDepth = 2;

// Relative to the volume:
constexpr double kConvexTolerance = 1e-5;
constexpr double kVolumeTolerance = 1e-2;
constexpr double kMergeTolerance = 1e-3;
constexpr double kDustVolume = 1e-7;

constexpr std::size_t kMaxPieces = 384;
constexpr std::size_t kMaxTriangles = 20000;
constexpr std::size_t kMaxCandidates = 200;

struct SurfacePolygon {
    int plane = 0;
    Polygon loop;
};

/// A convex cell of space and the surface of the solid inside it.
struct Node {
    ConvexCell cell;
    std::vector<SurfacePolygon> surface;
};

struct Surface {
    std::vector<Plane> planes;
    std::vector<SurfacePolygon> polygons;
};

/// Gives every triangle its plane, that of the largest triangle near it, so that noise does not make planes
/// of its own. Triangles lower than the tolerance have no direction of their own and are left out.
Surface collectSurface(const TriangleMesh& mesh, double tolerance) {
    std::vector<double> areas(mesh.triangles.size());
    std::vector<int> order;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const base::Vec3 ab = mesh.vertices[t[1]] - mesh.vertices[t[0]];
        const base::Vec3 ac = mesh.vertices[t[2]] - mesh.vertices[t[0]];
        areas[i] = ab.cross(ac).norm();
        if (areas[i] > tolerance * std::max({ab.norm(), ac.norm(), (ac - ab).norm()}))
            order.push_back(static_cast<int>(i));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });

    Surface surface;
    std::vector<char> taken(mesh.triangles.size(), 0);
    for (const int seed : order) {
        if (taken[seed] != 0) continue;
        Plane plane;
        plane.normal = triangleNormal(mesh, seed);
        plane.offset = plane.normal.dot(mesh.vertices[mesh.triangles[seed][0]]);
        for (const int i : order) {
            const Triangle& t = mesh.triangles[i];
            const bool belongs = taken[i] == 0 && plane.normal.dot(triangleNormal(mesh, i)) > 0.0 &&
                                 std::all_of(t.begin(), t.end(), [&](int v) {
                                     return std::abs(plane.calcHeight(mesh.vertices[v])) <= tolerance;
                                 });
            if (!belongs) continue;
            taken[i] = 1;
            surface.polygons.push_back({static_cast<int>(surface.planes.size()),
                                        {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}});
        }
        surface.planes.push_back(plane);
    }
    return surface;
}

/// What a plane does to a surface.
struct CutReport {
    double depth = 0.0;  // of the surface in front of it [m]
    int splits = 0;      // polygons with corners on both sides
};

CutReport examineCut(const std::vector<SurfacePolygon>& surface, const Plane& plane, int index,
                     double tolerance) {
    CutReport report;
    for (const SurfacePolygon& polygon : surface) {
        if (polygon.plane == index) continue;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const base::Vec3& point : polygon.loop) {
            const double height = plane.calcHeight(point);
            low = std::min(low, height);
            high = std::max(high, height);
        }
        report.depth = std::max(report.depth, high);
        if (low < -tolerance && high > tolerance) ++report.splits;
    }
    return report;
}

std::vector<int> collectPlanes(const std::vector<SurfacePolygon>& surface) {
    std::vector<int> planes;
    planes.reserve(surface.size());
    for (const SurfacePolygon& polygon : surface)
        planes.push_back(polygon.plane);
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
}

/// The plane to cut at: of those with surface in front the one that splits the fewest polygons, then the
/// deepest. None if the solid inside the node is convex. Of very many planes only some are tried, unless none
/// of those will do.
std::optional<int> findCut(const Node& node, const std::vector<Plane>& planes, double depth,
                           double tolerance) {
    const std::vector<int> candidates = collectPlanes(node.surface);
    const std::size_t stride = candidates.size() / kMaxCandidates + 1;
    for (std::size_t start = 0; start < stride; ++start) {
        std::optional<int> best;
        CutReport bestReport;
        for (std::size_t i = start; i < candidates.size(); i += stride) {
            const CutReport report =
                examineCut(node.surface, planes[candidates[i]], candidates[i], tolerance);
            if (report.depth <= depth) continue;
            const bool better = report.splits < bestReport.splits ||
                                (report.splits == bestReport.splits && report.depth > bestReport.depth);
            if (best && !better) continue;
            best = candidates[i];
            bestReport = report;
        }
        if (best) return best;
    }
    return std::nullopt;
}

/// The node behind the plane, none if there is no space behind it. Surface on the plane bounds the cell and
/// is left out.
std::optional<Node> takeBack(const Node& node, const Plane& plane, double cellTolerance, double onTolerance) {
    auto cell = clip(node.cell, plane, cellTolerance);
    if (!cell) return std::nullopt;
    Node back{std::move(*cell), {}};
    for (const SurfacePolygon& polygon : node.surface) {
        const bool reachesBehind =
            std::any_of(polygon.loop.begin(), polygon.loop.end(),
                        [&](const base::Vec3& point) { return plane.calcHeight(point) < -onTolerance; });
        if (!reachesBehind) continue;
        Polygon loop = clip(polygon.loop, plane, onTolerance);
        if (loop.size() >= 3) back.surface.push_back({polygon.plane, std::move(loop)});
    }
    return back;
}

/// Cuts until every piece is convex to within `depth`. None if that takes too many pieces.
std::optional<std::vector<ConvexPolytope>> cutApart(const TriangleMesh& mesh, const Surface& surface,
                                                    double size, double depth, double dustVolume) {
    Box box = calcBoundingBox(mesh);
    box.low.array() -= 0.01 * size;
    box.high.array() += 0.01 * size;
    std::vector<ConvexPolytope> pieces;
    std::vector<Node> open = {{makeCell(box), surface.polygons}};
    while (!open.empty()) {
        if (open.size() + pieces.size() > kMaxPieces) return std::nullopt;
        const Node node = std::move(open.back());
        open.pop_back();
        if (const auto cut = findCut(node, surface.planes, depth, kOnTolerance * size)) {
            const Plane& plane = surface.planes[*cut];
            for (const Plane& side : {plane, plane.flipped()})
                if (auto half = takeBack(node, side, kCellTolerance * size, kOnTolerance * size))
                    open.push_back(std::move(*half));
            continue;
        }
        // Convex: the solid in this cell is what is behind all of its surface; without surface, all or
        // nothing.
        std::optional<ConvexCell> solid = node.cell;
        if (node.surface.empty() && calcWindingNumber(mesh, node.cell.calcMiddle()) < 0.5) continue;
        for (const int plane : collectPlanes(node.surface))
            if (solid) solid = clip(*solid, surface.planes[plane], kCellTolerance * size);
        if (!solid) continue;
        auto piece = computeConvexHull(solid->collectPoints());
        // Cells without thickness have no hull and are not missed.
        if (piece && calcMassProperties(toMesh(*piece), 1.0).volume > dustVolume)
            pieces.push_back(std::move(*piece));
    }
    return pieces;
}

double sumVolumes(const std::vector<ConvexPolytope>& pieces) {
    return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const ConvexPolytope& piece) {
        return sum + calcMassProperties(toMesh(piece), 1.0).volume;
    });
}

constexpr double kLargestGrowth = 0.01;  // of the smaller piece's volume

struct Piece {
    ConvexPolytope shape;
    double volume = 0.0;
    Box box;
};

struct Merge {
    std::size_t first = 0;
    std::size_t second = 0;
    double added = 0.0;
    Piece result;
};

Piece makePiece(ConvexPolytope shape) {
    Piece piece;
    piece.volume = calcMassProperties(toMesh(shape), 1.0).volume;
    for (const base::Vec3& vertex : shape.vertices)
        piece.box.include(vertex);
    piece.shape = std::move(shape);
    return piece;
}

bool doTouch(const Box& a, const Box& b) {
    const double margin = 1e-6 * (a.size().norm() + b.size().norm());
    return (a.low.array() <= b.high.array() + margin).all() &&
           (b.low.array() <= a.high.array() + margin).all();
}

std::optional<Merge> tryMerge(const std::vector<Piece>& pieces, std::size_t first, std::size_t second) {
    const Piece& a = pieces[first];
    const Piece& b = pieces[second];
    if (!doTouch(a.box, b.box)) return std::nullopt;
    std::vector<base::Vec3> points = a.shape.vertices;
    points.insert(points.end(), b.shape.vertices.begin(), b.shape.vertices.end());
    auto hull = computeConvexHull(points);
    if (!hull) return std::nullopt;
    Merge merge{first, second, 0.0, makePiece(std::move(*hull))};
    merge.added = merge.result.volume - a.volume - b.volume;
    if (merge.added > kLargestGrowth * std::min(a.volume, b.volume)) return std::nullopt;
    return merge;
}

}  // namespace

base::Result<std::vector<ConvexPolytope>> computeConvexPieces(const TriangleMesh& mesh) {
    auto hull = computeConvexHull(mesh);
    if (!hull) return hull.error();
    const double volume = calcMassProperties(mesh, 1.0).volume;
    if (!(volume > 0.0))
        return base::Error{
            "No convex pieces: the mesh encloses no volume. Close it and turn its triangles outward."};
    if (isConvex(mesh, kConvexTolerance)) return std::vector{std::move(*hull)};
    if (mesh.triangles.size() > kMaxTriangles)
        return base::Error{"No convex pieces: the part is not convex and has " +
                           std::to_string(mesh.triangles.size()) + " triangles, more than " +
                           std::to_string(kMaxTriangles) + ". Export it with a coarser tolerance."};

    const double size = calcBoundingBox(mesh).size().norm();
    const Surface surface = collectSurface(mesh, kPlaneTolerance * size);
    std::array<bool, kDepths.size()> tried{};
    std::size_t depth = kFirstDepth;
    bool tooMany = false;
    while (depth < kDepths.size() && !tried[depth]) {
        tried[depth] = true;
        auto pieces = cutApart(mesh, surface, size, kDepths[depth] * size, kDustVolume * volume);
        tooMany = !pieces;
        if (pieces && std::abs(sumVolumes(*pieces) - volume) <= kVolumeTolerance * volume)
            return mergePieces(std::move(*pieces), kMergeTolerance * volume);
        if (!pieces)
            ++depth;
        else if (depth > 0)
            --depth;
    }
    if (tooMany)
        return base::Error{
            "No convex pieces: the part would need more than " + std::to_string(kMaxPieces) +
            ". Export it with a coarser tolerance, or leave out details that do not touch the track."};
    if (const auto place = findOverlap(mesh))
        return base::Error{"No convex pieces: the surface crosses or touches itself, at " +
                           formatPlace(*place) + ". Repair it in CAD and export it again."};
    return base::Error{
        "No convex pieces: they do not add up to the part's volume to within 1 %. The surface has walls "
        "thinner than 0.01 % of its size or is too finely curved. Export it with a coarser tolerance."};
}

std::vector<ConvexPolytope> mergePieces(std::vector<ConvexPolytope> pieces, double tolerance) {
    std::vector<Piece> current;
    current.reserve(pieces.size());
    for (ConvexPolytope& shape : pieces)
        current.push_back(makePiece(std::move(shape)));
    std::vector<Merge> merges;
    for (std::size_t i = 0; i < current.size(); ++i)
        for (std::size_t j = i + 1; j < current.size(); ++j)
            if (auto merge = tryMerge(current, i, j)) merges.push_back(std::move(*merge));

    std::vector<char> gone(current.size(), 0);
    double added = 0.0;
    while (!merges.empty()) {
        const auto best = std::min_element(merges.begin(), merges.end(),
                                           [](const Merge& a, const Merge& b) { return a.added < b.added; });
        if (added + best->added > tolerance) break;
        added += std::max(best->added, 0.0);
        const std::size_t first = best->first;
        const std::size_t second = best->second;
        gone[first] = gone[second] = 1;
        current.push_back(std::move(best->result));
        gone.push_back(0);
        std::erase_if(merges, [&](const Merge& m) { return gone[m.first] != 0 || gone[m.second] != 0; });
        for (std::size_t i = 0; i + 1 < current.size(); ++i)
            if (gone[i] == 0)
                if (auto merge = tryMerge(current, i, current.size() - 1))
                    merges.push_back(std::move(*merge));
    }
    std::vector<ConvexPolytope> result;
    for (std::size_t i = 0; i < current.size(); ++i)
        if (gone[i] == 0) result.push_back(std::move(current[i].shape));
    return result;
}

}  // namespace trapwright::geometry
