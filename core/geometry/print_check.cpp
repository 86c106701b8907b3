#include "core/geometry/print_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "core/geometry/mesh_check.h"
#include "core/geometry/wall_thickness.h"

namespace trapwright::geometry {

namespace {

constexpr double kOnBed = 1e-6;           // of the size; the coordinates of an STL file are good to 1e-7
constexpr double kAngleTolerance = 1e-6;  // [rad]
constexpr double kReach = 1.25;           // between cells of one wall, in longest edges of a cell
// How thin a cell must at least be for its distance from a ridge, against the wedge of that ridge: below it
// the solid stays thin where the wedge would have grown.
constexpr double kOfWedge = 0.7;

/// Which of `count` things hang together.
class Groups {
 public:
    explicit Groups(std::size_t count) : root_(count) {
        std::iota(root_.begin(), root_.end(), std::size_t{0});
    }

    void join(std::size_t a, std::size_t b) { root_[find(a)] = find(b); }
    [[nodiscard]] std::size_t find(std::size_t i) {
        while (root_[i] != i)
            i = root_[i] = root_[root_[i]];
        return i;
    }

 private:
    std::vector<std::size_t> root_;
};

/// The members of each group, in the order of their first ones.
std::vector<std::vector<std::size_t>> listGroups(Groups& groups, std::size_t count) {
    std::map<std::size_t, std::size_t> places;
    std::vector<std::vector<std::size_t>> lists;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [place, isNew] = places.try_emplace(groups.find(i), lists.size());
        if (isNew) lists.emplace_back();
        lists[place->second].push_back(i);
    }
    return lists;
}

double distanceToSegment(const base::Vec3& point, const base::Vec3& a, const base::Vec3& b) {
    const base::Vec3 along = b - a;
    const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (point - a - t * along).norm();
}

bool isOfRidge(const TriangleMesh& mesh, const WallCell& cell, const std::vector<SharpEdge>& edges) {
    const base::Vec3 middle = cell.middle();
    return std::any_of(edges.begin(), edges.end(), [&](const SharpEdge& edge) {
        const double distance = distanceToSegment(middle, mesh.vertices[edge.from], mesh.vertices[edge.to]);
        return cell.thickness >= kOfWedge * distance * std::tan(edge.angle);
    });
}

ThinWall makeThinWall(const std::vector<WallCell>& cells, const std::vector<std::size_t>& members) {
    ThinWall wall;
    wall.thickness = cells[members.front()].thickness;
    double both = 0.0;
    for (const std::size_t i : members) {
        const WallCell& cell = cells[i];
        const int first = static_cast<int>(wall.patch.vertices.size());
        wall.patch.vertices.insert(wall.patch.vertices.end(), cell.corners.begin(), cell.corners.end());
        wall.patch.triangles.push_back({first, first + 1, first + 2});
        wall.thickness = std::min(wall.thickness, cell.thickness);
        both += cell.area;
        wall.centre += cell.area * cell.middle();
    }
    wall.centre /= both;
    wall.area = 0.5 * both;
    return wall;
}

std::vector<ThinWall> findThinWalls(const TriangleMesh& mesh, double thinnest,
                                    const std::vector<SharpEdge>& edges) {
    std::vector<WallCell> cells = findThinCells(mesh, thinnest);
    if (cells.empty()) return {};
    std::erase_if(cells, [&](const WallCell& cell) { return isOfRidge(mesh, cell, edges); });
    if (cells.empty()) return {};

    double longest = 0.0;
    for (const WallCell& cell : cells) {
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, (cell.corners[(k + 1) % 3] - cell.corners[k]).norm());
    }
    const double reach = kReach * longest;
    std::map<std::tuple<int, int, int>, std::vector<std::size_t>> boxes;
    const auto boxOf = [&](const base::Vec3& place, int axis) {
        return static_cast<int>(std::floor(place[axis] / reach));
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const base::Vec3 place = cells[i].middle();
        boxes[{boxOf(place, 0), boxOf(place, 1), boxOf(place, 2)}].push_back(i);
    }
    Groups groups(cells.size());
    const auto joinNear = [&](std::size_t i, const base::Vec3& place) {
        for (int n = 0; n < 27; ++n) {
            const auto box = boxes.find(
                {boxOf(place, 0) + n % 3 - 1, boxOf(place, 1) + n / 3 % 3 - 1, boxOf(place, 2) + n / 9 - 1});
            if (box == boxes.end()) continue;
            for (const std::size_t other : box->second) {
                if ((cells[other].middle() - place).norm() <= reach) groups.join(i, other);
            }
        }
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const base::Vec3 place = cells[i].middle();
        joinNear(i, place);
        // A wall's two sides are one wall.
        const auto triangle = static_cast<std::size_t>(cells[i].triangle);
        joinNear(i, place - cells[i].thickness * triangleNormal(mesh, triangle));
    }
    std::vector<ThinWall> walls;
    for (const auto& members : listGroups(groups, cells.size()))
        walls.push_back(makeThinWall(cells, members));
    std::stable_sort(walls.begin(), walls.end(),
                     [](const ThinWall& a, const ThinWall& b) { return a.area > b.area; });
    return walls;
}

