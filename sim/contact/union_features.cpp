#include "sim/contact/union_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "sim/contact/contact_track.h"

namespace trapwright::contact {

using base::kPi;
using base::Vec3;

namespace {

/// What is free about an edge must be more than half a turn by this: less than the facets of anything round
/// have, more than cuts are off a plane. [rad]
constexpr double kLeastBend = 0.1 * base::kDegree;
/// Sine of the angle by which a vertex's edges must rise from the plane.
constexpr double kLeastRise = 1e-3;
/// Directions nearer to each other, or to a plane, are the same, or in it. [rad]
constexpr double kSameDirection = 1e-3;
/// In tolerances: shorter stretches of an edge cannot be judged; corners so near are one.
constexpr double kShort = 20.0;
constexpr double kSameCorner = 10.0;

/// A range of angles about an edge, no more than half a turn unless it is the whole. [rad]
struct Sector {
    double begin, width;
};

/// A part of an edge, from its begin. [m]
struct Stretch {
    double begin, end;
    double middle;  // of what can be judged
};

/// BodyEdge::into.
using Into = std::array<Vec3, 2>;

bool isAlike(const Into& a, const Vec3 (&b)[2]) {
    return (a[0] - b[0]).norm() < kSameDirection && (a[1] - b[1]).norm() < kSameDirection;
}

double wrapTurn(double angle) {
    const double rest = std::fmod(angle, 2.0 * kPi);
    return rest < 0.0 ? rest + 2.0 * kPi : rest;
}

/// How far a point is beyond the face that it is farthest beyond; negative inside. [m]
double calcHeight(const BodyPiece& piece, const Vec3& point) {
    double height = -1e300;
    for (const BodyFace& face : piece.faces)
        height = std::max(height, face.normal.dot(point) - face.offset);
    return height;
}

/// What a piece fills of the turn from x to y about a line through `point`.
std::optional<Sector> findSector(const BodyPiece& piece, const Vec3& point, const Vec3& x, const Vec3& y,
                                 double tolerance) {
    Sector filled{0.0, 2.0 * kPi};
    for (const BodyFace& face : piece.faces) {
        const double height = face.normal.dot(point) - face.offset;
        if (height > tolerance) return std::nullopt;
        if (height < -tolerance) continue;
        const Sector behind{std::atan2(face.normal.dot(y), face.normal.dot(x)) + 0.5 * kPi, kPi};
        if (filled.width > kPi) {
            filled = behind;
            continue;
        }
        const double shift = std::remainder(behind.begin - filled.begin, 2.0 * kPi);
        const double low = std::max(0.0, shift);
        const double high = std::min(filled.width, shift + kPi);
        if (high <= low) return std::nullopt;
        filled = {filled.begin + low, high - low};
    }
    return filled;
}

/// The largest range that no sector reaches into.
Sector findFree(const std::vector<Sector>& filled) {
    Sector free{0.0, 0.0};
    for (const Sector& before : filled) {
        const double end = before.begin + before.width;
        double width = 2.0 * kPi;
        for (const Sector& other : filled) {
            const double ahead = wrapTurn(end - other.begin);
            width = ahead < other.width - 1e-9 ? 0.0 : std::min(width, 2.0 * kPi - ahead);
            if (width <= free.width) break;
        }
        if (width > free.width) free = {end, width};
    }
    return free;
}

/// Leaves out directions that are there twice, amid the cone of the others or between two of them.
/// facets: normals of the cone's faces, inwards.
void keepSpanning(std::vector<Vec3>& directions, const std::vector<Vec3>& facets) {
    std::erase_if(directions, [&](const Vec3& d) {
        return std::all_of(facets.begin(), facets.end(), [&](const Vec3& f) { return f.dot(d) > 0.01; });
    });
    const auto isBetween = [&](std::size_t k) {
        for (std::size_t i = 0; i < directions.size(); ++i) {
            for (std::size_t j = 0; j < directions.size(); ++j) {
                const Vec3 normal = directions[i].cross(directions[j]).normalized();
                if (i != k && j != k && std::abs(normal.dot(directions[k])) < kSameDirection &&
                    directions[i].cross(directions[k]).dot(normal) > 0.0 &&
                    directions[k].cross(directions[j]).dot(normal) > 0.0)
                    return true;
            }
        }
        return false;
    };
    for (std::size_t k = directions.size(); k-- > 0;) {
        if (isBetween(k)) directions.erase(directions.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

/// Whether a plane touches the cone of these directions at its tip alone. If so, only those that span it are
/// left.
bool findPointedCone(std::vector<Vec3>& directions) {
    std::vector<Vec3> different;
    for (const Vec3& d : directions) {
        if (std::all_of(different.begin(), different.end(),
                        [&](const Vec3& other) { return (d - other).norm() > kSameDirection; }))
            different.push_back(d);
    }
    directions = std::move(different);
    std::vector<Vec3> facets;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < directions.size(); ++i) {
        for (std::size_t j = 0; j < directions.size(); ++j) {
            const Vec3 across = directions[i].cross(directions[j]);
            if (i == j || across.norm() < 0.5 * kSameDirection) continue;
            const Vec3 normal = across.normalized();
            if (std::any_of(directions.begin(), directions.end(),
                            [&](const Vec3& d) { return normal.dot(d) < -0.1 * kSameDirection; }))
                continue;
            facets.push_back(normal);
            sum += normal;
        }
    }
    const double least = kLeastRise * static_cast<double>(facets.size());
    if (facets.empty() ||
        std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) { return sum.dot(d) <= least; }))
        return false;
    keepSpanning(directions, facets);
    return true;
}

/// What of the pieces' features is the union's, piece after piece: of what several have, the first keeps it.
class UnionFeatures {
 public:
    UnionFeatures(const std::vector<BodyPiece>& pieces, double tolerance)
        : pieces_(&pieces), tolerance_(tolerance), kept_(pieces) {
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            kept_[p].vertices.clear();
            kept_[p].vertexEdges.clear();
            kept_[p].edges.clear();
        }
    }

