#pragma once

#include <QtTest>
#include <vector>

#include "core/base/random.h"
#include "core/part/part.h"

Q_DECLARE_METATYPE(trapwright::part::SymmetryGroup)

/// Symmetry groups, and rotations to try them with.
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

/// A row of every kind of group, in the column "group".
inline void addGroups() {
    QTest::addColumn<part::SymmetryGroup>("group");
    QTest::newRow("C1") << makeC1();
    QTest::newRow("D2") << makeD2();
    QTest::newRow("C5") << makeCn(5);
    QTest::newRow("Cinf") << makeContinuous(false);
    QTest::newRow("Dinf") << makeContinuous(true);
    QTest::newRow("SO3") << makeSphere();
}

inline std::vector<base::Quaternion> drawRotations(std::uint64_t seed, int count) {
    base::Random random({seed, 0, 0, 0, base::Purpose::test});
    std::vector<base::Quaternion> rotations;
    rotations.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rotations.push_back(random.rotation());
    return rotations;
}

inline base::Quaternion turn(double degrees, const base::Vec3& axis) {
    return base::Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

}  // namespace trapwright::testing
