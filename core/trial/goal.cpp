#include "core/trial/goal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trapwright::trial {

namespace {

base::Vec3 verticalInPart(const base::Quaternion& orientation) {
    return (orientation.normalized().conjugate() * base::Vec3::UnitZ()).normalized();
}

double angleBetween(const base::Vec3& a, const base::Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The nearest place to a direction on an arc through z across the track, of so much to either side, as an
/// angle about the conveying direction.
double nearestLean(const base::Vec3& direction, double lean) {
    return std::clamp(std::atan2(-direction.y(), direction.z()), -lean, lean);
}

base::Vec3 leaningVertical(double lean) {
    return {0.0, -std::sin(lean), std::cos(lean)};
}

/// calcTiltAngle of parts that may lean.
double calcTiltBesideLean(const base::Quaternion& orientation, const GoalOrientation& goal,
                          const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return 0.0;
    const base::Vec3 wanted = verticalInPart(goal.rotation);
    if (symmetry.continuous) {
        // The wanted vertical may be anywhere around the axis: the verticals on the arc are at angles to it
        // of which the least and the greatest are at the arc's ends or where the axis is above it.
        const base::Vec3 axis = (orientation * symmetry.axis).normalized();
        double low = base::kPi;
        double high = 0.0;
        for (const double lean :
             {-goal.lean, goal.lean, nearestLean(axis, goal.lean), nearestLean(-axis, goal.lean)}) {
            const double angle = angleBetween(leaningVertical(lean), axis);
            low = std::min(low, angle);
            high = std::max(high, angle);
        }
        const auto outside = [&](double angle) { return std::max({0.0, low - angle, angle - high}); };
        const double fromAxis = angleBetween(wanted, symmetry.axis);
        return symmetry.flip ? std::min(outside(fromAxis), outside(base::kPi - fromAxis)) : outside(fromAxis);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const base::Quaternion& g : symmetry.rotations) {
        const base::Vec3 vertical = orientation * (g * wanted);
        least = std::min(least, angleBetween(vertical, leaningVertical(nearestLean(vertical, goal.lean))));
    }
    return least;
}

/// calcOrientationAngle of parts that may lean.
double calcAngleBesideLean(const base::Quaternion& orientation, const GoalOrientation& goal,
                           const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return 0.0;
    if (symmetry.continuous) {
        const base::Vec3 axis = (orientation * symmetry.axis).normalized();
        const auto angleTo = [&](const base::Vec3& wanted) {
            const double around = std::remainder(
                std::atan2(axis.z(), axis.y()) - std::atan2(wanted.z(), wanted.y()), 2.0 * base::kPi);
            const Eigen::AngleAxisd leaning(std::clamp(around, -goal.lean, goal.lean), base::Vec3::UnitX());
            return angleBetween(axis, leaning * wanted);
        };
        const base::Vec3 wanted = (goal.rotation * symmetry.axis).normalized();
        return symmetry.flip ? std::min(angleTo(wanted), angleTo(-wanted)) : angleTo(wanted);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const base::Quaternion& g : symmetry.rotations) {
        base::Quaternion turned = (orientation * g * goal.rotation.conjugate()).normalized();
        if (turned.w() < 0.0) turned.coeffs() = -turned.coeffs();
        // What of it is a turn about the conveying direction ("twist").
        const double lean = std::clamp(2.0 * std::atan2(turned.x(), turned.w()), -goal.lean, goal.lean);
        const base::Quaternion left = Eigen::AngleAxisd(-lean, base::Vec3::UnitX()) * turned;
        least = std::min(least, 2.0 * std::atan2(left.vec().norm(), std::abs(left.w())));
    }
    return least;
}

double calcAngleTo(const GoalOrientation& goal, const base::Quaternion& orientation,
                   const part::SymmetryGroup& symmetry) {
    if (goal.lean > 0.0)
        return goal.anyHeading ? calcTiltBesideLean(orientation, goal, symmetry)
                               : calcAngleBesideLean(orientation, goal, symmetry);
    return goal.anyHeading
               ? calcTiltAngle(orientation, goal.rotation, symmetry)
               : calcOrientationAngle(orientation, goal.rotation, symmetry, OrientationDistance::symmetric);
}

}  // namespace

bool operator==(const Goal& a, const Goal& b) {
    return std::ranges::equal(a.orientations, b.orientations,
                              [](const GoalOrientation& one, const GoalOrientation& other) {
                                  return one.anyHeading == other.anyHeading && one.lean == other.lean &&
                                         one.rotation.coeffs() == other.rotation.coeffs();
                              });
}

Goal makeGoal(const base::Quaternion& orientation) {
    return {{GoalOrientation{orientation, false}}};
}

Goal findGoal(const std::optional<Goal>& wanted, std::span<const Outcome> outcomes,
              const part::SymmetryGroup& symmetry, double tolerance) {
    return wanted ? *wanted
                  : makeGoal(findModalOrientation(finalOrientations(outcomes), symmetry, tolerance));
}

double calcTiltAngle(const base::Quaternion& orientation, const base::Quaternion& lying,
                     const part::SymmetryGroup& symmetry) {
    if (symmetry.sphere) return 0.0;
    const base::Vec3 a = verticalInPart(orientation);
    const base::Vec3 b = verticalInPart(lying);
    if (symmetry.continuous) {
        // Turning about the axis takes the vertical around it: the angles to the axis are all that differs.
        const double fromAxis = angleBetween(a, symmetry.axis);
        const double wanted = angleBetween(b, symmetry.axis);
        const double angle = std::abs(fromAxis - wanted);
        return symmetry.flip ? std::min(angle, std::abs(base::kPi - fromAxis - wanted)) : angle;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const base::Quaternion& g : symmetry.rotations)
        least = std::min(least, angleBetween(g * a, b));
    return least;
}

double calcAngleToGoal(const base::Quaternion& orientation, const Goal& goal,
                       const part::SymmetryGroup& symmetry) {
    double least = std::numeric_limits<double>::infinity();
    for (const GoalOrientation& one : goal.orientations)
        least = std::min(least, calcAngleTo(one, orientation, symmetry));
    return least;
}

Verdict judge(const PartOutcome& outcome, const Goal& goal, const part::SymmetryGroup& symmetry,
              double tolerance) {
    switch (outcome.ending) {
        case Ending::finished:
            break;
        case Ending::fellOff:
            return Verdict::fellOff;
        case Ending::stuck:
        case Ending::timedOut:
            return Verdict::stuck;
    }
    return calcAngleToGoal(outcome.farthest.rotation, goal, symmetry) <= tolerance
               ? Verdict::success
               : Verdict::wrongOrientation;
}

Tally tally(std::span<const Outcome> outcomes, const Goal& goal, const part::SymmetryGroup& symmetry,
            double tolerance) {
    Tally counts;
    for (const Outcome& outcome : outcomes) {
        for (const PartOutcome& part : outcome.parts)
            counts.add(judge(part, goal, symmetry, tolerance));
    }
    return counts;
}

}  // namespace trapwright::trial
