#include "core/geometry/sheet_separation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace trapwright::geometry {

namespace {

constexpr double kSameAngle = 1e-4;  // between triangles at an edge [rad]; welding moves corners

class Groups {
 public:
    explicit Groups(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parents_[find(a)] = find(b); }

 private:
    std::vector<std::size_t> parents_;
};

/// A triangle at an edge that runs from its lower to its higher vertex.
struct Side {
    std::size_t triangle = 0;
    bool forward = false;
    double angle = 0.0;       // about the edge [rad]
    std::size_t cluster = 0;  // number of the angle, the same for those that lie on each other
};

using Edge = std::pair<int, int>;
using Sides = std::vector<Side>;
using SidePair = std::pair<std::size_t, std::size_t>;  // of triangles

std::map<Edge, Sides> collectSides(const TriangleMesh& mesh) {
    std::map<Edge, Sides> sides;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int from = mesh.triangles[i][k];
            const int to = mesh.triangles[i][(k + 1) % 3];
            sides[std::minmax(from, to)].push_back({i, from < to});
        }
    return sides;
}

bool isBalanced(const Sides& sides) {
    const auto forward =
        std::count_if(sides.begin(), sides.end(), [](const Side& side) { return side.forward; });
    return 2 * static_cast<std::size_t>(forward) == sides.size();
}

/// Takes out those pairs whose triangles hang together elsewhere as well.
std::vector<SidePair> takeConnected(Sides& sides, Groups& sheets) {
    std::map<std::size_t, Sides> bySheet;
    for (const Side& side : sides)
        bySheet[sheets.find(side.triangle)].push_back(side);
    std::vector<SidePair> pairs;
    sides.clear();
    for (const auto& [sheet, members] : bySheet) {
        if (members.size() == 2 && isBalanced(members))
            pairs.emplace_back(members[0].triangle, members[1].triangle);
        else
            sides.insert(sides.end(), members.begin(), members.end());
    }
    return pairs;
}

void sortByAngle(const TriangleMesh& mesh, const Edge& edge, FacingSheets facing, Sides& sides) {
    const base::Vec3& origin = mesh.vertices[edge.first];
    const base::Vec3 along = (mesh.vertices[edge.second] - origin).normalized();
    const base::Vec3 across = along.unitOrthogonal();
    const base::Vec3 third = along.cross(across);
    for (Side& side : sides) {
        const Triangle& t = mesh.triangles[side.triangle];
        const int apex = t[0] + t[1] + t[2] - edge.first - edge.second;
        const base::Vec3 towards = mesh.vertices[apex] - origin;
        side.angle = std::atan2(towards.dot(third), towards.dot(across));
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.angle < b.angle; });
    // Begin after the widest gap, so that triangles at one angle are not at both ends.
    std::size_t start = 0;
    double widest = sides.front().angle + 2.0 * base::kPi - sides.back().angle;
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i].angle - sides[i - 1].angle > widest) {
            widest = sides[i].angle - sides[i - 1].angle;
            start = i;
        }
    std::rotate(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(start), sides.end());
    // Where two solids touch, one ends before the other begins.
    const bool endsFirst = facing == FacingSheets::belongApart;
    std::size_t cluster = 0;
    for (auto first = sides.begin(); first != sides.end(); ++cluster) {
        const auto last = std::find_if(first, sides.end(), [&](const Side& side) {
            return std::abs(std::remainder(side.angle - first->angle, 2.0 * base::kPi)) > kSameAngle;
        });
        std::for_each(first, last, [&](Side& side) { side.cluster = cluster; });
        std::stable_partition(first, last, [&](const Side& side) { return side.forward == endsFirst; });
        first = last;
    }
}

/// Sides of an edge that are to be paired, first with second ones. Of several, each with any: triangles of
/// different shells that lie on each other.
struct Seam {
    Edge edge;
    std::vector<std::size_t> firsts;  // triangles
    std::vector<std::size_t> seconds;
};

/// Finds triangles with solid between them. Going round the edge, the solid begins at one that runs backward
/// and ends at one that runs forward.
void findSeams(const Edge& edge, Sides sides, std::vector<Seam>& seams) {
    std::map<std::pair<std::size_t, std::size_t>, Seam> byClusters;
    while (!sides.empty())
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::size_t next = (i + 1) % sides.size();
            if (sides[i].forward || !sides[next].forward) continue;
            Seam& seam = byClusters[{sides[i].cluster, sides[next].cluster}];
            seam.edge = edge;
            seam.firsts.push_back(sides[i].triangle);
            seam.seconds.push_back(sides[next].triangle);
            sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
            sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
            break;
        }
    for (auto& [clusters, seam] : byClusters)
        seams.push_back(std::move(seam));
}

/// Sews seams so that shells close: walks over each shell, and where it can go on to any of several triangles
/// that lie on each other, goes to one that it has been on already, if there is one.
class Sewing {
 public:
    Sewing(std::size_t triangles, std::vector<Seam> seams)
        : seams_(std::move(seams)), seamsOf_(triangles), shells_(triangles, kNone) {
        for (std::size_t i = 0; i < seams_.size(); ++i)
            for (const auto* side : {&seams_[i].firsts, &seams_[i].seconds})
                for (const std::size_t triangle : *side)
                    seamsOf_[triangle].push_back(i);
    }

