#include "core/geometry/shell_roles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/exact_solid.h"
#include "core/geometry/shell_union.h"

namespace trapwright::geometry {

namespace {

constexpr double kAll = 1.0 - 1e-6;  // of a shell's volume that is inside another one

double sizeOf(const Shell& shell) {
    return std::abs(shell.volume);
}

/// Turns the evidence around if the file is inside out as a whole.
void correctMirrored(const std::vector<Shell>& shells, const ShellNesting& nesting,
                     std::vector<char>& facedInward) {
    double inward = 0.0;
    double outward = 0.0;
    for (std::size_t i = 0; i < shells.size(); ++i)
        if (nesting.around[i].empty()) (facedInward[i] != 0 ? inward : outward) += sizeOf(shells[i]);
    if (inward <= outward) return;
    for (char& faced : facedInward)
        faced = faced != 0 ? 0 : 1;
}

/// The smallest shell in contact that has all of this one inside it, apart from one of its own size.
base::Result<std::optional<std::size_t>> findTouchedAround(const TriangleMesh& mesh,
                                                           const std::vector<Shell>& shells,
                                                           const ShellNesting& nesting,
                                                           const std::vector<char>& facedInward,
                                                           std::size_t inner) {
    std::optional<std::size_t> best;
    for (const ShellContact& contact : nesting.contacts) {
        if (contact.first != inner && contact.second != inner) continue;
        const std::size_t other = contact.first == inner ? contact.second : contact.first;
        if (facedInward[other] != 0 || sizeOf(shells[other]) * kAll <= sizeOf(shells[inner])) continue;
        if (best && sizeOf(shells[other]) >= sizeOf(shells[*best])) continue;
        const auto both =
            combineSolids(makeOutwardSolid(mesh, shells[inner]), makeOutwardSolid(mesh, shells[other]));
        if (!both) return describeOverlap(contact.place, both.error().message);
        if (both->common && both->common->calcVolume() >= kAll * sizeOf(shells[inner])) best = other;
    }
    return best;
}

}  // namespace

base::Result<std::vector<ShellRole>> findShellRoles(const TriangleMesh& mesh,
                                                    const std::vector<Shell>& shells,
                                                    const ShellNesting& nesting,
                                                    std::vector<char> facedInward) {
    correctMirrored(shells, nesting, facedInward);
    const auto isSmaller = [&](std::size_t a, std::size_t b) {
        return sizeOf(shells[a]) < sizeOf(shells[b]);
    };

    // The innermost shell around each.
    std::vector<std::optional<std::size_t>> parents(shells.size());
    bool tellsCavities = false;
    for (std::size_t i = 0; i < shells.size(); ++i) {
        const std::vector<std::size_t>& around = nesting.around[i];
        if (!around.empty()) parents[i] = *std::min_element(around.begin(), around.end(), isSmaller);
        if (facedInward[i] == 0) continue;
        auto touched = findTouchedAround(mesh, shells, nesting, facedInward, i);
        if (!touched) return touched.error();
        if (*touched && (!parents[i] || isSmaller(**touched, *parents[i]))) parents[i] = *touched;
        tellsCavities = tellsCavities || parents[i];
    }

    // From outside to inside, so that what is around a shell is known before it.
    std::vector<std::size_t> order(shells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return isSmaller(b, a); });
    std::vector<ShellRole> roles(shells.size());
    for (const std::size_t i : order) {
        ShellRole& role = roles[i];
        role.body = i;
        if (!parents[i] || roles[*parents[i]].isCavity) continue;
        const std::size_t around = roles[*parents[i]].body;
        const bool isAlone = !nesting.hasContact(i);
        if (facedInward[i] != 0 || (isAlone && !tellsCavities)) {
            role.isCavity = true;
            role.body = around;
            role.isDoubtful = facedInward[i] == 0;
        } else {
            role.embeddedIn = around;
        }
    }
    return roles;
}

}  // namespace trapwright::geometry
