#pragma once

#include "core/part/part.h"

namespace trapwright::testing {

inline part::SymmetryGroup makeC1() {
    return {};
}

/// The cuboid's: half turns about the three axes.
inline part::SymmetryGroup makeD2() {
    part::SymmetryGroup group;
    group.name = "D2";
    group.rotations = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    return group;
}

/// n-fold about z.
inline part::SymmetryGroup makeCn(int n) {
    part::SymmetryGroup group;
    group.name = "C" + std::to_string(n);
    group.rotations.clear();
    for (int k = 0; k < n; ++k) {
        const double half = base::kPi * k / n;
        group.rotations.emplace_back(std::cos(half), 0.0, 0.0, std::sin(half));
    }
    return group;
}

inline part::SymmetryGroup makeContinuous(bool flip) {
    part::SymmetryGroup group;
    group.name = flip ? "Dinf" : "Cinf";
    group.continuous = true;
    group.axis = base::Vec3(1.0, 2.0, 2.0) / 3.0;
    group.flip = flip;
    return group;
}

inline part::SymmetryGroup makeSphere() {
    part::SymmetryGroup group;
    group.name = "SO3";
    group.sphere = true;
    return group;
}

}  // namespace trapwright::testing
