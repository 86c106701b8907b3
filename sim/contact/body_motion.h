#pragma once

#include "core/base/math.h"

// Simbody's headers are no C++20: what they are compiled with keeps to C++17, as this does.

namespace trapwright::contact {

/// Velocity of the centre of mass and angular velocity, or the impulses that change them. Room axes.
struct BodyMotion {
    base::Vec3 velocity = base::Vec3::Zero();         // [m/s]
    base::Vec3 angularVelocity = base::Vec3::Zero();  // [rad/s]

    [[nodiscard]] base::Vec3 at(const base::Vec3& arm) const { return velocity + angularVelocity.cross(arm); }
};

/// A part's inverse inertia in room axes.
struct BodyInertia {
    double inverseMass;         // [1/kg]
    base::Mat3 inverseInertia;  // about the centre of mass [1/(kg m^2)]
};

/// What a step does to a part.
struct StepResult {
    BodyMotion motion;   // after the step's impulses
    BodyMotion advance;  // moves the pose over the step: an impact happens inside it
    int carrying = 0;    // contacts with an impulse
};

}  // namespace trapwright::contact