    std::vector<BodyPiece> keep() && {
        for (std::size_t p = 0; p < pieces_->size(); ++p) {
            const BodyPiece& piece = (*pieces_)[p];
            near_.clear();
            for (std::size_t q = 0; q < pieces_->size(); ++q) {
                const BodyPiece& other = (*pieces_)[q];
                if (q != p && (other.centre - piece.centre).norm() < piece.radius + other.radius + tolerance_)
                    near_.push_back(q);
            }
            for (const BodyEdge& edge : piece.edges)
                keepEdge(p, edge);
            for (const BodyVertex& vertex : piece.vertices)
                keepVertex(p, vertex);
        }
        for (BodyPiece& piece : kept_)
            for (BodyEdge& edge : piece.edges)
                lengthen(edge);
        return std::move(kept_);
    }

 private:
    /// An edge between places where other pieces begin or end. What is too short to be judged belongs to the
    /// stretch before it, at the edge's begin to the first. None if all of it is.
    [[nodiscard]] std::vector<Stretch> findStretches(const BodyEdge& edge) const {
        std::vector<double> places = {0.0, edge.length};
        for (const std::size_t q : near_) {
            double low = 0.0;
            double high = edge.length;
            for (const BodyFace& face : (*pieces_)[q].faces) {
                const double height = face.normal.dot(edge.from) - face.offset - tolerance_;
                const double climb = face.normal.dot(edge.direction);
                if (climb > 0.0) high = std::min(high, -height / climb);
                if (climb < 0.0) low = std::max(low, -height / climb);
                if (climb == 0.0 && height > 0.0) high = -1.0;
            }
            if (low < high) places.insert(places.end(), {low, high});
        }
        std::sort(places.begin(), places.end());
        std::vector<Stretch> stretches;
        for (std::size_t i = 0; i + 1 < places.size(); ++i) {
            if (places[i + 1] - places[i] < kShort * tolerance_) continue;
            if (!stretches.empty()) stretches.back().end = places[i];
            stretches.push_back({places[i], edge.length, 0.5 * (places[i] + places[i + 1])});
        }
        if (!stretches.empty()) stretches.front().begin = 0.0;
        return stretches;
    }

    /// The directions into the faces of the union's edge there, if it has one.
    [[nodiscard]] std::optional<Into> findInto(const BodyPiece& own, const BodyEdge& edge,
                                               const Vec3& point) const {
        const Vec3& x = edge.into[0];
        const Vec3 y = edge.direction.cross(x);
        std::vector<Sector> filled;
        for (const std::size_t q : near_) {
            if (const auto sector = findSector((*pieces_)[q], point, x, y, tolerance_))
                filled.push_back(*sector);
        }
        if (filled.empty()) return Into{edge.into[0], edge.into[1]};
        if (const auto sector = findSector(own, point, x, y, tolerance_)) filled.push_back(*sector);
        const Sector free = findFree(filled);
        if (free.width < kPi + kLeastBend) return std::nullopt;
        const auto towards = [&](double angle) { return Vec3(std::cos(angle) * x + std::sin(angle) * y); };
        return Into{towards(free.begin), towards(free.begin + free.width)};
    }

