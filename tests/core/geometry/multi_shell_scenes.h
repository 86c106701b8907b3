#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/mass_properties.h"
#include "shapes.h"

/// Parts of several shells whose mass properties are known in closed form.
namespace trapwright::geometry::multi_shell {

inline constexpr int kSides = 20;

/// Volume, first and second moments about the origin of a body whose integrals are known in closed form.
struct Moments {
    double volume = 0.0;
    base::Vec3 first = base::Vec3::Zero();
    base::Mat3 second = base::Mat3::Zero();

    Moments operator+(const Moments& o) const {
        return {volume + o.volume, first + o.first, second + o.second};
    }
    Moments operator-(const Moments& o) const {
        return {volume - o.volume, first - o.first, second - o.second};
    }
    [[nodiscard]] base::Vec3 centre() const { return first / volume; }
    [[nodiscard]] base::Mat3 inertia() const {
        const base::Mat3 central = second - volume * centre() * centre().transpose();
        return central.trace() * base::Mat3::Identity() - central;
    }
};

/// Of a body with this volume, centre and second moments about its centre along the axes.
inline Moments momentsAbout(double volume, const base::Vec3& centre, const base::Vec3& central) {
    return {volume, volume * centre, base::Mat3(central.asDiagonal()) + volume * centre * centre.transpose()};
}

/// A box in millimetres, in its simplest form and as a mesh.
struct Block {
    base::Vec3 low;
    base::Vec3 high;

    [[nodiscard]] TriangleMesh mesh() const { return shapes::makeBox(low, high); }
    [[nodiscard]] Moments moments() const {
        const base::Vec3 size = high - low;
        const double volume = size.prod();
        return momentsAbout(volume, 0.5 * (low + high), volume / 12.0 * size.cwiseAbs2());
    }
};

/// An upright regular prism about (x, y), in millimetres.
struct Peg {
    double x, y, radius, low, high;

