#include "core/track/print_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/print_check.h"

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
    std::optional<std::size_t> innerSidePost;  // of a rim or wall
    std::optional<std::size_t> outerSidePost;
};

/// One cross-section of the solid: (y, height in the room).
struct Row {
    std::vector<base::Vec2> top;  // the upper side from inside to outside
    std::vector<double> base;     // y of each post
};

bool hasRim(const PrintOutline& outline, double Rims::*side) {
    const bool hasWall = (side == &Rims::inner ? outline.innerWall : outline.outerWall).has_value();
    return !hasWall && std::ranges::any_of(outline.rims, [&](const Rims& rims) { return rims.*side > 0.0; });
}

/// In proportion between the two next to it.
Rims rimsAt(std::span<const Rims> rims, double x) {
    if (rims.empty()) return {x, 0.0, 0.0};
    const auto next = std::ranges::lower_bound(rims, x, {}, &Rims::x);
    if (next == rims.begin()) return rims.front();
    if (next == rims.end()) return rims.back();
    const Rims& last = *std::prev(next);
    const double share = (x - last.x) / (next->x - last.x);
    return {x, std::lerp(last.inner, next->inner, share), std::lerp(last.outer, next->outer, share)};
}

/// In proportion between the two sections next to it.
double crestAt(std::span<const base::Vec2> crest, double x) {
    const auto next = std::ranges::lower_bound(crest, x, {}, [](const base::Vec2& at) { return at.x(); });
    if (next == crest.begin()) return crest.front().y();
    if (next == crest.end()) return crest.back().y();
    const base::Vec2& last = *std::prev(next);
    return std::lerp(last.y(), next->y(), (x - last.x()) / (next->x() - last.x()));
}

/// Whether the surface's border from one place to another and the upright side below it are too sharp, with
/// the corner of the surface's triangle there.
bool isSharp(const base::Vec3& from, const base::Vec3& to, const base::Vec3& corner) {
    const base::Vec3 along = (to - from).normalized();
    const auto across = [&](const base::Vec3& direction) {
        return base::Vec3((direction - along * along.dot(direction)).normalized());
    };
    return across(corner - from).dot(across(-base::Vec3::UnitZ())) > std::cos(geometry::kSharpestEdge);
}

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
    if (outline.innerWall) {
        topology.innerSidePost = posts.size() - 1;
        posts.back().right.push_back(next);
        posts.push_back({{next + 2, next + 1}, {}});
        next += 2;
    } else if (hasRim(outline, &Rims::inner)) {
        topology.innerSidePost = posts.size() - 1;
        posts.back().right.push_back(next);
        posts.push_back({{next + 1}, {}});
        ++next;
    }
    topology.firstSurface = next;
    posts.back().right.push_back(next++);
    for (int j = 1; j < surfacePoints; ++j, ++next)
        posts.push_back({{next}, {next}});
    topology.lastSurface = next - 1;
    if (outline.outerWall) {
        topology.outerSidePost = posts.size();
        posts.back().right.push_back(next);
        posts.push_back({{next + 1}, {}});
        next += 2;
    } else if (hasRim(outline, &Rims::outer)) {
        topology.outerSidePost = posts.size();
        posts.push_back({{next}, {}});
        ++next;
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

/// How far a border may be from the track's edge that is not cut back: a point's strip (PointEncoding).
double stripOf(const CrossSection& section, double width) {
    return width / static_cast<double>(section.points.size());
}

/// Both borders are cut back.
bool standsFree(const CrossSection& section, double width) {
    const double edge = 0.5 * width - stripOf(section, width);
    return section.points.front().x() > -edge && section.points.back().x() < edge;
}

/// What there is of the walls at a section: 0 to 1.
struct WallShares {
    double x = 0.0;
    double height = 1.0;
    double thickness = 1.0;
};

/// A surface that stands free has none. They come down to it over the segment before the last one that does
/// not: with height and thickness at once they would end in a blade.
std::vector<WallShares> shareWalls(std::span<const CrossSection> sections, const PrintOutline& outline) {
    std::vector<WallShares> shares;
    if (!outline.innerWall && !outline.outerWall) return shares;
    shares.reserve(sections.size());
    const auto isFree = [&](std::size_t i) {
        return i < sections.size() && standsFree(sections[i], outline.width);
    };
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const bool endsHere = isFree(i) || isFree(i + 1) || (i > 0 && isFree(i - 1));
        shares.push_back({sections[i].x, endsHere ? 0.0 : 1.0, isFree(i) ? 0.0 : 1.0});
    }
    return shares;
}

