#include "core/geometry/piece_merging.h"

#include <algorithm>
#include <optional>

#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"

namespace trapwright::geometry {

namespace {

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
