#pragma once

// Simbody's headers are no C++20: what they are compiled with keeps to C++17, as this does.

namespace trapwright::trial {

/// The material pair. Values and their sources are in resources/materials.
struct ContactParameters {
    double staticFriction = 0.5;
    double kineticFriction = 0.5;
    double restitution = 0.2;
};

}  // namespace trapwright::trial
