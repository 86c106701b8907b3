#include "core/part/bundled.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>

#include "core/base/resources.h"
#include "core/geometry/sliver_removal.h"
#include "core/geometry/solid_cut.h"
#include "core/part/shapes.h"

namespace trapwright::part {

namespace {

using base::Vec2;
using base::Vec3;

constexpr std::array<BundledPart, 14> kParts = {{
    {"cuboid", "cuboid.stl", "ABS", "a cuboid, 4 x 8 x 12 mm, the paper's first part"},
    {"cone", "cone.stl", "brass",
     "a cone-like turned part with four stable poses, after the paper's second part"},
    {"bracket", "bracket.stl", "aluminium", "an L bracket, 12 x 10 x 8 mm, 2.5 mm thick"},
    {"pin", "pin.stl", "steel", "a stepped pin, 13 mm long"},
    {"cup", "cup.stl", "PP", "a cup, 12 mm wide and 9 mm high"},
    {"bolt", "bolt.stl", "steel", "a hexagon bolt M4 x 12 (ISO 4017), without its thread"},
    {"screw", "screw.stl", "steel", "a pan-head screw M4 x 10, without thread and drive"},
    {"washer", "washer.stl", "steel", "a washer for M4, 9 mm wide and 0.8 mm thick (ISO 7089)"},
    {"clip", "clip.stl", "steel", "a clip bent like a Z, flanges of 8 and 5 mm, 1.5 mm thick"},
    {"wedge", "wedge.stl", "ABS", "a wedge, 12 x 7 x 6 mm"},
    {"plate", "plate.stl", "aluminium", "a triangular plate with a hole, 14 x 10 mm, 3 mm thick"},
    {"d-shaft", "d-shaft.stl", "steel", "a shaft, 14 mm long and 6 mm wide, with a flat at one end"},
    {"holed-bracket", "holed-bracket.stl", "aluminium", "an L bracket with a hole off its centre"},
    {"housing", "housing.stl", "PA6", "a connector's housing, 12 x 8 x 7 mm, open above, with a keyway"},
}};

constexpr int kFacets = 32;
constexpr double kMm = base::kMillimetre;
constexpr double kNoHeight =
    1e-9;  // of triangles that a cut leaves, where three of its corners are in a row [m]

const std::array<Vec2, 6> kBracket = {Vec2(2.5 * kMm, 2.5 * kMm), Vec2(2.5 * kMm, 10.0 * kMm),
                                      Vec2(0.0, 10.0 * kMm),      Vec2(0.0, 0.0),
                                      Vec2(12.0 * kMm, 0.0),      Vec2(12.0 * kMm, 2.5 * kMm)};

/// (radius, z) in mm, from the axis at the bottom round to the axis at the top.
template <std::size_t N>
geometry::TriangleMesh turnMillimetres(std::array<Vec2, N> profile) {
    for (Vec2& point : profile)
        point *= kMm;
    return makeTurned(profile, kFacets);
}

/// A box between two corners in mm.
geometry::TriangleMesh makeBlock(const Vec3& low, const Vec3& high) {
    geometry::TriangleMesh mesh = makeBox((high - low) * kMm);
    for (Vec3& vertex : mesh.vertices)
        vertex += 0.5 * (low + high) * kMm;
    return mesh;
}

/// What is left of a solid; tools reach out of it, so that no face lies on another.
geometry::TriangleMesh cut(geometry::TriangleMesh solid,
                           std::initializer_list<geometry::TriangleMesh> tools) {
    for (const geometry::TriangleMesh& tool : tools) {
        auto rest = geometry::subtractSolid(solid, tool);
        assert(rest.ok());
        solid = std::move(rest).value();
    }
    return geometry::removeSlivers(solid, kNoHeight);
}

/// An upright hole or shaft, from z = low to z = high; in mm.
geometry::TriangleMesh makeRod(const Vec2& centre, double diameter, double low, double high) {
    return geometry::makeCylinder(centre * kMm, 0.5 * diameter * kMm, low * kMm, high * kMm, kFacets);
}

/// Upright becomes across: y and z change places.
geometry::TriangleMesh turnedOver(geometry::TriangleMesh mesh) {
    for (Vec3& vertex : mesh.vertices)
        vertex = Vec3(vertex.x(), vertex.z(), vertex.y());
    for (auto& triangle : mesh.triangles)
        std::swap(triangle[0], triangle[1]);
    return mesh;
}

/// A hexagon head that stands on the x-y plane, with a round shank on it.
geometry::TriangleMesh makeBolt(double acrossFlats, double headHeight, double diameter, double length) {
    constexpr int kSides = 6;
    constexpr int kShankFacets = 48;  // a multiple of the sides, so that the bolt maps onto itself
    constexpr int kPerSide = kShankFacets / kSides;
    geometry::TriangleMesh mesh;
    const auto addRing = [&](int corners, double radius, double z) {
        const int first = static_cast<int>(mesh.vertices.size());
        for (int k = 0; k < corners; ++k) {
            const double angle = 2.0 * base::kPi * k / corners;
            mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
        return [first, corners](int k) { return first + k % corners; };
    };
    const double cornerRadius = acrossFlats / std::sqrt(3.0);
    const auto under = addRing(kSides, cornerRadius, 0.0);
    const auto head = addRing(kSides, cornerRadius, headHeight);
    const auto neck = addRing(kShankFacets, 0.5 * diameter, headHeight);
    const auto tip = addRing(kShankFacets, 0.5 * diameter, headHeight + length);
    const int bottom = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(0.0, 0.0, 0.0);
    mesh.vertices.emplace_back(0.0, 0.0, headHeight + length);
    for (int side = 0; side < kSides; ++side) {
        mesh.triangles.push_back({bottom, under(side + 1), under(side)});
        mesh.triangles.push_back({under(side), under(side + 1), head(side + 1)});
        mesh.triangles.push_back({under(side), head(side + 1), head(side)});
        // Round the neck: the first half of a side's facets sees its first corner, the rest its second.
        for (int k = 0; k < kPerSide; ++k) {
            const int facet = side * kPerSide + k;
            mesh.triangles.push_back(
                {head(2 * k < kPerSide ? side : side + 1), neck(facet + 1), neck(facet)});
        }
        mesh.triangles.push_back({head(side), head(side + 1), neck(side * kPerSide + kPerSide / 2)});
    }
    for (int k = 0; k < kShankFacets; ++k) {
        mesh.triangles.push_back({neck(k), neck(k + 1), tip(k + 1)});
        mesh.triangles.push_back({neck(k), tip(k + 1), tip(k)});
        mesh.triangles.push_back({bottom + 1, tip(k), tip(k + 1)});
    }
    return mesh;
}

}  // namespace

std::span<const BundledPart> listBundledParts() {
    return kParts;
}

std::string nameBundledParts() {
    std::string names;
    for (const BundledPart& part : kParts)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", part.name);
    return names;
}

base::Result<BundledPart> findBundledPart(std::string_view name) {
    for (const BundledPart& part : kParts) {
        if (part.name == name) return part;
    }
    return base::Error{
        fmt::format("there is no bundled part \"{}\". The bundled parts are {}", name, nameBundledParts())};
}

geometry::TriangleMesh makeBundledShape(std::string_view name) {
    if (name == "cuboid") return makeBox(Vec3(4.0, 8.0, 12.0) * kMm);
    if (name == "bracket") return makePrism(kBracket, bracketWidth());
    if (name == "cone") {
        // A pin under a sharp-rimmed cone: rests on either end, on the cone, and on rim and pin.
        return turnMillimetres<6>({Vec2(0.0, 0.0), Vec2(3.2, 0.0), Vec2(3.2, 3.0), Vec2(5.5, 3.0),
                                   Vec2(2.8, 11.0), Vec2(0.0, 11.0)});
    }
    if (name == "pin") {
        return turnMillimetres<6>({Vec2(0.0, 0.0), Vec2(3.0, 0.0), Vec2(3.0, 6.0), Vec2(1.75, 6.0),
                                   Vec2(1.75, 13.0), Vec2(0.0, 13.0)});
    }
    if (name == "cup") {
        return turnMillimetres<6>(
            {Vec2(0.0, 0.0), Vec2(5.0, 0.0), Vec2(6.0, 9.0), Vec2(4.7, 9.0), Vec2(3.8, 1.5), Vec2(0.0, 1.5)});
    }
    if (name == "bolt") return makeBolt(7.0 * kMm, 2.8 * kMm, 4.0 * kMm, 12.0 * kMm);
    if (name == "screw") {
        return turnMillimetres<7>({Vec2(0.0, 0.0), Vec2(2.5, 0.0), Vec2(4.0, 1.3), Vec2(4.0, 2.4),
                                   Vec2(2.0, 2.4), Vec2(2.0, 12.4), Vec2(0.0, 12.4)});
    }
    if (name == "washer")
        return cut(makeRod({0.0, 0.0}, 9.0, 0.0, 0.8), {makeRod({0.0, 0.0}, 4.3, -1.0, 2.0)});
    if (name == "clip") {
        return cut(
            makeBlock({0.0, 0.0, 0.0}, {11.5, 8.0, 6.0}),
            {makeBlock({-1.0, 1.5, -1.0}, {6.5, 9.0, 7.0}), makeBlock({8.0, -1.0, -1.0}, {12.0, 6.5, 7.0})});
    }
    if (name == "wedge")
        return makePrism(std::array{Vec2(0.0, 0.0), Vec2(12.0 * kMm, 0.0), Vec2(0.0, 7.0 * kMm)}, 6.0 * kMm);
    if (name == "plate") {
        return cut(makePrism(std::array{Vec2(0.0, 0.0), Vec2(14.0 * kMm, 0.0), Vec2(4.0 * kMm, 10.0 * kMm)},
                             3.0 * kMm),
                   {makeRod({5.0, 3.5}, 3.5, -1.0, 4.0)});
    }
    if (name == "d-shaft") {
        return cut(makeRod({0.0, 0.0}, 6.0, 0.0, 14.0), {makeBlock({1.8, -4.0, 8.0}, {4.0, 4.0, 15.0})});
    }
    if (name == "holed-bracket") {
        return cut(makePrism(kBracket, bracketWidth()), {turnedOver(makeRod({8.2, 5.3}, 3.2, -1.0, 4.0))});
    }
    if (name == "housing") {
        return cut(
            makeBlock({0.0, 0.0, 0.0}, {12.0, 8.0, 7.0}),
            {makeBlock({1.2, 1.2, 2.0}, {10.8, 6.8, 8.0}), makeBlock({2.0, -1.0, 3.5}, {4.5, 2.0, 9.0})});
    }
    return {};
}

std::filesystem::path findBundledFile(const BundledPart& part) {
    return base::findResource(std::filesystem::path("parts") / part.file);
}

std::span<const Vec2> bracketProfile() {
    return kBracket;
}

double bracketWidth() {
    return 8.0 * kMm;
}

}  // namespace trapwright::part
