#include "core/part/bundled.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/resources.h"
#include "core/part/shapes.h"

namespace trapwright::part {

namespace {

using base::Vec2;
using base::Vec3;

constexpr std::array<BundledPart, 6> kParts = {{
    {"cuboid", "cuboid.stl", "ABS", "a cuboid, 4 x 8 x 12 mm, the paper's first part"},
    {"cone", "cone.stl", "brass",
     "a cone-like turned part with four stable poses, after the paper's second part"},
    {"bracket", "bracket.stl", "aluminium", "an L bracket, 12 x 10 x 8 mm, 2.5 mm thick"},
    {"pin", "pin.stl", "steel", "a stepped pin, 13 mm long"},
    {"cup", "cup.stl", "PP", "a cup, 12 mm wide and 9 mm high"},
    {"bolt", "bolt.stl", "steel", "a hexagon bolt M4 x 12 (ISO 4017), without its thread"},
}};

constexpr int kFacets = 32;
constexpr double kMm = base::kMillimetre;

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

base::Result<BundledPart> findBundledPart(std::string_view name) {
    std::string known;
    for (const BundledPart& part : kParts) {
        if (part.name == name) return part;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", part.name);
    }
    return base::Error{fmt::format("there is no bundled part \"{}\". The bundled parts are {}", name, known)};
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
