#pragma once

#include <cstdint>

#include "core/base/math.h"

// Simbody's headers are no C++20: what they are compiled with keeps to C++17, as this does.

namespace trapwright::trial {

/// The material pair. Values and their sources are in resources/materials.
struct ContactParameters {
    double staticFriction = 0.5;
    double kineticFriction = 0.5;
    double restitution = 0.2;
    /// A rough surface presses each grain of it in a direction of its own, up to so far off the normal of
    /// what is drawn (decisions.md#roughness). [rad]
    double roughness = 0.0;
    std::uint64_t surface = 0;  // names the rough surface: equal ones are alike in all grains
};

/// A body of a trial: the part of this place in TrialSpec::parts, or the track.
using Body = int;
inline constexpr Body kTrack = -1;

/// What one body does to another at one contact.
struct ContactForce {
    Body bodyA = kTrack;
    Body bodyB = 0;
    base::Vec3 point;  // in the frame of the track's mesh [m]
    base::Vec3 force;  // of A on B, in the axes of that frame [N]
};

}  // namespace trapwright::trial
