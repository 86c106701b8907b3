#include "core/track/print_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "core/geometry/solid_cut.h"
#include "core/track/print_mount.h"
#include "core/track/print_outline.h"
#include "core/track/track_solid.h"

namespace trapwright::track {

namespace {

constexpr int kBoltSides = 48;
constexpr int kInsertSides = 360;              // 175 mm: within 7 micrometres of the circle
constexpr double kBeyond = base::kMillimetre;  // how far tools reach past what they cut

/// Of the places of the track's plane, in the room.
double lowestRiseOf(const Track& track) {
    return std::min(track.shape.rise(track.begin()), track.shape.rise(track.end()));
}
double highestRiseOf(const Track& track) {
    return std::max(track.shape.rise(track.begin()), track.shape.rise(track.end()));
}

PrintOutline makeOutline(const Track& track, const PrintOptions& options) {
    PrintOutline outline;
    const double thickness = options.baseThickness.value_or(track.baseThickness);
    outline.base = findBase(track.shape, track.sections, thickness);
    outline.outerSide = outerSideOf(track, options);
    outline.innerSide = -outline.outerSide;
    // What the track was simulated with is printed at least.
    if (track.walls.any()) outline.width = track.width;
    outline.crest = findCrest(track.sections);
    const double inner = std::max(track.walls.inner, options.wallHeight);
    const double outer = std::max(track.walls.outer, options.wallHeight);
    if (inner > 0.0) outline.innerWall = inner;
    if (outer > 0.0) outline.outerWall = outer;
    outline.rims = placeRims(track, options.rim);
    if (!options.flange) return outline;
    // Of equal thicknesses the sum must be 0, whatever rounding says.
    outline.flangeTop = lowestRiseOf(track) + std::min(0.0, options.flangeThickness - thickness);
    if (track.shape.type == FeederType::linear) {
        outline.outerFlange = outline.outerSide + flangeWidthOf(options);
        outline.innerFlange = -*outline.outerFlange;
    } else {
        // Chords between the rows must stay outside the circle that is cut.
        outline.outerFlange = (insertRadiusOf(track, options) + kBeyond) / std::cos(0.5 * kLargestBowlStep) -
                              track.shape.bowlRadius;
    }
    return outline;
}

void append(geometry::TriangleMesh& mesh, const geometry::TriangleMesh& other) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const geometry::Triangle& t : other.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace

base::Result<geometry::TriangleMesh, PrintProblem> buildPrintSolid(const Track& track,
                                                                   const PrintOptions& options) {
    return buildPrintSolid(track, options, {0, static_cast<int>(track.sections.size()) - 1});
}

base::Result<geometry::TriangleMesh, PrintProblem> buildPrintSolid(const Track& track,
                                                                   const PrintOptions& options,
                                                                   const SectionRange& range) {
    assert(range.first >= 0 && range.first < range.last &&
           range.last < static_cast<int>(track.sections.size()));
    if (auto problem = findPrintProblem(track, options)) return *problem;
    const PrintOutline outline = makeOutline(track, options);
    const std::span<const CrossSection> sections(track.sections);
    geometry::TriangleMesh solid =
        buildOutlined(track.shape, sections.subspan(range.first, range.last - range.first + 1), outline).mesh;
    if (!options.flange) return solid;

    const double low = outline.base - kBeyond;
    if (track.shape.type == FeederType::bowl) {
        const auto top = std::ranges::max_element(outline.crest, {}, [](const auto& at) { return at.y(); });
        const double high = highestRiseOf(track) + top->y() +
                            std::max(outline.innerWall.value_or(0.0), outline.outerWall.value_or(0.0)) +
                            kBeyond;
        auto cut = geometry::intersectSolids(
            solid,
            geometry::makeCylinder({0.0, 0.0}, insertRadiusOf(track, options), low, high, kInsertSides));
        if (!cut) return PrintProblem{"insertRadius", cut.error().message};
        solid = std::move(*cut);
    }
    // A bolt needs the whole diameter between the sides of its hole.
    const double corner = 0.5 * options.boltDiameter / std::cos(base::kPi / kBoltSides);
    geometry::TriangleMesh bolts;
    for (const base::Vec2& centre : placeBolts(track, options))
        append(bolts, geometry::makeCylinder(centre, corner, low, outline.flangeTop + kBeyond, kBoltSides));
    if (bolts.triangles.empty()) return solid;
    auto drilled = geometry::subtractSolid(solid, bolts);
    if (!drilled) return PrintProblem{"boltDiameter", drilled.error().message};
    return std::move(*drilled);
}

}  // namespace trapwright::track