    /// `sew` takes the edge and the two triangles.
    template <class Sew>
    void run(Sew sew) {
        for (std::size_t seed = 0; seed < shells_.size(); ++seed) {
            if (shells_[seed] != kNone) continue;
            std::vector<std::size_t> forced = {seed};               // triangles just reached
            std::vector<std::pair<std::size_t, std::size_t>> open;  // triangle and seam, several ways to go
            shells_[seed] = seed;
            while (!forced.empty() || !open.empty()) {
                if (!forced.empty()) {
                    const std::size_t triangle = forced.back();
                    forced.pop_back();
                    for (const std::size_t seam : seamsOf_[triangle])
                        if (seams_[seam].firsts.size() > 1)
                            open.emplace_back(triangle, seam);
                        else if (!seams_[seam].firsts.empty())
                            go(triangle, seam, seed, forced, sew);
                    continue;
                }
                const auto returning = std::find_if(open.begin(), open.end(), [&](const auto& end) {
                    const auto* others = findOthers(end.first, end.second);
                    return others == nullptr ||
                           std::any_of(others->begin(), others->end(),
                                       [&](std::size_t o) { return shells_[o] == seed; });
                });
                const auto next = returning == open.end() ? open.begin() : returning;
                const auto [triangle, seam] = *next;
                open.erase(next);
                if (findOthers(triangle, seam) != nullptr) go(triangle, seam, seed, forced, sew);
            }
        }
    }

 private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    /// The far side of a seam that the triangle is not sewn to yet.
    std::vector<std::size_t>* findOthers(std::size_t triangle, std::size_t index) {
        Seam& seam = seams_[index];
        if (std::find(seam.firsts.begin(), seam.firsts.end(), triangle) != seam.firsts.end())
            return &seam.seconds;
        if (std::find(seam.seconds.begin(), seam.seconds.end(), triangle) != seam.seconds.end())
            return &seam.firsts;
        return nullptr;
    }

    template <class Sew>
    void go(std::size_t triangle, std::size_t index, std::size_t shell, std::vector<std::size_t>& forced,
            Sew sew) {
        std::vector<std::size_t>* others = findOthers(triangle, index);
        if (others == nullptr) return;
        const auto rank = [&](std::size_t other) {
            return shells_[other] == shell ? 0 : shells_[other] == kNone ? 1 : 2;
        };
        const std::size_t other = *std::min_element(
            others->begin(), others->end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
        std::erase(seams_[index].firsts, triangle);
        std::erase(seams_[index].seconds, triangle);
        std::erase(*others, other);
        sew(seams_[index].edge, triangle, other);
        if (shells_[other] != kNone) return;
        shells_[other] = shell;
        forced.push_back(other);
    }

    std::vector<Seam> seams_;
    std::vector<std::vector<std::size_t>> seamsOf_;  // by triangle
    std::vector<std::size_t> shells_;                // by triangle: the seed of its shell
};

std::size_t findCorner(const TriangleMesh& mesh, std::size_t triangle, int vertex) {
    const Triangle& t = mesh.triangles[triangle];
    return 3 * triangle + static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

/// Gives each group of corners at a vertex a vertex of its own; the first keeps the old one.
TriangleMesh splitVertices(const TriangleMesh& mesh, Groups& corners) {
    TriangleMesh apart = mesh;
    std::vector<char> taken(mesh.vertices.size(), 0);
    std::map<std::size_t, int> vertexOf;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const int old = mesh.triangles[i][k];
            const auto [place, isNew] = vertexOf.emplace(corners.find(3 * i + k), old);
            if (isNew && taken[old] != 0) {
                place->second = static_cast<int>(apart.vertices.size());
                apart.vertices.push_back(mesh.vertices[old]);
            }
            taken[old] = 1;
            apart.triangles[i][k] = place->second;
        }
    return apart;
}

}  // namespace

TriangleMesh separateSheets(const TriangleMesh& mesh, FacingSheets facing) {
    const std::map<Edge, Sides> edges = collectSides(mesh);
    if (std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second.size() <= 2; }))
        return mesh;
    Groups sheets(mesh.triangles.size());
    for (const auto& [edge, sides] : edges)
        if (sides.size() == 2) sheets.join(sides[0].triangle, sides[1].triangle);

    Groups corners(3 * mesh.triangles.size());
    const auto sew = [&](const Edge& edge, std::size_t a, std::size_t b) {
        for (const int vertex : {edge.first, edge.second})
            corners.join(findCorner(mesh, a, vertex), findCorner(mesh, b, vertex));
    };
    std::vector<Seam> seams;
    for (const auto& [edge, sides] : edges) {
        if (sides.size() <= 2 || !isBalanced(sides)) {
            for (std::size_t i = 1; i < sides.size(); ++i)
                seams.push_back({edge, {sides[0].triangle}, {sides[i].triangle}});
            continue;
        }
        Sides rest = sides;
        if (facing == FacingSheets::belongApart)
            for (const auto& [a, b] : takeConnected(rest, sheets))
                seams.push_back({edge, {a}, {b}});
        if (rest.empty()) continue;
        sortByAngle(mesh, edge, facing, rest);
        findSeams(edge, std::move(rest), seams);
    }
    Sewing(mesh.triangles.size(), std::move(seams)).run(sew);
    return splitVertices(mesh, corners);
}

}  // namespace trapwright::geometry
