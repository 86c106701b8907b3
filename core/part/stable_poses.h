#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/part/part.h"

namespace trapwright::part {

/// Solid angle of a polytope's face seen from the origin, which must be inside, as a share of the whole
/// sphere.
double calcSolidAngleShare(const geometry::ConvexPolytope& hull, std::size_t face);

/// The orientations in which a part rests, with quasi-static probabilities: a part dropped in a random
/// orientation lands on the hull face that is below its centre of mass, so that each face has the share of
/// its solid angle (Boothroyd, Poli, Murch 1982); from a face that does not hold the centre of mass it rolls
/// over the edge that the centre of mass is farthest beyond, on and on until one does (Wiegley, Goldberg,
/// Peshkin, Brokowski 1996).
///
/// `hull` has its origin at the centre of mass. Most probable pose first; the probabilities sum to 1.
/// One pose per resting face, so a cuboid has six; but facets that stand for a round surface are one pose:
/// those around the axis of a continuous group, and neighbours so alike that the part rolls across with
/// hardly any lift. With mergeAlike, faces that the symmetry group maps onto each other are one pose too, and
/// multiplicity counts them.
std::vector<StablePose> computeStablePoses(const geometry::ConvexPolytope& hull,
                                           const SymmetryGroup& symmetry, bool mergeAlike);

/// Stable poses that nobody can tell apart, because the part's symmetry maps them onto each other.
struct PoseGroup {
    std::vector<int> poses;    // indices into Part::stablePoses, rising
    double probability = 0.0;  // of landing in any of them
};

/// The part's stable poses as groups of alike ones, most probable group first; every pose is in one group.
/// With Part::symmetry switched off each pose is a group of its own.
std::vector<PoseGroup> findPoseGroups(const Part& part);

/// The group that has the pose; -1 if none has.
int findPoseGroup(const std::vector<PoseGroup>& groups, int pose);

/// What people read for poses, counted from 1: "7", "1-6", "1-3, 5". The indices rise.
std::string namePoses(std::span<const int> poses);

/// A stable pose and how far from it an orientation is.
struct NearestPose {
    std::size_t index = 0;
    double angle = 0.0;  // between the two down directions in the part frame [rad]
};

/// The stable pose nearest to an orientation (part frame to world, z up), whatever the heading. About the
/// axis of a continuous group the part may have turned. The part must have stable poses, as buildPart gives
/// them.
NearestPose findStablePose(const Part& part, const base::Quaternion& orientation);

/// The orientation, turned no farther than it takes to rest in that nearest pose.
base::Quaternion layDown(const Part& part, const base::Quaternion& orientation);

/// How a part in a pose lies in a groove: along the direction in which it is narrowest across.
struct LengthInPose {
    double length = 0.0;  // [m]
    double offset = 0.0;  // of the centre of mass from the middle of the length, not negative [m]
};

/// The part must be in its frame, as buildPart gives it.
LengthInPose findLength(const Part& part, const StablePose& pose);

/// Of the poses in which the part lands at least one time in ten (the most probable one, if there is none)
/// the one in which the centre of mass is farthest from the middle, as a share of the length: the more, the
/// more easily a track tells which end comes first (learning.md).
LengthInPose findUnevenLength(const Part& part);

/// How a part hangs between two rails (decisions.md#rails): its axis upright, that of its symmetry, or else
/// the longest one, of the least inertia, and all of where it is widest about that above its centre of mass.
/// None of a part that is not so, as one that is as wide at either end: it would tip over.
std::optional<base::Quaternion> findHanging(const Part& part);

}  // namespace trapwright::part
