#include "core/track/print_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/geometry/solid_cut.h"
#include "core/geometry/surface_distance.h"
#include "core/geometry/triangle_mesh.h"
#include "core/track/print_mount.h"

namespace trapwright::track {

namespace {

using base::inMillimetres;

using base::Vec3;
using geometry::TriangleMesh;

constexpr int kHoleSides = 32;
constexpr double kBeyond = base::kMillimetre;  // how far a drill stands out of the face
constexpr double kGrid = base::kMillimetre;    // between places that are tried for a pin
constexpr double kAlong = base::kMillimetre;   // between points of a pin whose distance is measured
constexpr double kInPlane = 1e-9;              // of a cut; radial ones are rounded [m]
constexpr double kLongest = 0.1;               // of a pin's diameter and depth; more was not meant [m]

int lastSectionOf(const Track& track) {
    return static_cast<int>(track.sections.size()) - 1;
}

double holeRadius(const SplitOptions& split) {
    return 0.5 * (split.dowelDiameter + split.dowelClearance);
}

double holeDepth(const SplitOptions& split) {
    return split.dowelDepth + split.dowelClearance;
}

/// Of a piece with holes at both ends, which must not meet. [m]
double shortestBetween(const SplitOptions& split) {
    return split.dowelDiameter > 0.0 ? 2.0 * holeDepth(split) + split.dowelWall : 0.0;
}

std::optional<PrintProblem> findSplitProblem(const Track& track, const SplitOptions& split) {
    const struct {
        const char* option;
        const char* name;
        double value;
        bool mayBeZero;
    } lengths[] = {{"dowelDiameter", "dowel diameter", split.dowelDiameter, true},
                   {"dowelDepth", "dowel depth", split.dowelDepth, false},
                   {"dowelClearance", "dowel clearance", split.dowelClearance, true},
                   {"dowelWall", "wall around a dowel", split.dowelWall, true}};
    for (const auto& [option, name, value, mayBeZero] : lengths) {
        if ((mayBeZero ? value >= 0.0 : value > 0.0) && value <= kLongest) continue;
        return PrintProblem{
            option,
            fmt::format("The {} is {:g} mm; it must be {}, and at most {:g} mm.", name, inMillimetres(value),
                        mayBeZero ? "at least 0" : "greater than 0", inMillimetres(kLongest))};
    }
    int before = 0;
    for (const int cut : split.cuts) {
        if (cut > before && cut < lastSectionOf(track)) {
            before = cut;
            continue;
        }
        return PrintProblem{"cuts",
                            fmt::format("The track cannot be cut at section {}; the cuts are sections "
                                        "from 1 to {}, in ascending order, none twice.",
                                        cut, lastSectionOf(track) - 1)};
    }
    return std::nullopt;
}

/// An upright cut across the conveying direction: where it is, and what is outward and, level, ahead there.
struct CutPlane {
    Vec3 origin;
    Vec3 ahead;
    Vec3 outward;

    CutPlane(const Track& track, int section) {
        const double x = track.sections[static_cast<std::size_t>(section)].x;
        origin = track.shape.toRoom({x, 0.0, 0.0});
        FeederShape level = track.shape;
        level.slope = 0.0;
        ahead = level.tangentFrame(x).col(0);
        outward = (track.shape.toRoom({x, base::kMillimetre, 0.0}) - origin).normalized();
    }

    [[nodiscard]] Vec3 at(double y, double z) const { return origin + y * outward + z * Vec3::UnitZ(); }
};

/// Finds places for pins in the cuts of one solid.
class DowelPlaces {
 public:
    DowelPlaces(const Track& track, const SplitOptions& split, TriangleMesh whole)
        : track_(track), split_(split), whole_(std::move(whole)), surface_(whole_) {}

    /// Where the pins' axes go through the cut. An error if two of them have no room.
    [[nodiscard]] base::Result<std::vector<Vec3>, PrintProblem> find(int section) const {
        std::vector<Vec3> places;
        if (split_.dowelDiameter == 0.0) return places;
        const CutPlane plane(track_, section);
        const double needed = holeRadius(split_) + split_.dowelWall;
        std::vector<Place> found;
        for (const auto& [y, z] : gridAt(plane)) {
            const double room = roomAround(plane.at(y, z), plane.ahead, needed);
            if (room > 0.0) found.push_back({y, z, room});
        }
        const auto refuse = [&](const std::string& what) {
            return PrintProblem{
                "dowelDiameter",
                fmt::format("At section {} there is no room for two dowels of {:g} mm: {}. Take "
                            "thinner or shorter ones, a thicker base, or cut at another section.",
                            section, inMillimetres(split_.dowelDiameter), what)};
        };
        // Far out, but where there is something around them.
        const auto findBest = [&](double side) -> std::optional<Place> {
            const auto worth = [&](const Place& p) { return side * p.y + std::min(p.room, 2.0 * needed); };
            std::sort(found.begin(), found.end(),
                      [&](const Place& a, const Place& b) { return worth(a) > worth(b); });
            const auto inside = std::find_if(found.begin(), found.end(),
                                             [&](const Place& p) { return isInside(plane.at(p.y, p.z)); });
            return inside == found.end() ? std::nullopt : std::optional(*inside);
        };
        const auto inner = findBest(-1.0);
        const auto outer = findBest(1.0);
        if (!inner || !outer) return refuse(describeWidest(plane));
        if (outer->y - inner->y < 2.0 * needed) return refuse("there is room for one");
        for (const Place& place : {*inner, *outer})
            places.push_back(plane.at(place.y, place.z));
        return places;
    }