    [[nodiscard]] TriangleMesh mesh() const {
        TriangleMesh mesh = shapes::makePrism(shapes::makeCircle(kSides, radius), high - low);
        shapes::transform(mesh, {base::Quaternion::Identity(), {x, y, low}});
        return mesh;
    }
    [[nodiscard]] Moments moments() const {
        const double area = shapes::calcCircleArea(kSides, radius);
        const double height = high - low;
        const double planar =
            area * height * radius * radius / 12.0 * (2.0 + std::cos(2.0 * base::kPi / kSides));
        return momentsAbout(area * height, {x, y, 0.5 * (low + high)},
                            {planar, planar, area * height * height * height / 12.0});
    }
};

/// A tube about z: what is left of a peg around a narrower one.
inline TriangleMesh makeTube(double outer, double inner, double low, double high) {
    TriangleMesh mesh;
    for (const base::Vec2& ring : {base::Vec2(outer, low), {outer, high}, {inner, high}, {inner, low}})
        for (const base::Vec2& p : shapes::makeCircle(kSides, ring.x()))
            mesh.vertices.emplace_back(p.x(), p.y(), ring.y());
    for (int band = 0; band < 4; ++band)
        for (int i = 0; i < kSides; ++i) {
            const int j = (i + 1) % kSides;
            const int low0 = band * kSides;
            const int high0 = (band + 1) % 4 * kSides;
            mesh.triangles.push_back({low0 + i, low0 + j, high0 + j});
            mesh.triangles.push_back({low0 + i, high0 + j, high0 + i});
        }
    return mesh;
}

inline TriangleMesh turned(TriangleMesh mesh) {
    shapes::turnInsideOut(mesh);
    return mesh;
}

/// A box whose faces are cut along their other diagonals.
inline TriangleMesh cutOtherwise(const Block& block) {
    TriangleMesh mesh;
    const base::Vec3 middle = 0.5 * (block.low + block.high);
    mesh = block.mesh();
    for (base::Vec3& v : mesh.vertices)
        v.x() = 2.0 * middle.x() - v.x();
    return turned(mesh);
}

/// Shells as a file has them, and the solid that they mean. [mm]
struct Scene {
    const char* name;
    std::vector<TriangleMesh> shells;
    Moments solid;
    const char* note;  // that the user is told; "" where it depends on rounding
};

inline std::vector<Scene> makeScenes() {
    std::vector<Scene> scenes;
    const Block box{{0, 0, 0}, {40, 30, 20}};
    const Block plate{{0, 0, 0}, {40, 30, 4}};
    const auto add = [&](const char* name, std::vector<TriangleMesh> shells, const Moments& solid,
                         const char* note = "") {
        scenes.push_back({name, std::move(shells), solid, note});
    };
    const auto corners = [](double inset, double low, double high) {
        std::vector<Block> plates;
        for (const double x : {inset, 40 - inset - 6})
            for (const double y : {inset, 30 - inset - 6})
                plates.push_back({{x, y, low}, {x + 6, y + 6, high}});
        return plates;
    };
    const auto withCorners = [&](const char* name, double inset, double low, double high) {
        std::vector<TriangleMesh> shells = {box.mesh()};
        Moments solid = box.moments();
        for (const Block& corner : corners(inset, low, high)) {
            shells.push_back(corner.mesh());
            solid = solid + Block{corner.low, {corner.high.x(), corner.high.y(), 0}}.moments();
        }
        add(name, shells, solid, "united 5 shells");
    };
    withCorners("four feet in the corners, touching", 0, -3, 0);
    withCorners("four feet in the corners, overlapping", 0, -3, 2);
    withCorners("four feet within, touching", 2, -3, 0);
    withCorners("four feet within, overlapping", 2, -3, 5);
    {
        std::vector<TriangleMesh> shells = {box.mesh()};
        Moments solid = box.moments();
        for (const Block& corner : corners(0, 5, 8)) {
            const Block out{{corner.low.x() - 2, corner.low.y() - 2, 5},
                            {corner.high.x() + 2, corner.high.y() + 2, 8}};
            const Block in{out.low.cwiseMax(box.low), out.high.cwiseMin(box.high)};
            shells.push_back(out.mesh());
            solid = solid + out.moments() - in.moments();
        }
        add("four plates around the corners", shells, solid, "united 5 shells");
    }

    const Peg standing{15, 12, 5, 4, 14};
    add("peg on a plate", {plate.mesh(), standing.mesh()}, plate.moments() + standing.moments(),
        "united 2 shells");
    const Peg sunk{15, 12, 5, 2, 14};
    add("peg sunk into a plate", {plate.mesh(), sunk.mesh()}, plate.moments() + standing.moments(),
        "united 2 shells that overlap");
    const Peg flush{15, 12, 5, 0, 14};
    add("peg flush with the bottom", {plate.mesh(), flush.mesh()}, plate.moments() + standing.moments(),
        "united 2 shells");
    const Peg through{15, 12, 5, -6, 14};
    add("peg through a plate", {plate.mesh(), through.mesh()},
        plate.moments() + standing.moments() + Peg{15, 12, 5, -6, 0}.moments(),
        "united 2 shells that overlap");
    add("peg wholly in the plate, flush on both sides", {plate.mesh(), Peg{15, 12, 5, 0, 4}.mesh()},
        plate.moments(), "united 2 shells");
    add("peg wholly in the plate, flush below", {plate.mesh(), Peg{15, 12, 5, 0, 3}.mesh()}, plate.moments());
    add("a peg inside out through a plate", {plate.mesh(), turned(through.mesh())},
        plate.moments() + standing.moments() + Peg{15, 12, 5, -6, 0}.moments(),
        "united 2 shells that overlap");

    const Moments tube = Peg{0, 0, 12, 0, 6}.moments() - Peg{0, 0, 6, 0, 6}.moments();
    const Peg loose{0, 0, 5.5, -4, 10};
    add("peg in a hole with clearance", {makeTube(12, 6, 0, 6), loose.mesh()}, tube + loose.moments(),
        "kept 2 shells, 0 of them cavities");
    const Peg fitting{0, 0, 6, -4, 10};
    add("peg that fills its hole", {makeTube(12, 6, 0, 6), fitting.mesh()}, tube + fitting.moments(),
        "united 2 shells");

    const auto nest = [&](int i) {
        return Block{base::Vec3::Constant(2.0 * i), base::Vec3(40, 30, 20) - base::Vec3::Constant(2.0 * i)};
    };
    add("a cavity", {nest(0).mesh(), turned(nest(1).mesh())}, nest(0).moments() - nest(1).moments(),
        "kept 2 shells, 1 of them a cavity");
    add("a cavity that faces outward", {nest(0).mesh(), nest(1).mesh()},
        nest(0).moments() - nest(1).moments(), "1 of them a cavity");
    add("a solid in a cavity", {nest(0).mesh(), turned(nest(1).mesh()), nest(2).mesh()},
        nest(0).moments() - nest(1).moments() + nest(2).moments(), "kept 3 shells, 1 of them a cavity");
    add("a solid in a cavity, all outward", {nest(0).mesh(), nest(1).mesh(), nest(2).mesh()},
        nest(0).moments() - nest(1).moments() + nest(2).moments(), "kept 3 shells, 1 of them a cavity");
    add("a cavity in a solid in a cavity",
        {nest(0).mesh(), turned(nest(1).mesh()), nest(2).mesh(), turned(nest(3).mesh())},
        nest(0).moments() - nest(1).moments() + nest(2).moments() - nest(3).moments(),
        "kept 4 shells, 2 of them cavities");
    add("a hollow part inside out as a whole", {turned(nest(0).mesh()), nest(1).mesh()},
        nest(0).moments() - nest(1).moments(), "kept 2 shells, 1 of them a cavity");
    add("an outer wall inside out", {turned(nest(0).mesh()), turned(nest(1).mesh())},
        nest(0).moments() - nest(1).moments(), "kept 2 shells, 1 of them a cavity");
    const Block left{{3, 3, 3}, {15, 25, 15}};
    const Block right{{20, 3, 3}, {35, 25, 15}};
    add("two cavities", {box.mesh(), turned(left.mesh()), turned(right.mesh())},
        box.moments() - left.moments() - right.moments(), "kept 3 shells, 2 of them cavities");
    add("a cavity and an insert that faces outward", {box.mesh(), turned(left.mesh()), right.mesh()},
        box.moments() - left.moments(), "united 2 shells");
    add("an insert in its cavity", {box.mesh(), turned(left.mesh()), left.mesh()}, box.moments());
    const Block longer{{3, 3, 3}, {22, 25, 15}};
    add("an insert that is longer than its cavity", {box.mesh(), turned(left.mesh()), longer.mesh()},
        box.moments());
    const Block lying{{5, 5, 3}, {10, 10, 9}};
    add("a solid that lies in its cavity", {box.mesh(), turned(left.mesh()), lying.mesh()},
        box.moments() - left.moments() + lying.moments());
    add("two cavities that overlap", {box.mesh(), turned(left.mesh()), turned(longer.mesh())},
        box.moments() - longer.moments());
    const Block open{{3, 3, 8}, {15, 25, 20}};
    add("a cavity that reaches the top", {box.mesh(), turned(open.mesh())}, box.moments() - open.moments());
    add("a cavity that reaches an edge", {box.mesh(), turned(Block{{0, 3, 8}, {15, 25, 20}}.mesh())},
        box.moments() - Block{{0, 3, 8}, {15, 25, 20}}.moments());
    const Block along0{{0, 0, 8}, {40, 12, 20}};
    add("a cavity along an edge", {box.mesh(), turned(along0.mesh())}, box.moments() - along0.moments());
    const Block slab{{0, 0, 0}, {40, 12, 20}};
    add("a cavity that takes a side away", {box.mesh(), turned(slab.mesh())}, box.moments() - slab.moments());
    const Block rib{{0, 0, 20}, {40, 6, 31}};
    add("a rib along an edge", {box.mesh(), rib.mesh()}, box.moments() + rib.moments(), "united 2 shells");
    {
        // A bar of rhombic cross-section along y, one edge of it in the top.
        TriangleMesh bar = shapes::makePrism({{15, 10}, {20, 15}, {15, 20}, {10, 15}}, 10);
        for (base::Vec3& v : bar.vertices)
            v = base::Vec3(v.x(), v.z() + 5, v.y());
        const double across = 500 * 25 / 6.0;
        add("a cavity that touches the top in an edge", {box.mesh(), bar},
            box.moments() - momentsAbout(500, {15, 10, 15}, {across, 500 * 100 / 12.0, across}));
    }

    const Block along{{-20, -3, -3}, {20, 3, 3}};
    const Block across{{-3, -20, -3}, {3, 20, 3}};
    const Block upright{{-3, -3, -20}, {3, 3, 20}};
    const Block middle{{-3, -3, -3}, {3, 3, 3}};
    add("a cross of two bars in one plane", {along.mesh(), across.mesh()},
        along.moments() + across.moments() - middle.moments(), "united 2 shells");
    add("a cross of three bars", {along.mesh(), across.mesh(), upright.mesh()},
        along.moments() + across.moments() + upright.moments() - middle.moments() - middle.moments(),
        "united 3 shells");
    const Block above{{-3, -20, 3}, {3, 20, 9}};
    add("a bar across another one", {along.mesh(), above.mesh()}, along.moments() + above.moments());
    const Block notched{{-3, -20, 0}, {3, 20, 9}};
    add("a bar across and into another one", {along.mesh(), notched.mesh()},
        along.moments() + above.moments() + Block{{-3, -20, 0}, {3, -3, 3}}.moments() +
            Block{{-3, 3, 0}, {3, 20, 3}}.moments(),
        "united 2 shells that overlap");
    {
        std::vector<TriangleMesh> shells;
        Moments solid;
        for (int i = 0; i < 6; ++i) {
            const Block link{{7.0 * i, 1.0 * i, 0.5 * i}, {7.0 * i + 10, 1.0 * i + 8, 0.5 * i + 6}};
            shells.push_back(link.mesh());
            solid = solid + link.moments();
            if (i > 0) solid = solid - Block{link.low, {7.0 * i + 3, 1.0 * i + 7, 0.5 * i + 5.5}}.moments();
        }
        add("a chain of boxes", shells, solid, "united 6 shells that overlap");
    }
    const Block cube{{0, 0, 0}, {10, 10, 10}};
    const Block diagonal{{10, 10, 0}, {20, 20, 10}};
    add("cubes at one edge", {cube.mesh(), diagonal.mesh()}, cube.moments() + diagonal.moments());
    const Block shifted{{10, 10, 4}, {20, 20, 14}};
    add("cubes at a part of an edge", {cube.mesh(), shifted.mesh()}, cube.moments() + shifted.moments());
    const Block far{{10, 10, 10}, {20, 20, 20}};
    add("cubes at one corner", {cube.mesh(), far.mesh()}, cube.moments() + far.moments());
    const Block stacked{{0, 0, 10}, {10, 10, 24}};
    add("two boxes with a face in common", {cube.mesh(), stacked.mesh()}, cube.moments() + stacked.moments());
    add("two boxes with a face in common, cut otherwise", {cube.mesh(), cutOtherwise(stacked)},
        cube.moments() + stacked.moments());
    const Block beside{{10, 0, 0}, {20, 10, 24}};
    add("two boxes with a part of a face in common", {cube.mesh(), beside.mesh()},
        cube.moments() + beside.moments());
    const Block third{{10, 0, 0}, {20, 10, 10}};
    add("three cubes in a corner", {cube.mesh(), third.mesh(), Block{{10, 10, 0}, {20, 20, 10}}.mesh()},
        cube.moments() + third.moments() + Block{{10, 10, 0}, {20, 20, 10}}.moments());
    add("a cube twice", {cube.mesh(), cube.mesh()}, cube.moments());
    add("a cube twice, cut otherwise", {cube.mesh(), cutOtherwise(cube)}, cube.moments());
    add("a cube inside out", {turned(cube.mesh())}, cube.moments(), "turned 12 triangles");
    const Block apart{{30, 0, 0}, {45, 12, 9}};
    add("two boxes apart, one inside out", {turned(cube.mesh()), apart.mesh()},
        cube.moments() + apart.moments(), "kept 2 shells, 0 of them cavities");
    const Peg thin{0, 0, 3, -10, 20};
    const Peg thick{0, 0, 8, 0, 12};
    add("a thin peg through a thick one", {thin.mesh(), thick.mesh()},
        thick.moments() + Peg{0, 0, 3, -10, 0}.moments() + Peg{0, 0, 3, 12, 20}.moments(),
        "united 2 shells that overlap");
    return scenes;
}

/// What is done to the triangles before they are read.
struct Disguise {
    const char* name;
    bool shuffled, rotated, asFloats;
    std::uint64_t seed;
};
inline constexpr std::array<Disguise, 10> kDisguises = {{{"as made", false, false, false, 0},
                                                         {"shuffled 1", true, false, false, 1},
                                                         {"shuffled 2", true, false, false, 2},
                                                         {"shuffled 3", true, false, false, 3},
                                                         {"rotated 1", false, true, false, 1},
                                                         {"rotated 2", true, true, false, 2},
                                                         {"rotated 3", true, true, false, 3},
                                                         {"rotated, floats 1", true, true, true, 1},
                                                         {"rotated, floats 2", true, true, true, 2},
                                                         {"rotated, floats 3", true, true, true, 3}}};

/// A soup, as an STL file has it, in metres.
struct Sample {
    TriangleMesh mesh;
    base::Pose pose;
    double area = 0.0;   // of all shells [m^2]
    double reach = 0.0;  // largest coordinate [m]
};

inline Sample makeSample(const Scene& scene, const Disguise& disguise) {
    base::Random random({.seed = disguise.seed});
    Sample sample;
    if (disguise.rotated)
        sample.pose = {random.rotation(), {random.uniform(-30, 30), random.uniform(-30, 30), 7}};
    std::vector<std::array<base::Vec3, 3>> triangles;
    for (const TriangleMesh& shell : scene.shells)
        for (const Triangle& t : shell.triangles) {
            triangles.push_back({shell.vertices[t[0]], shell.vertices[t[1]], shell.vertices[t[2]]});
            if (disguise.shuffled) {
                const std::uint32_t turn = random.below(3);
                std::rotate(triangles.back().begin(), triangles.back().begin() + turn,
                            triangles.back().end());
            }
        }
    if (disguise.shuffled)
        for (std::size_t i = triangles.size(); i > 1; --i)
            std::swap(triangles[i - 1], triangles[random.below(static_cast<std::uint32_t>(i))]);
    for (const auto& triangle : triangles) {
        const int first = static_cast<int>(sample.mesh.vertices.size());
        for (const base::Vec3& corner : triangle) {
            base::Vec3 point = sample.pose.apply(corner);
            if (disguise.asFloats) point = point.cast<float>().cast<double>();
            sample.mesh.vertices.push_back(point * base::kMillimetre);
            sample.reach = std::max(sample.reach, sample.mesh.vertices.back().cwiseAbs().maxCoeff());
        }
        sample.mesh.triangles.push_back({first, first + 1, first + 2});
    }
    sample.area = calcMassProperties(sample.mesh, 1.0).area;
    return sample;
}

}  // namespace trapwright::geometry::multi_shell
