#include "sim/contact/impulse_solver.h"

#include <Eigen/Cholesky>

#include "sim/contact/manifold.h"

namespace trapwright::contact {

using base::Mat3;
using base::Vec3;

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

}  // namespace

StepResult ImpulseSolver::solve(const BodyInertia& inertia, const BodyMotion& before, const BodyMotion& free,
                                const std::vector<MovingContact>& contacts,
                                const trial::ContactParameters& law, double dt) {
    const Scaling scaling(inertia);
    const scalar::Law pair{law.staticFriction, law.kineticFriction, law.restitution};
    const scalar::Motion scaledBefore = scaling.scale(before);
    const scalar::Motion scaledFree = scaling.scale(free);
    const scalar::Matrix turns = scaling.turns();
    points_.clear();
    for (const MovingContact& contact : contacts)
        points_.push_back({contact.arm, contact.normal, contact.gap});
    const int count = reduceManifold(points_, kept_);
    rows_.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        scalar::prepareConstraint(rows_[i], describe(contacts[kept_[i]]), turns, scaledBefore, scaledFree,
                                  pair, dt);

    const scalar::Motion after = scalar::solve(rows_.data(), count, scaledFree);
    StepResult result;
    result.motion = scaling.unscale(after);
    result.advance = scaling.unscale(scalar::advancePose(rows_.data(), count, scaledFree, after, dt));

    remembered_.clear();
    for (int i = 0; i < count; ++i) {
        const scalar::ContactConstraint& row = rows_[i];
        result.carrying += row.normal > 0.0 ? 1 : 0;
        // The impulse of an impact says nothing about the next step's.
        const bool impact = row.target > 0.0;
        remembered_.push_back({contacts[kept_[i]].feature, impact ? 0.0 : row.normal,
                               impact ? scalar::Pair{0.0, 0.0} : row.tangential, row.sliding});
    }
    return result;
}

std::vector<ContactImpulse> ImpulseSolver::impulses(double mass) const {
    std::vector<ContactImpulse> result;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const scalar::ContactConstraint& row = rows_[i];
        if (row.normal <= 0.0) continue;
        const Vec3 perMass = row.normal * fromTriple(row.axis[0]) +
                             row.tangential.x * fromTriple(row.axis[1]) +
                             row.tangential.y * fromTriple(row.axis[2]);
        result.push_back({kept_[i], mass * perMass});
    }
    return result;
}

scalar::MovingContact ImpulseSolver::describe(const MovingContact& contact) const {
    scalar::MovingContact touch{toTriple(contact.arm),
                                toTriple(contact.normal),
                                contact.gap,
                                toTriple(contact.trackVelocity),
                                toTriple(contact.trackVelocityBefore),
                                false,
                                0.0,
                                {0.0, 0.0},
                                false};
    for (const Remembered& old : remembered_) {
        if (old.feature != contact.feature) continue;
        touch.known = true;
        touch.normalImpulse = old.normal;
        touch.tangentialImpulse = old.tangential;
        touch.slid = old.sliding;
        break;
    }
    return touch;
}

}  // namespace trapwright::contact
