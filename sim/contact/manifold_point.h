#pragma once

#include "core/base/math.h"

namespace trapwright::contact {

/// What thinning out looks at of a contact.
struct ManifoldPoint {
    base::Vec3 arm;     // [m]
    base::Vec3 normal;  // unit
    double gap;         // [m]
};

}  // namespace trapwright::contact
