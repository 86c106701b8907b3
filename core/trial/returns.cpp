#include "core/trial/returns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace trapwright::trial {

namespace {

/// y half-way between the track's edges at x. [m]
double findMiddle(const track::Track& track, double x) {
    const auto middleOf = [](const track::CrossSection& section) {
        return std::midpoint(section.points.front().x(), section.points.back().x());
    };
    const auto next = std::ranges::lower_bound(track.sections, x, {}, &track::CrossSection::x);
    if (next == track.sections.begin()) return middleOf(*next);
    if (next == track.sections.end()) return middleOf(track.sections.back());
    const track::CrossSection& before = *std::prev(next);
    return std::lerp(middleOf(before), middleOf(*next), (x - before.x) / (next->x - before.x));
}

}  // namespace

bool comesAgain(const PartOutcome& outcome, const track::Track& track, Returns returns) {
    if (outcome.ending != Ending::fellOff || returns == Returns::nowhere) return false;
    if (returns == Returns::anywhere) return true;
    const base::Vec3& place = outcome.farthest.position;
    const bool isOuter = place.y() > findMiddle(track, place.x());
    return isOuter == (returns == Returns::outerSide);
}

}  // namespace trapwright::trial
