#include "core/study/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/spelling.h"
#include "core/study/number_text.h"
#include "core/traps/groove.h"
#include "core/traps/trap_chain.h"

namespace trapwright::study {

namespace {

constexpr std::string_view kAny = "any";
constexpr std::string_view kInAnyHeading = " in any heading";
constexpr double kSame = 0.5 * base::kDegree;
constexpr int kMostPoses = 1000000;

std::optional<int> readNumber(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > kMostPoses)
        return std::nullopt;
    return number;
}

/// "3" or "3-5" as its first and last number.
std::optional<std::pair<int, int>> readRange(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = readNumber(text.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : readNumber(text.substr(dash + 1));
    if (!first || !last || *last < *first) return std::nullopt;
    return std::pair(*first, *last);
}

/// A pose turned about the vertical. [rad]
base::Quaternion turned(const base::Quaternion& pose, double heading) {
    return base::Quaternion(Eigen::AngleAxisd(heading, base::Vec3::UnitZ())) * pose;
}

std::string nameOrientation(const base::Quaternion& q) {
    return fmt::format("the orientation (w, x, y, z) = ({:.3f}, {:.3f}, {:.3f}, {:.3f})", q.w(), q.x(), q.y(),
                       q.z());
}

/// As the track's end does.
std::string describeLean(double lean) {
    return fmt::format(", leaning across the track by up to {:g}°", lean / base::kDegree);
}

std::string nameGroups(std::span<const part::PoseGroup> groups, std::span<const int> named) {
    std::string text;
    for (const int group : named)
        text += (text.empty() ? "" : " or ") + part::namePoses(groups[static_cast<std::size_t>(group)].poses);
    return text;
}

}  // namespace

double findLean(const TrackSettings& track) {
    const auto traps = traps::readTraps(track.traps);
    if (traps && traps->back()->endsInGroove) return traps::kRestingWall;
    return track.spiral.width > 0.0 ? track.spiral.inclination : 0.0;
}

base::Result<std::vector<int>> readPoses(std::string_view text) {
    std::vector<int> poses;
    for (const std::string_view name : base::splitNames(text)) {
        const auto range = readRange(name);
        if (!range)
            return base::Error{fmt::format(
                "\"{}\" is no stable pose; write their numbers with commas between them, as in 3, 5-6.",
                name)};
        for (int number = range->first; number <= range->second; ++number)
            poses.push_back(number - 1);
    }
    std::sort(poses.begin(), poses.end());
    poses.erase(std::unique(poses.begin(), poses.end()), poses.end());
    return poses;
}

base::Result<std::optional<double>> readHeading(std::string_view text) {
    if (text == kAny) return std::optional<double>();
    const auto degrees = siValue(text, FileUnit::degree);
    if (!degrees || !(std::abs(*degrees) <= 2.0 * base::kPi))
        return base::Error{"It must be any, or an angle from -360 to 360."};
    return std::optional(*degrees);
}

std::vector<std::string> findTargetProblems(const Settings& settings) {
    const TargetSettings& target = settings.target;
    std::vector<std::string> problems;
    if (!target.poses.empty()) {
        if (const auto poses = readPoses(target.poses); !poses)
            problems.push_back("target.poses is \"" + target.poses + "\". " + poses.error().message);
        if (target.orientation)
            problems.emplace_back(
                "target.poses and target.orientation are both set; leave one of them empty.");
    }
    if (const auto heading = readHeading(target.heading); !heading)
        problems.push_back("target.heading_deg is \"" + target.heading + "\". " + heading.error().message);
    const auto summed = objectives::readObjectives(settings.evolution.objectives);
    if (!target.isSet() && summed) {
        for (const objectives::Objective* objective : *summed) {
            if (!objective->needsWanted) continue;
            problems.push_back(
                fmt::format("evolution.objectives names {}, but nothing is wanted. Set target.poses or "
                            "target.orientation, or leave {} out.",
                            objective->key, objective->key));
        }
    }
    return problems;
}

std::vector<std::string> findTargetPartProblems(const TargetSettings& target, const part::Part& part) {
    const auto poses = readPoses(target.poses);
    if (target.poses.empty() || !poses) return {};
    const std::size_t count = part.stablePoses.size();
    for (const int pose : *poses) {
        if (static_cast<std::size_t>(pose) < count) continue;
        const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
        std::string names;
        for (const part::PoseGroup& group : groups)
            names += (names.empty() ? "" : "; ") + part::namePoses(group.poses);
        return {fmt::format("target.poses is \"{}\", but the part {} has no stable pose {}. It has {}{}.",
                            target.poses, part.name, pose + 1, count == 0 ? "none" : names,
                            groups.size() == count ? "" : " (alike ones together)")};
    }
    return {};
}

std::vector<int> findWantedGroups(const TargetSettings& target, std::span<const part::PoseGroup> groups) {
    std::vector<int> named;
    const auto poses = readPoses(target.poses);
    if (target.poses.empty() || !poses) return named;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const bool isNamed = std::ranges::any_of(groups[g].poses, [&](int pose) {
            return std::binary_search(poses->begin(), poses->end(), pose);
        });
        if (isNamed) named.push_back(static_cast<int>(g));
    }
    return named;
}

