#include <vector>

#include "core/trial/fitness.h"
#include "core/trial/orientation_metric.h"

namespace trapwright::trial {

base::Quaternion findModalOrientation(std::span<const base::Quaternion> orientations,
                                      const part::SymmetryGroup& symmetry, double tolerance) {
    const std::size_t count = orientations.size();
    if (count == 0) return base::Quaternion::Identity();

    const OrientationMetric metric(orientations, symmetry, OrientationDistance::symmetric);
    std::vector<int> neighbours(count, 0);
    for (std::size_t j = 0; j + 1 < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k) {
            if (metric.angle(j, k) <= tolerance) {
                ++neighbours[j];
                ++neighbours[k];
            }
        }
    }
    std::size_t mode = 0;
    for (std::size_t j = 1; j < count; ++j) {
        if (neighbours[j] > neighbours[mode]) mode = j;
    }

    // The chordal mean: quaternions on one side of the sphere, added and normalised.
    const base::Quaternion centre = orientations[mode].normalized();
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < count; ++k) {
        if (k == mode || metric.angle(mode, k) <= tolerance) {
            sum += findNearestCopy(orientations[k].normalized(), centre, symmetry).coeffs();
        }
    }
    base::Quaternion mean;
    mean.coeffs() = sum.normalized();
    return mean;
}

}  // namespace trapwright::trial
