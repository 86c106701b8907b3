#include "core/traps/narrowed.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

namespace trapwright::traps {

namespace {

constexpr double kEdge = 0.5e-3;                        // along the track, of the cut's two ends [m]
constexpr double kMostInclined = 20.0 * base::kDegree;  // across the track
constexpr double kDeepest = 2.0 / 3.0;                  // of the track's width, from either edge
constexpr double kNarrowest = 0.05;                     // what is left of it at least, as a share
constexpr double kSteepestRise = 6.0 * base::kDegree;   // along the track, before a notch
constexpr double kSteepestFall = 15.0 * base::kDegree;
constexpr double kHighestStep = 1.0 / 3.0;  // of the longest segment or the box's height, behind a notch
constexpr double kFarthestBeyond = 0.1;     // of the track's width, a notch cuts beyond the lowest point
constexpr double kHighestLip = 0.5;         // of the same
constexpr double kLongestSlant = 0.5;       // of the longest segment: a notch's ends
constexpr double kLeastStretch = 10e-6;     // between points of a section [m]
constexpr int kBits = 7;
constexpr int kFineBits = 10;  // of what decides by a tenth of a millimetre

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

std::vector<search::Dimension> dimensionsOf(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double deepest = kMillimetres * kDeepest * parameters.segmentWidth;
    const double longest = kMillimetres * parameters.maxSegmentLength;
    const double steepest = kMostInclined / base::kDegree;
    std::vector<search::Dimension> dimensions = {
        {"before, length", "mm", kMillimetres * parameters.minSegmentLength, longest, kBits},
        {"inner cut", "mm", -deepest, deepest, kFineBits},
        {"outer cut", "mm", -deepest, deepest, kFineBits},
        {"length", "mm", kMillimetres * kEdge, longest, kBits},
        {"inclination", "deg", -steepest, steepest, kBits}};
    for (const std::size_t relief : {1, 2, 4})
        dimensions[relief].isRelief = true;
    return dimensions;
}

/// A section as it is, or what is left of it.
struct Left {
    double inner = 0.0;  // from this y ...
    double outer = 0.0;  // ... to that
    bool isWhole = true;
};

/// From one point to another, `count` of them at equal distances, the second one left out.
void spread(const track::CrossSection& whole, double from, double to, std::size_t count,
            std::span<base::Vec2> points) {
    for (std::size_t i = 0; i < count; ++i) {
        const double y = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
        points[i] = {y, heightAt(whole, y)};
    }
}

/// What is left of a section whose points follow each other across the track: these stay where and which they
/// are, so that what lies on them does not feel the cut; those that are cut off share the way from the cut
/// edge to the next one.
void cutExactly(const track::CrossSection& whole, const Left& left, track::CrossSection& section) {
    const std::vector<base::Vec2>& points = whole.points;
    const auto isLeft = [&](const base::Vec2& point) {
        return point.x() >= left.inner + kLeastStretch && point.x() <= left.outer - kLeastStretch;
    };
    const auto first = static_cast<std::size_t>(std::ranges::find_if(points, isLeft) - points.begin());
    if (first == points.size()) {
        spread(whole, left.inner, left.outer, points.size() - 1, section.points);
        section.points.back() = {left.outer, heightAt(whole, left.outer)};
        return;
    }
    std::size_t last = first;
    while (last + 1 < points.size() && isLeft(points[last + 1]))
        ++last;
    if (first > 0) spread(whole, left.inner, points[first].x(), first, section.points);
    const std::size_t behind = points.size() - 1 - last;
    if (behind > 0) {
        std::vector<base::Vec2> outward(behind);
        spread(whole, left.outer, points[last].x(), behind, outward);
        std::ranges::copy(outward, section.points.rbegin());
    }
}

/// The section, or what is left of it with as many points. One that goes back across the track somewhere is
/// cut where it is met first, into points at equal distances.
track::CrossSection cut(const track::CrossSection& whole, double x, const Left& left) {
    track::CrossSection section{x, whole.points};
    if (left.isWhole) return section;
    const bool isFunction =
        std::ranges::is_sorted(whole.points, std::less(), [](const base::Vec2& point) { return point.x(); });
    if (isFunction) {
        cutExactly(whole, left, section);
        return section;
    }
    spread(whole, left.inner, left.outer, whole.points.size() - 1, section.points);
    section.points.back() = {left.outer, heightAt(whole, left.outer)};
    return section;
}

/// Turned about the track's middle line; what would leave the segment's box is cut off at it.
track::CrossSection incline(const TrapParameters& parameters, track::CrossSection section, double slope) {
    for (base::Vec2& point : section.points)
        point.y() = std::clamp(point.y() + slope * point.x(), 0.0, parameters.segmentHeight);
    return section;
}

/// Raised, or lowered where `height` is negative, as far as that leaves all of it in the segment's box.
track::CrossSection raise(const TrapParameters& parameters, track::CrossSection section, double height) {
    const auto [low, high] =
        std::ranges::minmax(section.points, {}, [](const base::Vec2& point) { return point.y(); });
    const double room = std::max(0.0, parameters.segmentHeight - high.y());
    const double raised = std::clamp(height, -std::max(0.0, low.y()), room);
    for (base::Vec2& point : section.points)
        point.y() += raised;
    return section;
}

/// From one y to another, or as much as has to be left about the middle of both.
Left leave(const track::CrossSection& whole, double inner, double outer, bool isWhole) {
    const auto [low, high] =
        std::ranges::minmax(whole.points, {}, [](const base::Vec2& point) { return point.x(); });
    const double least = kNarrowest * (high.x() - low.x());
    Left left{inner, outer, isWhole || least <= 0.0};
    if (left.outer - left.inner < least) {
        const double middle =
            std::clamp(std::midpoint(left.inner, left.outer), low.x() + 0.5 * least, high.x() - 0.5 * least);
        left.inner = middle - 0.5 * least;
        left.outer = middle + 0.5 * least;
    }
    return left;
}

/// What is left of a section that is cut from both edges by so much, or less where nothing would be left.
Left cutAway(const track::CrossSection& whole, double inner, double outer) {
    const auto [low, high] =
        std::ranges::minmax(whole.points, {}, [](const base::Vec2& point) { return point.x(); });
    return leave(whole, low.x() + std::max(0.0, inner), high.x() - std::max(0.0, outer),
                 inner <= 0.0 && outer <= 0.0);
}

/// How far from the lowest point its neighbours in this order are no more than a lip higher; a lip below 0
/// is how far the cut goes beyond the lowest point. None: to the edge.
std::optional<double> findLip(std::span<const base::Vec2> fromLowest, double lip, double towards) {
    const base::Vec2 lowest = fromLowest.front();
    if (lip < 0.0) return lowest.x() - towards * -lip;
    base::Vec2 last = lowest;
    for (const base::Vec2& point : fromLowest) {
        if (point.y() - lowest.y() > lip) {
            const double share = (lowest.y() + lip - last.y()) / (point.y() - last.y());
            return std::lerp(last.x(), point.x(), std::clamp(share, 0.0, 1.0));
        }
        last = point;
    }
    return std::nullopt;
}

/// What is left of a section that keeps a lip of such a height on either side of its lowest point.
Left cutAtLips(const track::CrossSection& whole, double innerLip, double outerLip) {
    const std::span<const base::Vec2> points(whole.points);
    const auto lowest = static_cast<std::size_t>(
        std::ranges::min_element(points, {}, [](const base::Vec2& point) { return point.y(); }) -
        points.begin());
    std::vector<base::Vec2> inward(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(lowest) + 1);
    std::ranges::reverse(inward);
    const auto inner = findLip(inward, innerLip, -1.0);
    const auto outer = findLip(points.subspan(lowest), outerLip, 1.0);
    return leave(whole, std::max(inner.value_or(points.front().x()), points.front().x()),
                 std::min(outer.value_or(points.back().x()), points.back().x()), !inner && !outer);
}

/// What heights are told by: a chain of many traps has a box that is far higher than any of them. [m]
double scaleOf(const TrapParameters& parameters) {
    return std::min(parameters.segmentHeight, parameters.maxSegmentLength);
}

double slopeOf(double inclination) {
    return -std::tan(within(-kMostInclined, kMostInclined, inclination));
}

std::vector<track::CrossSection> buildNarrowed(const TrapParameters& parameters,
                                               const track::CrossSection& before,
                                               std::span<const double> numbers) {
    const double deepest = kDeepest * parameters.segmentWidth;
    const Left whole;
    const Left left =
        cutAway(before, within(-deepest, deepest, numbers[1]), within(-deepest, deepest, numbers[2]));
    const double slope = slopeOf(numbers[4]);
    const double begin = within(parameters.minSegmentLength, parameters.maxSegmentLength, numbers[0]);
    const double end = begin + kEdge + within(kEdge, parameters.maxSegmentLength, numbers[3]);
    const auto shape = [&](double x, const Left& part) {
        return incline(parameters, cut(before, x, part), slope);
    };
    return {shape(begin, whole), shape(begin + kEdge, left), shape(end, left), shape(end + kEdge, whole)};
}

std::vector<double> layOutNarrowed(const TrapParameters& parameters) {
    const double begin = 0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength);
    const double end = begin + kEdge + within(kEdge, parameters.maxSegmentLength, 0.5);
    return {begin, begin + kEdge, end, end + kEdge};
}

double longestNarrowed(const TrapParameters& parameters) {
    return 2.0 * parameters.maxSegmentLength + 2.0 * kEdge;
}

std::vector<search::Dimension> dimensionsOfNotched(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double deepest = kMillimetres * kFarthestBeyond * parameters.segmentWidth;
    const double lip = kMillimetres * kHighestLip * scaleOf(parameters);
    const double highest = kMillimetres * kHighestStep * scaleOf(parameters);
    const double shortest = kMillimetres * kEdge;
    const double longest = kMillimetres * parameters.maxSegmentLength;
    const double steepest = kMostInclined / base::kDegree;
    std::vector<search::Dimension> dimensions = {
        {"before, length", "mm", kMillimetres * parameters.minSegmentLength, longest, kBits},
        {"before, fall", "deg", -kSteepestRise / base::kDegree, kSteepestFall / base::kDegree, kBits},
        {"inner lip", "mm", -deepest, lip, kFineBits},
        {"outer lip", "mm", -deepest, lip, kFineBits},
        {"beginning", "mm", shortest, kLongestSlant * longest, kBits},
        {"length", "mm", shortest, longest, kBits},
        {"end", "mm", shortest, kLongestSlant * longest, kBits},
        {"raised", "mm", -highest, highest, kBits},
        {"behind, raised", "mm", -highest, highest, kBits},
        {"inclination", "deg", -steepest, steepest, kBits}};
    for (const std::size_t relief : {1, 7, 8, 9})
        dimensions[relief].isRelief = true;
    return dimensions;
}

std::vector<track::CrossSection> buildNotched(const TrapParameters& parameters,
                                              const track::CrossSection& before,
                                              std::span<const double> numbers) {
    const double longest = parameters.maxSegmentLength;
    const double length = within(parameters.minSegmentLength, longest, numbers[0]);
    const double fall = length * std::tan(within(-kSteepestRise, kSteepestFall, numbers[1]));
    const auto lip = [&](double number) {
        return within(-kFarthestBeyond * parameters.segmentWidth, kHighestLip * scaleOf(parameters), number);
    };
    const auto edge = [&](double number) { return within(kEdge, kLongestSlant * longest, number); };
    const auto height = [&](double number) {
        return kHighestStep * scaleOf(parameters) * within(-1.0, 1.0, number);
    };

    const track::CrossSection entry =
        raise(parameters, incline(parameters, before, slopeOf(numbers[9])), -fall);
    const track::CrossSection notch = raise(parameters, entry, height(numbers[7]));
    const track::CrossSection behind = raise(parameters, entry, height(numbers[8]));
    const Left whole;
    const Left left = cutAtLips(entry, lip(numbers[2]), lip(numbers[3]));
    const double begin = length + edge(numbers[4]);
    const double end = begin + within(kEdge, longest, numbers[5]);
    return {cut(entry, length, whole), cut(notch, begin, left), cut(notch, end, left),
            cut(behind, end + edge(numbers[6]), whole)};
}

std::vector<double> layOutNotched(const TrapParameters& parameters) {
    const double longest = parameters.maxSegmentLength;
    std::vector<double> places{within(parameters.minSegmentLength, longest, 0.5)};
    for (const double next : {within(kEdge, kLongestSlant * longest, 0.5), within(kEdge, longest, 0.5),
                              within(kEdge, kLongestSlant * longest, 0.5)})
        places.push_back(places.back() + next);
    return places;
}

double longestNotched(const TrapParameters& parameters) {
    return (2.0 + 2.0 * kLongestSlant) * parameters.maxSegmentLength;
}

}  // namespace

double heightAt(const track::CrossSection& section, double y) {
    for (std::size_t i = 1; i < section.points.size(); ++i) {
        const base::Vec2& a = section.points[i - 1];
        const base::Vec2& b = section.points[i];
        if (y < std::min(a.x(), b.x()) || y > std::max(a.x(), b.x())) continue;
        if (a.x() == b.x()) return a.y();
        return std::lerp(a.y(), b.y(), (y - a.x()) / (b.x() - a.x()));
    }
    const base::Vec2& first = section.points.front();
    const base::Vec2& last = section.points.back();
    return std::abs(y - first.x()) < std::abs(y - last.x()) ? first.y() : last.y();
}

TrapKind narrowed() {
    return {"narrowed",
            "Narrowed track",
            "What comes before goes on, cut away at its edges: parts without support there fall off.",
            &dimensionsOf,
            &buildNarrowed,
            &layOutNarrowed,
            &longestNarrowed};
}

TrapKind notched() {
    return {"notched",
            "Notched track",
            "What comes before goes on, notched across, raised or lowered: tells a part's two ends apart.",
            &dimensionsOfNotched,
            &buildNotched,
            &layOutNotched,
            &longestNotched};
}

}  // namespace trapwright::traps
