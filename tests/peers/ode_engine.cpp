#include "tests/peers/ode_engine.h"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <stdexcept>

#include "sim/contact/drive_motion.h"
#include "tests/peers/box_shape.h"

namespace trapwright::peers {

namespace {

using base::Vec3;

// ODE's tolerances are absolute and meant for metres and kilograms: lengths in cm and masses in g bring a
// part of 12 mm and 0.4 g near to what they were made for.
constexpr double kLength = 1e2;  // units per m
constexpr double kMass = 1e3;    // units per kg

constexpr int kMaxContacts = 64;        // of one convex piece
constexpr double kErp = 0.8;            // share of an overlap that is taken back per step
constexpr double kCfm = 1e-6;           // [1/unit of mass] for a unit step; keeps the LCP solvable
constexpr double kSurfaceLayer = 1e-5;  // overlap that is left alone [m]
constexpr double kMaxCorrection = 0.1;  // speed at which overlaps are taken back at most [m/s]
constexpr double kBounceSpeed = 0.0;    // from which on parts bounce [m/s]

constexpr double kSamePlace = 1e-4;    // [m]
constexpr double kSameNormal = 0.999;  // cosine

// Debian builds ODE without collision caches of each thread's own (no ODE_EXT_mt_collisions).
std::mutex collisionMutex;

/// An assertion of ODE's that failed.
struct InternalError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// In place of ending the program. Whoever catches it shall not step that world again.
[[noreturn]] void throwInternalError(int /*number*/, const char* message, va_list arguments) {
    std::array<char, 300> text{};
    std::vsnprintf(text.data(), text.size(), message, arguments);
    throw InternalError(text.data());
}

void initOde() {
    static std::once_flag once;
    std::call_once(once, [] {
        dInitODE2(0);
        dSetDebugHandler(throwInternalError);
    });
    thread_local const int ready = dAllocateODEDataForThread(dAllocateMaskAll);
    (void)ready;
}

/// A convex solid as dCreateConvex wants it: around the origin. ODE keeps pointers to it.
struct OdeConvex {
    Vec3 centre = Vec3::Zero();  // where its origin is in the part
    std::vector<dReal> planes;
    std::vector<dReal> points;
    std::vector<unsigned int> polygons;

    explicit OdeConvex(const geometry::ConvexPolytope& solid) {
        for (const Vec3& vertex : solid.vertices)
            centre += kLength / static_cast<double>(solid.vertices.size()) * vertex;
        for (const Vec3& vertex : solid.vertices)
            for (int k = 0; k < 3; ++k)
                points.push_back(kLength * vertex[k] - centre[k]);
        for (const geometry::PolytopeFace& face : solid.faces) {
            for (int k = 0; k < 3; ++k)
                planes.push_back(face.normal[k]);
            planes.push_back(kLength * face.offset - face.normal.dot(centre));
            polygons.push_back(static_cast<unsigned int>(face.loop.size()));
            polygons.insert(polygons.end(), face.loop.begin(), face.loop.end());
        }
    }
};

struct OdeScene : PeerScene {
    OdeScene(const trial::TrialBatch& b, const part::Part& p, double step);
    OdeScene(const OdeScene&) = delete;
    OdeScene& operator=(const OdeScene&) = delete;
    ~OdeScene() override { dGeomTriMeshDataDestroy(mesh); }

    [[nodiscard]] std::unique_ptr<PeerTrial> start(std::size_t trial) const override;

