#include "sim/contact/part_contact.h"

#include <array>
#include <cmath>

#include "sim/contact/roughness.h"

namespace trapwright::contact {

using base::Vec3;

namespace {

/// Added to what a part can travel in a step, so that contacts are there before they carry. [m]
constexpr double kMargin = 5e-6;

}  // namespace

PartContact::PartContact(const ContactTrack& track, const ContactBody& body, const DriveMotion& drive,
                         const trial::ContactParameters& law, double dt)
    : body_(&body), drive_(drive), law_(law), dt_(dt), detector_(track, body) {
    before_ = drive_.placement(-dt_);
    now_ = drive_.placement(0.0);
    next_ = drive_.placement(dt_);
}

StepResult PartContact::step(long step, const base::Pose& pose, double inverseMass,
                             const base::Mat3& inverseInertia, const BodyMotion& before,
                             const BodyMotion& free, trial::CostLaps& laps) {
    // How far any point of the part can come relative to the track in this step. The track's own motion
    // differs little between its points; that of the part's centre stands for it, with a reserve.
    const Vec3 centre = now_.toTrack(pose.position);
    const Vec3 trackStep = next_.toRoom(centre) - pose.position;
    const double turn = std::abs(next_.sine - now_.sine) * body_->radius;
    const double reach =
        (free.velocity * dt_ - trackStep).norm() + free.angularVelocity.norm() * dt_ * body_->radius + turn;
    detector_.findContacts(now_.toTrack(pose), lastReach_, 1.1 * reach + kMargin, points_);
    if (law_.roughness > 0.0) roughen();
    laps.end(&trial::Costs::detection);

    StepResult result{free, free, 0};
    if (points_.empty()) {
        if (!solver_.released()) solver_.release();
    } else {
        stepContacts_.clear();
        for (const Contact& point : points_) {
            const Vec3 here = now_.toRoom(point.point);
            stepContacts_.push_back({here - pose.position, now_.turn(point.normal), point.gap,
                                     (next_.toRoom(point.point) - here) / dt_,
                                     (here - before_.toRoom(point.point)) / dt_, point.feature, point.bodyA,
                                     point.bodyB});
        }
        const base::Mat3 rotation = pose.rotation.toRotationMatrix();
        const MovingBody body{{inverseMass, rotation * inverseInertia * rotation.transpose()}, before, free};
        result = solver_.solve({&body, 1}, stepContacts_, {law_, law_}, dt_).front();
    }
    laps.end(&trial::Costs::law);

    lastReach_ = (result.advance.velocity * dt_ - trackStep).norm() +
                 result.advance.angularVelocity.norm() * dt_ * body_->radius + turn;
    before_ = now_;
    now_ = next_;
    next_ = drive_.placement(static_cast<double>(step + 2) * dt_);
    return result;
}

void PartContact::roughen() {
    // Grains hide which contacts lie in one plane: the solver could not thin them out any more.
    manifold_.clear();
    for (const Contact& contact : points_)
        manifold_.push_back({contact.point, contact.normal, contact.gap});
    std::array<int, ImpulseSolver::kMaxContacts> kept{};
    const int count = reduceManifold(manifold_, kept);
    for (int i = 0; i < count; ++i) {
        Contact& contact = points_[static_cast<std::size_t>(i)];
        contact =
            points_[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];  // in order: kept[i] >= i
        contact.normal = tiltNormal(law_, contact.point, contact.normal);
    }
    points_.resize(static_cast<std::size_t>(count));
}

std::vector<trial::ContactForce> PartContact::forces() const {
    std::vector<trial::ContactForce> result;
    if (points_.empty()) return result;
    // The track has moved on since.
    for (const ContactImpulse& given : solver_.impulses()) {
        const Contact& contact = points_[static_cast<std::size_t>(given.contact)];
        result.push_back(
            {contact.bodyA, contact.bodyB, contact.point, before_.turnBack(given.impulse) / dt_});
    }
    return result;
}

}  // namespace trapwright::contact
