#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

/// The contact law, both forms. Derivations and sources: README.md of this folder.
namespace trapwright::contact {

/// The material pair of one trial.
struct SurfaceLaw {
    double staticFriction = 0.5;
    double kineticFriction = 0.5;
    double restitution = 0.3;
};

/// Below kRestSpeed an impact is plastic, above kFullSpeed the restitution is the set one; linear in between.
/// Impacts of a feeder are at 0.02-0.5 m/s. [m/s]
inline constexpr double kRestSpeed = 0.003;
inline constexpr double kFullSpeed = 0.012;

/// Rebound over impact speed for an impact at `speed` > 0 [m/s].
inline double calcRestitution(double speed, double restitution) {
    return restitution * std::clamp((speed - kRestSpeed) / (kFullSpeed - kRestSpeed), 0.0, 1.0);
}

/// What friction does to the slip at a contact over one step.
struct Friction {
    base::Vec2 change;  // of the slip velocity [m/s]
    bool sliding;
};

/// Mean direction (along, across) of a slip whose component along an axis runs evenly over [from, to], both
/// >= 0, while the one across it stays.
inline base::Vec2 calcMeanDirection(double from, double to, double across) {
    const double way = to - from;
    if (way < 1e-6 * (from + to + across)) return base::Vec2(0.5 * (from + to), across).normalized();
    if (across < 1e-9 * to) return {1.0, 0.0};
    return {(std::hypot(to, across) - std::hypot(from, across)) / way,
            across * (std::asinh(to / across) - std::asinh(from / across)) / way};
}

/// What friction changes where the track carries the slip on by `carried`, more than the bound: friction
/// against the slip at each moment of the step.
inline base::Vec2 calcFrictionOnTheWay(const base::Vec2& slipBefore, const base::Vec2& carried,
                                       double bound) {
    const double way = carried.norm();
    const base::Vec2 axis = carried / way;
    const double start = slipBefore.dot(axis);
    const base::Vec2 lateral = slipBefore - start * axis;
    const double across = lateral.norm();
    // Far from turning the direction half-way will do.
    if (start > 2.0 * way || start < -3.0 * way || across > 4.0 * way)
        return -bound * (slipBefore + 0.5 * carried).normalized();

    base::Vec2 against;  // along the axis, across it
    if (start >= 0.0) {
        const double pull = start > 0.0 ? bound * start / slipBefore.norm() : bound;
        against = -calcMeanDirection(start, start + way - pull, across);
    } else {
        const base::Vec2 first = calcMeanDirection(0.0, -start, across);
        const double share = -start / (way + bound * first.x());  // of the step until the slip turns
        if (share >= 1.0) {
            const double end = std::max(0.0, -start - way - bound * first.x());
            const base::Vec2 mean = calcMeanDirection(end, -start, across);
            against = {mean.x(), -mean.y()};
        } else {
            // How far it gets after turning depends on friction's direction, which depends on how far.
            const double rest = 1.0 - share;
            base::Vec2 second = calcMeanDirection(0.0, rest * (way - bound), across);
            second = calcMeanDirection(0.0, rest * (way - bound * second.x()), across);
            against = {share * first.x() - rest * second.x(), -share * first.y() - rest * second.y()};
        }
    }
    const double back = std::min(-bound * against.y(), across);
    base::Vec2 change = bound * against.x() * axis;
    if (across > 0.0) change -= back / across * lateral;
    return change;
}

/// Coulomb's cone over one step. `slip`: the slip velocity at the step's end without this contact's friction;
/// `slipBefore`: at its begin; `bound`: the change that the full friction impulse makes. A contact that can
/// hold sticks exactly; one that slides has the full impulse against its slip. Where the track carries the
/// slip on by more than that, friction turns with the slip within the step: at 50 Hz and 0.2 ms the direction
/// at the step's end alone would convey up to 30 % too fast.
inline Friction calcFriction(const base::Vec2& slip, const base::Vec2& slipBefore, double bound) {
    const base::Vec2 carried = slip - slipBefore;
    if (carried.squaredNorm() > bound * bound)
        return {calcFrictionOnTheWay(slipBefore, carried, bound), true};
    const double size = slip.norm();
    if (size <= bound) return {-slip, false};
    return {-bound / size * slip, true};
}

// The continuous form.

/// Stiffness of one contact. A plastic corner of 0.15 mm radius hit at 0.1 m/s by 0.1 g is in contact for
/// 0.16 ms (Hertz), as a linear spring of this stiffness would be. [N/m]
inline constexpr double kStiffness = 4e4;
/// Slip at which friction is fully developed: what sticks creeps more slowly than this. [m/s]
inline constexpr double kSlipScale = 1e-4;
/// The approach speed that damping refers to is at least this. [m/s]
inline constexpr double kLeastApproach = kRestSpeed;

/// Hunt and Crossley's damping (1975) in its dimensionless form d = alpha x approach speed, such that a free
/// rebound has the ratio `restitution`: ln((1 + d) / (1 - d e)) = d (1 + e).
inline double calcContactDamping(double restitution) {
    const double e = std::clamp(restitution, 0.01, 0.999);
    double low = 1e-6;
    double high = (1.0 - 1e-12) / e;
    for (int i = 0; i < 100; ++i) {
        const double d = 0.5 * (low + high);
        (std::log((1.0 + d) / (1.0 - d * e)) < d * (1.0 + e) ? low : high) = d;
    }
    return 0.5 * (low + high);
}

/// Normal force [N] of a contact with overlap `depth` > 0 [m] that grows at `rate` [m/s] and came with
/// `approach`.
inline double calcNormalForce(double depth, double rate, double approach, double damping) {
    return std::max(0.0, kStiffness * depth * (1.0 + damping * rate / std::max(approach, kLeastApproach)));
}

/// Friction force over normal force and slip speed `slip` [s/m]: Coulomb's law, linear below kSlipScale;
/// static friction up to ten times that, kinetic from there on.
inline double calcFrictionRatio(double slip, const SurfaceLaw& law) {
    const double kinetic = std::clamp((slip / kSlipScale - 1.0) / 9.0, 0.0, 1.0);
    const double friction = law.staticFriction + (law.kineticFriction - law.staticFriction) * kinetic;
    return friction / std::max(slip, kSlipScale);
}

}  // namespace trapwright::contact