std::vector<SharpRidge> collectRidges(const TriangleMesh& mesh, double thinnest,
                                      const std::vector<SharpEdge>& edges) {
    Groups groups(edges.size());
    std::map<int, std::size_t> seen;  // a vertex's first edge
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (const int vertex : {edges[i].from, edges[i].to}) {
            const auto [place, isNew] = seen.try_emplace(vertex, i);
            if (!isNew) groups.join(i, place->second);
        }
    }
    std::vector<SharpRidge> ridges;
    for (const auto& members : listGroups(groups, edges.size())) {
        SharpRidge ridge;
        ridge.angle = edges[members.front()].angle;
        for (const std::size_t i : members) {
            const base::Vec3& from = mesh.vertices[edges[i].from];
            const base::Vec3& to = mesh.vertices[edges[i].to];
            const double length = (to - from).norm();
            ridge.edges.emplace_back(from, to);
            ridge.angle = std::min(ridge.angle, edges[i].angle);
            ridge.length += length;
            ridge.centre += 0.5 * length * (from + to);
        }
        ridge.centre /= ridge.length;
        ridge.lost = 0.5 * thinnest / std::tan(0.5 * ridge.angle);
        ridges.push_back(std::move(ridge));
    }
    std::stable_sort(ridges.begin(), ridges.end(),
                     [](const SharpRidge& a, const SharpRidge& b) { return a.length > b.length; });
    return ridges;
}

Overhang makeOverhang(const TriangleMesh& mesh, const std::vector<double>& angles,
                      const std::vector<std::size_t>& members) {
    Overhang overhang;
    for (const std::size_t i : members) {
        const auto& [a, b, c] = mesh.triangles[i];
        const double area =
            0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
        overhang.angle = std::max(overhang.angle, angles[i]);
        overhang.triangles.push_back(static_cast<int>(i));
        overhang.area += area;
        overhang.centre += area / 3.0 * (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]);
    }
    overhang.centre /= overhang.area;
    return overhang;
}

}  // namespace

std::vector<SharpRidge> findSharpRidges(const TriangleMesh& mesh, const PrintLimits& limits) {
    return collectRidges(mesh, limits.thinnestWall, findSharpEdges(mesh, kSharpestEdge));
}

std::vector<ThinWall> findThinWalls(const TriangleMesh& mesh, const PrintLimits& limits) {
    return findThinWalls(mesh, limits.thinnestWall, findSharpEdges(mesh, kSharpestEdge));
}

std::vector<Overhang> findOverhangs(const TriangleMesh& mesh, const PrintLimits& limits) {
    double bed = mesh.vertices.front().dot(limits.direction);
    for (const Triangle& t : mesh.triangles) {
        for (const int vertex : t)
            bed = std::min(bed, mesh.vertices[vertex].dot(limits.direction));
    }
    bed += kOnBed * calcBoundingBox(mesh).size().norm();
    std::vector<double> angles(mesh.triangles.size(), 0.0);  // of those that hang over
    std::map<std::pair<int, int>, std::size_t> seen;         // an edge's first such triangle
    Groups groups(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (std::all_of(t.begin(), t.end(),
                        [&](int vertex) { return mesh.vertices[vertex].dot(limits.direction) <= bed; }))
            continue;
        const double angle = std::asin(std::clamp(-triangleNormal(mesh, i).dot(limits.direction), -1.0, 1.0));
        if (angle <= limits.steepestOverhang + kAngleTolerance) continue;
        angles[i] = angle;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
            const auto [place, isNew] = seen.try_emplace({low, high}, i);
            if (!isNew) groups.join(i, place->second);
        }
    }
    std::vector<Overhang> overhangs;
    for (const auto& members : listGroups(groups, angles.size())) {
        if (angles[members.front()] > 0.0) overhangs.push_back(makeOverhang(mesh, angles, members));
    }
    std::stable_sort(overhangs.begin(), overhangs.end(),
                     [](const Overhang& a, const Overhang& b) { return a.area > b.area; });
    return overhangs;
}

PrintReport checkClosedForPrinting(const TriangleMesh& mesh, const PrintLimits& limits) {
    PrintReport report;
    if (mesh.triangles.empty()) return report;
    const std::vector<SharpEdge> edges = findSharpEdges(mesh, kSharpestEdge);
    report.thinWalls = findThinWalls(mesh, limits.thinnestWall, edges);
    report.ridges = collectRidges(mesh, limits.thinnestWall, edges);
    report.overhangs = findOverhangs(mesh, limits);
    return report;
}

PrintReport checkForPrinting(const TriangleMesh& mesh, const PrintLimits& limits) {
    const MeshReport found = checkMesh(mesh, true);
    const bool isClosed = found.isSolid() && found.nonManifoldEdges == 0;
    PrintReport report = isClosed ? checkClosedForPrinting(mesh, limits) : PrintReport{};
    report.volume = found.volume;
    report.closed = isClosed;
    report.overlappingTriangles = found.overlappingTriangles;
    if (!mesh.triangles.empty()) report.size = calcBoundingBox(mesh).size();
    return report;
}

}  // namespace trapwright::geometry
