#include "sim/contact/trial_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/contact/roughness.h"

namespace trapwright::contact {

using base::Vec3;

TrialContact::TrialContact(const ContactTrack& track, const DriveMotion& drive, const ContactLaws& laws,
                           double dt)
    : laws_(laws), drive_(drive), dt_(dt), track_(&track) {
    before_ = drive_.placement(-dt_);
    now_ = drive_.placement(0.0);
    next_ = drive_.placement(dt_);
}

void TrialContact::add(int slot, const ContactBody& body) {
    if (slot >= slotCount()) parts_.resize(static_cast<std::size_t>(slot) + 1);
    parts_[static_cast<std::size_t>(slot)].emplace(Part{Detector(*track_, body), &body, {}});
    pairs_.add(slot, body);
}

void TrialContact::remove(int slot) {
    parts_[static_cast<std::size_t>(slot)].reset();
    pairs_.remove(slot);
    solver_.forget(slot);
}

void TrialContact::findTrackContacts(int slot, const SteppedPart& part) {
    Part& own = *parts_[static_cast<std::size_t>(slot)];
    // How far any point of the part can come relative to the track in this step. The track's own motion
    // differs little between its points; that of the part's centre stands for it, with a reserve.
    const Vec3 centre = now_.toTrack(part.pose.position);
    const Vec3 trackStep = next_.toRoom(centre) - part.pose.position;
    const double turn = std::abs(next_.sine - now_.sine) * own.body->radius;
    const double reach = (part.free.velocity * dt_ - trackStep).norm() +
                         part.free.angularVelocity.norm() * dt_ * own.body->radius + turn;
    const Vec3 trackTurn(0.0, 0.0, next_.sine * now_.cosine - next_.cosine * now_.sine);
    const ComingWay coming{now_.turnBack(part.free.velocity * dt_ - trackStep),
                           now_.turnBack(part.free.angularVelocity * dt_) - trackTurn};
    own.detector.findContacts(now_.toTrack(part.pose), coming, own.lastReach, 1.1 * reach + kTravelMargin,
                              found_);
    if (laws_.track.roughness > 0.0) roughen(found_);
    for (Contact& contact : found_) {
        contact.bodyB = slot;
        points_.push_back(contact);
        const Vec3 here = now_.toRoom(contact.point);
        stepContacts_.push_back({here - part.pose.position, now_.turn(contact.normal), contact.gap,
                                 (next_.toRoom(contact.point) - here) / dt_,
                                 (here - before_.toRoom(contact.point)) / dt_, contact.feature, contact.bodyA,
                                 contact.bodyB});
    }
}

void TrialContact::findPairContacts(std::span<const SteppedPart> parts) {
    positions_.clear();
    for (const SteppedPart& part : parts)
        positions_.push_back(part.pose.position);
    if (pairs_.findNear(positions_).empty()) return;
    nearParts_.resize(parts.size());
    for (std::size_t slot = 0; slot < parts_.size(); ++slot) {
        if (!parts_[slot]) continue;
        const Part& own = *parts_[slot];
        nearParts_[slot] = {parts[slot].pose, parts[slot].free.velocity, own.lastAdvance.velocity, own.turn,
                            own.lastTurn};
    }
    partContacts_.clear();
    pairs_.findContacts(nearParts_, dt_, partContacts_);
    for (const PartContact& found : partContacts_) {
        const Contact& contact = found.contact;
        stepContacts_.push_back(describe(contact, parts[static_cast<std::size_t>(contact.bodyA)].pose,
                                         parts[static_cast<std::size_t>(contact.bodyB)].pose));
        points_.push_back(contact);
        points_.back().point = now_.toTrack(contact.point);
        points_.back().normal = now_.turnBack(contact.normal);
    }
}

std::span<const StepResult> TrialContact::step(long step, std::span<const SteppedPart> parts,
                                               trial::CostLaps& laps) {
    points_.clear();
    stepContacts_.clear();
    results_.clear();
    for (int slot = 0; slot < slotCount(); ++slot) {
        const SteppedPart& part = parts[static_cast<std::size_t>(slot)];
        results_.push_back({part.free, part.free, 0});
        if (auto& own = parts_[static_cast<std::size_t>(slot)]) {
            own->turn = part.free.angularVelocity.norm() * dt_ * own->body->radius;
            findTrackContacts(slot, part);
        }
    }
    if (slotCount() > 1) findPairContacts(parts);
    laps.end(&trial::Costs::detection);

    if (points_.empty()) {
        if (!solver_.released()) solver_.release();
    } else {
        bodies_.clear();
        for (int slot = 0; slot < slotCount(); ++slot) {
            const SteppedPart& part = parts[static_cast<std::size_t>(slot)];
            const base::Mat3 rotation = part.pose.rotation.toRotationMatrix();
            bodies_.push_back({{part.inverseMass, rotation * part.inverseInertia * rotation.transpose()},
                               part.before,
                               part.free});
        }
        const auto solved = solver_.solve(bodies_, stepContacts_, laws_, dt_);
        std::copy(solved.begin(), solved.end(), results_.begin());
    }
    laps.end(&trial::Costs::law);

    for (int slot = 0; slot < slotCount(); ++slot) {
        auto& own = parts_[static_cast<std::size_t>(slot)];
        if (!own) continue;
        const base::Pose& pose = parts[static_cast<std::size_t>(slot)].pose;
        const Vec3 trackStep = next_.toRoom(now_.toTrack(pose.position)) - pose.position;
        own->lastAdvance = results_[static_cast<std::size_t>(slot)].advance;
        own->lastTurn = own->lastAdvance.angularVelocity.norm() * dt_ * own->body->radius;
        own->lastReach = (own->lastAdvance.velocity * dt_ - trackStep).norm() + own->lastTurn +
                         std::abs(next_.sine - now_.sine) * own->body->radius;
    }
    before_ = now_;
    now_ = next_;
    next_ = drive_.placement(static_cast<double>(step + 2) * dt_);
    return results_;
}

void TrialContact::roughen(std::vector<Contact>& contacts) {
    // Grains hide which contacts lie in one plane: the solver could not thin them out any more.
    manifold_.clear();
    for (const Contact& contact : contacts)
        manifold_.push_back({contact.point, contact.normal, contact.gap});
    std::array<int, ImpulseSolver::kMaxContacts> kept{};
    const int count = reduceManifold(manifold_, kept);
    for (int i = 0; i < count; ++i) {
        Contact& contact = contacts[static_cast<std::size_t>(i)];
        contact =
            contacts[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];  // in order: kept[i] >= i
        contact.normal = tiltNormal(laws_.track, contact.point, contact.normal);
    }
    contacts.resize(static_cast<std::size_t>(count));
}

std::vector<trial::ContactForce> TrialContact::forces() const {
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
