#include "core/verify/scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry/convex_hull.h"
#include "core/track/track_solid.h"

namespace trapwright::verify {

using base::kMillimetre;
using base::Vec2;
using base::Vec3;

namespace {

std::vector<double> spread(double from, double to, int count) {
    std::vector<double> values;
    values.reserve(count);
    for (int i = 0; i < count; ++i)
        values.push_back(from + (to - from) * i / (count - 1));
    return values;
}

}  // namespace

namespace {

/// The hull of these corners, whose centre of mass is the origin.
std::shared_ptr<part::Part> makeConvex(const std::vector<Vec3>& corners, double density) {
    auto part = std::make_shared<part::Part>();
    part->density = density;
    part->hull = geometry::computeConvexHull(corners).value();
    part->pieces = {part->hull};
    part->mesh = geometry::toMesh(part->hull);
    part->massProperties = geometry::calcMassProperties(part->mesh, density);
    for (const Vec3& corner : corners)
        part->boundingRadius = std::max(part->boundingRadius, corner.norm());
    return part;
}

}  // namespace

std::shared_ptr<const part::Part> makeCuboid(const Vec3& size, double density) {
    std::vector<Vec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i)
        corners.emplace_back(
            Vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1).cwiseProduct(0.5 * size));
    const auto part = makeConvex(corners, density);
    part->name = "cuboid";
    part->symmetry.name = "D2";
    part->symmetry.rotations = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    return part;
}

std::shared_ptr<const part::Part> makePrism(const std::vector<Vec2>& profile, double width, double density) {
    // The centre of mass of a prism lies over that of its profile (shoelace formula).
    double area = 0.0;
    Vec2 centre = Vec2::Zero();
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const Vec2& from = profile[i];
        const Vec2& to = profile[(i + 1) % profile.size()];
        const double twice = from.x() * to.y() - to.x() * from.y();
        area += twice;
        centre += twice * (from + to) / 3.0;
    }
    centre /= area;
    std::vector<Vec3> corners;
    for (const Vec2& point : profile)
        for (const double side : {-0.5, 0.5})
            corners.emplace_back(point.x() - centre.x(), side * width, point.y() - centre.y());
    const auto part = makeConvex(corners, density);
    part->name = "prism";
    return part;
}

std::shared_ptr<const part::Part> makePaperCuboid() {
    return makeCuboid(Vec3(4, 8, 12) * kMillimetre, 1040.0);
}

std::shared_ptr<const track::Track> makeSurface(const std::vector<double>& xs, const std::vector<double>& ys,
                                                const std::function<double(double x, double y)>& height,
                                                const track::FeederShape& shape) {
    auto result = std::make_shared<track::Track>();
    result->shape = shape;
    for (const double x : xs) {
        track::CrossSection section;
        section.x = x;
        for (const double y : ys)
            section.points.emplace_back(y, height(x, y));
        result->sections.push_back(section);
    }
    const track::TrackSolid solid =
        track::buildTrackSolid(result->shape, result->sections, 3.0 * kMillimetre);
    result->solid = solid.mesh;
    result->surfaceTriangles = solid.surfaceTriangles;
    result->firstTrapSection = 1;
    result->lastTrapSection = static_cast<int>(result->sections.size()) - 1;
    result->start = xs.front() + 60.0 * kMillimetre;
    result->finish = xs.back();
    result->width = ys.back() - ys.front();
    result->height = 30.0 * kMillimetre;
    return result;
}

std::shared_ptr<const track::Track> makeFlat(const track::FeederShape& shape) {
    return makeSurface(
        spread(0.0, 0.4, 11), spread(-0.03, 0.03, 8), [](double, double) { return 15.0 * kMillimetre; },
        shape);
}

std::shared_ptr<const track::Track> makeSlope(double slopeX, double slopeY) {
    return makeSurface(spread(0.0, 0.6, 13), spread(-0.3, 0.3, 13), [=](double x, double y) {
        return std::tan(slopeX) * x + std::tan(slopeY) * (y + 0.3) + 5.0 * kMillimetre;
    });
}

