#pragma once

#include <span>

#include "core/base/math.h"

namespace trapwright::contact {

/// What thinning out looks at of a contact.
struct ManifoldPoint {
    base::Vec3 arm;     // [m]
    base::Vec3 normal;  // unit
    double gap;         // [m]
};

/// Contacts of one plane nearer to each other than this are one. [m]
inline constexpr double kSamePlace = 0.2e-3;
/// Contacts whose normals differ by less belong to one plane. (cosine)
inline constexpr double kSameNormal = 0.9998;

/// Puts into `kept` the indices of contacts that stand for all of them, in order, and returns how many: of
/// contacts that say the same (same normal, same place) the lowest; if these are more than `kept` holds, of
/// contacts with the same normal (a face lying on a plane) the lowest and those that span the widest figure.
int reduceManifold(std::span<const ManifoldPoint> points, std::span<int> kept);

}  // namespace trapwright::contact
