#include "core/search/pareto.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>

namespace trapwright::search {

namespace {

/// All indices, the best of the first score first, then of the second.
std::vector<std::size_t> sortByFirst(std::span<const TwoScores> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return points[i]; });
    return order;
}

/// Of the members of one front: the room about each of them, from one neighbour to the other in both ways
/// together, each as a share of the front's own. The two ends have more than any.
void addRoom(std::span<const TwoScores> points, std::vector<std::size_t> front, std::vector<double>& room) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto score = [&](std::size_t i) { return points[i][axis]; };
        std::ranges::stable_sort(front, {}, score);
        const double range = score(front.back()) - score(front.front());
        for (const std::size_t end : {front.front(), front.back()})
            room[end] = std::numeric_limits<double>::infinity();
        if (!(range > 0.0)) continue;
        for (std::size_t k = 1; k + 1 < front.size(); ++k)
            room[front[k]] += (score(front[k + 1]) - score(front[k - 1])) / range;
    }
}

}  // namespace

std::vector<int> sortFronts(std::span<const TwoScores> points) {
    std::vector<int> fronts(points.size(), 0);
    // Of each front its point with the best second score: as the first scores fall, it is the one that can be
    // as good in both ways.
    std::vector<TwoScores> best;
    for (const std::size_t i : sortByFirst(points)) {
        const TwoScores& point = points[i];
        const auto dominates = [&](const TwoScores& other) {
            return other[1] > point[1] || (other[1] == point[1] && other[0] > point[0]);
        };
        const auto front = std::ranges::partition_point(best, dominates);
        fronts[i] = static_cast<int>(front - best.begin());
        if (front == best.end()) {
            best.push_back(point);
        } else {
            *front = point;
        }
    }
    return fronts;
}

std::vector<std::size_t> findFront(std::span<const TwoScores> points) {
    std::vector<std::size_t> front;
    for (const std::size_t i : sortByFirst(points))
        if (front.empty() || points[i][1] > points[front.back()][1]) front.push_back(i);
    return front;
}

std::vector<std::size_t> rankByFronts(std::span<const TwoScores> points) {
    const std::vector<int> fronts = sortFronts(points);
    std::vector<std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto front = static_cast<std::size_t>(fronts[i]);
        if (front >= members.size()) members.resize(front + 1);
        members[front].push_back(i);
    }
    std::vector<double> room(points.size(), 0.0);
    for (const std::vector<std::size_t>& front : members)
        addRoom(points, front, room);
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::tuple(fronts[i], -room[i]); });
    return order;
}

}  // namespace trapwright::search
