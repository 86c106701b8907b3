#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/part/part.h"
#include "core/trial/orientations.h"
#include "core/trial/outcome.h"

namespace trapwright::trial {

/// An orientation in which parts may end.
struct GoalOrientation {
    base::Quaternion rotation = base::Quaternion::Identity();  // part frame to the track's tangent frame
    bool anyHeading = false;                                   // also turned about the vertical
    /// How far it may also be turned about the conveying direction, to either side: in a groove it lies on
    /// one of two walls. Below 90 degrees. [rad]
    double lean = 0.0;
};

/// What counts as success (decisions.md#wanted-orientation): a part that finishes within the tolerance of any
/// of these orientations, modulo its symmetry. Where nothing is wanted, the one in which most parts finish.
struct Goal {
    std::vector<GoalOrientation> orientations = {GoalOrientation{}};  // at least one

    /// The one to show people who can be shown only one: the first.
    [[nodiscard]] const base::Quaternion& shown() const { return orientations.front().rotation; }
    /// Whether shown() is all of it.
    [[nodiscard]] bool isOneOrientation() const {
        const GoalOrientation& first = orientations.front();
        return orientations.size() == 1 && !first.anyHeading && first.lean == 0.0;
    }
};

/// Bit for bit.
bool operator==(const Goal& a, const Goal& b);

/// This orientation alone.
Goal makeGoal(const base::Quaternion& orientation);

/// What counts for these outcomes: what is wanted, or their mode (findModalOrientation) if nothing is.
Goal findGoal(const std::optional<Goal>& wanted, std::span<const Outcome> outcomes,
              const part::SymmetryGroup& symmetry, double tolerance);

/// The least angle that turns a part so that it lies as in `lying`, whatever its heading, modulo its
/// symmetry: the angle between the two vertical directions in the part frame. In [0, pi]. [rad]
double calcTiltAngle(const base::Quaternion& orientation, const base::Quaternion& lying,
                     const part::SymmetryGroup& symmetry);

/// How far an orientation is from the nearest one of the goal, modulo the part's symmetry. In [0, pi]. [rad]
double calcAngleToGoal(const base::Quaternion& orientation, const Goal& goal,
                       const part::SymmetryGroup& symmetry);

/// Success: finished within `tolerance` [rad] of the goal.
Verdict judge(const PartOutcome& outcome, const Goal& goal, const part::SymmetryGroup& symmetry,
              double tolerance);

/// What all these parts count as.
Tally tally(std::span<const Outcome> outcomes, const Goal& goal, const part::SymmetryGroup& symmetry,
            double tolerance);

}  // namespace trapwright::trial
