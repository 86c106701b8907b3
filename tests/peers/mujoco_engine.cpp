#include "tests/peers/mujoco_engine.h"

#include <mujoco/mujoco.h>

#include <array>
#include <cmath>

#include "tests/peers/mujoco_model.h"
#include "tests/peers/vibrating_frame.h"

namespace trapwright::peers {

using base::Vec3;

namespace {

constexpr int kPart = 1;               // the only body beside the world
constexpr double kContactSteps = 4.0;  // time constant of a contact; less is unstable [steps]

struct DeleteModel {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, DeleteModel>;

base::Result<ModelPointer> compileModel(const std::string& xml) {
    constexpr const char* kName = "scene.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
    xml.copy(static_cast<char*>(files->filedata[0]), xml.size());
    std::array<char, 1000> message{};
    ModelPointer model(mj_loadXML(kName, files.get(), message.data(), static_cast<int>(message.size())));
    mj_deleteVFS(files.get());
    if (!model) return base::Error{std::string("MuJoCo does not take the scene: ") + message.data()};
    return model;
}

/// The damping ratio of a contact that rebounds with the ratio `restitution`: a damped spring that is let go
/// as soon as it would pull, e = exp(-2 d acos(d) / sqrt(1 - d^2)); critical damping gives 0.135.
double calcDampingRatio(double restitution) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 50; ++i) {
        const double d = 0.5 * (low + high);
        const double rebound = std::exp(-2.0 * d * std::acos(d) / std::sqrt(1.0 - d * d));
        (rebound > restitution ? low : high) = d;
    }
    return high;
}

struct MujocoScene : PeerScene {
    MujocoScene(const trial::TrialBatch& b, const part::Part& p, ModelPointer m)
        : batch(b), part(p), model(std::move(m)) {}
    [[nodiscard]] std::unique_ptr<PeerTrial> start(std::size_t trial) const override;

    const trial::TrialBatch& batch;
    const part::Part& part;
    ModelPointer model;
};

class MujocoTrial : public PeerTrial {
 public:
    MujocoTrial(const MujocoScene& scene, std::size_t index);

    void step(trial::CostLaps& laps) override;
    [[nodiscard]] base::Pose poseInTrack() const override;
    [[nodiscard]] base::Pose pose() const override { return frame_.placement().toRoom(poseInTrack()); }
    [[nodiscard]] contact::BodyMotion motion() const override {
        return frame_.toRoom(poseInTrack().position, motionInTrack());
    }
    [[nodiscard]] int contacts() const override { return data_->ncon; }

 private:
    [[nodiscard]] contact::BodyMotion motionInTrack() const;
    void applyInertialForces();
    void setContactLaw();

    const trial::TrialBatch& batch_;
    const part::Part& part_;
    const mjModel* model_;
    std::unique_ptr<mjData, DeleteData> data_;
    VibratingFrame frame_;
    double friction_;
    double damping_;
};

MujocoTrial::MujocoTrial(const MujocoScene& scene, std::size_t index)
    : batch_(scene.batch),
      part_(scene.part),
      model_(scene.model.get()),
      data_(mj_makeData(model_)),
      frame_(batch_, index, model_->opt.timestep) {
    const trial::TrialSpec& spec = batch_.trials[index];
    friction_ = batch_.contactOf(spec).kineticFriction;
    damping_ = calcDampingRatio(batch_.contactOf(spec).restitution);
    // The start pose is told relative to the track already.
    const base::Pose& pose = spec.parts[0].pose;
    const contact::BodyMotion motion =
        frame_.toFrame(pose.position, {spec.parts[0].velocity, spec.parts[0].angularVelocity});
    const Vec3 spin = pose.rotation.conjugate() * motion.angularVelocity;
    const base::Quaternion& q = pose.rotation;
    const std::array<double, 4> rotation = {q.w(), q.x(), q.y(), q.z()};
    mju_copy(data_->qpos, pose.position.data(), 3);
    mju_copy(data_->qpos + 3, rotation.data(), 4);
    mju_copy(data_->qvel, motion.velocity.data(), 3);
    mju_copy(data_->qvel + 3, spin.data(), 3);
}

base::Pose MujocoTrial::poseInTrack() const {
    const mjtNum* q = data_->qpos;
    return {base::Quaternion(q[3], q[4], q[5], q[6]), Vec3(q[0], q[1], q[2])};
}

contact::BodyMotion MujocoTrial::motionInTrack() const {
    const mjtNum* v = data_->qvel;
    return {Vec3(v[0], v[1], v[2]), poseInTrack().rotation * Vec3(v[3], v[4], v[5])};
}

void MujocoTrial::applyInertialForces() {
    const geometry::MassProperties& mass = part_.massProperties;
    const base::Pose pose = poseInTrack();
    const base::Mat3 rotation = pose.rotation.toRotationMatrix();
    const Wrench wrench = frame_.calcInertialForces(mass.mass, rotation * mass.inertia * rotation.transpose(),
                                                    pose.position, motionInTrack());
    mju_copy(data_->xfrc_applied + 6 * kPart, wrench.force.data(), 3);
    mju_copy(data_->xfrc_applied + 6 * kPart + 3, wrench.torque.data(), 3);
}

void MujocoTrial::setContactLaw() {
    for (int i = 0; i < data_->ncon; ++i) {
        mjContact& contact = data_->contact[i];
        contact.friction[0] = friction_;
        contact.friction[1] = friction_;
        contact.solref[0] = kContactSteps * model_->opt.timestep;
        contact.solref[1] = damping_;
    }
}

void MujocoTrial::step(trial::CostLaps& laps) {
    // mj_step() for a model without actuators, sensors, tendons and cameras, in its order.
    mjData* d = data_.get();
    applyInertialForces();
    mj_kinematics(model_, d);
    mj_comPos(model_, d);
    mj_crb(model_, d);
    mj_factorM(model_, d);
    laps.end(&trial::Costs::integration);
    mj_collision(model_, d);
    laps.end(&trial::Costs::detection);
    setContactLaw();
    mj_makeConstraint(model_, d);
    mj_projectConstraint(model_, d);
    laps.end(&trial::Costs::law);
    mj_fwdVelocity(model_, d);
    mj_fwdActuation(model_, d);
    mj_fwdAcceleration(model_, d);
    laps.end(&trial::Costs::integration);
    mj_fwdConstraint(model_, d);
    laps.end(&trial::Costs::law);
    mj_Euler(model_, d);
    frame_.advance();
}

std::unique_ptr<PeerTrial> MujocoScene::start(std::size_t trial) const {
    return std::make_unique<MujocoTrial>(*this, trial);
}

}  // namespace

base::Result<std::unique_ptr<PeerScene>> MujocoEngine::prepare(const trial::TrialBatch& batch,
                                                               const part::Part& part) const {
    const auto xml = writeMujocoModel(batch, part, batch.stepOf(step(), step()));
    if (!xml) return xml.error();
    auto model = compileModel(*xml);
    if (!model) return model.error();
    return std::unique_ptr<PeerScene>(std::make_unique<MujocoScene>(batch, part, std::move(model).value()));
}

}  // namespace trapwright::peers
