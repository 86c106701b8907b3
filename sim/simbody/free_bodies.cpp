#include "sim/simbody/free_bodies.h"

#include <Simbody.h>

#include <vector>

namespace trapwright::simbody {

using base::Mat3;
using base::Vec3;
using contact::BodyMotion;

namespace {

constexpr int kQ = 7;  // quaternion (w, x, y, z), position
constexpr int kU = 6;  // angular velocity in the room's axes, velocity

Vec3 fromSimbody(const SimTK::Vec3& v) {
    return {v[0], v[1], v[2]};
}

SimTK::Vec3 toSimbody(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

SimTK::Inertia toSimbody(const Mat3& i) {
    return SimTK::Inertia(SimTK::Vec3(i(0, 0), i(1, 1), i(2, 2)), SimTK::Vec3(i(0, 1), i(0, 2), i(1, 2)));
}

}  // namespace

struct FreeBodies::Model {
    Model(double mass, const Mat3& inertia, const Vec3& gravityValue, int count)
        : matter(system),
          forces(system),
          gravity(forces, matter, toSimbody(gravityValue)),
          inverseMass(1.0 / mass),
          inverseInertia(inertia.inverse()),
          inertiaTensor(inertia),
          gravityVector(gravityValue),
          slots(count) {
        const SimTK::Body::Rigid body(SimTK::MassProperties(mass, SimTK::Vec3(0), toSimbody(inertia)));
        for (int i = 0; i < count; ++i)
            bodies.emplace_back(matter.Ground(), SimTK::Transform(), body, SimTK::Transform());
        state = system.realizeTopology();
        system.realizeModel(state);
    }

