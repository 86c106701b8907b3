#include "tests/peers/points_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/convex_hull.h"
#include "sim/contact/drive_motion.h"
#include "sim/contact/law.h"

namespace trapwright::peers {

namespace {

using base::Mat3;
using base::Vec2;
using base::Vec3;

// The cloud. A ridge of 10 degrees sinks between points of a face by 20 micrometres at most. [m]
constexpr double kEdgePitch = 0.2e-3;
constexpr double kFacePitch = 0.5e-3;
// Springs of its points. [N/m]
constexpr double kCornerStiffness = 4e4;
constexpr double kEdgeStiffness = 2e4;
constexpr double kFaceStiffness = 5e3;
constexpr double kTangentialShare = 0.8;     // of the normal spring (Mindlin: 2/7 to 1)
constexpr double kTangentialDamping = 1e-5;  // of that spring [s]
constexpr double kLeastApproach = 3e-3;      // that damping refers to [m/s]

constexpr double kLeastRestitution = 0.1;  // less takes smaller steps

constexpr double kLeastUpward = 1e-3;  // of a normal, of a surface that is a height over its plane
constexpr double kDeepest = 1e-3;      // deeper points are elsewhere [m]
constexpr double kSkin = 0.3e-3;       // points within this of the track are looked at in each step [m]
constexpr double kCell = 0.5e-3;       // of the map of triangles [m]

/// The track's surface as heights over its plane.
class HeightMap {
 public:
    explicit HeightMap(const track::Track& track);

    struct Spot {
        double height;
        Vec3 normal;
    };
    /// The surface there; the height is that of an abyss beside the track.
    [[nodiscard]] Spot find(double x, double y) const;
    /// Distance over height of a point above the surface, at least.
    [[nodiscard]] double leastCosine() const { return leastCosine_; }

    static constexpr double kAbyss = -1.0;  // [m]

 private:
    struct Facet {
        Vec3 normal;
        double a, b, c;  // height = a x + b y + c
        Vec3 sides[3];   // (p, q, r): p x + q y + r >= 0 inside
    };
    [[nodiscard]] int column(double x) const {
        return static_cast<int>(std::floor((x - origin_.x()) / kCell));
    }
    [[nodiscard]] int row(double y) const { return static_cast<int>(std::floor((y - origin_.y()) / kCell)); }

