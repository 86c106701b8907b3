#include "core/geometry/near_convex_pieces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/convex_cell.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/solid_probe.h"
#include "core/geometry/surface_distance.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

namespace {

/// A hull of some of the points.
struct ThinnedHull {
    TriangleMesh mesh;
    double shortfall = 0.0;  // the farthest that any of the points is outside [m]
};

/// The convex hull of few of the points: of those farthest out, then of more, those farthest from the hull so
/// far, until none is farther outside than `tolerance` [m]. Depends on the set of points only. Error: they do
/// not span a volume.
base::Result<ThinnedHull> thinHull(std::span<const base::Vec3> points, double tolerance);

using base::Vec3;

// Relative to the diagonal of the box around the mesh:
constexpr double kOnTolerance = 4e-6;  // corners this near to a cut are on it
constexpr double kCellTolerance = 1e-9;
constexpr double kThinnest = 1e-4;    // a cut leaves at least this much on both sides
constexpr double kDustVolume = 1e-9;  // of the solid's volume
constexpr int kSamplesAcross = 8;     // on the longest edge of a hull
constexpr std::size_t kHollowSamples = 400;
constexpr std::size_t kWeighedPolygons = 1000;
constexpr std::size_t kFewPolygons = 100;
constexpr double kJitter = 1e-7;

constexpr double kLargestGrowth = 0.1;  // when two pieces are joined: of the smaller one's volume

/// A cell of space, the surface of the solid inside it, and the hull of the solid inside it.
struct Node {
    ConvexCell cell;
    std::vector<Polygon> surface;
    std::vector<Vec3> points;         // corners of the solid in the cell
    std::vector<Vec3> insideCorners;  // those of them that are the cell's
    TriangleMesh hull;
    double volume = 0.0;          // of the hull [m^3]
    double excess = 0.0;          // [m]
    Vec3 over = Vec3::Zero();     // where the hull reaches out farthest
    Vec3 under = Vec3::Zero();    // the surface nearest to it
    Vec3 deepest = Vec3::Zero();  // corner of the surface that is farthest inside the hull
};

struct Solid {
    const SolidProbe& probe;
    double size;
    double volume;
    Vec3 centre;  // of mass
    std::vector<Vec3> axes;
};

/// Twice the polygon's area, along its outward normal. [m^2]
Vec3 calcAreaVector(const Polygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
    return sum;
}

/// The node behind the plane as far as needed to weigh a cut: cell, surface and corners.
std::optional<Node> takeBack(const Node& node, const Plane& plane, const Solid& solid) {
    auto cell = clip(node.cell, plane, kCellTolerance * solid.size);
    if (!cell) return std::nullopt;
    Node back;
    back.cell = std::move(*cell);
    const double tolerance = kOnTolerance * solid.size;
    for (const Polygon& polygon : node.surface) {
        // Surface on the plane bounds the half that its solid is in.
        const bool isBehind =
            std::any_of(polygon.begin(), polygon.end(),
                        [&](const Vec3& point) { return plane.calcHeight(point) < -tolerance; }) ||
            (calcAreaVector(polygon).dot(plane.normal) > 0.0 &&
             std::all_of(polygon.begin(), polygon.end(),
                         [&](const Vec3& point) { return plane.calcHeight(point) <= tolerance; }));
        if (!isBehind) continue;
        Polygon part = clip(polygon, plane, tolerance);
        if (part.size() < 3) continue;
        back.points.insert(back.points.end(), part.begin(), part.end());
        back.surface.push_back(std::move(part));
    }
    return back;
}

/// Adds the corners of the cell that are inside the solid.
void addCellCorners(Node& node, const Solid& solid) {
    for (const Vec3& corner : node.cell.collectPoints())
        if (solid.probe.isInside(corner)) node.insideCorners.push_back(corner);
    node.points.insert(node.points.end(), node.insideCorners.begin(), node.insideCorners.end());
}

/// Makes the hull. False if there is no solid.
bool fillHull(Node& node, const Solid& solid) {
    auto hull = computeHullMesh(node.points);
    if (!hull) return false;
    node.hull = std::move(*hull);
    node.volume = calcMassProperties(node.hull, 1.0).volume;
    return node.volume > kDustVolume * solid.volume;
}

/// Notes how far the hull reaches out of the solid at this point of its surface, if farther than elsewhere.
void probeExcess(Node& node, const Solid& solid, const Vec3& point) {
    const Vec3 nearest = solid.probe.findNearest(point);
    const double distance = (nearest - point).norm();
    if (distance <= node.excess || solid.probe.isInside(point)) return;
    node.excess = distance;
    node.over = point;
    node.under = nearest;
}

/// Finds where the hull reaches out of the solid farthest, at points spread over it and over every hollow.
void measure(Node& node, const Solid& solid) {
    std::vector<Plane> planes;
    Box box;
    for (std::size_t i = 0; i < node.hull.triangles.size(); ++i) {
        const Vec3 normal = triangleNormal(node.hull, i);
        planes.push_back({normal, normal.dot(node.hull.vertices[node.hull.triangles[i][0]])});
    }
    for (const Vec3& vertex : node.hull.vertices)
        box.include(vertex);
    const double spacing = box.size().norm() / kSamplesAcross;
    for (const Triangle& t : node.hull.triangles) {
        const Vec3& a = node.hull.vertices[t[0]];
        const Vec3& b = node.hull.vertices[t[1]];
        const Vec3& c = node.hull.vertices[t[2]];
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const int n = 1 + static_cast<int>(longest / spacing);
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const bool isCorner = i == n || j == n || i + j == 0;
                if (!isCorner) probeExcess(node, solid, a + (b - a) * i / n + (c - a) * j / n);
            }
        probeExcess(node, solid, (a + b + c) / 3.0);
    }

