#include "core/part/rotation_group.h"

#include <algorithm>
#include <cmath>

namespace trapwright::part {

namespace {

using base::Quaternion;

constexpr std::size_t kLargestGroup = 60;
// Two elements of a group of at most 60 are at least 6 degrees apart; generators come with errors of some
// tenths.
constexpr double kSameRotation = 2.0 * base::kDegree;

/// q and -q are one rotation: the one with w >= 0 stands for both.
Quaternion canonical(const Quaternion& q) {
    Quaternion result = q.normalized();
    if (result.w() < 0.0) result.coeffs() = -result.coeffs();
    return result;
}

/// How often a rotation must be applied to get back to the start.
int calcOrder(const Quaternion& rotation) {
    const double angle = calcAngleBetween(Quaternion::Identity(), rotation);
    if (angle < kSameRotation) return 1;
    Quaternion power = rotation;
    int order = 1;
    while (calcAngleBetween(Quaternion::Identity(), power) > kSameRotation &&
           order < static_cast<int>(kLargestGroup)) {
        power = power * rotation;
        ++order;
    }
    return order;
}

}  // namespace

double calcAngleBetween(const Quaternion& a, const Quaternion& b) {
    return a.angularDistance(b);
}

bool hasRotation(const std::vector<Quaternion>& group, const Quaternion& rotation, double tolerance) {
    return std::any_of(group.begin(), group.end(), [&](const Quaternion& element) {
        return calcAngleBetween(element, rotation) <= tolerance;
    });
}

std::optional<std::vector<Quaternion>> extendGroup(const std::vector<Quaternion>& group,
                                                   const Quaternion& rotation) {
    std::vector<Quaternion> elements = group;
    std::vector<Quaternion> generators(group.begin() + 1, group.end());
    generators.push_back(rotation);
    // Every product of an element with a generator, including the elements added on the way.
    for (std::size_t i = 0; i < elements.size(); ++i) {
        for (const Quaternion& generator : generators) {
            const Quaternion product = canonical(generator * elements[i]);
            if (hasRotation(elements, product, kSameRotation)) continue;
            if (elements.size() == kLargestGroup) return std::nullopt;
            elements.push_back(product);
        }
    }
    return elements;
}

std::string nameGroup(const std::vector<Quaternion>& group) {
    const std::size_t size = group.size();
    int largest = 1;
    for (const Quaternion& element : group)
        largest = std::max(largest, calcOrder(element));
    if (size == 12 && largest == 3) return "T";
    if (size == 24 && largest == 4) return "O";
    if (size == 60 && largest == 5) return "I";
    if (static_cast<std::size_t>(largest) == size) return "C" + std::to_string(size);
    return "D" + std::to_string(size / 2);
}

}  // namespace trapwright::part