std::shared_ptr<const track::Track> makeRough() {
    return makeSurface(spread(0.0, 0.4, 17), spread(-0.03, 0.03, 9), [](double x, double y) {
        return 15e-3 + 2.0e-3 * std::sin(110.0 * x + 60.0 * y) + 1.5e-3 * std::sin(230.0 * y - 70.0 * x) +
               60.0 * y * y / 9.0;
    });
}

std::shared_ptr<const track::Track> makeHills(double amplitude) {
    constexpr double kLevel = 0.1;
    std::vector<double> xs = spread(kLevel, 0.34, 13);
    xs.insert(xs.begin(), 0.0);
    return makeSurface(xs, spread(-0.03, 0.03, 9), [=](double x, double y) {
        const double along = std::max(0.0, x - kLevel);
        const double rise = std::min(1.0, along / 0.04);
        return 15e-3 + amplitude * rise *
                           (std::sin(110.0 * along + 60.0 * y) + 0.75 * std::sin(230.0 * y - 70.0 * along));
    });
}

double findSurfaceHeight(const track::Track& track, double x, double y) {
    double highest = -1e300;
    for (std::size_t t = 0; t < track.surfaceTriangles; ++t) {
        const geometry::Triangle& triangle = track.solid.triangles[t];
        const Vec3& a = track.solid.vertices[triangle[0]];
        const Vec3 ab = track.solid.vertices[triangle[1]] - a;
        const Vec3 ac = track.solid.vertices[triangle[2]] - a;
        const double area = ab.x() * ac.y() - ab.y() * ac.x();
        const double u = ((x - a.x()) * ac.y() - (y - a.y()) * ac.x()) / area;
        const double v = ((y - a.y()) * ab.x() - (x - a.x()) * ab.y()) / area;
        if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9) continue;
        highest = std::max(highest, a.z() + u * ab.z() + v * ac.z());
    }
    return highest;
}

trial::TrialBatch makeStillScene(std::shared_ptr<const track::Track> track,
                                 std::shared_ptr<const part::Part> part, const base::Pose& pose,
                                 double duration) {
    trial::TrialBatch scene;
    scene.track = std::move(track);
    scene.parts = {std::move(part)};
    scene.drive.halfStroke = 0.0;
    scene.termination.timeLimit = duration;
    scene.termination.stuckTime = 2.0 * duration;
    scene.trials.resize(1);
    scene.trials[0].parts.resize(1);
    scene.trials[0].parts[0].pose = pose;
    return scene;
}

trial::Trajectory replayScene(const trial::Engine& engine, const trial::TrialBatch& scene, double interval,
                              const base::RunControl& control) {
    auto trajectory = engine.replay(scene, 0, interval, control);
    if (!trajectory) throw std::runtime_error(trajectory.error().message);
    return std::move(trajectory).value();
}

double findEnergyGain(const trial::TrialBatch& scene, const trial::Trajectory& trajectory) {
    const double first = calcEnergy(scene, trajectory.samples.front());
    double least = first;
    double gain = 0.0;
    for (const trial::TrajectorySample& sample : trajectory.samples) {
        const double energy = calcEnergy(scene, sample);
        gain = std::max(gain, energy - least);
        least = std::min(least, energy);
    }
    return gain;
}

double calcEnergy(const trial::TrialBatch& scene, const trial::TrajectorySample& sample) {
    double energy = 0.0;
    for (const trial::PartState& part : sample.parts) {
        const std::size_t kind = scene.trials[0].parts[part.part].part;
        const geometry::MassProperties& mass = scene.parts[kind]->massProperties;
        const Vec3 spin = part.room.rotation.conjugate() * part.angularVelocity;
        energy += 0.5 * mass.mass * part.velocity.squaredNorm() + 0.5 * spin.dot(mass.inertia * spin) -
                  mass.mass * scene.gravityVector().dot(part.room.position);
    }
    return energy;
}

}  // namespace trapwright::verify