    struct Slot {
        BodyMotion motion;  // at the middle of the last step
        BodyMotion advance;
        Vec3 lastAngularAcceleration = Vec3::Zero();   // [rad/s^2]
        Vec3 priorAngularAcceleration = Vec3::Zero();  // one step earlier
    };

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    SimTK::Force::Gravity gravity;
    std::vector<SimTK::MobilizedBody::Free> bodies;
    SimTK::State state;
    SimTK::Vector advanceU, advanceQ;
    double inverseMass;
    Mat3 inverseInertia;
    Mat3 inertiaTensor;
    Vec3 gravityVector;
    std::vector<Slot> slots;
};

FreeBodies::FreeBodies(double mass, const Mat3& inertia, const Vec3& gravity, int count)
    : model_(std::make_unique<Model>(mass, inertia, gravity, count)) {}
FreeBodies::~FreeBodies() = default;
FreeBodies::FreeBodies(FreeBodies&&) noexcept = default;
FreeBodies& FreeBodies::operator=(FreeBodies&&) noexcept = default;

int FreeBodies::count() const {
    return static_cast<int>(model_->slots.size());
}
double FreeBodies::inverseMass() const {
    return model_->inverseMass;
}
const Mat3& FreeBodies::inverseInertia() const {
    return model_->inverseInertia;
}

void FreeBodies::place(int slot, const base::Pose& pose, const BodyMotion& motion, double dt) {
    SimTK::Vector& q = model_->state.updQ();
    const base::Quaternion& r = pose.rotation;
    const double values[kQ] = {
        r.w(), r.x(), r.y(), r.z(), pose.position.x(), pose.position.y(), pose.position.z()};
    for (int i = 0; i < kQ; ++i)
        q[kQ * slot + i] = values[i];
    Model::Slot& s = model_->slots[slot];
    s = {};
    s.motion = motion;
    // Velocities belong to the middles of steps: go back by half of one.
    const Mat3 rotation = r.toRotationMatrix();
    const Vec3& w = motion.angularVelocity;
    const Vec3 momentum = rotation * (model_->inertiaTensor * (rotation.transpose() * w));
    s.lastAngularAcceleration =
        -(rotation * (model_->inverseInertia * (rotation.transpose() * w.cross(momentum))));
    s.priorAngularAcceleration = s.lastAngularAcceleration;
    s.motion.velocity -= 0.5 * dt * model_->gravityVector;
    s.motion.angularVelocity -= 0.5 * dt * s.lastAngularAcceleration;
}

void FreeBodies::adopt(int slot, const FreeBodies& other, int otherSlot) {
    SimTK::Vector& q = model_->state.updQ();
    for (int i = 0; i < kQ; ++i)
        q[kQ * slot + i] = other.model_->state.getQ()[kQ * otherSlot + i];
    model_->slots[slot] = other.model_->slots[otherSlot];
}

void FreeBodies::beginStep(double dt) {
    // Simbody's gravity and inertia; the gyroscopic torque is Euler's. Realizing velocities and dynamics too,
    // for the same numbers, would take as long as all the rest of a step.
    model_->system.realize(model_->state, SimTK::Stage::Position);
    const SimTK::Vector_<SimTK::SpatialVec>& gravity = model_->gravity.getBodyForces(model_->state);
    for (int i = 0; i < count(); ++i) {
        Model::Slot& s = model_->slots[i];
        const SimTK::MobilizedBody& body = model_->bodies[i];
        // The gyroscopic torque wants the angular velocity at the pose's time: half a step on.
        const Vec3 spin = s.motion.angularVelocity +
                          dt * (0.875 * s.lastAngularAcceleration - 0.375 * s.priorAngularAcceleration);
        const SimTK::Vec3 now = toSimbody(spin);
        const SimTK::SpatialInertia& inertia = body.getBodySpatialInertiaInGround(model_->state);
        const SimTK::SpatialVec& force = gravity[body.getMobilizedBodyIndex()];
        const SimTK::Vec3 gyroscopic = inertia.getMass() * (now % (inertia.getUnitInertia() * now));
        const SimTK::Rotation& rotation = body.getBodyRotation(model_->state);
        const Vec3 torque = fromSimbody(~rotation * (force[0] - gyroscopic));
        s.priorAngularAcceleration = s.lastAngularAcceleration;
        s.lastAngularAcceleration = fromSimbody(rotation * toSimbody(Vec3(model_->inverseInertia * torque)));
        s.advance.angularVelocity = s.motion.angularVelocity + dt * s.lastAngularAcceleration;
        s.advance.velocity = s.motion.velocity + dt * model_->inverseMass * fromSimbody(force[1]);
    }
}

base::Pose FreeBodies::pose(int slot) const {
    const double* q = model_->state.getQ().getContiguousScalarData() + static_cast<std::ptrdiff_t>(kQ) * slot;
    return {base::Quaternion(q[0], q[1], q[2], q[3]), {q[4], q[5], q[6]}};
}

BodyMotion FreeBodies::before(int slot) const {
    return model_->slots[slot].motion;
}

BodyMotion FreeBodies::free(int slot) const {
    return model_->slots[slot].advance;
}

BodyMotion FreeBodies::now(int slot, double dt) const {
    // The acceleration is taken as linear in time over the last step and a half.
    const Model::Slot& s = model_->slots[slot];
    BodyMotion motion;
    motion.velocity = 0.5 * (s.motion.velocity + s.advance.velocity);
    motion.angularVelocity = s.motion.angularVelocity +
                             dt * (0.375 * s.lastAngularAcceleration + 0.125 * s.priorAngularAcceleration);
    return motion;
}

void FreeBodies::resolve(int slot, const contact::StepResult& result) {
    model_->slots[slot].motion = result.motion;
    model_->slots[slot].advance = result.advance;
}

void FreeBodies::endStep(double dt) {
    model_->advanceU.resize(kU * count());
    double* u = model_->advanceU.updContiguousScalarData();
    for (int i = 0; i < count(); ++i) {
        Model::Slot& s = model_->slots[i];
        // A rotation whose axis wanders is not the mean angular velocity times the step: the next terms of
        // Magnus' series (Iserles et al. 2000, section 4).
        const Vec3& acceleration = s.lastAngularAcceleration;
        s.advance.angularVelocity += dt * dt / 12.0 * acceleration.cross(s.advance.angularVelocity) +
                                     dt / 24.0 * (acceleration - s.priorAngularAcceleration);
        for (int k = 0; k < 3; ++k) {
            u[kU * i + k] = s.advance.angularVelocity[k];
            u[kU * i + 3 + k] = s.advance.velocity[k];
        }
    }
    model_->matter.multiplyByN(model_->state, false, model_->advanceU, model_->advanceQ);
    const double* rate = model_->advanceQ.getContiguousScalarData();
    double* q = model_->state.updQ().updContiguousScalarData();
    for (int i = 0; i < count(); ++i) {
        // The rate is tangent to the unit sphere: go along it by the tangent of the angle, then back onto the
        // sphere.
        const double half = 0.5 * dt * model_->slots[i].advance.angularVelocity.norm();
        const double tangent = dt * (1.0 + half * half / 3.0);
        double square = 0.0;
        for (int k = kQ * i; k < kQ * i + 4; ++k) {
            q[k] += tangent * rate[k];
            square += q[k] * q[k];
        }
        const double scale = 1.0 / std::sqrt(square);
        for (int k = kQ * i; k < kQ * i + 4; ++k)
            q[k] *= scale;
        for (int k = kQ * i + 4; k < kQ * (i + 1); ++k)
            q[k] += dt * rate[k];
    }
}

}  // namespace trapwright::simbody
