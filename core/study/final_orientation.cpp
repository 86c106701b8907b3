#include "core/study/final_orientation.h"

#include <algorithm>

#include "core/trial/fitness.h"

namespace trapwright::study {

std::vector<base::Quaternion> finalOrientations(std::span<const trial::Outcome> outcomes) {
    std::vector<base::Quaternion> orientations;
    for (const trial::Outcome& outcome : outcomes) {
        if (outcome.ending == trial::Ending::finished) orientations.push_back(outcome.farthest.rotation);
    }
    return orientations;
}

bool isOriented(const trial::Outcome& outcome, const base::Quaternion& expected,
                const part::SymmetryGroup& symmetry, double tolerance) {
    return outcome.ending == trial::Ending::finished &&
           trial::calcOrientationAngle(outcome.farthest.rotation, expected, symmetry,
                                       trial::OrientationDistance::symmetric) <= tolerance;
}

int countOriented(std::span<const trial::Outcome> outcomes, const base::Quaternion& expected,
                  const part::SymmetryGroup& symmetry, double tolerance) {
    return static_cast<int>(std::count_if(
        outcomes.begin(), outcomes.end(),
        [&](const trial::Outcome& outcome) { return isOriented(outcome, expected, symmetry, tolerance); }));
}

}  // namespace trapwright::study
