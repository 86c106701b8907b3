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
/// `slipBefore`: at its begin; `bound`: the change that the full friction impulse makes. A contact that can hold
/// sticks exactly; one that slides has the full impulse against its slip. Where the track carries the slip through zero
/// and on within the step, friction acts against the old direction first and against the new one after:
/// at 50 Hz and 0.2 ms the new direction alone would convey up to 20 % too fast.
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

/// Damping ratio of the linear spring-damper whose free rebound from contact has ratio `restitution`:
/// e = exp(-pi zeta / sqrt(1 - zeta^2)); critical for 0.
inline double calcDampingRatio(double restitution) {
    if (restitution <= 0.0) return 1.0;
    const double l = std::log(restitution);
    return -l / std::sqrt(base::kPi * base::kPi + l * l);
}

}  // namespace trapwright::contact