 private:
    struct Place {
        double y;
        double z;
        double room;  // to the nearest surface [m]
    };

    [[nodiscard]] std::vector<std::pair<double, double>> gridAt(const CutPlane& plane) const {
        // What of the solid is at the cut lies in the box of the vertices around it.
        double left = 1e300;
        double right = -1e300;
        double low = 1e300;
        double high = -1e300;
        for (const Vec3& v : whole_.vertices) {
            if (std::abs((v - plane.origin).dot(plane.ahead)) > kBeyond) continue;
            left = std::min(left, (v - plane.origin).dot(plane.outward));
            right = std::max(right, (v - plane.origin).dot(plane.outward));
            low = std::min(low, v.z() - plane.origin.z());
            high = std::max(high, v.z() - plane.origin.z());
        }
        // With only thin pins there is room near its sides.
        const double inset = split_.dowelWall;
        std::vector<std::pair<double, double>> grid;
        const auto steps = [&](double from, double to) {
            return static_cast<int>(std::floor((to - from - 2.0 * inset) / kGrid));
        };
        for (int i = 0; i <= steps(left, right); ++i) {
            for (int j = 0; j <= steps(low, high); ++j)
                grid.emplace_back(left + inset + i * kGrid, low + inset + j * kGrid);
        }
        return grid;
    }

    [[nodiscard]] bool isInside(const Vec3& place) const {
        return geometry::calcWindingNumber(whole_, place) > 0.5;
    }

    /// From the pin's axis to the nearest surface; 0 if that is less than `needed`. [m]
    [[nodiscard]] double roomAround(const Vec3& middle, const Vec3& ahead, double needed) const {
        double room = std::numeric_limits<double>::infinity();
        const int steps = static_cast<int>(std::ceil(holeDepth(split_) / kAlong));
        for (int i = 0; i <= steps; ++i) {
            for (const double side : {1.0, -1.0}) {
                const Vec3 point = middle + side * holeDepth(split_) * i / steps * ahead;
                room = std::min(room, surface_.calcDistance(point));
                if (room < needed) return 0.0;
            }
        }
        return room;
    }

    /// For people: the thickest pin that would have room.
    [[nodiscard]] std::string describeWidest(const CutPlane& plane) const {
        double widest = 0.0;
        for (const auto& [y, z] : gridAt(plane)) {
            const double room = roomAround(plane.at(y, z), plane.ahead, widest);
            if (room > widest && isInside(plane.at(y, z))) widest = room;
        }
        const double most = 2.0 * (widest - split_.dowelWall) - split_.dowelClearance;
        return most > 0.0 ? fmt::format("one of {:.1f} mm would have it", inMillimetres(most))
                          : std::string("the track is too thin there");
    }

    const Track& track_;
    const SplitOptions& split_;
    TriangleMesh whole_;
    geometry::SurfaceDistance surface_;
};

/// The drill for a hole: a prism around its axis, from outside the face to the hole's end.
TriangleMesh makeDrill(const DowelHole& hole) {
    TriangleMesh drill = geometry::makeCylinder({0.0, 0.0}, hole.radius / std::cos(base::kPi / kHoleSides),
                                                -kBeyond, hole.depth, kHoleSides);
    const base::Quaternion turn = base::Quaternion::FromTwoVectors(Vec3::UnitZ(), hole.axis);
    for (Vec3& v : drill.vertices)
        v = hole.mouth + turn * v;
    return drill;
}

std::optional<PrintProblem> drill(PrintPiece& piece) {
    for (const DowelHole& hole : piece.holes) {
        auto drilled = geometry::subtractSolid(piece.solid, makeDrill(hole));
        if (!drilled) return PrintProblem{"dowelDiameter", drilled.error().message};
        piece.solid = std::move(*drilled);
    }
    return std::nullopt;
}

/// Where a track may be cut into pieces that fit.
class CutSearch {
 public:
    CutSearch(std::vector<int> reaches, std::vector<double> places, double shortest)
        : reaches_(std::move(reaches)), places_(std::move(places)), shortest_(shortest) {}

