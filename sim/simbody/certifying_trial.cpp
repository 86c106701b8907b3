#include "sim/simbody/certifying_trial.h"

#include <Simbody.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "sim/contact/detector.h"
#include "sim/contact/law.h"
#include "sim/contact/roughness.h"

namespace trapwright::simbody {

using base::Mat3;
using base::Quaternion;
using base::Vec3;

namespace {

/// Relative accuracy of the integrator.
constexpr double kAccuracy = 1e-5;
/// Contacts are watched from this distance on, so that their approach speed is known when they touch. [m]
constexpr double kWatch = 100e-6;
/// Longest integration step: nothing crosses kWatch unseen at 2 m/s. [s]
constexpr double kLongestStep = 50e-6;

SimTK::Vec3 toSimbody(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
Vec3 fromSimbody(const SimTK::Vec3& v) {
    return {v[0], v[1], v[2]};
}

base::Pose fromSimbody(const SimTK::Transform& x) {
    const SimTK::Quaternion q = x.R().convertRotationToQuaternion();
    return {Quaternion(q[0], q[1], q[2], q[3]), fromSimbody(x.p())};
}

/// The continuous form between one part and the track.
class ContactForce : public SimTK::Force::Custom::Implementation {
 public:
    ContactForce(const CertifyingScene& scene, SimTK::MobilizedBodyIndex track,
                 SimTK::MobilizedBodyIndex part, const SimTK::SimbodyMatterSubsystem& matter)
        : law_(scene.law),
          damping_(contact::calcContactDamping(scene.law.restitution)),
          bodyRadius_(scene.body->radius),
          track_(track),
          part_(part),
          matter_(matter),
          detector_(*scene.track, *scene.body) {}

    void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& bodyForces,
                   SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
        const SimTK::MobilizedBody& track = matter_.getMobilizedBody(track_);
        const SimTK::MobilizedBody& part = matter_.getMobilizedBody(part_);
        const SimTK::Transform& trackInRoom = track.getBodyTransform(state);
        pressing_.clear();
        for (const contact::Contact& point : findContacts(state)) {
            if (point.gap >= 0.0) continue;
            const SimTK::Vec3 place = trackInRoom * toSimbody(point.point);
            const SimTK::Vec3 normal = trackInRoom.R() * toSimbody(point.normal);
            const SimTK::Vec3 onPart = part.findStationAtGroundPoint(state, place);
            const SimTK::Vec3 onTrack = track.findStationAtGroundPoint(state, place);
            const SimTK::Vec3 relative = part.findStationVelocityInGround(state, onPart) -
                                         track.findStationVelocityInGround(state, onTrack);
            const double speed = ~relative * normal;
            const auto known = approach_.find(point.feature);
            const double approach = known == approach_.end() ? std::max(-speed, 0.0) : known->second;
            const double pressure = contact::calcNormalForce(-point.gap, -speed, approach, damping_);
            if (pressure <= 0.0) continue;
            const SimTK::Vec3 slip = relative - speed * normal;
            const SimTK::Vec3 force =
                pressure * normal - pressure * contact::calcFrictionRatio(slip.norm(), law_) * slip;
            part.applyForceToBodyPoint(state, onPart, force, bodyForces);
            track.applyForceToBodyPoint(state, onTrack, -force, bodyForces);
            pressing_.push_back(
                {point.bodyA, point.bodyB, point.point, fromSimbody(SimTK::Vec3(~trackInRoom.R() * force))});
        }
    }

    SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

    /// After an accepted step: notes how fast the features that do not touch yet approach.
    void observe(const SimTK::State& state) {
        const SimTK::MobilizedBody& track = matter_.getMobilizedBody(track_);
        const SimTK::MobilizedBody& part = matter_.getMobilizedBody(part_);
        const SimTK::Transform& trackInRoom = track.getBodyTransform(state);
        std::map<std::uint64_t, double> approach;
        for (const contact::Contact& point : findContacts(state)) {
            const auto known = approach_.find(point.feature);
            if (point.gap < 0.0 && known != approach_.end()) {
                approach.insert(*known);
                continue;
            }
            const SimTK::Vec3 place = trackInRoom * toSimbody(point.point);
            const SimTK::Vec3 relative =
                part.findStationVelocityInGround(state, part.findStationAtGroundPoint(state, place)) -
                track.findStationVelocityInGround(state, track.findStationAtGroundPoint(state, place));
            approach[point.feature] =
                std::max(0.0, -(~relative * (trackInRoom.R() * toSimbody(point.normal))));
        }
        approach_ = std::move(approach);
    }

    [[nodiscard]] const std::vector<trial::ContactForce>& pressing() const { return pressing_; }

    [[nodiscard]] base::Pose poseInTrack(const SimTK::State& state) const {
        return fromSimbody(~matter_.getMobilizedBody(track_).getBodyTransform(state) *
                           matter_.getMobilizedBody(part_).getBodyTransform(state));
    }

 private:
    const std::vector<contact::Contact>& findContacts(const SimTK::State& state) const {
        const base::Pose pose = poseInTrack(state);
        const double moved = (pose.position - lastPose_.position).norm() +
                             pose.rotation.angularDistance(lastPose_.rotation) * bodyRadius_;
        lastPose_ = pose;
        detector_.findContacts(pose, {}, moved, kWatch, points_);
        for (contact::Contact& point : points_)
            point.normal = contact::tiltNormal(law_, point.point, point.normal);
        return points_;
    }

    trial::ContactParameters law_;
    double damping_;
    double bodyRadius_;
    SimTK::MobilizedBodyIndex track_, part_;
    const SimTK::SimbodyMatterSubsystem& matter_;
    std::map<std::uint64_t, double> approach_;  // speed at which a feature came [m/s]
    // Scratch of one trial on one thread.
    mutable contact::Detector detector_;
    mutable base::Pose lastPose_;
    mutable std::vector<contact::Contact> points_;
    mutable std::vector<trial::ContactForce> pressing_;
};

/// The vibrating track as a body with prescribed motion.
SimTK::MobilizedBody makeTrack(SimTK::SimbodyMatterSubsystem& matter, const CertifyingScene& scene) {
    const SimTK::Body::Rigid body(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1.0)));
    const double rate = scene.drive.angularFrequency();
    const double along = scene.drive.halfStroke * std::cos(scene.drive.angle);
    const double up = scene.drive.halfStroke * std::sin(scene.drive.angle);
    if (scene.shape.type == track::FeederType::bowl && along > 0.0) {
        const double turn =
            (scene.shape.conveying == track::Conveying::clockwise ? -along : along) / scene.shape.bowlRadius;
        SimTK::MobilizedBody::Screw screw(matter.Ground(), SimTK::Transform(), body, SimTK::Transform(),
                                          up / turn);
        const SimTK::Motion::Sinusoid motion(screw, SimTK::Motion::Position, turn, rate, scene.phase);
        return screw;
    }
    // A slider moves along its x axis: lay that along the vibration line.
    const SimTK::Transform frame(SimTK::Rotation(-scene.drive.angle, SimTK::YAxis));
    SimTK::MobilizedBody::Slider slider(matter.Ground(), frame, body, frame);
    const SimTK::Motion::Sinusoid motion(slider, SimTK::Motion::Position, scene.drive.halfStroke, rate,
                                         scene.phase);
    return slider;
}

