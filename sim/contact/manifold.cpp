#include "sim/contact/manifold.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trapwright::contact {

namespace {

using Indices = std::vector<int>;

/// A gap counts this many times as much as a distance within the plane when contacts are chosen.
constexpr double kGapWeight = 30.0;

bool saySame(const ManifoldPoint& a, const ManifoldPoint& b) {
    return (a.arm - b.arm).squaredNorm() < kSamePlace * kSamePlace && a.normal.dot(b.normal) > kSameNormal;
}

/// One for each place and normal; the lowest stands for the others. Into `distinct`, in order, if it has room
/// for them; returns how many there are.
int findDistinct(std::span<const ManifoldPoint> points, std::span<int> distinct) {
    int count = 0;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
        bool stands = true;
        for (int k = 0; k < static_cast<int>(points.size()) && stands; ++k) {
            const bool lower = points[k].gap < points[i].gap || (points[k].gap == points[i].gap && k < i);
            stands = !(lower && saySame(points[i], points[k]));
        }
        if (!stands) continue;
        if (count < static_cast<int>(distinct.size())) distinct[count] = i;
        ++count;
    }
    return count;
}

/// The lowest first, then always the one farthest from all that are chosen; far gaps count against it.
Indices chooseWidest(std::span<const ManifoldPoint> points, const Indices& group, int share) {
    Indices chosen = {*std::min_element(group.begin(), group.end(),
                                        [&](int a, int b) { return points[a].gap < points[b].gap; })};
    while (static_cast<int>(chosen.size()) < share) {
        int best = -1;
        double bestScore = -1e300;
        for (const int i : group) {
            double nearest = 1e300;
            for (const int c : chosen)
                nearest = std::min(nearest, (points[i].arm - points[c].arm).norm());
            const double score = nearest - kGapWeight * points[i].gap;
            if (nearest > 0.0 && score > bestScore) {
                bestScore = score;
                best = i;
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
    const int distinct = findDistinct(points, kept);
    if (distinct <= most) return distinct;
    Indices all(static_cast<std::size_t>(distinct));
    findDistinct(points, all);
    const Indices chosen = thinOutPlanes(points, all, most);
    std::copy(chosen.begin(), chosen.end(), kept.begin());
    return static_cast<int>(chosen.size());
}

}  // namespace trapwright::contact
