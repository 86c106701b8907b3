#include "core/track/track.h"

#include <algorithm>
#include <cassert>

namespace trapwright::track {

namespace {

// How many segments lie between the track's beginning and x, the current one counted by its fraction.
double segmentsFromBegin(const Track& track, double x) {
    const auto& sections = track.sections;
    if (x <= sections.front().x) return 0.0;
    const auto after =
        std::upper_bound(sections.begin(), sections.end(), x,
                         [](double value, const CrossSection& section) { return value < section.x; });
    if (after == sections.end()) return static_cast<double>(sections.size() - 1);
    const auto before = after - 1;
    return static_cast<double>(before - sections.begin()) + (x - before->x) / (after->x - before->x);
}

}  // namespace

double segmentsToFinish(const Track& track, double x) {
    assert(track.sections.size() >= 2);
    return std::max(0.0, segmentsFromBegin(track, track.finish) - segmentsFromBegin(track, x));
}

}  // namespace trapwright::track
