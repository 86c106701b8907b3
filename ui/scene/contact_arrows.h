#pragma once

#include "core/part/part.h"

namespace trapwright::scene {

/// How long the arrow of a force [N] on this part is: a bounding radius at the part's weight, and from there
/// with the square root, because impacts are a hundred times the weight; never beyond six radii. 0 for no
/// force. [m]
double arrowLength(const part::Part& part, double force);

}  // namespace trapwright::scene