SimTK::MobilizedBody::Free makePart(SimTK::SimbodyMatterSubsystem& matter, const CertifyingScene& scene) {
    const Mat3& i = scene.inertia;
    const SimTK::Inertia inertia(SimTK::Vec3(i(0, 0), i(1, 1), i(2, 2)),
                                 SimTK::Vec3(i(0, 1), i(0, 2), i(1, 2)));
    return {matter.Ground(), SimTK::Transform(),
            SimTK::Body::Rigid(SimTK::MassProperties(scene.mass, SimTK::Vec3(0), inertia)),
            SimTK::Transform()};
}

}  // namespace

struct CertifyingTrial::Model {
    Model(const CertifyingScene& scene, const base::Pose& pose, const contact::BodyMotion& motion)
        : matter(system),
          forces(system),
          gravity(forces, matter, toSimbody(scene.gravity)),
          track(makeTrack(matter, scene)),
          part(makePart(matter, scene)),
          contactForce(
              new ContactForce(scene, track.getMobilizedBodyIndex(), part.getMobilizedBodyIndex(), matter)),
          custom(forces, contactForce),
          integrator(system) {
        SimTK::State state = system.realizeTopology();
        const Quaternion& r = pose.rotation;
        part.setQToFitTransform(
            state, SimTK::Transform(SimTK::Rotation(SimTK::Quaternion(r.w(), r.x(), r.y(), r.z())),
                                    toSimbody(pose.position)));
        part.setUToFitVelocity(
            state, SimTK::SpatialVec(toSimbody(motion.angularVelocity), toSimbody(motion.velocity)));
        integrator.setAccuracy(kAccuracy);
        integrator.setMaximumStepSize(kLongestStep);
        integrator.setReturnEveryInternalStep(true);
        integrator.initialize(state);
        contactForce->observe(integrator.getState());
    }

    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    SimTK::Force::Gravity gravity;
    SimTK::MobilizedBody track;
    SimTK::MobilizedBody::Free part;
    ContactForce* contactForce;  // owned by `custom`
    SimTK::Force::Custom custom;
    SimTK::RungeKuttaMersonIntegrator integrator;
};

CertifyingTrial::CertifyingTrial(const CertifyingScene& scene, const base::Pose& pose,
                                 const contact::BodyMotion& motion)
    : model_(std::make_unique<Model>(scene, pose, motion)) {}
CertifyingTrial::~CertifyingTrial() = default;
CertifyingTrial::CertifyingTrial(CertifyingTrial&&) noexcept = default;
CertifyingTrial& CertifyingTrial::operator=(CertifyingTrial&&) noexcept = default;

void CertifyingTrial::advanceTo(double time) {
    while (model_->integrator.getTime() < time) {
        model_->integrator.stepTo(time);
        model_->system.realize(model_->integrator.getState(), SimTK::Stage::Velocity);
        model_->contactForce->observe(model_->integrator.getState());
    }
}

base::Pose CertifyingTrial::pose() const {
    return fromSimbody(model_->part.getBodyTransform(model_->integrator.getState()));
}

base::Pose CertifyingTrial::poseInTrack() const {
    return model_->contactForce->poseInTrack(model_->integrator.getState());
}

contact::BodyMotion CertifyingTrial::motion() const {
    const SimTK::State& state = model_->integrator.getState();
    return {fromSimbody(model_->part.getBodyOriginVelocity(state)),
            fromSimbody(model_->part.getBodyAngularVelocity(state))};
}

const std::vector<trial::ContactForce>& CertifyingTrial::forces() const {
    return model_->contactForce->pressing();
}

}  // namespace trapwright::simbody
