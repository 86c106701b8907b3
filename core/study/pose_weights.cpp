#include "core/study/pose_weights.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace trapwright::study {

namespace {

/// The counts that hold for the part; none if there are none.
std::optional<std::vector<int>> findCounts(const part::Part& part, const Settings& settings) {
    if (settings.part.poseWeights == PoseWeights::quasiStatic) return std::nullopt;
    auto counts = readCounts(settings.part.droppedCounts);
    if (!counts || counts->size() != part.stablePoses.size()) return std::nullopt;
    if (std::accumulate(counts->begin(), counts->end(), 0.0) <= 0.0) return std::nullopt;
    return counts;
}

}  // namespace

std::vector<double> poseWeights(const part::Part& part, const Settings& settings) {
    std::vector<double> weights;
    weights.reserve(part.stablePoses.size());
    if (const auto counts = findCounts(part, settings)) {
        weights.assign(counts->begin(), counts->end());
    } else {
        for (const part::StablePose& pose : part.stablePoses)
            weights.push_back(std::max(0.0, pose.probability));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights)
        weight = sum > 0.0 ? weight / sum : 1.0 / static_cast<double>(weights.size());
    return weights;
}

PoseWeights weightsInForce(const part::Part& part, const Settings& settings) {
    return findCounts(part, settings) ? PoseWeights::dropped : PoseWeights::quasiStatic;
}

std::vector<part::PoseGroup> weighPoseGroups(const part::Part& part, const Settings& settings) {
    const std::vector<double> weights = poseWeights(part, settings);
    std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
    for (part::PoseGroup& group : groups) {
        group.probability = 0.0;
        for (const int pose : group.poses)
            group.probability += weights[static_cast<std::size_t>(pose)];
    }
    return groups;
}

std::string countsText(const std::vector<int>& counts) {
    std::string text;
    for (const int count : counts)
        text += (text.empty() ? "" : ", ") + std::to_string(count);
    return text;
}

std::optional<std::vector<int>> readCounts(std::string_view text) {
    std::vector<int> counts;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        int count = 0;
        const auto [next, problem] = std::from_chars(at, end, count);
        if (problem != std::errc() || count < 0) return std::nullopt;
        counts.push_back(count);
        at = next;
        if (at == end) break;
        if (*at != ',') return std::nullopt;
        ++at;
        while (at != end && *at == ' ')
            ++at;
        if (at == end) return std::nullopt;
    }
    return counts;
}

}  // namespace trapwright::study
