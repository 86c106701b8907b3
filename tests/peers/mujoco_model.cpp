#include "tests/peers/mujoco_model.h"

#include <fmt/format.h>

#include <iterator>

#include "tests/peers/box_shape.h"

namespace trapwright::peers {

using base::Vec3;

namespace {

/// Steeper triangles than this (sine of what is left to the vertical) have no prism below them.
constexpr double kLeastUpward = 1e-3;

void writeMesh(std::string& xml, const std::string& name, const std::vector<Vec3>& points) {
    fmt::format_to(std::back_inserter(xml), R"(<mesh name="{}" vertex=")", name);
    for (const Vec3& p : points)
        fmt::format_to(std::back_inserter(xml), "{} {} {} ", p.x(), p.y(), p.z());
    xml += "\"/>\n";
}

}  // namespace

base::Result<std::string> writeMujocoModel(const trial::TrialBatch& batch, const part::Part& part,
                                           double step) {
    const track::Track& track = *batch.track;
    std::string assets;
    std::string trackGeoms;
    const double base = geometry::calcBoundingBox(track.solid).low.z();
    for (std::size_t t = 0; t < track.surfaceTriangles; ++t) {
        if (geometry::triangleNormal(track.solid, t).z() < kLeastUpward)
            return base::Error{"MuJoCo knows convex solids only, and the surface overhangs."};
        std::vector<Vec3> prism;
        for (const int index : track.solid.triangles[t]) {
            prism.push_back(track.solid.vertices[static_cast<std::size_t>(index)]);
            prism.emplace_back(prism.back().x(), prism.back().y(), base);
        }
        const std::string name = fmt::format("t{}", t);
        writeMesh(assets, name, prism);
        trackGeoms += fmt::format("<geom type=\"mesh\" mesh=\"{}\"/>\n", name);
    }

    std::string partGeoms;
    if (const auto box = findBox(part)) {
        partGeoms = fmt::format("<geom type=\"box\" size=\"{} {} {}\"/>\n", box->x(), box->y(), box->z());
    } else {
        for (std::size_t p = 0; p < part.pieces.size(); ++p) {
            const std::string name = fmt::format("p{}", p);
            writeMesh(assets, name, part.pieces[p].vertices);
            partGeoms += fmt::format("<geom type=\"mesh\" mesh=\"{}\"/>\n", name);
        }
    }

    const geometry::MassProperties& mass = part.massProperties;
    const base::Mat3& i = mass.inertia;
    const base::Vec3 gravity = batch.gravityVector();
    return fmt::format(R"(<mujoco>
<compiler inertiafromgeom="false" boundmass="0" balanceinertia="false"/>
<option timestep="{}" gravity="{} 0 {}" cone="elliptic" solver="Newton" jacobian="dense" integrator="Euler" impratio="10" mpr_tolerance="1e-9">
<flag multiccd="enable"/></option>
<size njmax="1000" nconmax="200"/>
<asset>
{}</asset>
<worldbody>
{}<body name="part"><freejoint/>
<inertial pos="0 0 0" mass="{}" fullinertia="{} {} {} {} {} {}"/>
{}</body>
</worldbody>
</mujoco>
)",
                       step, gravity.x(), gravity.z(), assets, trackGeoms, mass.mass, i(0, 0), i(1, 1),
                       i(2, 2), i(0, 1), i(0, 2), i(1, 2), partGeoms);
}

}  // namespace trapwright::peers
