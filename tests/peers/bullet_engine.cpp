#include "tests/peers/bullet_engine.h"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>
#include <mutex>
#include <vector>

#include "tests/peers/box_shape.h"
#include "tests/peers/vibrating_frame.h"

namespace trapwright::peers {

using base::Vec3;

namespace {

// Debian's Bullet computes in floats, and its tolerances are absolute: lengths in mm and masses in g give
// parts sizes that it was made for.
constexpr double kLength = 1e3;  // units per m
constexpr double kMass = 1e3;    // units per kg

constexpr btScalar kMargin = 0.04F;          // corners of solids are round by so much [mm]
constexpr btScalar kBreaking = 0.02F;        // contacts are kept up to this distance [mm]
constexpr btScalar kRecovery = 0.2F;         // share of an overlap that is taken back in one step
constexpr int kIterations = 50;              // of the solver
constexpr btScalar kSplitPenetration = 0.F;  // any overlap is taken back without giving the part speed

btVector3 toBullet(const Vec3& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
Vec3 fromBullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
btQuaternion toBullet(const base::Quaternion& q) {
    return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
            static_cast<btScalar>(q.w())};
}
base::Quaternion fromBullet(const btQuaternion& q) {
    return base::Quaternion(q.w(), q.x(), q.y(), q.z()).normalized();
}

/// Keeps the edges between the track's triangles from stopping what slides over them.
bool adjustContact(btManifoldPoint& point, const btCollisionObjectWrapper* first, int /*part0*/,
                   int /*index0*/, const btCollisionObjectWrapper* second, int part1, int index1) {
    btAdjustInternalEdgeContacts(point, second, first, part1, index1);
    return false;
}

void initBullet() {
    static std::once_flag once;
    std::call_once(once, [] {
        gContactAddedCallback = adjustContact;
        gContactBreakingThreshold = kBreaking;
    });
}

struct BulletScene : PeerScene {
    BulletScene(const trial::TrialBatch& b, const part::Part& p, double step);
    [[nodiscard]] std::unique_ptr<PeerTrial> start(std::size_t trial) const override;

    const trial::TrialBatch& batch;
    const part::Part& part;
    double dt;
    btTriangleMesh triangles;
    std::unique_ptr<btBvhTriangleMeshShape> track;
    btTriangleInfoMap edges;
    // Bullet wants a body's own axes to be those of its inertia.
    base::Quaternion principal;  // body -> part
    btVector3 inertia;           // [g mm^2]
    std::vector<std::unique_ptr<btPolyhedralConvexShape>> solids;
    btCompoundShape whole;  // all solids
};

BulletScene::BulletScene(const trial::TrialBatch& b, const part::Part& p, double step)
    : batch(b), part(p), dt(step) {
    initBullet();
    const geometry::TriangleMesh& solid = batch.track->solid;
    const auto corner = [&](int index) {
        return toBullet(kLength * solid.vertices[static_cast<std::size_t>(index)]);
    };
    for (const geometry::Triangle& triangle : solid.triangles)
        triangles.addTriangle(corner(triangle[0]), corner(triangle[1]), corner(triangle[2]));
    track = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    track->setMargin(0.0F);
    btGenerateInternalEdgeInfo(track.get(), &edges);

    const Eigen::SelfAdjointEigenSolver<base::Mat3> axes(part.massProperties.inertia);
    base::Mat3 rotation = axes.eigenvectors();
    if (rotation.determinant() < 0.0) rotation.col(2) *= -1.0;
    principal = base::Quaternion(rotation);
    inertia = toBullet(kMass * kLength * kLength * axes.eigenvalues());
    const auto add = [&](std::unique_ptr<btPolyhedralConvexShape> shape) {
        shape->setMargin(kMargin);
        shape->initializePolyhedralFeatures();
        whole.addChildShape(btTransform(toBullet(principal.conjugate())), shape.get());
        solids.push_back(std::move(shape));
    };
    if (const auto box = findBox(part)) {
        add(std::make_unique<btBoxShape>(toBullet(kLength * *box)));
        return;
    }
    for (const geometry::ConvexPolytope& piece : part.pieces) {
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Vec3& vertex : piece.vertices)
            hull->addPoint(toBullet(kLength * vertex), false);
        hull->recalcLocalAabb();
        add(std::move(hull));
    }
}

/// The track stands still and the part feels the inertial forces of its frame.
class BulletTrial : public PeerTrial {
 public:
    BulletTrial(const BulletScene& scene, std::size_t index);
    BulletTrial(const BulletTrial&) = delete;
    BulletTrial& operator=(const BulletTrial&) = delete;
    ~BulletTrial() override {
        world_.removeRigidBody(part_.get());
        world_.removeRigidBody(track_.get());
    }