    /// Lets an edge act a little farther where it ends in a reflex corner, inside the union, or goes on
    /// straight (kCornerSlack).
    void lengthen(BodyEdge& edge) const {
        constexpr double kBelow = 0.02;  // where the union bends away by less it is straight
        const double slack = std::min(kCornerSlack, edge.length);
        const Vec3 inward = (edge.into[0] + edge.into[1]).normalized();
        const auto goesOn = [&](const Vec3& end, const Vec3& away) {
            const Vec3 beyond = end + slack * (away + kBelow * inward);
            return std::ranges::any_of(
                *pieces_, [&](const BodyPiece& piece) { return calcHeight(piece, beyond) <= 0.0; });
        };
        const bool before = goesOn(edge.from, -edge.direction);
        const bool behind = goesOn(edge.to, edge.direction);
        if (before) edge.from -= slack * edge.direction;
        if (behind) edge.to += slack * edge.direction;
        edge.length = (edge.to - edge.from).norm();
    }

    [[nodiscard]] bool isKeptAlready(const BodyEdge& edge, const Vec3& point) const {
        return std::any_of(near_.begin(), near_.end(), [&](std::size_t q) {
            return std::any_of(kept_[q].edges.begin(), kept_[q].edges.end(), [&](const BodyEdge& other) {
                const double along = std::clamp(other.direction.dot(point - other.from), 0.0, other.length);
                return (other.from + along * other.direction - point).norm() <= 2.0 * tolerance_ &&
                       std::abs(other.direction.dot(edge.direction)) > 0.99;
            });
        });
    }

    void keepEdge(std::size_t p, const BodyEdge& edge) {
        std::vector<BodyEdge>& kept = kept_[p].edges;
        const std::vector<Stretch> stretches = findStretches(edge);
        if (stretches.empty()) kept.push_back(edge);
        double reached = -1.0;  // by the edge kept last
        for (const Stretch& stretch : stretches) {
            const Vec3 middle = edge.from + stretch.middle * edge.direction;
            const auto into = findInto((*pieces_)[p], edge, middle);
            if (!into || isKeptAlready(edge, middle)) continue;
            const bool goesOn = reached == stretch.begin && isAlike(*into, kept.back().into);
            if (!goesOn) {
                kept.push_back(edge);
                std::copy(into->begin(), into->end(), kept.back().into);
                if (stretch.begin > 0.0) kept.back().from = edge.from + stretch.begin * edge.direction;
            }
            reached = stretch.end;
            kept.back().to = reached == edge.length ? edge.to : Vec3(edge.from + reached * edge.direction);
            kept.back().length = (kept.back().to - kept.back().from).norm();
        }
    }

    void keepVertex(std::size_t p, const BodyVertex& vertex) {
        const BodyPiece& piece = (*pieces_)[p];
        std::vector<std::size_t> here;
        std::copy_if(near_.begin(), near_.end(), std::back_inserter(here),
                     [&](std::size_t q) { return calcHeight((*pieces_)[q], vertex.position) <= tolerance_; });
        std::vector<Vec3> directions;
        if (here.empty()) {
            const auto first = piece.vertexEdges.begin() + vertex.firstEdge;
            directions.assign(first, first + vertex.edgeCount);
        } else {
            here.push_back(p);
            for (const std::size_t q : here) {
                const auto& kept = kept_[q].vertices;
                const bool keptAlready = std::any_of(kept.begin(), kept.end(), [&](const BodyVertex& other) {
                    return (other.position - vertex.position).norm() <= tolerance_;
                });
                if (keptAlready || !addDirections((*pieces_)[q], vertex.position, directions)) return;
            }
            if (!findPointedCone(directions)) return;
        }
        BodyPiece& kept = kept_[p];
        kept.vertices.push_back({vertex.position, static_cast<int>(kept.vertexEdges.size()),
                                 static_cast<int>(directions.size())});
        kept.vertexEdges.insert(kept.vertexEdges.end(), directions.begin(), directions.end());
    }

    /// Adds the directions of a piece's edges away from its corner at `point`. False if it has none there.
    [[nodiscard]] bool addDirections(const BodyPiece& piece, const Vec3& point,
                                     std::vector<Vec3>& directions) const {
        bool isCorner = false;
        for (const BodyEdge& edge : piece.edges) {
            const Vec3 from = edge.from - point;
            const Vec3 to = edge.to - point;
            const bool begins = from.norm() <= kSameCorner * tolerance_;
            const bool ends = to.norm() <= kSameCorner * tolerance_;
            isCorner = isCorner || begins || ends;
            if (begins != ends) directions.push_back((begins ? to : from).normalized());
        }
        return isCorner;
    }

    const std::vector<BodyPiece>* pieces_;
    double tolerance_;
    std::vector<std::size_t> near_;  // pieces that may touch the one that is looked at
    std::vector<BodyPiece> kept_;
};

}  // namespace

void keepUnionFeatures(std::vector<BodyPiece>& pieces, double tolerance) {
    pieces = UnionFeatures(pieces, tolerance).keep();
}

}  // namespace trapwright::contact