    // Over the corners of hollows: these are narrower than the spacing, maybe.
    struct Hollow {
        double depth;
        Vec3 corner;
        Vec3 normal;
    };
    std::vector<Hollow> hollows;
    for (const Vec3& point : node.points) {
        Hollow hollow{std::numeric_limits<double>::infinity(), point, Vec3::UnitZ()};
        for (const Plane& plane : planes) {
            const double depth = -plane.calcHeight(point);
            if (depth < hollow.depth) {
                hollow.depth = depth;
                hollow.normal = plane.normal;
                if (depth < kOnTolerance * solid.size) break;
            }
        }
        if (hollow.depth > std::max(node.excess * 0.5, kOnTolerance * solid.size)) hollows.push_back(hollow);
    }
    if (hollows.empty()) return;
    std::sort(hollows.begin(), hollows.end(),
              [](const Hollow& a, const Hollow& b) { return a.depth > b.depth; });
    node.deepest = hollows.front().corner;
    const std::size_t stride = hollows.size() / kHollowSamples + 1;
    for (std::size_t i = 0; i < hollows.size(); i += stride)
        if (hollows[i].depth > node.excess)
            probeExcess(node, solid, hollows[i].corner + hollows[i].depth * hollows[i].normal);
}

Box boxOf(const Node& node) {
    Box box;
    for (const Vec3& vertex : node.hull.vertices)
        box.include(vertex);
    return box;
}

std::vector<Plane> proposeCuts(const Node& node, const Solid& solid) {
    std::vector<Plane> planes;
    const auto add = [&](const Vec3& normal, const Vec3& point) {
        if (normal.norm() < 1e-3) return;
        const Vec3 unit = normal.normalized();
        const double offset = unit.dot(point);
        const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
            return std::abs(plane.normal.dot(unit)) > 0.9999 &&
                   std::abs(std::abs(plane.offset) - std::abs(offset)) < 1e-5 * solid.size;
        });
        if (!known) planes.push_back({unit, offset});
    };
    const Vec3 across = (node.over - node.under).normalized();
    // Through its middle a ring's sector falls into equal ones, which are the fewest.
    const Box box = boxOf(node);
    for (const Vec3& point : {node.under, node.deepest, Vec3(0.5 * (box.low + box.high))}) {
        if (point.isZero(0.0)) continue;
        for (const Vec3& axis : solid.axes) {
            add(axis, point);
            add(axis.cross(point - solid.centre), point);
            add(across.cross(axis), point);
        }
        add(across, point);
    }
    return planes;
}

