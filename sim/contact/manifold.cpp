#include "sim/contact/manifold.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace trapwright::contact {

namespace {

using Indices = std::vector<int>;

/// A gap counts this many times as much as a distance within the plane when contacts are chosen.
constexpr double kGapWeight = 30.0;

bool saySame(const ManifoldPoint& a, const ManifoldPoint& b) {
    return (a.arm - b.arm).squaredNorm() < kSamePlace * kSamePlace && a.normal.dot(b.normal) > kSameNormal;
}

/// One for each place and normal, in order; the lowest stands for the others.
Indices findDistinct(std::span<const ManifoldPoint> points) {
    // Along an axis, so that those at the same place are near each other in this row.
    Indices row(points.size());
    std::iota(row.begin(), row.end(), 0);
    std::sort(row.begin(), row.end(), [&](int a, int b) { return points[a].arm.x() < points[b].arm.x(); });
    std::vector<bool> stands(points.size(), true);
    for (std::size_t first = 0; first < row.size(); ++first) {
        const int a = row[first];
        for (std::size_t second = first + 1; second < row.size(); ++second) {
            const int b = row[second];
            if (points[b].arm.x() - points[a].arm.x() > kSamePlace) break;
            if (!saySame(points[a], points[b])) continue;
            const bool aIsLower = points[a].gap < points[b].gap || (points[a].gap == points[b].gap && a < b);
            stands[static_cast<std::size_t>(aIsLower ? b : a)] = false;
        }
    }
    Indices distinct;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
        if (stands[static_cast<std::size_t>(i)]) distinct.push_back(i);
    }
    return distinct;
}

/// The lowest first, then always the one farthest from all that are chosen; far gaps count against it.
Indices chooseWidest(std::span<const ManifoldPoint> points, const Indices& group, int share) {
    Indices chosen = {*std::min_element(group.begin(), group.end(),
                                        [&](int a, int b) { return points[a].gap < points[b].gap; })};
    std::vector<double> nearest(group.size(), 1e300);  // of those that are chosen, of each of the group
    while (static_cast<int>(chosen.size()) < share) {
        int best = -1;
        double bestScore = -1e300;
        for (std::size_t i = 0; i < group.size(); ++i) {
            const ManifoldPoint& point = points[group[i]];
            nearest[i] = std::min(nearest[i], (point.arm - points[chosen.back()].arm).norm());
            const double score = nearest[i] - kGapWeight * point.gap;
            if (nearest[i] > 0.0 && score > bestScore) {
                bestScore = score;
                best = group[i];
            }
        }
        if (best < 0) break;
        chosen.push_back(best);
    }
    return chosen;
}

Indices thinOutPlanes(std::span<const ManifoldPoint> points, const Indices& all, int most) {
    // Group by normal, in order of appearance.
    std::vector<Indices> groups;
    for (const int i : all) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const Indices& g) {
            return points[g.front()].normal.dot(points[i].normal) > kSameNormal;
        });
        if (group == groups.end())
            groups.push_back({i});
        else
            group->push_back(i);
    }

    const int share = std::max(3, most / static_cast<int>(groups.size()));
    Indices kept;
    for (const Indices& group : groups) {
        const Indices part =
            static_cast<int>(group.size()) <= share ? group : chooseWidest(points, group, share);
        kept.insert(kept.end(), part.begin(), part.end());
    }
    // So many planes that three contacts of each are too many: the lowest of all count.
    if (static_cast<int>(kept.size()) > most) {
        std::sort(kept.begin(), kept.end());
        std::stable_sort(kept.begin(), kept.end(),
                         [&](int a, int b) { return points[a].gap < points[b].gap; });
        kept.resize(static_cast<std::size_t>(most));
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

}  // namespace

int reduceManifold(std::span<const ManifoldPoint> points, std::span<int> kept) {
    const int most = static_cast<int>(kept.size());
    Indices chosen = findDistinct(points);
    if (static_cast<int>(chosen.size()) > most) chosen = thinOutPlanes(points, chosen, most);
    std::copy(chosen.begin(), chosen.end(), kept.begin());
    return static_cast<int>(chosen.size());
}

}  // namespace trapwright::contact
