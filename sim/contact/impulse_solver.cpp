#include "sim/contact/impulse_solver.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/manifold.h"

namespace trapwright::contact {

using base::Vec2;
using base::Vec3;

namespace {

constexpr int kMaxIterations = 50;
/// Iterations end when no contact's velocity changes by more. [m/s]
constexpr double kVelocityTolerance = 1e-6;
/// Share of an overlap that is taken back in one step, without giving the part speed.
constexpr double kRecovery = 0.2;
/// Overlaps that are left alone. [m]
constexpr double kOverlapTolerance = 1e-9;
/// Slower than this a new contact sticks if it can. [m/s]
constexpr double kStickSpeed = 1e-3;

}  // namespace

StepResult ImpulseSolver::solve(const BodyInertia& inertia, const BodyMotion& before, const BodyMotion& free,
                                const std::vector<StepContact>& contacts, const SurfaceLaw& law, double dt) {
    prepareRows(inertia, before, free, contacts, law, dt);
    StepResult result;
    result.motion = iterate(inertia, free);

    // Newton's restitution at several places at once may create energy: such an impact is taken as plastic.
    bool impact = false;
    double work = 0.0;
    for (const Row& row : rows_) {
        impact |= row.target > 0.0;
        const double impulse[3] = {row.normal, row.tangential[0], row.tangential[1]};
        for (int k = 0; k < 3; ++k)
            work += 0.5 * impulse[k] * (row.speed[k] + row.velocityAlong(result.motion, k));
    }
    if (impact && work > 0.0) {
        for (Row& row : rows_) {
            row.target = std::min(row.target, 0.0);
            row.normal = 0.0;
            row.tangential.setZero();
        }
        result.motion = iterate(inertia, free);
    }

    result.advance = advancePose(inertia, free, result.motion, dt);
    for (const Row& row : rows_)
        result.carrying += row.normal > 0.0 ? 1 : 0;
    remember();
    return result;
}

void ImpulseSolver::prepareRows(const BodyInertia& inertia, const BodyMotion& before, const BodyMotion& free,
                                const std::vector<StepContact>& contacts, const SurfaceLaw& law, double dt) {
    rows_.clear();
    for (const int index : thinOut(contacts, kMaxContacts)) {
        const StepContact& contact = contacts[index];
        Row& row = rows_.emplace_back();
        row.feature = contact.feature;
        row.gap = contact.gap;
        row.axis[0] = contact.normal;
        // Any tangents will do, as long as the same normal always gives the same ones.
        const Vec3 aside = std::abs(contact.normal.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
        row.axis[1] = (aside - contact.normal.dot(aside) * contact.normal).normalized();
        row.axis[2] = contact.normal.cross(row.axis[1]);
        for (int k = 0; k < 3; ++k) {
            row.turn[k] = contact.arm.cross(row.axis[k]);
            row.spin[k] = inertia.inverseInertia * row.turn[k];
            row.track[k] = row.axis[k].dot(contact.trackVelocity);
            row.speed[k] = row.velocityAlong(free, k);
        }
        const auto inverseMass = [&](int i, int j) {
            return (i == j ? inertia.inverseMass : 0.0) + row.turn[i].dot(row.spin[j]);
        };
        row.inverseNormalMass = inverseMass(0, 0);
        const double mean = 0.5 * (inverseMass(1, 1) + inverseMass(2, 2));
        row.tangentStep =
            1.0 / (mean + std::hypot(0.5 * (inverseMass(1, 1) - inverseMass(2, 2)), inverseMass(1, 2)));

        // Not deeper than touching at the step's end; an impact inside the step rebounds.
        row.target = -std::max(contact.gap, 0.0) / dt;
        row.impactTime = 2.0;
        const Vec3 relativeBefore = before.at(contact.arm) - contact.trackVelocityBefore;
        const double approach = -contact.normal.dot(relativeBefore);
        row.slipBefore = Vec2(row.axis[1].dot(relativeBefore), row.axis[2].dot(relativeBefore));
        if (approach > kRestSpeed && contact.gap + dt * row.speed[0] < 0.0) {
            const double share = std::clamp(-std::max(contact.gap, 0.0) / (dt * row.speed[0]), 0.0, 1.0);
            // Velocities belong to the middles of steps; the impact lies between two of them.
            const double speed = approach + (0.5 + share) * (-row.speed[0] - approach);
            // From the impact to the middle of this step the part goes on being pulled.
            const double rebound =
                speed * calcRestitution(speed, law.restitution) + (0.5 - share) * (row.speed[0] + approach);
            if (rebound > 0.0) {
                row.target = rebound;
                row.impactTime = share;
                // An impact is over in no time: what sticks has the track's velocity of that moment, and
                // no slip has time to turn round.
                const Vec2 slip(row.speed[1], row.speed[2]);
                row.slipTarget = (0.5 - share) * (slip - row.slipBefore);
                row.slipBefore = slip - row.slipTarget;
            }
        }

        row.sliding = std::hypot(row.speed[1], row.speed[2]) > kStickSpeed;
        for (const Remembered& old : remembered_) {
            if (old.feature != row.feature) continue;
            row.normal = old.normal;
            row.tangential = old.tangential;
            row.sliding = old.sliding;
            break;
        }
        row.friction = row.sliding ? law.kineticFriction : law.staticFriction;
    }
}

BodyMotion ImpulseSolver::iterate(const BodyInertia& inertia, BodyMotion motion) {
    for (const Row& row : rows_) {
        row.push(motion, inertia.inverseMass, 0, row.normal);
        row.push(motion, inertia.inverseMass, 1, row.tangential[0]);
        row.push(motion, inertia.inverseMass, 2, row.tangential[1]);
    }
    const int count = static_cast<int>(rows_.size());
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        double change = 0.0;
        for (int i = 0; i < count; ++i) {
            Row& row = rows_[iteration % 2 == 0 ? i : count - 1 - i];
            const double normal = std::max(
                0.0, row.normal + (row.target - row.velocityAlong(motion, 0)) / row.inverseNormalMass);
            const double step = normal - row.normal;
            row.normal = normal;
            row.push(motion, inertia.inverseMass, 0, step);
            change = std::max(change, std::abs(step) * row.inverseNormalMass);

            const Vec2 slip =
                Vec2(row.velocityAlong(motion, 1), row.velocityAlong(motion, 2)) - row.slipTarget;
            const Friction friction = calcFriction(slip - row.tangential / row.tangentStep, row.slipBefore,
                                                   row.friction * row.normal / row.tangentStep);
            row.sliding = friction.sliding;
            const Vec2 tangential = row.tangentStep * friction.change;
            const Vec2 tangentialStep = tangential - row.tangential;
            row.tangential = tangential;
            row.push(motion, inertia.inverseMass, 1, tangentialStep[0]);
            row.push(motion, inertia.inverseMass, 2, tangentialStep[1]);
            change = std::max(change, tangentialStep.norm() / row.tangentStep);
        }
        if (change < kVelocityTolerance) break;
    }
    return motion;
}

BodyMotion ImpulseSolver::advancePose(const BodyInertia& inertia, const BodyMotion& free,
                                      const BodyMotion& after, double dt) {
    // Free motion up to the earliest impact, the rebound from there on.
    double impactTime = 2.0;
    for (const Row& row : rows_)
        if (row.target > 0.0) impactTime = std::min(impactTime, row.impactTime);
    BodyMotion advance = after;
    if (impactTime <= 1.0) {
        advance.velocity = impactTime * free.velocity + (1.0 - impactTime) * after.velocity;
        advance.angularVelocity =
            impactTime * free.angularVelocity + (1.0 - impactTime) * after.angularVelocity;
    }

    // The pose that this leads to may not overlap more than before: push it out without giving it speed.
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
        double worst = 0.0;
        for (const Row& row : rows_) {
            const double allowed = row.gap < 0.0 ? (1.0 - kRecovery) * row.gap : 0.0;
            const double overlap = allowed - (row.gap + dt * row.velocityAlong(advance, 0));
            if (overlap <= kOverlapTolerance) continue;
            row.push(advance, inertia.inverseMass, 0, overlap / dt / row.inverseNormalMass);
            worst = std::max(worst, overlap);
        }
        if (worst <= kOverlapTolerance) break;
    }
    return advance;
}

void ImpulseSolver::remember() {
    remembered_.clear();
    for (const Row& row : rows_) {
        // The impulse of an impact says nothing about the next step's.
        const bool impact = row.target > 0.0;
        remembered_.push_back(
            {row.feature, impact ? 0.0 : row.normal, impact ? Vec2::Zero() : row.tangential, row.sliding});
    }
}

}  // namespace trapwright::contact
