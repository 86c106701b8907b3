#pragma once

#include "core/base/math.h"

namespace trapwright::trial {

/// What the track does to the part at one contact.
struct ContactForce {
    base::Vec3 point;  // in the frame of the track's mesh [m]
    base::Vec3 force;  // on the part, in the axes of that frame [N]
};

}  // namespace trapwright::trial