/// About the volume of the node's hull. Most corners occur in several polygons, and of very many only some
/// count. All are moved a little, because points in one plane make exact predicates slow.
double weigh(const Node& node, const Plane& cut, const Solid& solid) {
    std::vector<Vec3> some;
    double at = 0.0;
    const auto add = [&](const Vec3& point) {
        at += 1.0;
        some.emplace_back(point + kJitter * solid.size *
                                      Vec3(std::fmod(at * 0.8191725133961645, 1.0),
                                           std::fmod(at * 0.6710436067037893, 1.0),
                                           std::fmod(at * 0.5497004779019703, 1.0)));
    };
    const std::size_t stride = node.surface.size() / kWeighedPolygons + 1;
    for (std::size_t i = 0; i < node.surface.size(); i += stride) {
        const Polygon& polygon = node.surface[i];
        const bool all = polygon.size() > 3 || node.surface.size() < kFewPolygons;
        add(polygon[0]);
        for (std::size_t k = 1; k < polygon.size(); ++k)
            if (all || std::abs(cut.calcHeight(polygon[k])) <= kOnTolerance * solid.size) add(polygon[k]);
    }
    for (const Vec3& corner : node.insideCorners)
        add(corner);
    const auto hull = computeHullMesh(some);
    return hull ? calcMassProperties(*hull, 1.0).volume : 0.0;
}

/// The two halves of the cut that leaves the least hull volume; none if no cut leaves two.
std::vector<Node> split(const Node& node, const Solid& solid) {
    std::vector<Node> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Plane& plane : proposeCuts(node, solid)) {
        double low = 0.0;
        double high = 0.0;
        for (const Vec3& vertex : node.hull.vertices) {
            low = std::min(low, plane.calcHeight(vertex));
            high = std::max(high, plane.calcHeight(vertex));
        }
        if (low > -kThinnest * solid.size || high < kThinnest * solid.size) continue;
        std::vector<Node> halves;
        double volume = 0.0;
        for (const Plane& side : {plane, plane.flipped()}) {
            auto half = takeBack(node, side, solid);
            if (!half) continue;
            addCellCorners(*half, solid);
            volume += weigh(*half, plane, solid);
            halves.push_back(std::move(*half));
        }
        if (halves.empty() || volume >= least) continue;
        least = volume;
        best = std::move(halves);
    }
    std::erase_if(best, [&](Node& half) { return !fillHull(half, solid); });
    return best;
}

/// The hull of the solid in two cells, if it may be a piece: it adds little, so that it is worth measuring.
std::optional<Node> tryJoin(const Node& a, const Node& b, const Solid& solid) {
    const Box boxA = boxOf(a);
    const Box boxB = boxOf(b);
    const double margin = kOnTolerance * solid.size;
    if ((boxA.low.array() > boxB.high.array() + margin).any() ||
        (boxB.low.array() > boxA.high.array() + margin).any())
        return std::nullopt;
    Node joined;
    joined.points = a.hull.vertices;
    joined.points.insert(joined.points.end(), b.hull.vertices.begin(), b.hull.vertices.end());
    if (!fillHull(joined, solid)) return std::nullopt;
    if (joined.volume - a.volume - b.volume > kLargestGrowth * std::min(a.volume, b.volume))
        return std::nullopt;
    joined.points = a.points;
    joined.points.insert(joined.points.end(), b.points.begin(), b.points.end());
    return joined;
}