    std::vector<Facet> facets_;
    std::vector<std::vector<int>> cells_;
    Vec2 origin_;
    int columns_ = 0;
    int rows_ = 0;
    double leastCosine_ = 1.0;
};

HeightMap::HeightMap(const track::Track& track) {
    const std::vector<Vec3>& vertices = track.solid.vertices;
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::max());
    Vec2 high = -low;
    for (std::size_t i = 0; i < track.surfaceTriangles; ++i)
        for (const int v : track.solid.triangles[i]) {
            low = low.cwiseMin(vertices[v].head<2>());
            high = high.cwiseMax(vertices[v].head<2>());
        }
    origin_ = low;
    columns_ = column(high.x()) + 1;
    rows_ = row(high.y()) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (std::size_t i = 0; i < track.surfaceTriangles; ++i) {
        const geometry::Triangle& t = track.solid.triangles[i];
        const Vec3 corners[3] = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        Facet facet{};
        facet.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        leastCosine_ = std::min(leastCosine_, facet.normal.z());
        facet.a = -facet.normal.x() / facet.normal.z();
        facet.b = -facet.normal.y() / facet.normal.z();
        facet.c = corners[0].z() - facet.a * corners[0].x() - facet.b * corners[0].y();
        for (int k = 0; k < 3; ++k) {
            const Vec2 from = corners[k].head<2>();
            const Vec2 side = (corners[(k + 1) % 3].head<2>() - from).normalized();
            facet.sides[k] = Vec3(-side.y(), side.x(), side.y() * from.x() - side.x() * from.y());
        }
        Vec2 least = corners[0].head<2>();
        Vec2 most = least;
        for (const Vec3& corner : corners) {
            least = least.cwiseMin(corner.head<2>());
            most = most.cwiseMax(corner.head<2>());
        }
        for (int c = column(least.x()); c <= std::min(column(most.x()), columns_ - 1); ++c)
            for (int r = row(least.y()); r <= std::min(row(most.y()), rows_ - 1); ++r)
                cells_[static_cast<std::size_t>(c) * rows_ + r].push_back(static_cast<int>(facets_.size()));
        facets_.push_back(facet);
    }
}

HeightMap::Spot HeightMap::find(double x, double y) const {
    constexpr double kOnBorder = -1e-9;  // [m]
    Spot spot{kAbyss, Vec3::UnitZ()};
    const int c = column(x);
    const int r = row(y);
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return spot;
    for (const int i : cells_[static_cast<std::size_t>(c) * rows_ + r]) {
        const Facet& facet = facets_[i];
        const double height = facet.a * x + facet.b * y + facet.c;
        if (height <= spot.height) continue;
        const bool inside = std::all_of(
            std::begin(facet.sides), std::end(facet.sides),
            [&](const Vec3& side) { return side.x() * x + side.y() * y + side.z() >= kOnBorder; });
        if (inside) spot = {height, facet.normal};
    }
    return spot;
}

/// A point on a part.
struct CloudPoint {
    Vec3 place;        // in the part frame [m]
    double stiffness;  // [N/m]
};

void addSegment(const Vec3& from, const Vec3& to, std::vector<CloudPoint>& cloud) {
    const int steps = std::max(2, static_cast<int>(std::ceil((to - from).norm() / kEdgePitch)));
    for (int i = 1; i < steps; ++i)
        cloud.push_back({from + static_cast<double>(i) / steps * (to - from), kEdgeStiffness});
}

/// What lies more than half a pitch inside the face.
void addFace(const geometry::ConvexPolytope& solid, const geometry::PolytopeFace& face,
             std::vector<CloudPoint>& cloud) {
    const Vec3 origin = solid.vertices[face.loop[0]];
    const Vec3 u = (solid.vertices[face.loop[1]] - origin).normalized();
    const Vec3 v = face.normal.cross(u);
    Vec2 low = Vec2::Zero();
    Vec2 high = Vec2::Zero();
    for (const int corner : face.loop) {
        const Vec3 arm = solid.vertices[corner] - origin;
        low = low.cwiseMin(Vec2(arm.dot(u), arm.dot(v)));
        high = high.cwiseMax(Vec2(arm.dot(u), arm.dot(v)));
    }
    const auto isInside = [&](const Vec3& point) {
        for (std::size_t i = 0; i < face.loop.size(); ++i) {
            const Vec3& from = solid.vertices[face.loop[i]];
            const Vec3& to = solid.vertices[face.loop[(i + 1) % face.loop.size()]];
            if (face.normal.cross((to - from).normalized()).dot(point - from) < 0.5 * kFacePitch)
                return false;
        }
        return true;
    };
    const int columns = static_cast<int>(std::ceil((high - low).x() / kFacePitch));
    const int rows = static_cast<int>(std::ceil((high - low).y() / kFacePitch));
    for (int i = 0; i <= columns; ++i)
        for (int k = 0; k <= rows; ++k) {
            const Vec3 point = origin + (low.x() + (high - low).x() * i / columns) * u +
                               (low.y() + (high - low).y() * k / rows) * v;
            if (isInside(point)) cloud.push_back({point, kFaceStiffness});
        }
}

std::vector<CloudPoint> cloudOf(const geometry::ConvexPolytope& solid) {
    std::vector<CloudPoint> cloud;
    for (const Vec3& vertex : solid.vertices)
        cloud.push_back({vertex, kCornerStiffness});
    for (const geometry::PolytopeEdge& edge : solid.edges)
        addSegment(solid.vertices[edge.from], solid.vertices[edge.to], cloud);
    for (const geometry::PolytopeFace& face : solid.faces)
        addFace(solid, face, cloud);
    return cloud;
}

/// On the surface of all pieces together: what lies in or on another one is on a cut between them, or in an
/// inner corner, which nothing of a track can reach.
std::vector<CloudPoint> makeCloud(const std::vector<geometry::ConvexPolytope>& pieces) {
    constexpr double kOnBorder = 1e-6;  // [m]
    std::vector<CloudPoint> cloud;
    for (const geometry::ConvexPolytope& piece : pieces)
        for (const CloudPoint& point : cloudOf(piece)) {
            const bool isCovered = std::ranges::any_of(pieces, [&](const geometry::ConvexPolytope& other) {
                return &other != &piece && geometry::contains(other, point.place, kOnBorder);
            });
            if (!isCovered) cloud.push_back(point);
        }
    return cloud;
}

struct PointsScene : PeerScene {
    PointsScene(const trial::TrialBatch& b, const part::Part& p, double step)
        : batch(b), part(p), dt(step), surface(*b.track), cloud(makeCloud(p.pieces)) {}
    [[nodiscard]] std::unique_ptr<PeerTrial> start(std::size_t trial) const override;

