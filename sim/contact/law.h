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

/// Coulomb's cone over one step. `slip`: the slip velocity at the step's end without this contact's friction;
/// `slipBefore`: at its begin; `bound`: the change that the full friction impulse makes. A contact that can
/// hold sticks exactly; one that slides has the full impulse against its slip. Where the track carries the
/// slip through zero and on within the step, friction acts against the old direction first and against the
/// new one after: at 50 Hz and 0.2 ms the new direction alone would convey up to 20 % too fast.
inline Friction calcFriction(const base::Vec2& slip, const base::Vec2& slipBefore, double bound) {
    const double size = slip.norm();
    const double before = slipBefore.norm();
    if (before > 0.01 * bound) {
        const base::Vec2 old = slipBefore / before;
        const double end = slip.dot(old);
        const double loss = before - end;
        if (loss > bound && end < bound) {
            const double share = before / (loss + bound);  // of the step until the slip turns round
            const base::Vec2 other = end < 0.0 ? base::Vec2(slip / size) : base::Vec2(-old);
            return {-bound * (share * old + (1.0 - share) * other), true};
        }
    }
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