struct Join {
    std::size_t first = 0;
    std::size_t second = 0;
    double added = 0.0;  // volume [m^3]
    Node result;
};

/// Joins neighbours whose common hull reaches out of the solid by no more than `tolerance`, either: cutting
/// in halves leaves some. What adds least goes first.
std::vector<Node> joinNeighbours(std::vector<Node> nodes, double tolerance, const Solid& solid) {
    std::vector<Join> joins;
    const auto propose = [&](std::size_t i, std::size_t j) {
        auto node = tryJoin(nodes[i], nodes[j], solid);
        if (!node) return;
        const double added = node->volume - nodes[i].volume - nodes[j].volume;
        joins.push_back({i, j, added, std::move(*node)});
    };
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = i + 1; j < nodes.size(); ++j)
            propose(i, j);
    std::vector<char> gone(nodes.size(), 0);
    while (!joins.empty()) {
        const auto best = std::min_element(joins.begin(), joins.end(),
                                           [](const Join& a, const Join& b) { return a.added < b.added; });
        Join join = std::move(*best);
        joins.erase(best);
        measure(join.result, solid);
        if (join.result.excess > tolerance) continue;
        gone[join.first] = gone[join.second] = 1;
        nodes.push_back(std::move(join.result));
        gone.push_back(0);
        std::erase_if(joins, [&](const Join& j) { return gone[j.first] != 0 || gone[j.second] != 0; });
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
            if (gone[i] == 0) propose(i, nodes.size() - 1);
    }
    std::vector<Node> left;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (gone[i] == 0) left.push_back(std::move(nodes[i]));
    return left;
}

/// The file's axes and the principal ones.
std::vector<Vec3> findAxes(const base::Mat3& inertia) {
    const Eigen::SelfAdjointEigenSolver<base::Mat3> solver(inertia);
    std::vector<Vec3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (int k = 0; k < 3; ++k) {
        const Vec3 axis = solver.eigenvectors().col(k);
        if (axis.cwiseAbs().maxCoeff() < 0.9999) axes.push_back(axis);
    }
    return axes;
}

using base::Vec3;

constexpr double kApart = 0.3;  // corners that are added at once, of the size

/// How far each of the corners is outside the hull of some of them. [m]
std::vector<double> calcDistances(const TriangleMesh& hull, const std::vector<Vec3>& corners) {
    const SurfaceDistance surface(hull);
    std::vector<double> distances;
    distances.reserve(corners.size());
    for (const Vec3& corner : corners)
        distances.push_back(surface.calcDistance(corner));
    return distances;
}

/// Chooses the corner that is farthest outside, and others that are too far, none near one chosen before:
/// fewer hulls have to be made than if there was but one at a time. False if there is none.
bool chooseMore(const std::vector<Vec3>& corners, const std::vector<double>& distances, double tolerance,
                double apart, std::vector<char>& chosen) {
    std::vector<std::size_t> order(corners.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distances[a] > distances[b]; });
    std::vector<Vec3> added;
    for (const std::size_t i : order) {
        if (distances[i] <= tolerance) break;
        const bool isNear = std::any_of(added.begin(), added.end(), [&](const Vec3& other) {
            return (other - corners[i]).norm() < apart;
        });
        if (isNear || chosen[i] != 0) continue;
        chosen[i] = 1;
        added.push_back(corners[i]);
    }
    return !added.empty();
}

