#include "sim/contact/impulse_solver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "sim/contact/manifold.h"

namespace trapwright::contact {

using base::Mat3;
using base::Vec3;

namespace scalar {

namespace {

/// The motions of parts that touch each other. What formulas/step.inl does with one part it does with these.
struct PartMotions {
    std::vector<Motion> parts;
};

/// A contact of one of these parts, B, with another or the track.
struct PairConstraint : ContactConstraint {
    int a = -1;  // its place in PartMotions; -1: the track
    int b = 0;
    Triple turnA[3];    // scaled arm of A x axis
    Real ratio = 0.0;   // B's mass over A's: impulses are per mass of B
    Real weight = 1.0;  // B's mass over that of the first part, by which work is compared
};

inline Real velocityAlong(const PairConstraint& row, const PartMotions& motion, int k) {
    const ContactConstraint& own = row;
    const Real velocity = velocityAlong(own, motion.parts[static_cast<std::size_t>(row.b)], k);
    if (row.a < 0) return velocity;
    const Motion& other = motion.parts[static_cast<std::size_t>(row.a)];
    return velocity - dot(row.axis[k], other.velocity) - dot(row.turnA[k], other.spin);
}

inline void applyImpulse(const PairConstraint& row, PartMotions& motion, int k, Real impulse) {
    const ContactConstraint& own = row;
    applyImpulse(own, motion.parts[static_cast<std::size_t>(row.b)], k, impulse);
    if (row.a < 0) return;
    Motion& other = motion.parts[static_cast<std::size_t>(row.a)];
    other.velocity = mulAdd(-row.ratio * impulse, row.axis[k], other.velocity);
    other.spin = mulAdd(-row.ratio * impulse, row.turnA[k], other.spin);
}

/// Of the slowest: what rests stays where it is, also beside what moves.
Real squaredSpeed(const PartMotions& motion) {
    Real least = squaredSpeed(motion.parts.front());
    for (const Motion& part : motion.parts)
        least = min(least, squaredSpeed(part));
    return least;
}

Real workOf(const PairConstraint& row, Real work) {
    return row.weight * work;
}

PartMotions blend(Real early, const PartMotions& first, const PartMotions& second) {
    PartMotions result = first;
    for (std::size_t i = 0; i < result.parts.size(); ++i)
        result.parts[i] = blend(early, first.parts[i], second.parts[i]);
    return result;
}

PartMotions select(Mask mask, const PartMotions& yes, const PartMotions& no) {
    return mask ? yes : no;
}

}  // namespace

}  // namespace scalar

namespace {

scalar::Triple toTriple(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

Vec3 fromTriple(const scalar::Triple& v) {
    return {v.x, v.y, v.z};
}

/// Between room axes and the scaled quantities of formulas/step.inl.
class Scaling {
 public:
    explicit Scaling(const BodyInertia& inertia)
        : factor_(Mat3(inertia.inverseInertia / inertia.inverseMass).llt().matrixL()) {}

    [[nodiscard]] scalar::Matrix turns() const {
        scalar::Matrix matrix{};
        for (int k = 0; k < 3; ++k)
            matrix.row[k] = toTriple(factor_.col(k));
        return matrix;
    }
    [[nodiscard]] scalar::Motion scale(const BodyMotion& motion) const {
        return {toTriple(motion.velocity),
                toTriple(factor_.triangularView<Eigen::Lower>().solve(motion.angularVelocity))};
    }
    [[nodiscard]] BodyMotion unscale(const scalar::Motion& motion) const {
        return {fromTriple(motion.velocity), factor_ * fromTriple(motion.spin)};
    }

 private:
    Mat3 factor_;  // lower triangular; times its transpose: inverse inertia times mass
};

scalar::Law lawOf(const MovingContact& contact, const ContactLaws& laws) {
    const trial::ContactParameters& pair = contact.bodyA == trial::kTrack ? laws.track : laws.parts;
    return {pair.staticFriction, pair.kineticFriction, pair.restitution};
}

/// A part on its way through a step, scaled.
struct ScaledBody {
    explicit ScaledBody(const MovingBody& body)
        : scaling(body.inertia),
          turns(scaling.turns()),
          motion{scaling.scale(body.before), scaling.scale(body.free), {}},
          mass(1.0 / body.inertia.inverseMass) {}

    Scaling scaling;
    scalar::Matrix turns;
    scalar::StepMotion motion;
    double mass;  // [kg]
};

/// Like scalar::prepareConstraint, for a contact whose B is `b` and whose A, if it is a part, is `a`.
void preparePair(scalar::PairConstraint& row, const scalar::MovingContact& touch, const Vec3& armA,
                 const ScaledBody& b, const ScaledBody* a, const scalar::Law& law, double dt) {
    if (a == nullptr) {
        scalar::prepareConstraint(row, touch, b.turns, b.motion, law, dt);
        return;
    }
    row.ratio = b.mass / a->mass;
    scalar::setAxes(row, touch);
    double speedBefore[3];
    scalar::InverseMass inverse{};
    const scalar::Triple arm = toTriple(armA);
    for (int k = 0; k < 3; ++k) {
        const scalar::Triple& axis = row.axis[k];
        row.turn[k] = b.turns * scalar::cross(touch.arm, axis);
        row.turnA[k] = a->turns * scalar::cross(arm, axis);
        row.track[k] = 0.0;
        const auto along = [&](const scalar::Motion& ofB, const scalar::Motion& ofA) {
            return scalar::dot(axis, ofB.velocity - ofA.velocity) + scalar::dot(row.turn[k], ofB.spin) -
                   scalar::dot(row.turnA[k], ofA.spin);
        };
        row.speed[k] = along(b.motion.free, a->motion.free);
        speedBefore[k] = along(b.motion.before, a->motion.before);
        inverse.along[k] = 1.0 + scalar::dot(row.turn[k], row.turn[k]) +
                           row.ratio * (1.0 + scalar::dot(row.turnA[k], row.turnA[k]));
    }
    const scalar::Motion& offset = b.motion.offset;
    const scalar::Motion& offsetA = a->motion.offset;
    row.gap =
        touch.gap + dt * (scalar::dot(row.axis[0], offset.velocity - offsetA.velocity) +
                          scalar::dot(row.turn[0], offset.spin) - scalar::dot(row.turnA[0], offsetA.spin));
    const auto couple = [&](int k, int l) {
        return scalar::dot(row.turn[k], row.turn[l]) + row.ratio * scalar::dot(row.turnA[k], row.turnA[l]);
    };
    inverse.coupling = couple(1, 2);
    inverse.normalCoupling = {couple(0, 1), couple(0, 2)};
    scalar::applyLaw(row, touch, inverse, speedBefore, law, dt);
}

bool isOfSameBodies(const MovingContact& a, const MovingContact& b) {
    return a.bodyA == b.bodyA && a.bodyB == b.bodyB;
}

}  // namespace

/// What solveTogether() works with, kept from step to step.
struct ImpulseSolver::Workspace {
    std::vector<ScaledBody> bodies;
    std::vector<int> places;  // of all bodies, among these
    std::vector<scalar::PairConstraint> rows;
    scalar::PartMotions free;
};

ImpulseSolver::ImpulseSolver() : workspace_(std::make_unique<Workspace>()) {}
ImpulseSolver::~ImpulseSolver() = default;
ImpulseSolver::ImpulseSolver(ImpulseSolver&&) noexcept = default;
ImpulseSolver& ImpulseSolver::operator=(ImpulseSolver&&) noexcept = default;

void ImpulseSolver::reduce(std::span<const MovingContact> contacts) {
    kept_.clear();
    for (std::size_t first = 0; first < contacts.size();) {
        points_.clear();
        std::size_t end = first;
        for (; end < contacts.size() && isOfSameBodies(contacts[end], contacts[first]); ++end)
            points_.push_back({contacts[end].arm, contacts[end].normal, contacts[end].gap});
        std::array<int, kMaxContacts> kept;
        const int count = reduceManifold(points_, kept);
        for (int i = 0; i < count; ++i)
            kept_.push_back(static_cast<int>(first) + kept[static_cast<std::size_t>(i)]);
        first = end;
    }
}

void ImpulseSolver::findIslands(std::size_t bodies, std::span<const MovingContact> contacts) {
    islandOf_.resize(bodies);
    std::iota(islandOf_.begin(), islandOf_.end(), 0);
    for (const int i : kept_) {
        const MovingContact& contact = contacts[static_cast<std::size_t>(i)];
        if (contact.bodyA == trial::kTrack) continue;
        const auto ofA = islandOf_[static_cast<std::size_t>(contact.bodyA)];
        const auto ofB = islandOf_[static_cast<std::size_t>(contact.bodyB)];
        if (ofA != ofB)
            std::replace(islandOf_.begin(), islandOf_.end(), std::max(ofA, ofB), std::min(ofA, ofB));
    }
    islands_.resize(bodies);
    for (Island& island : islands_) {
        island.bodies.clear();
        island.contacts.clear();
    }
    for (std::size_t i = 0; i < bodies; ++i)
        islands_[static_cast<std::size_t>(islandOf_[i])].bodies.push_back(static_cast<int>(i));
    for (const int i : kept_) {
        const auto body = static_cast<std::size_t>(contacts[static_cast<std::size_t>(i)].bodyB);
        islands_[static_cast<std::size_t>(islandOf_[body])].contacts.push_back(i);
    }
}

std::span<const StepResult> ImpulseSolver::solve(std::span<const MovingBody> bodies,
                                                 std::span<const MovingContact> contacts,
                                                 const ContactLaws& laws, double dt) {
    results_.clear();
    for (const MovingBody& body : bodies)
        results_.push_back({body.free, body.free, 0});
    impulses_.clear();
    impulseOf_.assign(contacts.size(), -1);
    next_.clear();
    reduce(contacts);
    if (bodies.size() == 1) {
        solveAlone(bodies, contacts, kept_, laws, dt);
    } else {
        findIslands(bodies.size(), contacts);
        for (const Island& one : islands_) {
            if (one.contacts.empty()) continue;
            if (one.bodies.size() == 1)
                solveAlone(bodies, contacts, one.contacts, laws, dt);
            else
                solveTogether(bodies, contacts, one, laws, dt);
        }
    }
    std::swap(remembered_, next_);
    return results_;
}

void ImpulseSolver::solveAlone(std::span<const MovingBody> bodies, std::span<const MovingContact> contacts,
                               std::span<const int> kept, const ContactLaws& laws, double dt) {
    const auto index = kept.empty()
                           ? std::size_t{0}
                           : static_cast<std::size_t>(contacts[static_cast<std::size_t>(kept.front())].bodyB);
    ScaledBody body(bodies[index]);
    const int count = static_cast<int>(kept.size());
    rows_.resize(kept.size());
    for (int moment = 0;; ++moment) {
        const bool last = moment + 1 == scalar::kMostMoments;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const MovingContact& contact = contacts[static_cast<std::size_t>(kept[i])];
            scalar::prepareConstraint(rows_[i], describe(contact, moment), body.turns, body.motion,
                                      lawOf(contact, laws), dt);
        }
        scalar::takeFirstImpacts(rows_.data(), count, dt);
        const scalar::Motion& free = body.motion.free;
        const scalar::Motion after = scalar::solve(rows_.data(), count, free);
        const scalar::Motion own = scalar::advancePose(rows_.data(), count, free, after, dt, last);
        const scalar::Motion advance = body.motion.offset + own;
        StepResult& result = results_[index];
        result.motion = body.scaling.unscale(after);
        result.advance = body.scaling.unscale(advance);
        for (std::size_t i = 0; i < kept.size(); ++i)
            keep(contacts[static_cast<std::size_t>(kept[i])], kept[i], rows_[i], body.mass, moment);
        if (last || !scalar::reachesLater(rows_.data(), count, own, dt)) return;
        body.motion = goOnAfter(body.motion, after, advance);
    }
}

void ImpulseSolver::solveTogether(std::span<const MovingBody> bodies, std::span<const MovingContact> contacts,
                                  const Island& island, const ContactLaws& laws, double dt) {
    std::vector<ScaledBody>& own = workspace_->bodies;
    std::vector<int>& places = workspace_->places;
    std::vector<scalar::PairConstraint>& rows = workspace_->rows;
    scalar::PartMotions& free = workspace_->free;
    own.clear();
    places.resize(bodies.size());
    for (const int body : island.bodies) {
        places[static_cast<std::size_t>(body)] = static_cast<int>(own.size());
        own.emplace_back(bodies[static_cast<std::size_t>(body)]);
    }
    const auto placeOf = [&places](trial::Body body) { return places[static_cast<std::size_t>(body)]; };
    rows.resize(island.contacts.size());
    const int count = static_cast<int>(rows.size());
    free.parts.resize(own.size());
    for (int moment = 0;; ++moment) {
        const bool last = moment + 1 == scalar::kMostMoments;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const MovingContact& contact = contacts[static_cast<std::size_t>(island.contacts[i])];
            scalar::PairConstraint& row = rows[i];
            row.b = placeOf(contact.bodyB);
            row.a = contact.bodyA == trial::kTrack ? -1 : placeOf(contact.bodyA);
            const ScaledBody& b = own[static_cast<std::size_t>(row.b)];
            const ScaledBody* a = row.a < 0 ? nullptr : &own[static_cast<std::size_t>(row.a)];
            row.weight = b.mass / own.front().mass;
            preparePair(row, describe(contact, moment), contact.armA, b, a, lawOf(contact, laws), dt);
        }
        for (std::size_t i = 0; i < own.size(); ++i)
            free.parts[i] = own[i].motion.free;
        scalar::takeFirstImpacts(rows.data(), count, dt);
        const scalar::PartMotions after = scalar::solve(rows.data(), count, free);
        const scalar::PartMotions ways = scalar::advancePose(rows.data(), count, free, after, dt, last);
        for (std::size_t i = 0; i < rows.size(); ++i)
            keep(contacts[static_cast<std::size_t>(island.contacts[i])], island.contacts[i], rows[i],
                 own[static_cast<std::size_t>(rows[i].b)].mass, moment);
        const bool more = !last && scalar::reachesLater(rows.data(), count, ways, dt);
        for (std::size_t i = 0; i < own.size(); ++i) {
            StepResult& result = results_[static_cast<std::size_t>(island.bodies[i])];
            const scalar::Motion advance = own[i].motion.offset + ways.parts[i];
            result.motion = own[i].scaling.unscale(after.parts[i]);
            result.advance = own[i].scaling.unscale(advance);
            if (more) own[i].motion = goOnAfter(own[i].motion, after.parts[i], advance);
        }
        if (!more) return;
    }
}

