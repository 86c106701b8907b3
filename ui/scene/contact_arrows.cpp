#include "ui/scene/contact_arrows.h"

#include <algorithm>
#include <cmath>

namespace trapwright::scene {

namespace {

constexpr double kLongest = 6.0;  // in bounding radii

}  // namespace

double arrowLength(const part::Part& part, double force) {
    const double weight = part.massProperties.mass * base::kStandardGravity;
    if (force <= 0.0 || weight <= 0.0) return 0.0;
    return part.boundingRadius * std::min(std::sqrt(force / weight), kLongest);
}

}  // namespace trapwright::scene