    /// The fewest cuts that avoid these sections; of those the ones with the shortest longest piece.
    [[nodiscard]] std::optional<std::vector<int>> find(const std::set<int>& avoided) const {
        struct Best {
            int pieces = std::numeric_limits<int>::max();
            double longest = 0.0;
            int before = -1;
        };
        std::vector<Best> best(places_.size());
        best[0].pieces = 0;
        for (std::size_t to = 1; to < best.size(); ++to) {
            if (avoided.contains(static_cast<int>(to))) continue;
            for (std::size_t from = 0; from < to; ++from) {
                if (best[from].pieces == std::numeric_limits<int>::max()) continue;
                if (reaches_[from] < static_cast<int>(to)) continue;
                const bool isBetweenCuts = from > 0 && to + 1 < best.size();
                if (isBetweenCuts && places_[to] - places_[from] < shortest_) continue;
                const int pieces = best[from].pieces + 1;
                const double longest = std::max(best[from].longest, places_[to] - places_[from]);
                if (std::pair(pieces, longest) < std::pair(best[to].pieces, best[to].longest))
                    best[to] = {pieces, longest, static_cast<int>(from)};
            }
        }
        if (best.back().before < 0) return std::nullopt;
        std::vector<int> cuts;
        for (int at = best.back().before; at > 0; at = best[static_cast<std::size_t>(at)].before)
            cuts.push_back(at);
        std::reverse(cuts.begin(), cuts.end());
        return cuts;
    }

 private:
    std::vector<int> reaches_;    // the last section that a piece from each section may have
    std::vector<double> places_;  // of the sections along the track [m]
    double shortest_;             // of a piece between two cuts [m]
};

/// Sections at which a cut would go through a bolt hole, or leave less than the wall beside it.
std::set<int> findBoltedSections(const Track& track, const PrintOptions& options, const SplitOptions& split) {
    std::set<int> sections;
    const double needed = 0.5 * options.boltDiameter + split.dowelWall;
    for (const base::Vec2& bolt : placeBolts(track, options)) {
        for (int i = 1; i < lastSectionOf(track); ++i) {
            const CutPlane plane(track, i);
            const Vec3 way = Vec3(bolt.x(), bolt.y(), 0.0) - plane.origin;
            const bool isBehindAxis =
                way.dot(plane.outward) < -track.shape.bowlRadius && track.shape.type == FeederType::bowl;
            if (!isBehindAxis && std::abs(way.dot(plane.ahead)) < needed) sections.insert(i);
        }
    }
    return sections;
}

}  // namespace

double volumeOf(const DowelHole& hole) {
    return kHoleSides * hole.radius * hole.radius * std::tan(base::kPi / kHoleSides) * hole.depth;
}

base::Result<std::vector<PrintPiece>, PrintProblem> buildPrintPieces(const Track& track,
                                                                     const PrintOptions& options,
                                                                     const SplitOptions& split) {
    if (auto problem = findSplitProblem(track, split)) return *problem;
    std::vector<PrintPiece> pieces;
    int first = 0;
    std::vector<int> ends = split.cuts;
    ends.push_back(lastSectionOf(track));
    for (const int end : ends) {
        auto solid = buildPrintSolid(track, options, {first, end});
        if (!solid) return solid.error();
        pieces.push_back({{first, end}, std::move(*solid), {}});
        first = end;
    }
    if (split.cuts.empty() || split.dowelDiameter == 0.0) return pieces;

    auto whole = buildPrintSolid(track, options);
    if (!whole) return whole.error();
    const DowelPlaces places(track, split, std::move(*whole));
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        const int cut = pieces[i].sections.last;
        const auto mouths = places.find(cut);
        if (!mouths) return mouths.error();
        const Vec3 ahead = CutPlane(track, cut).ahead;
        for (const Vec3& mouth : *mouths) {
            pieces[i].holes.push_back({mouth, -ahead, holeRadius(split), holeDepth(split)});
            pieces[i + 1].holes.push_back({mouth, ahead, holeRadius(split), holeDepth(split)});
        }
    }
    for (std::size_t i = 1; i + 1 < pieces.size(); ++i) {
        const double length = track.sections[static_cast<std::size_t>(pieces[i].sections.last)].x -
                              track.sections[static_cast<std::size_t>(pieces[i].sections.first)].x;
        if (shortestBetween(split) <= length) continue;
        return PrintProblem{
            "dowelDepth",
            fmt::format("The piece between sections {} and {} is {:.1f} mm long: holes of {:g} mm "
                        "from both sides meet. Take shorter dowels or fewer cuts.",
                        pieces[i].sections.first, pieces[i].sections.last, inMillimetres(length),
                        inMillimetres(holeDepth(split)))};
    }
    for (PrintPiece& piece : pieces) {
        if (auto problem = drill(piece)) return *problem;
    }
    return pieces;
}

