#include "core/traps/ledge.h"

#include <algorithm>
#include <cmath>

#include "core/traps/trap_chain.h"

namespace trapwright::traps {

namespace {

constexpr double kEdge = 0.5e-3;       // along the track: a gap's edges, the shortest end of a cut [m]
constexpr double kSliver = 0.3e-3;     // what is left of a ledge beside its wall at least [m]
constexpr double kThinnest = 1.2e-3;   // and without one, as of its wall, so that they can be printed [m]
constexpr double kLeastCut = 2e-3;     // of the ledge's width: the middle of a range, rounded to bits
constexpr double kLeastStep = 1e-2;    // of the highest, likewise
constexpr double kLongestSlant = 0.5;  // of the longest segment: a cut's beginning and end
constexpr double kHighestStep = 1.0 / 6.0;  // of the longest segment
constexpr double kDepthOfGap = 0.5;         // of the longest segment
constexpr int kBits = 7;
constexpr int kFineBits = 10;  // of cuts, which decide by a tenth of a millimetre

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

/// How wide the ledge is of which cuts are told, beside its wall. What decides is how far a part's centre of
/// mass is from the wall; told of a wide track hardly any cut would be near that. [m]
double widthOf(const TrapParameters& parameters) {
    if (parameters.spiral.width > 0.0) return parameters.spiral.width;
    return 0.5 * std::min(parameters.segmentWidth, parameters.maxSegmentLength);
}

/// Where the whole ledge is that goes on from a section.
struct Place {
    double inner = 0.0;  // y of its inner edge [m]
    double foot = 0.0;   // y of the wall's foot [m]
    double z = 0.0;      // of the wall's foot [m]
};

/// At the section's lowest point, or at its outer edge where it is level.
Place placeBehind(const TrapParameters& parameters, const track::CrossSection& before) {
    constexpr double kLevel = 1e-9;
    const double lowest = findLowest(before);
    Place place{before.points.front().x(), before.points.back().x(), lowest};
    const auto isLow = [&](const base::Vec2& point) { return point.y() - lowest <= kLevel; };
    for (const base::Vec2& point : before.points) {
        place.inner = std::min(place.inner, point.x());
        if (isLow(point)) place.foot = point.x();
    }
    const double half = 0.5 * parameters.segmentWidth;
    place.inner = std::max(place.inner, -half);
    place.foot = std::clamp(place.foot, std::min(place.inner + kThinnest, half - track::kSpiralWallWidth),
                            half - track::kSpiralWallWidth);
    return place;
}

/// What is left of the ledge, and whether the wall is.
struct Left {
    double inner = 0.0;
    double outer = 0.0;
    bool hasWall = true;
};

/// Cut from the inner edge and from the wall by so much; 0 or less: not at all.
Left cut(const TrapParameters& parameters, const Place& place, double inner, double outer) {
    // The whole ledge may be wider than what cuts are told of.
    const double from =
        inner <= 0.0 ? place.inner : std::max(place.inner, place.foot - widthOf(parameters) + inner);
    Left left{from, place.foot - std::max(0.0, outer), outer <= 0.0};
    const double least = left.hasWall ? kSliver : kThinnest;
    if (left.outer - left.inner >= least) return left;
    // At the wall, or where the cut from there ends.
    left.outer = std::max(left.outer, place.inner + least);
    left.inner = left.outer - least;
    return left;
}

class Course {
 public:
    Course(const TrapParameters& parameters, const track::CrossSection& before)
        : parameters_(&parameters), place_(placeBehind(parameters, before)) {}

    [[nodiscard]] const Place& place() const { return place_; }

    /// Goes on for a length to what is left of the ledge there, so much below where the trap begins.
    void add(double length, const Left& left, double below) {
        x_ += length;
        const double fall = std::tan(parameters_->spiral.inclination);
        const double highest = parameters_->segmentHeight;
        track::CrossSection section{x_, {}};
        const double foot = std::max(0.0, place_.z - below);
        const auto onLedge = [&](double y) {
            return base::Vec2(y, std::clamp(foot + fall * (place_.foot - y), 0.0, highest));
        };
        const int last = parameters_->pointsPerSection - 3;
        for (int j = 0; j <= last; ++j)
            section.points.push_back(onLedge(
                last > 0 ? within(left.inner, left.outer, static_cast<double>(j) / last) : left.outer));
        if (left.hasWall) {
            const double top = std::min(highest, foot + parameters_->spiral.wall);
            section.points.emplace_back(place_.foot + track::kSpiralWallRun, top);
            section.points.emplace_back(place_.foot + track::kSpiralWallWidth, top);
        } else {
            // Towards here the wall becomes lower, not too thin to be printed: what is left of it is level.
            section.points.push_back(onLedge(left.outer + track::kSpiralWallRun));
            section.points.push_back(onLedge(left.outer + track::kSpiralWallRun + kThinnest));
        }
        sections_.push_back(std::move(section));
    }

