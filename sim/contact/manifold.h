#pragma once

#include <span>

#include "sim/contact/manifold_point.h"

namespace trapwright::contact {

/// Puts into `kept` the indices of contacts that stand for all of them, in order, and returns how many: of
/// contacts that say the same (same normal, same place) the lowest; if these are more than `kept` holds, of
/// contacts with the same normal (a face lying on a plane) the lowest and those that span the widest figure.
int reduceManifold(std::span<const ManifoldPoint> points, std::span<int> kept);

}  // namespace trapwright::contact