std::vector<std::vector<base::Vec3>> findCutOutline(const Track& track, const PrintPiece& piece) {
    const CutPlane plane(track, piece.sections.last);
    const auto isInCut = [&](const geometry::Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](int v) {
            const Vec3 way = piece.solid.vertices[static_cast<std::size_t>(v)] - plane.origin;
            return std::abs(way.dot(plane.ahead)) < kInPlane;
        });
    };
    // Edges that only one of its triangles has.
    std::set<std::pair<int, int>> open;
    for (const geometry::Triangle& t : piece.solid.triangles) {
        if (!isInCut(t)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::pair<int, int> edge = std::minmax(t[k], t[(k + 1) % 3]);
            if (!open.insert(edge).second) open.erase(edge);
        }
    }
    std::vector<std::vector<base::Vec3>> lines;
    lines.reserve(open.size());
    for (const auto& [from, to] : open) {
        lines.push_back({piece.solid.vertices[static_cast<std::size_t>(from)],
                         piece.solid.vertices[static_cast<std::size_t>(to)]});
    }
    return lines;
}

std::vector<base::Vec3> layApart(const Track& track, const std::vector<PrintPiece>& pieces, double gap) {
    std::vector<base::Vec3> shifts;
    Vec3 shift = Vec3::Zero();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (i > 0) shift += gap * CutPlane(track, pieces[i].sections.first).ahead;
        shifts.push_back(shift);
    }
    // The middle stays where it is.
    for (Vec3& one : shifts)
        one -= 0.5 * shift;
    return shifts;
}

base::Result<std::vector<int>, PrintProblem> proposeCuts(const Track& track, const PrintOptions& options,
                                                         const SplitOptions& split,
                                                         const geometry::BuildSpace& space) {
    SplitOptions uncut = split;
    uncut.cuts.clear();
    if (auto problem = findSplitProblem(track, uncut)) return *problem;
    auto whole = buildPrintSolid(track, options);
    if (!whole) return whole.error();
    const geometry::BedFit fit = geometry::fitOnBed(*whole, space);
    if (fit.fits) return std::vector<int>{};
    if (fit.excess.z() > 0.0) {
        return PrintProblem{"cuts",
                            fmt::format("The track is {:.1f} mm high, the printer prints up to {:g} mm: no "
                                        "cut across it helps.",
                                        inMillimetres(fit.size.z()), inMillimetres(space.height))};
    }

    const int last = lastSectionOf(track);
    std::vector<double> places;
    for (const CrossSection& section : track.sections)
        places.push_back(section.x);
    PrintOptions undrilled = options;
    undrilled.boltDiameter = 0.0;
    // The farthest section that a piece from each one may reach; what is part of a piece that fits fits too.
    std::vector<int> reaches;
    int reach = 0;
    for (int from = 0; from < last; ++from) {
        while (reach < last) {
            const auto piece = buildPrintSolid(track, undrilled, {from, reach + 1});
            if (!piece) return piece.error();
            if (!geometry::fitOnBed(*piece, space).fits) break;
            ++reach;
        }
        if (reach == from) {
            const double length =
                places[static_cast<std::size_t>(from) + 1] - places[static_cast<std::size_t>(from)];
            return PrintProblem{
                "cuts", fmt::format("The segment between sections {} and {}, {:.1f} mm long, is too large "
                                    "for a bed of {:g} x {:g} mm by itself.",
                                    from, from + 1, inMillimetres(length), inMillimetres(space.x),
                                    inMillimetres(space.y))};
        }
        reaches.push_back(reach);
    }

    const CutSearch search(std::move(reaches), std::move(places), shortestBetween(split));
    const DowelPlaces dowels(track, split, std::move(*whole));
    std::set<int> unfit;  // without room for pins
    std::optional<PrintProblem> reason;
    std::set<int> bolted = findBoltedSections(track, options, split);
    while (true) {
        std::set<int> avoided = unfit;
        avoided.insert(bolted.begin(), bolted.end());
        const auto cuts = search.find(avoided);
        if (!cuts) {
            if (!bolted.empty()) {
                bolted.clear();
                continue;
            }
            if (reason) return *reason;
            return PrintProblem{
                "dowelDepth",
                fmt::format("Pieces that fit would be too short for dowels of {:g} mm from both "
                            "sides. Take shorter ones.",
                            inMillimetres(split.dowelDepth))};
        }
        bool isGood = true;
        for (const int cut : *cuts) {
            const auto found = dowels.find(cut);
            if (found) continue;
            isGood = false;
            unfit.insert(cut);
            reason = found.error();
        }
        if (isGood) return *cuts;
    }
}

}  // namespace trapwright::track