    void step(trial::CostLaps& laps) override;
    [[nodiscard]] base::Pose poseInTrack() const override;
    [[nodiscard]] base::Pose pose() const override { return frame_.placement().toRoom(poseInTrack()); }
    [[nodiscard]] contact::BodyMotion motion() const override {
        return frame_.toRoom(poseInTrack().position, motionInTrack());
    }
    [[nodiscard]] int contacts() const override;

 private:
    [[nodiscard]] contact::BodyMotion motionInTrack() const {
        return {fromBullet(part_->getLinearVelocity()) / kLength, fromBullet(part_->getAngularVelocity())};
    }
    void applyForces();

    const BulletScene& scene_;
    VibratingFrame frame_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::unique_ptr<btRigidBody> track_, part_;
};

BulletTrial::BulletTrial(const BulletScene& scene, std::size_t index)
    : scene_(scene),
      frame_(scene.batch, index, scene.dt),
      dispatcher_(&configuration_),
      world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    const base::Vec3 gravity = kLength * scene.batch.gravityVector();
    world_.setGravity({static_cast<btScalar>(gravity.x()), 0.0F, static_cast<btScalar>(gravity.z())});
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_numIterations = kIterations;
    info.m_erp2 = kRecovery;
    info.m_splitImpulsePenetrationThreshold = kSplitPenetration;
    info.m_restitutionVelocityThreshold = 0.0F;
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;

    track_ = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(0.0F, nullptr, scene.track.get()));
    track_->setCollisionFlags(track_->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    track_->setFriction(1.0F);
    track_->setRestitution(1.0F);
    world_.addRigidBody(track_.get());

    const trial::TrialSpec& spec = scene.batch.trials[index];
    const trial::PartStart& start = spec.parts.front();
    btRigidBody::btRigidBodyConstructionInfo made(
        static_cast<btScalar>(kMass * scene.part.massProperties.mass), nullptr,
        const_cast<btCompoundShape*>(&scene.whole), scene.inertia);
    // Of two bodies the product counts.
    made.m_friction = static_cast<btScalar>(scene.batch.contactOf(spec).kineticFriction);
    made.m_restitution = static_cast<btScalar>(scene.batch.contactOf(spec).restitution);
    // The start pose is told relative to the track already.
    made.m_startWorldTransform.setRotation(toBullet(start.pose.rotation * scene.principal));
    made.m_startWorldTransform.setOrigin(toBullet(kLength * start.pose.position));
    part_ = std::make_unique<btRigidBody>(made);
    part_->setActivationState(DISABLE_DEACTIVATION);
    part_->setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    const contact::BodyMotion motion =
        frame_.toFrame(start.pose.position, {start.velocity, start.angularVelocity});
    part_->setLinearVelocity(toBullet(kLength * motion.velocity));
    part_->setAngularVelocity(toBullet(motion.angularVelocity));
    world_.addRigidBody(part_.get());
}

base::Pose BulletTrial::poseInTrack() const {
    const btTransform& transform = part_->getWorldTransform();
    return {(fromBullet(transform.getRotation()) * scene_.principal.conjugate()).normalized(),
            fromBullet(transform.getOrigin()) / kLength};
}

int BulletTrial::contacts() const {
    int count = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
        const btPersistentManifold& manifold =
            *const_cast<btCollisionDispatcher&>(dispatcher_).getManifoldByIndexInternal(i);
        for (int k = 0; k < manifold.getNumContacts(); ++k)
            count += manifold.getContactPoint(k).getDistance() <= kMargin ? 1 : 0;
    }
    return count;
}

void BulletTrial::applyForces() {
    const geometry::MassProperties& mass = scene_.part.massProperties;
    const base::Pose pose = poseInTrack();
    const base::Mat3 rotation = pose.rotation.toRotationMatrix();
    const Wrench wrench = frame_.calcInertialForces(mass.mass, rotation * mass.inertia * rotation.transpose(),
                                                    pose.position, motionInTrack());
    part_->applyCentralForce(toBullet(kMass * kLength * wrench.force));
    part_->applyTorque(toBullet(kMass * kLength * kLength * wrench.torque));
}

void BulletTrial::step(trial::CostLaps& laps) {
    applyForces();
    // Detection, law and integration are one call.
    world_.stepSimulation(static_cast<btScalar>(scene_.dt), 0);
    frame_.advance();
    laps.end(&trial::Costs::law);
}

std::unique_ptr<PeerTrial> BulletScene::start(std::size_t trial) const {
    return std::make_unique<BulletTrial>(*this, trial);
}

}  // namespace

base::Result<std::unique_ptr<PeerScene>> BulletEngine::prepare(const trial::TrialBatch& batch,
                                                               const part::Part& part) const {
    return std::unique_ptr<PeerScene>(
        std::make_unique<BulletScene>(batch, part, batch.stepOf(step(), step())));
}

}  // namespace trapwright::peers
