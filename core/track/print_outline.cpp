#include "core/track/print_outline.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace trapwright::track {

namespace {

/// A place in y of the cross-section: what the columns left and right of it have there above the base, from
/// below, as numbers of points of the row's upper side.
struct Post {
    std::vector<int> left;
    std::vector<int> right;
};

/// How all rows are alike.
struct Topology {
    std::vector<Post> posts;
    int firstSurface = 0;  // the surface's first point of the upper side
    int lastSurface = 0;
    int topCount = 0;
};

/// One cross-section of the solid: (y, height in the room).
struct Row {
    std::vector<base::Vec2> top;  // the upper side from inside to outside
    std::vector<double> base;     // y of each post
};

Topology makeTopology(const PrintOutline& outline, int surfacePoints) {
    Topology topology;
    std::vector<Post>& posts = topology.posts;
    int next = 0;
    if (outline.innerFlange) {
        posts.push_back({{}, {0}});
        posts.push_back({{1}, {1}});
        next = 2;
    } else {
        posts.emplace_back();
    }
    if (outline.innerWallTop) {
        posts.back().right.push_back(next);
        posts.push_back({{next + 2, next + 1}, {}});
        next += 2;
    }
    topology.firstSurface = next;
    posts.back().right.push_back(next++);
    for (int j = 1; j < surfacePoints; ++j, ++next)
        posts.push_back({{next}, {next}});
    topology.lastSurface = next - 1;
    if (outline.outerWallTop) {
        posts.back().right.push_back(next);
        posts.push_back({{next + 1}, {}});
        next += 2;
    }
    if (outline.outerFlange) {
        posts.back().left.insert(posts.back().left.begin(), next);
        posts.back().right = {next};
        posts.push_back({{next + 1}, {}});
        next += 2;
    }
    topology.topCount = next;
    return topology;
}

/// `rise`: of the track's plane z = 0 there, in the room.
Row makeRow(const CrossSection& section, const PrintOutline& outline, double rise) {
    const double innerBorder = section.points.front().x();
    const double outerBorder = section.points.back().x();
    const double innerSide = outline.innerWallTop ? outline.innerSide : innerBorder;
    const double outerSide = outline.outerWallTop ? outline.outerSide : outerBorder;
    Row row;
    if (outline.innerFlange) {
        row.top.emplace_back(*outline.innerFlange, outline.flangeTop);
        row.top.emplace_back(innerSide, outline.flangeTop);
        row.base.push_back(*outline.innerFlange);
    }
    if (outline.innerWallTop) {
        row.top.emplace_back(innerSide, *outline.innerWallTop + rise);
        row.top.emplace_back(innerBorder, *outline.innerWallTop + rise);
        row.base.push_back(innerSide);
    }
    for (const base::Vec2& point : section.points)
        row.top.emplace_back(point.x(), point.y() + rise);
    const std::vector<double> below = placeBase(section);
    row.base.insert(row.base.end(), below.begin(), below.end());
    if (outline.outerWallTop) {
        row.top.emplace_back(outerBorder, *outline.outerWallTop + rise);
        row.top.emplace_back(outerSide, *outline.outerWallTop + rise);
        row.base.push_back(outerSide);
    }
    if (outline.outerFlange) {
        row.top.emplace_back(outerSide, outline.flangeTop);
        row.top.emplace_back(*outline.outerFlange, outline.flangeTop);
        row.base.push_back(*outline.outerFlange);
    }
    return row;
}

class Builder {
 public:
    Builder(const FeederShape& shape, std::span<const CrossSection> sections, const PrintOutline& outline)
        : topology_(makeTopology(outline, static_cast<int>(sections.front().points.size()))) {
        for (const CrossSection& section : subdivideSections(shape, sections))
            addRow(shape, section.x, makeRow(section, outline, shape.rise(section.x)), outline.base);
    }

