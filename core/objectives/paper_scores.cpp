#include "core/objectives/paper_scores.h"

#include <cmath>
#include <vector>

#include "core/stats/mean.h"

namespace trapwright::objectives {

using trial::calcOrientationAngle;
using trial::OrientationDistance;

namespace {

Measured measureCollisions(const Evaluation& evaluation) {
    return {-static_cast<double>(evaluation.overlaps)};
}

Measured measureDistance(const Evaluation& evaluation) {
    const track::Track& track = *evaluation.track;
    if (evaluation.outcomes.empty()) return {-track::segmentsToFinish(track, track.start)};
    std::vector<double> left;
    left.reserve(trial::countParts(evaluation.outcomes));
    double segments = 0.0;
    for (const trial::Outcome& outcome : evaluation.outcomes) {
        for (const trial::PartOutcome& part : outcome.parts) {
            const bool finished = part.ending == trial::Ending::finished;
            left.push_back(finished ? 0.0 : track::segmentsToFinish(track, part.farthest.position.x()));
            if (!finished) segments += left.back();
        }
    }
    return {-segments / static_cast<double>(left.size()), stats::calcStandardError(left)};
}

Measured measureOrientation(const Evaluation& evaluation) {
    // Below anything that trials can give: all ends half a turn apart, starts alike.
    if (evaluation.outcomes.empty()) return {-std::sqrt(base::kPi)};
    std::vector<base::Quaternion> initial;
    std::vector<base::Quaternion> farthest;
    for (const trial::Outcome& outcome : evaluation.outcomes) {
        for (const trial::PartOutcome& part : outcome.parts) {
            initial.push_back(part.initial.rotation);
            farthest.push_back(part.farthest.rotation);
        }
    }
    const Concentration ends = calcConcentration(farthest, *evaluation.symmetry, evaluation.distance);
    const Concentration starts = calcConcentration(initial, *evaluation.symmetry, evaluation.distance);
    Measured measured{ends.value - starts.value};
    // A mean over pairs is a U-statistic: its variance is four times that of what one trial adds to it, over
    // the number of trials (Hoeffding 1948).
    std::vector<double> gains(ends.means.size());
    for (std::size_t i = 0; i < gains.size(); ++i)
        gains[i] = ends.means[i] - starts.means[i];
    measured.error = 2.0 * stats::calcStandardError(gains);
    return measured;
}

// The mean of sqrt(t) over angles t in [0, end] of a density, by Simpson's rule in u = sqrt(t), where the
// integrand is smooth: integral of 2 u^2 density(u^2) du.
template <class Density>
double calcMeanRoot(double end, Density density) {
    constexpr int kIntervals = 512;
    const double step = std::sqrt(end) / kIntervals;
    double sum = 0.0;
    for (int i = 0; i <= kIntervals; ++i) {
        const double u = i * step;
        const double weight = (i == 0 || i == kIntervals) ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
        sum += weight * 2.0 * u * u * density(u * u);
    }
    return sum * step / 3.0;
}

// E sqrt(angle) of a uniformly random rotation, whose angle has the density (1 - cos t) / pi.
double calcRandomPlain() {
    return calcMeanRoot(base::kPi, [](double t) { return (1.0 - std::cos(t)) / base::kPi; });
}

// The i-th of a low-discrepancy sequence of rotations: the additive recurrence on the generalised golden
// ratio in three dimensions (Roberts 2018), mapped to the group as Shoemake (1992) maps uniform numbers.
base::Quaternion spreadRotation(int i) {
    constexpr double kRatio = 1.2207440846057596;  // the root of x^4 = x + 1
    const auto fraction = [&](double alpha) {
        const double value = 0.5 + (i + 1) * alpha;
        return value - std::floor(value);
    };
    const double u = fraction(1.0 / kRatio);
    const double a = 2.0 * base::kPi * fraction(1.0 / (kRatio * kRatio));
    const double b = 2.0 * base::kPi * fraction(1.0 / (kRatio * kRatio * kRatio));
    const double r1 = std::sqrt(1.0 - u);
    const double r2 = std::sqrt(u);
    return {r2 * std::cos(b), r1 * std::sin(a), r1 * std::cos(a), r2 * std::sin(b)};
}

// E sqrt(least angle over the group) of a uniformly random rotation. The error of so many spread rotations is
// some 1e-4.
double calcRandomFinite(const part::SymmetryGroup& symmetry) {
    constexpr int kRotations = 1 << 15;
    double sum = 0.0;
    for (int i = 0; i < kRotations; ++i) {
        sum += std::sqrt(calcOrientationAngle(base::Quaternion::Identity(), spreadRotation(i), symmetry,
                                              OrientationDistance::symmetric));
    }
    return sum / kRotations;
}

double calcRandomSymmetric(const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return 0.0;
    // The angle between random axes has the density sin(t) / 2; between lines it is folded at pi / 2.
    if (symmetry.continuous && symmetry.flip)
        return calcMeanRoot(0.5 * base::kPi, [](double t) { return std::sin(t); });
    if (symmetry.continuous) return calcMeanRoot(base::kPi, [](double t) { return 0.5 * std::sin(t); });
    return calcRandomFinite(symmetry);
}

// E sqrt(plain angle) between two of a symmetric part's indistinguishable orientations: what stays apart
// however well a feeder works.
double calcIndistinguishablePlain(const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return calcRandomPlain();
    if (symmetry.continuous) {
        const double aboutAxis = calcMeanRoot(base::kPi, [](double) { return 1.0 / base::kPi; });
        // A turned end is half a turn away, however the part is rotated about its axis.
        return symmetry.flip ? 0.5 * (aboutAxis + std::sqrt(base::kPi)) : aboutAxis;
    }
    double sum = 0.0;
    for (const auto& g : symmetry.rotations) {
        sum += std::sqrt(
            calcOrientationAngle(base::Quaternion::Identity(), g, symmetry, OrientationDistance::plain));
    }
    return sum / static_cast<double>(symmetry.rotations.size());
}

}  // namespace

Objective collisions() {
    Objective objective;
    objective.key = objective.symbol = "F_C";
    objective.name = "Collisions";
    objective.unit = "triangles";
    objective.help = "Minus the number of the surface's triangles that overlap. 0 is best.";
    objective.decimals = 0;
    objective.isNoisy = false;
    objective.isDetail = true;
    objective.measure = &measureCollisions;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

Objective distance() {
    Objective objective;
    objective.key = objective.symbol = "F_D";
    objective.name = "Distance";
    objective.unit = "segments";
    objective.help = "Minus the distance that parts stay short of the finish, on average. 0 is best.";
    objective.isDetail = true;
    objective.measure = &measureDistance;
    objective.attainable = [](const Task&) { return 0.0; };
    return objective;
}

Objective orientation() {
    Objective objective;
    objective.key = objective.symbol = "F_O";
    objective.name = "Orientation";
    objective.unit = "√rad";
    objective.help = "How much more alike the parts lie at the end than at the start. Higher is better.";
    objective.isDetail = true;
    objective.measure = &measureOrientation;
    objective.attainable = [](const Task& task) {
        return calcBestOrientationScore(*task.symmetry, task.distance);
    };
    return objective;
}

Concentration calcConcentration(std::span<const base::Quaternion> orientations,
                                const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    const std::size_t count = orientations.size();
    if (count < 2) return {};
    const trial::OrientationMetric metric(orientations, symmetry, distance);
    std::vector<double> sums(count, 0.0);
    double sum = 0.0;
    for (std::size_t j = 0; j + 1 < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k) {
            const double root = std::sqrt(metric.angle(j, k));
            sum += root;
            sums[j] += root;
            sums[k] += root;
        }
    }
    const double n = static_cast<double>(count);
    for (double& one : sums)
        one /= -(n - 1.0);
    return {-2.0 / (n * n - n) * sum, std::move(sums)};
}

double calcBestOrientationScore(const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    if (distance == OrientationDistance::symmetric) return calcRandomSymmetric(symmetry);
    return calcRandomPlain() - calcIndistinguishablePlain(symmetry);
}

}  // namespace trapwright::objectives