    std::vector<track::CrossSection> take() { return std::move(sections_); }

 private:
    const TrapParameters* parameters_;
    Place place_;
    double x_ = 0.0;
    std::vector<track::CrossSection> sections_;
};

double longestSlant(const TrapParameters& parameters) {
    return kLongestSlant * parameters.maxSegmentLength;
}

std::vector<search::Dimension> dimensionsOf(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double deepest = kMillimetres * widthOf(parameters);
    const double edge = kMillimetres * kEdge;
    const double slant = kMillimetres * longestSlant(parameters);
    const double longest = kMillimetres * parameters.maxSegmentLength;
    const double step = kHighestStep * longest;
    std::vector<search::Dimension> dimensions = {
        {"before, length", "mm", kMillimetres * parameters.minSegmentLength, longest, kBits},
        {"beginning", "mm", edge, slant, kBits},
        {"inner cut", "mm", -deepest, deepest, kFineBits},
        {"outer cut", "mm", -deepest, deepest, kFineBits},
        {"length", "mm", edge, longest, kBits},
        {"inner cut at the end", "mm", -deepest, deepest, kFineBits},
        {"outer cut at the end", "mm", -deepest, deepest, kFineBits},
        {"end", "mm", edge, slant, kBits},
        {"step", "mm", -step, step, kBits}};
    for (const std::size_t relief : {2, 3, 5, 6, 8})
        dimensions[relief].isRelief = true;
    return dimensions;
}

std::vector<track::CrossSection> build(const TrapParameters& parameters, const track::CrossSection& before,
                                       std::span<const double> numbers) {
    const double deepest = widthOf(parameters);
    const double longest = parameters.maxSegmentLength;
    const auto cutBy = [&](double number) {
        const double by = within(-deepest, deepest, number);
        return by > kLeastCut * deepest ? by : 0.0;
    };
    const auto slant = [&](double number) { return within(kEdge, longestSlant(parameters), number); };
    const double share = within(-1.0, 1.0, numbers[8]);
    const double step = std::abs(share) > kLeastStep ? kHighestStep * longest * share : 0.0;
    const double lowered = std::max(0.0, -step);
    const double behind = std::abs(step);

    Course course(parameters, before);
    const Left whole{course.place().inner, course.place().foot, true};
    const Left begin = cut(parameters, course.place(), cutBy(numbers[2]), cutBy(numbers[3]));
    const Left end = cut(parameters, course.place(), cutBy(numbers[5]), cutBy(numbers[6]));
    // What is left at the beginning and at the end have nothing in common: between them is a gap.
    const bool isGap = begin.inner >= end.outer || end.inner >= begin.outer;
    // A gap has no floor: a thread far below the inner edge, which carries nothing, joins its edges.
    const Left thread{whole.inner, whole.inner + kThinnest, false};
    const double depth = isGap ? kDepthOfGap * longest : 0.0;
    course.add(within(parameters.minSegmentLength, longest, numbers[0]), whole, 0.0);
    course.add(slant(numbers[1]), begin, lowered);
    course.add(kEdge, isGap ? thread : begin, lowered + depth);
    course.add(within(kEdge, longest, numbers[4]), isGap ? thread : end, lowered + depth);
    course.add(kEdge, end, isGap ? behind : lowered);
    course.add(slant(numbers[7]), whole, behind);
    return course.take();
}

std::vector<double> layOut(const TrapParameters& parameters) {
    const double longest = parameters.maxSegmentLength;
    const double slant = within(kEdge, longestSlant(parameters), 0.5);
    std::vector<double> places{within(parameters.minSegmentLength, longest, 0.5)};
    for (const double next : {slant, kEdge, within(kEdge, longest, 0.5), kEdge, slant})
        places.push_back(places.back() + next);
    return places;
}

double longest(const TrapParameters& parameters) {
    return 2.0 * (parameters.maxSegmentLength + longestSlant(parameters) + kEdge);
}

}  // namespace

TrapKind ledge() {
    return {"ledge",
            "Ledge",
            "A ledge beside a wall, cut over a length: parts whose weight finds no support there fall off.",
            &dimensionsOf,
            &build,
            &layOut,
            &longest,
            nullptr,
            false,
            true,
            static_cast<int>(track::kLeastSpiralPoints)};
}

}  // namespace trapwright::traps
