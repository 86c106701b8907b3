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

/// Coulomb's cone: shortens the tangential impulse or force `tangential` to at most `bound`. Returns true if
/// it had to, that is, if the contact slides.
inline bool clampToDisc(base::Vec2& tangential, double bound) {
    const double square = tangential.squaredNorm();
    if (square <= bound * bound) return false;
    tangential *= bound / std::sqrt(square);
    return true;
}

/// Damping ratio of the linear spring-damper whose free rebound from contact has ratio `restitution`:
/// e = exp(-pi zeta / sqrt(1 - zeta^2)); critical for 0.
inline double calcDampingRatio(double restitution) {
    if (restitution <= 0.0) return 1.0;
    const double l = std::log(restitution);
    return -l / std::sqrt(base::kPi * base::kPi + l * l);
}

}  // namespace trapwright::contact
