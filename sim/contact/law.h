#pragma once

#include <algorithm>
#include <cmath>

#include "core/trial/contact.h"

/// The contact law's continuous form, and what both forms are told. The discrete form is in formulas/.
/// Derivations and sources: README.md of this folder.
namespace trapwright::contact {

// The continuous form.

/// Stiffness of one contact. A plastic corner of 0.15 mm radius hit at 0.1 m/s by 0.1 g is in contact for
/// 0.16 ms (Hertz), as a linear spring of this stiffness would be. [N/m]
inline constexpr double kStiffness = 4e4;
/// Slip at which friction is fully developed: what sticks creeps more slowly than this. [m/s]
inline constexpr double kSlipScale = 1e-4;
/// The approach speed that damping refers to is at least this. [m/s]
inline constexpr double kLeastApproach = 0.003;

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
inline double calcFrictionRatio(double slip, const trial::ContactParameters& law) {
    const double kinetic = std::clamp((slip / kSlipScale - 1.0) / 9.0, 0.0, 1.0);
    const double friction = law.staticFriction + (law.kineticFriction - law.staticFriction) * kinetic;
    return friction / std::max(slip, kSlipScale);
}

}  // namespace trapwright::contact
