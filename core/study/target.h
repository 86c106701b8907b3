#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/part/stable_poses.h"
#include "core/study/settings.h"
#include "core/trial/goal.h"

namespace trapwright::study {

/// Numbers of stable poses as part::namePoses writes them ("1-3, 5"): indices, rising, none twice. An error
/// that says what is wrong.
base::Result<std::vector<int>> readPoses(std::string_view text);

/// The heading of TargetSettings in [rad]; none: any. An error that says what is wrong.
base::Result<std::optional<double>> readHeading(std::string_view text);

/// What is wrong with the settings by themselves, as findProblems tells it.
std::vector<std::string> findTargetProblems(const Settings& settings);
/// What is wrong with them for this part: poses that it does not have.
std::vector<std::string> findTargetPartProblems(const TargetSettings& target, const part::Part& part);

/// How steep across the track is what parts leave it on: a groove's walls, or a spiral's ledge. [rad]
double findLean(const TrackSettings& track);

/// What counts as success with this part; none: nothing is wanted. The settings must be without problems. Of
/// poses one orientation for each group of alike ones that is named, which may lean by findLean().
std::optional<trial::Goal> findWanted(const Settings& settings, const part::Part& part);

/// The groups of alike stable poses of which one is named; indices into `groups`, rising.
std::vector<int> findWantedGroups(const TargetSettings& target, std::span<const part::PoseGroup> groups);

/// What there is to attain with these settings and this part. An orientation further than the tolerance from
/// every stable pose is not resting.
objectives::Task makeTask(const Settings& settings, const part::Part& part);

/// How parts shall end, for people: "stable pose 3-4 in any heading", "the orientation (w, x, y, z) = ...";
/// "in whatever way most do" if nothing is wanted. How far they may lean is told, too.
std::string describeTarget(const Settings& settings, const part::Part& part);

/// How parts that lie so are to be wanted: the stable pose, alike ones together, and the heading, in whole
/// degrees, that are nearest, leaning as parts may on the settings' track; any heading where it looks the
/// same in each. The part has stable poses.
TargetSettings findNearestTarget(const Settings& settings, const part::Part& part,
                                 const base::Quaternion& orientation);

/// Parts that hang between rails (part::findHanging): the stable pose that they are in then, in any heading,
/// or the orientation, if they have no such pose. Nothing is wanted of a part that would tip over.
TargetSettings findHangingTarget(const part::Part& part);

/// Whether parts that hang so are right, in any heading; not where the settings have problems.
bool wantsHanging(const Settings& settings, const part::Part& part);

/// What counted as success, for people: "the orientation (w, x, y, z) = ...", "stable pose 3-4 in any
/// heading", several with "or" between them.
std::string describeGoal(const trial::Goal& goal, const part::Part& part);

/// A goal as JSON and back: orientations as [w, x, y, z], to the last bit.
std::string goalToJson(const trial::Goal& goal);
base::Result<trial::Goal> goalFromJson(const std::string& text);

}  // namespace trapwright::study