/// In proportion between the two next to it.
WallShares sharesAt(std::span<const WallShares> shares, double x) {
    if (shares.empty()) return {x};
    const auto next = std::ranges::lower_bound(shares, x, {}, &WallShares::x);
    if (next == shares.begin()) return shares.front();
    if (next == shares.end()) return shares.back();
    const WallShares& last = *std::prev(next);
    const double share = (x - last.x) / (next->x - last.x);
    return {x, std::lerp(last.height, next->height, share),
            std::lerp(last.thickness, next->thickness, share)};
}

/// `rise`: of the track's plane z = 0 there, in the room.
Row makeRow(const CrossSection& section, const PrintOutline& outline, const WallShares& walls, double rise) {
    const double innerBorder = section.points.front().x();
    const double outerBorder = section.points.back().x();
    const Rims rims = rimsAt(outline.rims, section.x);
    const auto sideOf = [&](double border, double side) { return std::lerp(border, side, walls.thickness); };
    const double innerSide =
        outline.innerWall ? sideOf(innerBorder, outline.innerSide) : innerBorder - rims.inner;
    const double outerSide =
        outline.outerWall ? sideOf(outerBorder, outline.outerSide) : outerBorder + rims.outer;
    const auto topOf = [&](double wall, const base::Vec2& border) {
        return rise + std::lerp(border.y(), crestAt(outline.crest, section.x) + wall, walls.height);
    };
    Row row;
    if (outline.innerFlange) {
        row.top.emplace_back(*outline.innerFlange, outline.flangeTop);
        row.top.emplace_back(innerSide, outline.flangeTop);
        row.base.push_back(*outline.innerFlange);
    }
    if (outline.innerWall) {
        row.top.emplace_back(innerSide, topOf(*outline.innerWall, section.points.front()));
        row.top.emplace_back(innerBorder, topOf(*outline.innerWall, section.points.front()));
        row.base.push_back(innerSide);
    } else if (hasRim(outline, &Rims::inner)) {
        row.top.emplace_back(innerSide, section.points.front().y() + rise);
        row.base.push_back(innerSide);
    }
    for (const base::Vec2& point : section.points)
        row.top.emplace_back(point.x(), point.y() + rise);
    const std::vector<double> below = placeBase(section);
    row.base.insert(row.base.end(), below.begin(), below.end());
    if (outline.outerWall) {
        row.top.emplace_back(outerBorder, topOf(*outline.outerWall, section.points.back()));
        row.top.emplace_back(outerSide, topOf(*outline.outerWall, section.points.back()));
        row.base.push_back(outerSide);
    } else if (hasRim(outline, &Rims::outer)) {
        row.top.emplace_back(outerSide, section.points.back().y() + rise);
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
        const std::vector<WallShares> walls = shareWalls(sections, outline);
        for (const CrossSection& section : subdivideSections(shape, sections))
            addRow(shape, section.x,
                   makeRow(section, outline, sharesAt(walls, section.x), shape.rise(section.x)),
                   outline.base);
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
            // A flange as high as the surface's border has one point in common with it, and so has a rim of
            // no width.
            if (j > 0 && row.top[j] == row.top[j - 1]) {
                top.push_back(top.back());
                continue;
            }
            top.push_back(static_cast<int>(mesh_.vertices.size()));
            addVertex(row.top[j].x(), row.top[j].y());
        }
        std::vector<int>& bottom = bottom_.emplace_back();
        for (std::size_t k = 0; k < row.base.size(); ++k) {
            if (k > 0 && row.base[k] == row.base[k - 1]) {
                bottom.push_back(bottom.back());
                continue;
            }
            bottom.push_back(static_cast<int>(mesh_.vertices.size()));
            addVertex(row.base[k], base);
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

    /// Where a rim or wall has no width its side's post and the border's are at one place, and what the
    /// side's says holds.
    [[nodiscard]] const Post& postAt(const std::vector<int>& base, std::size_t k) const {
        const std::size_t inner = topology_.innerSidePost.value_or(k);
        const std::size_t outer = topology_.outerSidePost.value_or(k);
        if (k == inner + 1 && base[inner] == base[k]) return topology_.posts[inner];
        if (k + 1 == outer && base[outer] == base[k]) return topology_.posts[outer];
        return topology_.posts[k];
    }

    /// An end face, column by column between two posts.
    void addEnd(int i, bool ahead) {
        const std::vector<int>& base = bottom_[i];
        for (std::size_t k = 0; k + 1 < topology_.posts.size(); ++k) {
            if (base[k] == base[k + 1]) continue;
            std::vector<int> left{base[k]};
            std::vector<int> right{base[k + 1]};
            for (const int point : postAt(base, k).right)
                left.push_back(top_[i][point]);
            for (const int point : postAt(base, k + 1).left)
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

std::vector<base::Vec2> findCrest(std::span<const CrossSection> sections) {
    std::vector<base::Vec2> crest;
    crest.reserve(sections.size());
    for (const CrossSection& section : sections) {
        const auto highest =
            std::ranges::max_element(section.points, {}, [](const auto& p) { return p.y(); });
        crest.emplace_back(section.x, highest->y());
    }
    const auto hold = [](base::Vec2& own, const base::Vec2& beside) {
        own.y() = std::max(own.y(), beside.y() - std::abs(own.x() - beside.x()));
    };
    for (std::size_t i = 1; i < crest.size(); ++i)
        hold(crest[i], crest[i - 1]);
    for (std::size_t i = crest.size(); i-- > 1;)
        hold(crest[i - 1], crest[i]);
    return crest;
}

std::vector<Rims> placeRims(const Track& track, double width) {
    const std::vector<CrossSection>& sections = track.sections;
    std::vector<Rims> rims;
    if (!(width > 0.0)) return rims;
    for (const CrossSection& section : sections)
        rims.push_back({section.x, 0.0, 0.0});
    const std::size_t last = sections.front().points.size() - 1;
    const double strip = stripOf(sections.front(), track.width);
    const auto place = [&](std::size_t i, std::size_t point) {
        const base::Vec2& own = sections[i].points[point];
        return track.shape.toRoom({sections[i].x, own.x(), own.y()});
    };
    const auto isCut = [&](std::size_t i, std::size_t border) {
        return std::abs(sections[i].points[border].x()) < 0.5 * track.width - strip;
    };
    // `corner`: of the surface's triangle at its border (buildTrackSolid).
    const auto widen = [&](std::size_t i, std::size_t border, const base::Vec3& corner, double Rims::*side) {
        if (isCut(i, border) || isCut(i + 1, border)) return;
        if (isSharp(place(i, border), place(i + 1, border), corner))
            rims[i].*side = rims[i + 1].*side = width;
    };
    for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
        widen(i, 0, place(i, 1), &Rims::inner);
        widen(i, last, place(i + 1, last - 1), &Rims::outer);
    }
    if (std::ranges::all_of(rims, [](const Rims& one) { return one.inner == 0.0 && one.outer == 0.0; }))
        rims.clear();
    return rims;
}

TrackSolid buildOutlined(const FeederShape& shape, std::span<const CrossSection> sections,
                         const PrintOutline& outline) {
    // Anticlockwise track coordinates are left-handed in the room.
    const bool mirrored = shape.type == FeederType::bowl && shape.conveying == Conveying::anticlockwise;
    return Builder(shape, sections, outline).build(mirrored);
}

}  // namespace trapwright::track