    const trial::TrialBatch& batch;
    const part::Part& part;
    double dt;
    std::vector<double> vertices;
    std::vector<dTriIndex> indices;
    dTriMeshDataID mesh;
    std::optional<Vec3> box;
    std::vector<OdeConvex> pieces;
};

OdeScene::OdeScene(const trial::TrialBatch& b, const part::Part& p, double step)
    : batch(b), part(p), dt(step) {
    initOde();
    const geometry::TriangleMesh& solid = batch.track->solid;
    for (const Vec3& vertex : solid.vertices)
        for (int k = 0; k < 3; ++k)
            vertices.push_back(kLength * vertex[k]);
    for (const geometry::Triangle& triangle : solid.triangles)
        for (const int index : triangle)
            indices.push_back(static_cast<dTriIndex>(index));
    mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(mesh, vertices.data(), 3 * sizeof(double),
                                static_cast<int>(solid.vertices.size()), indices.data(),
                                static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
    dGeomTriMeshDataPreprocess2(
        mesh, 1U << dTRIDATAPREPROCESS_BUILD_CONCAVE_EDGES | 1U << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES,
        nullptr);
    box = findBox(part);
    if (box) return;
    for (const geometry::ConvexPolytope& piece : part.pieces)
        pieces.emplace_back(piece);
}

using FoundContacts = std::array<dContactGeom, kMaxContacts>;

/// Whether one of the contacts before is the same.
bool isRepeated(const FoundContacts& found, int index) {
    const auto vector = [](const dReal* v) { return Vec3(v[0], v[1], v[2]); };
    const dContactGeom& one = found[index];
    return std::any_of(found.begin(), found.begin() + index, [&](const dContactGeom& other) {
        return (vector(one.pos) - vector(other.pos)).norm() < kLength * kSamePlace &&
               vector(one.normal).dot(vector(other.normal)) > kSameNormal;
    });
}

int collide(dGeomID part, dGeomID track, FoundContacts& found) {
    const std::lock_guard lock(collisionMutex);
    // Some colliders look at the boxes around the geoms, which dCollide() alone does not bring up to date.
    std::array<dReal, 6> box;
    dGeomGetAABB(part, box.data());
    dGeomGetAABB(track, box.data());
    return dCollide(part, track, kMaxContacts, found.data(), sizeof(dContactGeom));
}

class OdeTrial : public PeerTrial {
 public:
    OdeTrial(const OdeScene& scene, std::size_t index);
    ~OdeTrial() override {
        dJointGroupDestroy(joints_);
        for (const dGeomID geom : geoms_)
            dGeomDestroy(geom);
        dGeomDestroy(trackGeom_);
        dWorldDestroy(world_);
        // One that was broken off still has work to do, and would not be freed.
        if (!broken_) dThreadingFreeImplementation(threading_);
    }

    void step(trial::CostLaps& laps) override;
    [[nodiscard]] base::Pose poseInTrack() const override { return now_.toTrack(pose()); }
    [[nodiscard]] base::Pose pose() const override;
    [[nodiscard]] contact::BodyMotion motion() const override;
    [[nodiscard]] int contacts() const override { return contacts_; }

 private:
    void makePart(const trial::PartStart& start);
    void moveTrack();
    void touch(dGeomID geom);

    const OdeScene& scene_;
    contact::DriveMotion drive_;
    double friction_;
    double restitution_;
    dThreadingImplementationID threading_;
    dWorldID world_;
    dJointGroupID joints_;
    dBodyID part_;
    dBodyID track_;
    std::vector<dGeomID> geoms_;  // of the part
    dGeomID trackGeom_;
    contact::TrackPlacement now_;
    long steps_ = 0;
    int contacts_ = 0;
    bool broken_ = false;  // ODE could not go on: the part stays where it is
};

OdeTrial::OdeTrial(const OdeScene& scene, std::size_t index)
    : scene_(scene),
      drive_(scene.batch.driveOf(scene.batch.trials[index]), scene.batch.track->shape,
             scene.batch.trials[index].phase) {
    initOde();
    const trial::TrialSpec& spec = scene.batch.trials[index];
    friction_ = scene.batch.contactOf(spec).kineticFriction;
    restitution_ = scene.batch.contactOf(spec).restitution;
    // By default all worlds share one, and may not step at the same time.
    threading_ = dThreadingAllocateSelfThreadedImplementation();
    world_ = dWorldCreate();
    dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_),
                                         threading_);
    const base::Vec3 gravity = kLength * scene.batch.gravityVector();
    dWorldSetGravity(world_, gravity.x(), 0.0, gravity.z());
    dWorldSetERP(world_, kErp);
    dWorldSetCFM(world_, kCfm);
    dWorldSetContactSurfaceLayer(world_, kLength * kSurfaceLayer);
    dWorldSetContactMaxCorrectingVel(world_, kLength * kMaxCorrection);
    joints_ = dJointGroupCreate(0);
    makePart(spec.parts.front());
    track_ = dBodyCreate(world_);
    dBodySetKinematic(track_);
    trackGeom_ = dCreateTriMesh(nullptr, scene.mesh, nullptr, nullptr, nullptr);
    dGeomSetBody(trackGeom_, track_);
    now_ = drive_.placement(0.0);
}

void OdeTrial::makePart(const trial::PartStart& start) {
    const part::Part& part = scene_.part;
    part_ = dBodyCreate(world_);
    const base::Mat3 inertia = kMass * kLength * kLength * part.massProperties.inertia;
    dMass mass;
    dMassSetParameters(&mass, kMass * part.massProperties.mass, 0, 0, 0, inertia(0, 0), inertia(1, 1),
                       inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2));
    dBodySetMass(part_, &mass);
    const base::Pose pose = drive_.placement(0.0).toRoom(start.pose);
    const dQuaternion rotation = {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
    dBodySetQuaternion(part_, rotation);
    const Vec3 position = kLength * pose.position;
    dBodySetPosition(part_, position.x(), position.y(), position.z());
    const Vec3 velocity = kLength * start.velocity;
    dBodySetLinearVel(part_, velocity.x(), velocity.y(), velocity.z());
    const Vec3& spin = start.angularVelocity;
    dBodySetAngularVel(part_, spin.x(), spin.y(), spin.z());
    if (scene_.box) {
        const Vec3 size = 2.0 * kLength * *scene_.box;
        geoms_.push_back(dCreateBox(nullptr, size.x(), size.y(), size.z()));
    }
    for (const OdeConvex& piece : scene_.pieces)
        geoms_.push_back(dCreateConvex(
            nullptr, piece.planes.data(), static_cast<unsigned int>(piece.planes.size() / 4),
            piece.points.data(), static_cast<unsigned int>(piece.points.size() / 3), piece.polygons.data()));
    for (const dGeomID geom : geoms_)
        dGeomSetBody(geom, part_);
    for (std::size_t i = 0; i < scene_.pieces.size(); ++i) {
        const Vec3& centre = scene_.pieces[i].centre;
        dGeomSetOffsetPosition(geoms_[i], centre.x(), centre.y(), centre.z());
    }
}

void OdeTrial::moveTrack() {
    const contact::TrackPlacement next = drive_.placement(static_cast<double>(steps_ + 1) * scene_.dt);
    const dMatrix3 rotation = {now_.cosine, -now_.sine, 0, 0, now_.sine, now_.cosine, 0, 0, 0, 0, 1, 0};
    dBodySetRotation(track_, rotation);
    const Vec3 shift = kLength * now_.shift;
    dBodySetPosition(track_, shift.x(), shift.y(), shift.z());
    // The velocity that takes it to where it will be, so that the contacts know it.
    const Vec3 velocity = kLength / scene_.dt * (next.shift - now_.shift);
    dBodySetLinearVel(track_, velocity.x(), velocity.y(), velocity.z());
    const double turn = std::atan2(next.sine, next.cosine) - std::atan2(now_.sine, now_.cosine);
    dBodySetAngularVel(track_, 0, 0, turn / scene_.dt);
    now_ = next;
}

void OdeTrial::touch(dGeomID geom) {
    FoundContacts found;
    const int count = collide(geom, trackGeom_, found);
    for (int i = 0; i < count; ++i) {
        // Neighbouring triangles report their common corners one by one; the LCP's cost grows with the cube.
        if (isRepeated(found, i)) continue;
        ++contacts_;
        dContact contact{};
        contact.surface.mode = dContactApprox1 | dContactBounce | dContactFDir1;
        contact.surface.mu = friction_;
        contact.surface.bounce = restitution_;
        contact.surface.bounce_vel = kLength * kBounceSpeed;
        contact.geom = found[i];
        // Friction is a pyramid: one with an edge along the slip is a cone where it matters.
        dVector3 here;
        dVector3 there;
        const dReal* at = found[i].pos;
        dBodyGetPointVel(part_, at[0], at[1], at[2], here);
        dBodyGetPointVel(track_, at[0], at[1], at[2], there);
        const Vec3 normal(found[i].normal[0], found[i].normal[1], found[i].normal[2]);
        Vec3 slip(here[0] - there[0], here[1] - there[1], here[2] - there[2]);
        slip -= slip.dot(normal) * normal;
        if (slip.norm() < 1e-3 * kLength) slip = normal.unitOrthogonal();
        slip.normalize();
        for (int k = 0; k < 3; ++k)
            contact.fdir1[k] = slip[k];
        dJointAttach(dJointCreateContact(world_, joints_, &contact), part_, track_);
    }
}

void OdeTrial::step(trial::CostLaps& laps) {
    if (broken_) return;
    moveTrack();
    laps.end(&trial::Costs::integration);
    contacts_ = 0;
    for (const dGeomID geom : geoms_)
        touch(geom);
    laps.end(&trial::Costs::detection);
    // The law and the integration are one call.
    try {
        dWorldStep(world_, scene_.dt);
    } catch (const InternalError& error) {
        broken_ = true;
        std::fprintf(stderr, "ODE breaks a trial off, which ends as stuck: %s\n", error.what());
    }
    dJointGroupEmpty(joints_);
    laps.end(&trial::Costs::law);
    ++steps_;
}

base::Pose OdeTrial::pose() const {
    const dReal* q = dBodyGetQuaternion(part_);
    const dReal* p = dBodyGetPosition(part_);
    return {base::Quaternion(q[0], q[1], q[2], q[3]), Vec3(p[0], p[1], p[2]) / kLength};
}

contact::BodyMotion OdeTrial::motion() const {
    const dReal* v = dBodyGetLinearVel(part_);
    const dReal* w = dBodyGetAngularVel(part_);
    return {Vec3(v[0], v[1], v[2]) / kLength, Vec3(w[0], w[1], w[2])};
}

std::unique_ptr<PeerTrial> OdeScene::start(std::size_t trial) const {
    return std::make_unique<OdeTrial>(*this, trial);
}

}  // namespace

base::Result<std::unique_ptr<PeerScene>> OdeEngine::prepare(const trial::TrialBatch& batch,
                                                            const part::Part& part) const {
    return std::unique_ptr<PeerScene>(std::make_unique<OdeScene>(batch, part, batch.stepOf(step(), step())));
}

}  // namespace trapwright::peers
