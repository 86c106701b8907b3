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

}  // namespace

bool operator==(const Goal& a, const Goal& b) {
    return std::ranges::equal(
        a.orientations, b.orientations, [](const GoalOrientation& one, const GoalOrientation& other) {
            return one.anyHeading == other.anyHeading && one.rotation.coeffs() == other.rotation.coeffs();
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
    for (const GoalOrientation& one : goal.orientations) {
        const double angle = one.anyHeading ? calcTiltAngle(orientation, one.rotation, symmetry)
                                            : calcOrientationAngle(orientation, one.rotation, symmetry,
                                                                   OrientationDistance::symmetric);
        least = std::min(least, angle);
    }
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