    TrackSolid build(bool mirrored) {
        const int rows = static_cast<int>(top_.size());
        const int points = topology_.topCount;
        for (int i = 0; i + 1 < rows; ++i)
            addTop(i, topology_.firstSurface, topology_.lastSurface);
        const std::size_t surfaceTriangles = mesh_.triangles.size();
        for (int i = 0; i + 1 < rows; ++i) {
            addTop(i, 0, topology_.firstSurface);
            addTop(i, topology_.lastSurface, points - 1);
            const int last = static_cast<int>(topology_.posts.size()) - 1;
            addQuad(bottom_[i][0], top_[i][0], bottom_[i + 1][0], top_[i + 1][0]);
            addQuad(top_[i][points - 1], bottom_[i][last], top_[i + 1][points - 1], bottom_[i + 1][last]);
            for (int k = 0; k < last; ++k)
                addQuad(bottom_[i][k + 1], bottom_[i][k], bottom_[i + 1][k + 1], bottom_[i + 1][k]);
        }
        addEnd(0, false);
        addEnd(rows - 1, true);
        if (mirrored) {
            for (geometry::Triangle& triangle : mesh_.triangles)
                std::swap(triangle[1], triangle[2]);
        }
        return {std::move(mesh_), surfaceTriangles};
    }

 private:
    void addRow(const FeederShape& shape, double x, const Row& row, double base) {
        const auto addVertex = [&](double y, double height) {
            base::Vec3& vertex = mesh_.vertices.emplace_back(shape.toRoom({x, y, 0.0}));
            vertex.z() = height;
        };
        std::vector<int>& top = top_.emplace_back();
        for (std::size_t j = 0; j < row.top.size(); ++j) {
            // A flange as high as the surface's border has one point in common with it.
            if (j > 0 && row.top[j] == row.top[j - 1]) {
                top.push_back(top.back());
                continue;
            }
            top.push_back(static_cast<int>(mesh_.vertices.size()));
            addVertex(row.top[j].x(), row.top[j].y());
        }
        std::vector<int>& bottom = bottom_.emplace_back();
        for (const double y : row.base) {
            bottom.push_back(static_cast<int>(mesh_.vertices.size()));
            addVertex(y, base);
        }
    }

    void addTriangle(int a, int b, int c) {
        if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
    }

    /// The quad a b d c (a, b on one row, c, d on the next) seen with c ahead of a and b left of it.
    void addQuad(int a, int b, int c, int d) {
        addTriangle(a, c, b);
        addTriangle(b, c, d);
    }

    void addTop(int i, int from, int to) {
        for (int j = from; j < to; ++j)
            addQuad(top_[i][j], top_[i][j + 1], top_[i + 1][j], top_[i + 1][j + 1]);
    }

    /// An end face, column by column between two posts.
    void addEnd(int i, bool ahead) {
        for (std::size_t k = 0; k + 1 < topology_.posts.size(); ++k) {
            std::vector<int> left{bottom_[i][k]};
            std::vector<int> right{bottom_[i][k + 1]};
            for (const int point : topology_.posts[k].right)
                left.push_back(top_[i][point]);
            for (const int point : topology_.posts[k + 1].left)
                right.push_back(top_[i][point]);
            std::size_t l = 0;
            std::size_t r = 0;
            while (l + 1 < left.size() || r + 1 < right.size()) {
                // Diagonals as the track's own solid has them.
                const bool goLeft =
                    r + 1 == right.size() || (l + 1 < left.size() && (ahead ? l <= r : l < r));
                const std::array<int, 3> corners = goLeft ? std::array{left[l + 1], right[r], left[l]}
                                                          : std::array{left[l], right[r + 1], right[r]};
                (goLeft ? l : r) += 1;
                if (ahead) {
                    addTriangle(corners[0], corners[2], corners[1]);
                } else {
                    addTriangle(corners[0], corners[1], corners[2]);
                }
            }
        }
    }

    Topology topology_;
    geometry::TriangleMesh mesh_;
    std::vector<std::vector<int>> top_;     // vertices of each row's upper side
    std::vector<std::vector<int>> bottom_;  // and of its base
};

}  // namespace

double highestOf(std::span<const CrossSection> sections) {
    double highest = 0.0;
    for (const CrossSection& section : sections) {
        for (const base::Vec2& point : section.points)
            highest = std::max(highest, point.y());
    }
    return highest;
}

TrackSolid buildOutlined(const FeederShape& shape, std::span<const CrossSection> sections,
                         const PrintOutline& outline) {
    // Anticlockwise track coordinates are left-handed in the room.
    const bool mirrored = shape.type == FeederType::bowl && shape.conveying == Conveying::anticlockwise;
    return Builder(shape, sections, outline).build(mirrored);
}

}  // namespace trapwright::track