std::optional<trial::Goal> findWanted(const Settings& settings, const part::Part& part) {
    const TargetSettings& target = settings.target;
    if (target.orientation) return trial::Goal{{{*target.orientation, target.orientationTurns}}};
    if (!target.isSet()) return std::nullopt;
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    const auto heading = readHeading(target.heading);
    assert(heading.ok());
    trial::Goal goal;
    goal.orientations.clear();
    const double lean = findLean(settings.track);
    for (const int group : findWantedGroups(target, groups)) {
        const auto pose = static_cast<std::size_t>(groups[static_cast<std::size_t>(group)].poses.front());
        const base::Quaternion& rotation = part.stablePoses[pose].rotation;
        goal.orientations.push_back({*heading ? turned(rotation, **heading) : rotation, !*heading, lean});
    }
    assert(!goal.orientations.empty());
    return goal;
}

objectives::Task makeTask(const Settings& settings, const part::Part& part) {
    objectives::Task task{&part.symmetry, settings.evolution.orientationDistance, settings.target.isSet()};
    const std::optional<base::Quaternion>& orientation = settings.target.orientation;
    if (orientation && !part.stablePoses.empty())
        task.isResting = part::findStablePose(part, *orientation).angle <= settings.validation.tolerance;
    return task;
}

std::string describeTarget(const Settings& settings, const part::Part& part) {
    const TargetSettings& target = settings.target;
    if (!target.isSet()) return "in whatever way most do";
    if (target.orientation) {
        std::string text = "in " + nameOrientation(*target.orientation);
        if (target.orientationTurns) text += std::string(kInAnyHeading);
        if (part.stablePoses.empty()) return text;
        const part::NearestPose nearest = part::findStablePose(part, *target.orientation);
        return fmt::format("{}, {:.0f}° from stable pose {}", text, nearest.angle / base::kDegree,
                           nearest.index + 1);
    }
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    const auto heading = readHeading(target.heading);
    assert(heading.ok());
    const double lean = findLean(settings.track);
    return fmt::format(
        "in stable pose {}, {}{}", nameGroups(groups, findWantedGroups(target, groups)),
        *heading ? fmt::format("turned to {:g}°", **heading / base::kDegree) : std::string("any heading"),
        lean > 0.0 ? describeLean(lean) : "");
}

TargetSettings findNearestTarget(const Settings& settings, const part::Part& part,
                                 const base::Quaternion& orientation) {
    constexpr int kCircle = 360;
    const double lean = findLean(settings.track);
    TargetSettings nearest;
    double least = std::numeric_limits<double>::max();
    for (const part::PoseGroup& group : part::findPoseGroups(part)) {
        const base::Quaternion& pose =
            part.stablePoses[static_cast<std::size_t>(group.poses.front())].rotation;
        double most = 0.0;
        int best = -1;
        for (int degrees = 0; degrees < kCircle; ++degrees) {
            const trial::Goal goal{{{turned(pose, degrees * base::kDegree), false, lean}}};
            const double angle = trial::calcAngleToGoal(orientation, goal, part.symmetry);
            most = std::max(most, angle);
            if (angle >= least) continue;
            least = angle;
            best = degrees;
        }
        if (best < 0) continue;
        nearest.poses = part::namePoses(group.poses);
        nearest.heading = most - least < kSame ? std::string(kAny) : std::to_string(best);
    }
    return nearest;
}