    const trial::TrialBatch& batch;
    const part::Part& part;
    double dt;
    HeightMap surface;
    std::vector<CloudPoint> cloud;
};

class PointsTrial : public PeerTrial {
 public:
    PointsTrial(const PointsScene& scene, std::size_t index);

    void step(trial::CostLaps& laps) override;
    [[nodiscard]] base::Pose poseInTrack() const override { return now_.toTrack(pose_); }
    [[nodiscard]] base::Pose pose() const override { return pose_; }
    [[nodiscard]] contact::BodyMotion motion() const override { return {velocity_, turning()}; }
    [[nodiscard]] int contacts() const override { return contacts_; }

 private:
    /// A point that is near the track.
    struct Near {
        int point;
        double clearUntil = 0.0;  // of travel_ [m]
        bool touching = false;
        double approach = 0.0;       // speed at which it touched [m/s]
        Vec3 spring = Vec3::Zero();  // what the tangential spring is stretched by, in the track frame [m]
    };

    [[nodiscard]] Vec3 turning() const;
    void collect(const base::Pose& inTrack);
    /// In the track's axes, on the point; `velocity`: of the point in the track frame.
    Vec3 press(Near& near, const Vec3& place, const Vec3& velocity) const;

    const PointsScene& scene_;
    contact::DriveMotion drive_;
    double friction_;
    double damping_;
    base::Pose pose_;
    Vec3 velocity_;
    Vec3 momentum_;  // angular, in the room [kg m^2/s]
    contact::TrackPlacement now_;
    std::vector<Near> near_;
    double travel_ = kSkin;  // since they were collected [m]
    long steps_ = 0;
    int contacts_ = 0;
};

PointsTrial::PointsTrial(const PointsScene& scene, std::size_t index)
    : scene_(scene),
      drive_(scene.batch.driveOf(scene.batch.trials[index]), scene.batch.track->shape,
             scene.batch.trials[index].phase) {
    const trial::TrialSpec& spec = scene.batch.trials[index];
    friction_ = scene.batch.contactOf(spec).kineticFriction;
    damping_ =
        contact::calcContactDamping(std::max(scene.batch.contactOf(spec).restitution, kLeastRestitution));
    now_ = drive_.placement(0.0);
    const trial::PartStart& start = spec.parts.front();
    pose_ = now_.toRoom(start.pose);
    velocity_ = start.velocity;
    const Mat3 rotation = pose_.rotation.toRotationMatrix();
    momentum_ =
        rotation * (scene.part.massProperties.inertia * (rotation.transpose() * start.angularVelocity));
}

Vec3 PointsTrial::turning() const {
    const Mat3 rotation = pose_.rotation.toRotationMatrix();
    return rotation * scene_.part.massProperties.inertia.ldlt().solve(rotation.transpose() * momentum_);
}

void PointsTrial::collect(const base::Pose& inTrack) {
    std::vector<Near> before;
    std::swap(before, near_);
    auto known = before.begin();
    for (int i = 0; i < static_cast<int>(scene_.cloud.size()); ++i) {
        while (known != before.end() && known->point < i)
            ++known;
        const Vec3 place = inTrack.apply(scene_.cloud[i].place);
        const HeightMap::Spot spot = scene_.surface.find(place.x(), place.y());
        const bool beside = spot.height == HeightMap::kAbyss;
        if (!beside && (place.z() - spot.height) * scene_.surface.leastCosine() > kSkin) continue;
        near_.push_back(known != before.end() && known->point == i ? *known : Near{i});
        near_.back().clearUntil = 0.0;
    }
    travel_ = 0.0;
}

Vec3 PointsTrial::press(Near& near, const Vec3& place, const Vec3& velocity) const {
    const HeightMap::Spot spot = scene_.surface.find(place.x(), place.y());
    const double depth = (spot.height - place.z()) * spot.normal.z();
    if (depth <= 0.0 || depth > kDeepest) {
        near.touching = false;
        if (spot.height != HeightMap::kAbyss)
            near.clearUntil =
                travel_ + std::max(0.0, (place.z() - spot.height) * scene_.surface.leastCosine());
        return Vec3::Zero();
    }
    const double rate = -velocity.dot(spot.normal);
    if (!near.touching) near = {near.point, 0.0, true, kLeastApproach, Vec3::Zero()};
    near.approach = std::max(near.approach, rate);
    const double stiffness = scene_.cloud[near.point].stiffness;
    const double normal = std::max(0.0, stiffness * depth * (1.0 + damping_ * rate / near.approach));
    const double tangential = kTangentialShare * stiffness;
    const Vec3 slip = velocity + rate * spot.normal;
    near.spring += scene_.dt * slip;
    near.spring -= near.spring.dot(spot.normal) * spot.normal;
    Vec3 held = -tangential * (near.spring + kTangentialDamping * slip);
    const double most = friction_ * normal;
    if (held.norm() > most) {
        held *= most / held.norm();
        near.spring = -held / tangential;
    }
    return normal * spot.normal + held;
}

void PointsTrial::step(trial::CostLaps& laps) {
    const contact::TrackPlacement next = drive_.placement(static_cast<double>(steps_ + 1) * scene_.dt);
    const double turnRate = std::atan2(next.sine * now_.cosine - next.cosine * now_.sine,
                                       next.cosine * now_.cosine + next.sine * now_.sine) /
                            scene_.dt;
    const base::Pose inTrack = now_.toTrack(pose_);
    const Mat3 rotation = inTrack.rotation.toRotationMatrix();
    // Of the part as the track sees it, in the track's axes.
    const Vec3 spin = now_.turnBack(turning()) - turnRate * Vec3::UnitZ();
    const Vec3 velocity = now_.turnBack(velocity_ - (next.shift - now_.shift) / scene_.dt) -
                          turnRate * Vec3::UnitZ().cross(inTrack.position);
    travel_ += (velocity.norm() + spin.norm() * scene_.part.boundingRadius) * scene_.dt;
    if (travel_ >= kSkin) collect(inTrack);

    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    contacts_ = 0;
    for (Near& near : near_) {
        if (travel_ < near.clearUntil) continue;
        const Vec3 arm = rotation * scene_.cloud[near.point].place;
        const Vec3 push = press(near, inTrack.position + arm, velocity + spin.cross(arm));
        force += push;
        torque += arm.cross(push);
        contacts_ += near.touching ? 1 : 0;
    }
    laps.end(&trial::Costs::law);

    velocity_ +=
        scene_.dt * (now_.turn(force) / scene_.part.massProperties.mass + scene_.batch.gravityVector());
    momentum_ += scene_.dt * now_.turn(torque);
    pose_.position += scene_.dt * velocity_;
    const Vec3 turned = scene_.dt * turning();
    pose_.rotation =
        (base::Quaternion(1.0, 0.5 * turned.x(), 0.5 * turned.y(), 0.5 * turned.z()) * pose_.rotation)
            .normalized();
    now_ = next;
    ++steps_;
    laps.end(&trial::Costs::integration);
}

std::unique_ptr<PeerTrial> PointsScene::start(std::size_t trial) const {
    return std::make_unique<PointsTrial>(*this, trial);
}

}  // namespace

base::Result<std::unique_ptr<PeerScene>> PointsEngine::prepare(const trial::TrialBatch& batch,
                                                               const part::Part& part) const {
    for (std::size_t t = 0; t < batch.track->surfaceTriangles; ++t)
        if (geometry::triangleNormal(batch.track->solid, t).z() < kLeastUpward)
            return base::Error{"The engine 'points' knows heights only, and the surface overhangs."};
    return std::unique_ptr<PeerScene>(
        std::make_unique<PointsScene>(batch, part, batch.stepOf(step(), step())));
}

}  // namespace trapwright::peers
