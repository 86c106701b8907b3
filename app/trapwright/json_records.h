#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "core/part/stable_poses.h"
#include "core/stats/stratified.h"
#include "core/study/records.h"
#include "core/study/robustness.h"
#include "core/trial/remade_trials.h"

namespace trapwright::app {

/// Records as --json shows them. Angles in degrees, quaternions [w, x, y, z]; shares with their bounds.
nlohmann::ordered_json toJson(const base::Quaternion& rotation);
nlohmann::ordered_json toJson(const base::Vec3& vector, double scale);
/// {key: the orientation that is shown}, and with "wanted" all of a goal that is more than that.
nlohmann::ordered_json goalToJson(const char* key, const trial::Goal& goal);
/// F and the scores by their keys, in SI units; not success, which records have with its bounds.
nlohmann::ordered_json toJson(const objectives::Fitness& fitness);
nlohmann::ordered_json toJson(const study::IndividualRecord& record);
nlohmann::ordered_json toJson(const study::GenerationSummary& summary);
/// Differences are the reference's value less the learning engine's.
nlohmann::ordered_json toJson(const std::vector<study::CheckRecord>& records);
nlohmann::ordered_json toJson(const study::SelectionRecord& record);
nlohmann::ordered_json toJson(const study::ValidationRecord& record, const part::Part& part,
                              std::span<const part::PoseGroup> groups);
/// Its stream, and why it was made again.
nlohmann::ordered_json toJson(const trial::RemadeTrial& trial);
/// {"share", "low", "high", "bounds"}; no share where it is not known.
nlohmann::ordered_json toJson(const stats::WeightedRate& weighted,
                              const char* bounds = "95 % profile limits");
/// [{"condition", "slices": [{"low", "high", "trials", "success"}]}], in the units that the keys tell.
nlohmann::ordered_json toJson(std::span<const study::SlicedCondition> conditions);
/// Counted from 1.
nlohmann::ordered_json numbersToJson(std::span<const int> poses);
/// {"count", "share", "low", "high", "bounds"} of `count` successes in `trials`; "bounds" names the interval.
nlohmann::ordered_json shareToJson(int count, int trials);

}  // namespace trapwright::app
