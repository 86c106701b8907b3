#include "sim/contact/roughness.h"

#include <cmath>
#include <cstdint>

namespace trapwright::contact {

using base::Vec3;

namespace {

/// Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014), its finaliser.
std::uint64_t mix(std::uint64_t bits) {
    bits += 0x9E3779B97F4A7C15U;
    bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBU;
    return bits ^ (bits >> 31U);
}

/// Uniform in [0, 1).
double share(std::uint64_t bits) {
    constexpr int kFraction = 53;
    return std::ldexp(static_cast<double>(bits >> (64 - kFraction)), -kFraction);
}

}  // namespace

Vec3 tiltNormal(const trial::ContactParameters& law, const Vec3& point, const Vec3& normal) {
    if (!(law.roughness > 0.0)) return normal;
    std::uint64_t bits = law.surface;
    for (int axis = 0; axis < 3; ++axis)
        bits = mix(bits ^ static_cast<std::uint64_t>(std::llround(point[axis] / kGrain)));
    const double angle = law.roughness * std::sqrt(share(bits));
    const double around = 2.0 * base::kPi * share(mix(bits));
    // From the axis that the normal lies along least.
    Eigen::Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 across = normal.cross(Vec3::Unit(least)).normalized();
    const Vec3 aside = std::cos(around) * across + std::sin(around) * normal.cross(across);
    return std::cos(angle) * normal + std::sin(angle) * aside;
}

}  // namespace trapwright::contact