TargetSettings findHangingTarget(const part::Part& part) {
    TargetSettings target;
    const auto hanging = part::findHanging(part);
    if (!hanging) return target;
    const part::NearestPose nearest = part::findStablePose(part, *hanging);
    if (nearest.angle > kSame) {
        target.orientation = hanging;
        target.orientationTurns = true;
        return target;
    }
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    const int group = part::findPoseGroup(groups, static_cast<int>(nearest.index));
    target.poses = part::namePoses(groups[static_cast<std::size_t>(group)].poses);
    return target;
}

bool wantsHanging(const Settings& settings, const part::Part& part) {
    if (!findTargetProblems(settings).empty() || !findTargetPartProblems(settings.target, part).empty())
        return false;
    const auto wanted = findWanted(settings, part);
    const auto hanging = part::findHanging(part);
    return wanted && hanging && std::ranges::any_of(wanted->orientations, [&](const auto& one) {
               return one.anyHeading && trial::calcTiltAngle(*hanging, one.rotation, part.symmetry) <=
                                            settings.validation.tolerance;
           });
}

std::string describeGoal(const trial::Goal& goal, const part::Part& part) {
    const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    std::string text;
    for (const trial::GoalOrientation& one : goal.orientations) {
        if (!text.empty()) text += " or ";
        const part::NearestPose nearest =
            groups.empty() ? part::NearestPose{} : part::findStablePose(part, one.rotation);
        if (!one.anyHeading || groups.empty() || nearest.angle > kSame) {
            text += nameOrientation(one.rotation);
        } else {
            const int group = part::findPoseGroup(groups, static_cast<int>(nearest.index));
            text += "stable pose " + part::namePoses(groups[static_cast<std::size_t>(group)].poses);
        }
        if (one.anyHeading) text += kInAnyHeading;
        if (one.lean > 0.0) text += describeLean(one.lean);
    }
    return text;
}

std::string goalToJson(const trial::Goal& goal) {
    nlohmann::json list = nlohmann::json::array();
    for (const trial::GoalOrientation& one : goal.orientations) {
        const base::Quaternion& q = one.rotation;
        nlohmann::json& json = list.emplace_back(
            nlohmann::json{{"rotation", {q.w(), q.x(), q.y(), q.z()}}, {"any_heading", one.anyHeading}});
        if (one.lean > 0.0) json["lean_rad"] = one.lean;
    }
    return list.dump();
}

base::Result<trial::Goal> goalFromJson(const std::string& text) {
    const base::Error damaged{"It is no list of orientations."};
    const nlohmann::json list = nlohmann::json::parse(text, nullptr, false);
    if (!list.is_array() || list.empty()) return damaged;
    trial::Goal goal;
    goal.orientations.clear();
    for (const nlohmann::json& one : list) {
        if (!one.is_object() || !one.contains("rotation") || !one.contains("any_heading")) return damaged;
        const nlohmann::json& q = one["rotation"];
        const bool areNumbers = q.is_array() && q.size() == 4 &&
                                std::ranges::all_of(q, [](const auto& x) { return x.is_number(); });
        const nlohmann::json lean = one.value("lean_rad", nlohmann::json(0.0));
        if (!areNumbers || !one["any_heading"].is_boolean() || !lean.is_number()) return damaged;
        if (!(lean.get<double>() >= 0.0 && lean.get<double>() < 0.5 * base::kPi)) return damaged;
        goal.orientations.push_back(
            {base::Quaternion(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()),
             one["any_heading"].get<bool>(), lean.get<double>()});
    }
    return goal;
}

}  // namespace trapwright::study