/// For the next step, and for whoever asks for impulses. `mass`: of B [kg]. What carries over a step shows
/// before its first impact: `moment` 0.
void ImpulseSolver::keep(const MovingContact& contact, int index, const scalar::ContactConstraint& row,
                         double mass, int moment) {
    if (moment == 0) {
        // The impulse of an impact says nothing about the next step's.
        const bool impact = row.impactTime <= 1.0;
        next_.push_back({contact.bodyA, contact.bodyB, contact.feature, impact ? 0.0 : row.normal,
                         impact ? scalar::Pair{0.0, 0.0} : row.tangential, row.sliding});
    }
    if (row.normal <= 0.0) return;
    const Vec3 perMass = row.normal * fromTriple(row.axis[0]) + row.tangential.x * fromTriple(row.axis[1]) +
                         row.tangential.y * fromTriple(row.axis[2]);
    int& place = impulseOf_[static_cast<std::size_t>(index)];
    if (place >= 0) {
        impulses_[static_cast<std::size_t>(place)].impulse += mass * perMass;
        return;
    }
    place = static_cast<int>(impulses_.size());
    impulses_.push_back({index, mass * perMass});
    ++results_[static_cast<std::size_t>(contact.bodyB)].carrying;
    if (contact.bodyA != trial::kTrack) ++results_[static_cast<std::size_t>(contact.bodyA)].carrying;
}

scalar::MovingContact ImpulseSolver::describe(const MovingContact& contact, int moment) {
    scalar::MovingContact touch{toTriple(contact.arm),
                                toTriple(contact.normal),
                                contact.gap,
                                toTriple(contact.trackVelocity),
                                toTriple(contact.trackVelocityBefore),
                                false,
                                0.0,
                                {0.0, 0.0},
                                false};
    // Contacts come in about the same order in each step.
    for (std::size_t tried = 0; tried < remembered_.size(); ++tried, ++expected_) {
        if (expected_ >= remembered_.size()) expected_ = 0;
        const Remembered& old = remembered_[expected_];
        if (old.feature != contact.feature || old.bodyA != contact.bodyA || old.bodyB != contact.bodyB)
            continue;
        ++expected_;
        touch.known = true;
        if (moment == 0) {
            touch.normalImpulse = old.normal;
            touch.tangentialImpulse = old.tangential;
        }
        touch.slid = old.sliding;
        break;
    }
    return touch;
}

}  // namespace trapwright::contact
