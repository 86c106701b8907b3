#include "core/trial/fitness.h"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/trial/orientation_metric.h"

namespace trapwright::trial {

double calcOrientationAngle(const base::Quaternion& a, const base::Quaternion& b,
                            const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    const std::array both = {a, b};
    return OrientationMetric(both, symmetry, distance).angle(0, 1);
}

double calcConcentration(std::span<const base::Quaternion> orientations, const part::SymmetryGroup& symmetry,
                         OrientationDistance distance) {
    const std::size_t count = orientations.size();
    if (count < 2) return 0.0;
    const OrientationMetric metric(orientations, symmetry, distance);
    double sum = 0.0;
    for (std::size_t j = 0; j + 1 < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k)
            sum += std::sqrt(metric.angle(j, k));
    }
    const double n = static_cast<double>(count);
    return -2.0 / (n * n - n) * sum;
}

Fitness calcFitness(const track::Track& track, std::span<const Outcome> outcomes, int overlaps,
                    const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    assert(!outcomes.empty());
    std::vector<base::Quaternion> initial;
    std::vector<base::Quaternion> farthest;
    double segments = 0.0;
    for (const Outcome& outcome : outcomes) {
        initial.push_back(outcome.initial.rotation);
        farthest.push_back(outcome.farthest.rotation);
        if (outcome.ending != Ending::finished) {
            segments += track::segmentsToFinish(track, outcome.farthest.position.x());
        }
    }
    Fitness fitness;
    fitness.collision = -static_cast<double>(overlaps);
    fitness.distance = -segments / static_cast<double>(outcomes.size());
    fitness.orientation =
        calcConcentration(farthest, symmetry, distance) - calcConcentration(initial, symmetry, distance);
    return fitness;
}

Fitness calcUnsimulatedFitness(const track::Track& track, int overlaps) {
    Fitness fitness;
    fitness.collision = -static_cast<double>(overlaps);
    fitness.distance = -track::segmentsToFinish(track, track.start);
    fitness.orientation = -std::sqrt(base::kPi);
    return fitness;
}

}  // namespace trapwright::trial