/// The corners farthest along the axes, and those farthest from their line and plane: they span a volume.
std::vector<char> chooseFirst(const std::vector<Vec3>& corners) {
    std::vector<char> chosen(corners.size(), 0);
    const auto choose = [&](auto&& measure) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < corners.size(); ++i)
            if (measure(corners[i]) > measure(corners[best])) best = i;
        chosen[best] = 1;
        return corners[best];
    };
    for (int axis = 0; axis < 3; ++axis) {
        choose([&](const Vec3& p) { return p[axis]; });
        choose([&](const Vec3& p) { return -p[axis]; });
    }
    const Vec3 a = corners.front();
    const Vec3 b = choose([&](const Vec3& p) { return (p - a).norm(); });
    const Vec3 c = choose([&](const Vec3& p) { return (b - a).cross(p - a).norm(); });
    const Vec3 normal = (b - a).cross(c - a);
    choose([&](const Vec3& p) { return normal.dot(p - a); });
    choose([&](const Vec3& p) { return -normal.dot(p - a); });
    return chosen;
}

std::vector<Vec3> take(const std::vector<Vec3>& corners, const std::vector<char>& chosen) {
    std::vector<Vec3> taken;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (chosen[i] != 0) taken.push_back(corners[i]);
    return taken;
}

base::Result<ThinnedHull> thinHull(std::span<const Vec3> points, double tolerance) {
    auto whole = computeHullMesh(points);
    if (!whole) return whole.error();
    const std::vector<Vec3> corners = whole->vertices;
    const double apart = kApart * calcBoundingBox(*whole).size().norm();
    std::vector<char> chosen = chooseFirst(corners);
    while (true) {
        auto hull = computeHullMesh(take(corners, chosen));
        if (!hull) break;
        const std::vector<double> distances = calcDistances(*hull, corners);
        const double worst = *std::max_element(distances.begin(), distances.end());
        if (worst <= tolerance) return ThinnedHull{std::move(*hull), worst};
        if (!chooseMore(corners, distances, tolerance, apart, chosen)) break;  // rounding
    }
    return ThinnedHull{std::move(*whole), 0.0};
}

}  // namespace

base::Result<NearConvexPieces> computeNearConvexPieces(const TriangleMesh& mesh, double tolerance,
                                                       double thinning, std::size_t mostPieces) {
    Box box = calcBoundingBox(mesh);
    const SolidProbe probe(mesh);
    const MassProperties mass = calcMassProperties(mesh, 1.0);
    const Solid solid{probe, box.size().norm(), mass.volume, mass.centre, findAxes(mass.inertia)};
    box.low.array() -= 0.01 * solid.size;
    box.high.array() += 0.01 * solid.size;
    Node all;
    all.cell = makeCell(box);
    for (const Triangle& t : mesh.triangles) {
        all.surface.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
        all.points.insert(all.points.end(), all.surface.back().begin(), all.surface.back().end());
    }
    if (!fillHull(all, solid)) return base::Error{"No convex pieces: the mesh encloses no volume."};
    measure(all, solid);

    std::vector<Node> open;
    std::vector<Node> done;
    const auto isBetter = [](const Node& a, const Node& b) { return a.excess < b.excess; };
    open.push_back(std::move(all));
    while (!open.empty() && open.size() + done.size() < mostPieces) {
        std::pop_heap(open.begin(), open.end(), isBetter);
        Node worst = std::move(open.back());
        open.pop_back();
        if (worst.excess <= tolerance) {
            done.push_back(std::move(worst));
            continue;
        }
        std::vector<Node> halves = split(worst, solid);
        if (halves.empty()) {
            done.push_back(std::move(worst));
            continue;
        }
        for (Node& half : halves) {
            measure(half, solid);
            open.push_back(std::move(half));
            std::push_heap(open.begin(), open.end(), isBetter);
        }
    }
    for (Node& node : open)
        done.push_back(std::move(node));
    NearConvexPieces result;
    for (const Node& node : joinNeighbours(std::move(done), tolerance, solid)) {
        const auto thinned = thinHull(node.points, thinning);
        if (!thinned) continue;
        auto piece = mergeHullFaces(thinned->mesh);
        if (!piece) continue;
        result.excess = std::max(result.excess, node.excess);
        result.shortfall = std::max(result.shortfall, thinned->shortfall);
        result.pieces.push_back(std::move(*piece));
    }
    return result;
}

}  // namespace trapwright::geometry
