#include <cmath>

#include "core/trial/fitness.h"
#include "core/trial/orientation_metric.h"

namespace trapwright::trial {

namespace {

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

double calcBestOrientationScore(const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    if (distance == OrientationDistance::symmetric) return calcRandomSymmetric(symmetry);
    return calcRandomPlain() - calcIndistinguishablePlain(symmetry);
}

}  // namespace trapwright::trial
