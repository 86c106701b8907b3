#include "core/geometry/sliver_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_edges.h"
#include "core/geometry/sheet_separation.h"
#include "core/geometry/shell_nesting.h"

namespace trapwright::geometry {

namespace {

using Edge = std::pair<int, int>;

constexpr double kSameVolume = 1e-6;
constexpr std::size_t kMostCuts = 20;  // for each triangle
// Of the tolerance: flat triangles that lie on each other can be cut in a circle without end, and are less
// likely to where fewer count as flat.
constexpr std::array<double, 4> kShares = {1.0, 0.5, 0.25, 0.1};

bool isCollapsed(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Begins with its lowest corner.
Triangle rotateToFirst(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

/// Triangles whose edges are cut one after the other. Those with the same corners the other way round cancel.
class Cutting {
 public:
    Cutting(const TriangleMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {
        for (const Triangle& t : mesh.triangles)
            add(t);
        mostCuts_ = kMostCuts * mesh.triangles.size();
    }

    /// Whether it came to an end.
    bool run() {
        for (std::size_t cuts = 0; !flat_.empty(); ++cuts) {
            if (cuts > mostCuts_) return false;
            const Triangle t = flat_.top().second;
            flat_.pop();
            if (!triangles_.contains(t)) continue;
            const auto [p, q, r] = rotateToLongestEdge(t);
            cut(p, r, q);
        }
        return true;
    }

    [[nodiscard]] TriangleMesh mesh() const {
        return {mesh_.vertices, {triangles_.begin(), triangles_.end()}};
    }

 private:
    /// Cuts the edge between two vertices at a third one, in all triangles that have it.
    void cut(int start, int end, int middle) {
        for (const auto& [a, b] : {Edge{start, end}, Edge{end, start}}) {
            const auto apexes = along_[{a, b}];
            for (const int apex : apexes) {
                remove(rotateToFirst({a, b, apex}));
                add({a, middle, apex});
                add({middle, b, apex});
            }
        }
    }

    void add(const Triangle& triangle) {
        if (isCollapsed(triangle)) return;
        const Triangle t = rotateToFirst(triangle);
        const Triangle opposite = {t[0], t[2], t[1]};
        if (triangles_.contains(opposite)) return remove(opposite);
        triangles_.insert(t);
        for (std::size_t k = 0; k < 3; ++k)
            along_[{t[k], t[(k + 1) % 3]}].insert(t[(k + 2) % 3]);
        const auto [p, q, r] = rotateToLongestEdge(t);
        const base::Vec3 edge = mesh_.vertices[r] - mesh_.vertices[p];
        const double length = edge.norm();
        if (edge.cross(mesh_.vertices[q] - mesh_.vertices[p]).norm() <= tolerance_ * length)
            flat_.emplace(length, t);
    }

    void remove(const Triangle& t) {
        const auto place = triangles_.find(t);
        if (place == triangles_.end()) return;
        triangles_.erase(place);
        for (std::size_t k = 0; k < 3; ++k) {
            auto& apexes = along_[{t[k], t[(k + 1) % 3]}];
            apexes.erase(apexes.find(t[(k + 2) % 3]));
        }
    }

    /// So that the longest edge is from the last corner to the first.
    [[nodiscard]] Triangle rotateToLongestEdge(Triangle t) const {
        const auto length = [&](int a, int b) {
            return (mesh_.vertices[a] - mesh_.vertices[b]).squaredNorm();
        };
        const std::array<double, 3> lengths = {length(t[2], t[0]), length(t[0], t[1]), length(t[1], t[2])};
        std::rotate(t.begin(),
                    t.begin() + (std::max_element(lengths.begin(), lengths.end()) - lengths.begin()),
                    t.end());
        return t;
    }

    const TriangleMesh& mesh_;
    double tolerance_;
    std::multiset<Triangle> triangles_;                      // each beginning with its lowest corner
    std::map<Edge, std::multiset<int>> along_;               // third corners of those that run along it so
    std::priority_queue<std::pair<double, Triangle>> flat_;  // longest first: edges only get shorter
    std::size_t mostCuts_ = 0;
};

/// Without shells thinner than the tolerance: sheets back to back.
TriangleMesh dropFlatShells(const TriangleMesh& mesh, double tolerance) {
    TriangleMesh kept;
    for (const Shell& shell : findShells(mesh)) {
        const TriangleMesh own = extractShell(mesh, shell);
        if (std::abs(shell.volume) <= tolerance * calcMassProperties(own, 1.0).area) continue;
        const int first = static_cast<int>(kept.vertices.size());
        kept.vertices.insert(kept.vertices.end(), own.vertices.begin(), own.vertices.end());
        for (const Triangle& t : own.triangles)
            kept.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return kept;
}

std::optional<TriangleMesh> tryRemoveSlivers(const TriangleMesh& mesh, double tolerance) {
    const TriangleMesh welded = weldVertices(mesh, tolerance);
    Cutting cutting(welded, tolerance);
    if (!cutting.run()) return std::nullopt;
    TriangleMesh clean =
        dropFlatShells(separateSheets(cutting.mesh(), FacingSheets::belongTogether), tolerance);
    const double volume = calcMassProperties(mesh, 1.0).volume;
    if (std::abs(calcMassProperties(clean, 1.0).volume - volume) > kSameVolume * volume) return std::nullopt;
    return clean;
}

}  // namespace

TriangleMesh removeSlivers(const TriangleMesh& mesh, double tolerance) {
    for (const double share : kShares)
        if (auto clean = tryRemoveSlivers(mesh, share * tolerance)) return std::move(*clean);
    return mesh;
}

}  // namespace trapwright::geometry
