#include "core/trial/orientations.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trapwright::trial {

namespace {

constexpr std::array<std::string_view, 4> kVerdictNames = {"success", "wrong-orientation", "stuck",
                                                           "fell-off"};

Eigen::Vector4d toVector(const base::Quaternion& q) {
    return q.normalized().coeffs();
}

// The angle between the rotations of unit quaternions a and b, dot = |a . b|. The arc cosine loses half the
// digits near 0, where the square root of Eq. 5 would show it; there the chord is used.
double rotationAngle(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double dot) {
    if (dot < 0.99) return 2.0 * std::acos(dot);
    const double chord = std::min((a - b).norm(), (a + b).norm());
    return 4.0 * std::asin(0.5 * chord);
}

}  // namespace

OrientationMetric::OrientationMetric(std::span<const base::Quaternion> orientations,
                                     const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    const bool plain = distance == OrientationDistance::plain;
    if (!plain && symmetry.sphere) {
        kind_ = Kind::nothing;
        return;
    }
    if (!plain && symmetry.continuous) {
        kind_ = symmetry.flip ? Kind::line : Kind::axis;
        axes_.reserve(orientations.size());
        for (const auto& q : orientations)
            axes_.push_back((q.normalized() * symmetry.axis).normalized());
        return;
    }
    static const std::vector<base::Quaternion> kNoSymmetry = {base::Quaternion::Identity()};
    const auto& group = plain ? kNoSymmetry : symmetry.rotations;
    copiesPerOrientation_ = group.size();
    orientations_.reserve(orientations.size());
    copies_.reserve(orientations.size() * group.size());
    for (const auto& q : orientations) {
        orientations_.push_back(toVector(q));
        // The identity's copy must be the orientation itself, so that equal orientations are 0 apart.
        for (const auto& g : group) {
            const bool identity = g.coeffs() == base::Quaternion::Identity().coeffs();
            copies_.push_back(identity ? orientations_.back() : toVector(q.normalized() * g));
        }
    }
}

double OrientationMetric::angle(std::size_t j, std::size_t k) const {
    switch (kind_) {
        case Kind::nothing:
            return 0.0;
        case Kind::axis:
        case Kind::line: {
            const double cosine = axes_[j].dot(axes_[k]);
            const double sine = axes_[j].cross(axes_[k]).norm();
            return std::atan2(sine, kind_ == Kind::line ? std::abs(cosine) : cosine);
        }
        case Kind::finite:
            break;
    }
    const Eigen::Vector4d& a = orientations_[j];
    const Eigen::Vector4d* copies = &copies_[k * copiesPerOrientation_];
    std::size_t nearest = 0;
    double dot = -1.0;
    for (std::size_t g = 0; g < copiesPerOrientation_; ++g) {
        const double candidate = std::abs(a.dot(copies[g]));
        if (candidate > dot) {
            dot = candidate;
            nearest = g;
        }
    }
    return rotationAngle(a, copies[nearest], dot);
}

base::Quaternion makeFlip(const base::Vec3& axis) {
    const base::Vec3 perpendicular = axis.unitOrthogonal();
    return {0.0, perpendicular.x(), perpendicular.y(), perpendicular.z()};
}

base::Quaternion findNearestCopy(const base::Quaternion& orientation, const base::Quaternion& reference,
                                 const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return reference;
    std::vector<base::Quaternion> candidates;
    if (symmetry.continuous) {
        candidates.push_back(orientation);
        if (symmetry.flip) candidates.push_back(orientation * makeFlip(symmetry.axis));
        for (auto& candidate : candidates) {
            // Of the rotation that is missing, take what the axis can give.
            const base::Quaternion missing = candidate.conjugate() * reference;
            const double along = missing.vec().dot(symmetry.axis);
            const base::Vec3 part = along * symmetry.axis;
            const base::Quaternion twist(missing.w(), part.x(), part.y(), part.z());
            if (twist.norm() > 0.0) candidate = candidate * twist.normalized();
        }
    } else {
        for (const auto& g : symmetry.rotations)
            candidates.push_back(orientation * g);
    }
    base::Quaternion nearest = candidates.front();
    for (const auto& candidate : candidates) {
        if (std::abs(candidate.dot(reference)) > std::abs(nearest.dot(reference))) nearest = candidate;
    }
    if (nearest.dot(reference) < 0.0) nearest.coeffs() = -nearest.coeffs();
    return nearest;
}

double calcOrientationAngle(const base::Quaternion& a, const base::Quaternion& b,
                            const part::SymmetryGroup& symmetry, OrientationDistance distance) {
    const std::array both = {a, b};
    return OrientationMetric(both, symmetry, distance).angle(0, 1);
}

std::vector<base::Quaternion> finalOrientations(std::span<const Outcome> outcomes) {
    std::vector<base::Quaternion> orientations;
    for (const Outcome& outcome : outcomes) {
        for (const PartOutcome& part : outcome.parts)
            if (part.ending == Ending::finished) orientations.push_back(part.farthest.rotation);
    }
    return orientations;
}

std::string_view verdictName(Verdict verdict) {
    return kVerdictNames[static_cast<std::size_t>(verdict)];
}

std::optional<Verdict> findVerdict(std::string_view name) {
    const auto found = std::ranges::find(kVerdictNames, name);
    if (found == kVerdictNames.end()) return std::nullopt;
    return static_cast<Verdict>(found - kVerdictNames.begin());
}

void Tally::add(Verdict verdict) {
    switch (verdict) {
        case Verdict::success:
            ++success;
            return;
        case Verdict::wrongOrientation:
            ++wrongOrientation;
            return;
        case Verdict::stuck:
            ++stuck;
            return;
        case Verdict::fellOff:
            ++fellOff;
            return;
    }
}

Tally& Tally::operator+=(const Tally& other) {
    success += other.success;
    wrongOrientation += other.wrongOrientation;
    stuck += other.stuck;
    fellOff += other.fellOff;
    return *this;
}

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
