#include "sim/contact/manifold.h"

#include <algorithm>
#include <cmath>

namespace trapwright::contact {

namespace {

/// Contacts whose normals differ by less belong to one plane. (cosine)
constexpr double kSameNormal = 0.9998;
/// A gap counts this many times as much as a distance within the plane when contacts are chosen.
constexpr double kGapWeight = 30.0;

}  // namespace

std::vector<int> thinOut(const std::vector<StepContact>& contacts, int most) {
    std::vector<int> kept;
    const int count = static_cast<int>(contacts.size());
    if (count <= most) {
        for (int i = 0; i < count; ++i)
            kept.push_back(i);
        return kept;
    }

    // Group by normal, in order of appearance.
    std::vector<std::vector<int>> groups;
    for (int i = 0; i < count; ++i) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<int>& g) {
            return contacts[g.front()].normal.dot(contacts[i].normal) > kSameNormal;
        });
        if (group == groups.end())
            groups.push_back({i});
        else
            group->push_back(i);
    }

    const int share = std::max(3, most / static_cast<int>(groups.size()));
    for (const std::vector<int>& group : groups) {
        if (static_cast<int>(group.size()) <= share) {
            kept.insert(kept.end(), group.begin(), group.end());
            continue;
        }
        // The lowest first, then always the one farthest from all that are chosen; far gaps count against it.
        std::vector<int> chosen = {*std::min_element(
            group.begin(), group.end(), [&](int a, int b) { return contacts[a].gap < contacts[b].gap; })};
        while (static_cast<int>(chosen.size()) < share) {
            int best = -1;
            double bestScore = -1e300;
            for (const int i : group) {
                double nearest = 1e300;
                for (const int c : chosen)
                    nearest = std::min(nearest, (contacts[i].arm - contacts[c].arm).norm());
                const double score = nearest - kGapWeight * contacts[i].gap;
                if (nearest > 0.0 && score > bestScore) {
                    bestScore = score;
                    best = i;
                }
            }
            if (best < 0) break;
            chosen.push_back(best);
        }
        std::sort(chosen.begin(), chosen.end());
        kept.insert(kept.end(), chosen.begin(), chosen.end());
    }

    // So many planes that three contacts of each are too many: the lowest of all count.
    if (static_cast<int>(kept.size()) > most) {
        std::stable_sort(kept.begin(), kept.end(),
                         [&](int a, int b) { return contacts[a].gap < contacts[b].gap; });
        kept.resize(most);
        std::sort(kept.begin(), kept.end());
    }
    return kept;
}

}  // namespace trapwright::contact
