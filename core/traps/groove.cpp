#include "core/traps/groove.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/traps/trap_chain.h"

namespace trapwright::traps {

namespace {

constexpr double kSteepestWall = 42.0 * base::kDegree;
constexpr double kMostInclined = 45.0 * base::kDegree;  // across the track
constexpr double kSteepestRise = 6.0 * base::kDegree;   // along the track: what parts still climb
constexpr double kSteepestFall = 22.0 * base::kDegree;
constexpr double kShortestEdge = 0.5e-3;  // along the track, because sections must follow each other [m]
constexpr double kLongestEdge = 6e-3;     // [m]
constexpr double kSteepestLedgeWall = 60.0 * base::kDegree;
constexpr double kMostFloor = 20.0 * base::kDegree;  // of a ledge, across the track
constexpr double kSlotSide = 0.1e-3;                 // across the track [m]
constexpr int kPointsOfSlot = 6;  // of a section: on either side the track's edge, the slot's, its foot
constexpr double kThinnestRail = 1.5e-3;  // so that it can be printed [m]
constexpr double kLevelestRoof = 15.0 * base::kDegree;
constexpr double kRounding = 1e-9;  // [m]
// Of each number: 0.2 mm, 0.7 degrees. Finer ones would have a mutated bit change nothing that a part feels.
constexpr int kBits = 7;

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

/// A slot along a groove's middle.
struct Opening {
    double width = 0.0;  // [m]; 0: there is none
    double depth = 0.0;  // below the groove's bottom [m]
    /// How much of the track is left on either side. [m] None: all of it.
    std::optional<double> rail{};
    double roof = 0.0;  // how steeply that falls outward [rad]
};

/// A groove's cross-section.
struct Form {
    double walls = kRestingWall;  // how steep both are [rad]
    double inclined = 0.0;        // as a whole, positive: down towards the outer edge [rad]
    double middle = 0.0;          // y of its bottom [m]
    double cut = 0.0;  // how much of the track's width is cut away: from its outer edge, negative: inner [m]
    Opening slot{};
};

double restingLength(const TrapParameters& parameters) {
    return 0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength);
}

/// Sections one after the other, each a groove whose bottom is where the one before leaves it.
class Course {
 public:
    Course(const TrapParameters& parameters, const track::CrossSection& entry)
        : parameters_(&parameters), bottom_(findLowest(entry)) {}

    /// Goes on for a length (of the track, along x) that falls by an angle, to a groove of this form.
    void add(double length, double fall, const Form& form) {
        x_ += length;
        bottom_ = std::clamp(bottom_ - length * std::tan(fall), 0.0, parameters_->segmentHeight);
        track::CrossSection section{x_, {}};
        const double wall = std::tan(form.walls);
        const double slope = -std::tan(form.inclined);
        for (int j = 0; j < parameters_->pointsPerSection; ++j) {
            const double y = placeOf(j, form);
            const double across = y - form.middle;
            const double foot = 0.5 * form.slot.width;
            const bool isFloor = form.slot.width > 0.0 && std::abs(across) <= foot + kRounding;
            const double onRail = form.slot.rail ? std::max(0.0, std::abs(across) - foot) : 0.0;
            const double z = isFloor ? bottom_ - form.slot.depth
                                     : bottom_ + wall * (std::abs(across) - onRail) -
                                           std::tan(form.slot.roof) * onRail + slope * across;
            section.points.emplace_back(y, std::clamp(z, 0.0, parameters_->segmentHeight));
        }
        sections_.push_back(std::move(section));
    }

    void fallBy(double height, double length, const Form& form) {
        add(length, std::atan2(height, length), form);
    }

    /// The groove in which parts lie down: its first half turns the surface into it.
    void rest() {
        add(0.5 * restingLength(*parameters_), kRestingFall, {});
        add(0.5 * restingLength(*parameters_), kRestingFall, {});
    }

    std::vector<track::CrossSection> take() { return std::move(sections_); }

 private:
    /// y of a section's point. Two points cannot shape a groove: they are the track's edges.
    [[nodiscard]] double placeOf(int point, const Form& form) const {
        const double half = 0.5 * parameters_->segmentWidth;
        const double inner = -half + std::max(0.0, -form.cut);
        const double outer = half - std::max(0.0, form.cut);
        const int last = parameters_->pointsPerSection - 1;
        const int lowest = parameters_->pointsPerSection / 2;
        if (last < 2) return point == 0 ? inner : outer;
        if (form.slot.width > 0.0) return placeBesideSlot(point, form.slot);
        // Where the bottom itself is cut away, all points are on the wall that is left.
        if (form.middle <= inner || form.middle >= outer)
            return within(inner, outer, static_cast<double>(point) / last);
        if (point <= lowest) return within(inner, form.middle, static_cast<double>(point) / lowest);
        return within(form.middle, outer, static_cast<double>(point - lowest) / (last - lowest));
    }

    /// From either of the track's or the rails' outer edges to the slot's, down its side, and its floor.
    [[nodiscard]] double placeBesideSlot(int point, const Opening& slot) const {
        const int last = parameters_->pointsPerSection - 1;
        const int rails = std::max(0, parameters_->pointsPerSection / 2 - 2);  // the last point beside it
        const double sign = 2 * point < last ? -1.0 : 1.0;
        const int fromEdge = std::min(point, last - point);
        const double foot = 0.5 * slot.width;
        const double half = 0.5 * parameters_->segmentWidth;
        const double edge = slot.rail ? std::min(half, foot + *slot.rail) : half;
        if (2 * point == last) return 0.0;
        if (fromEdge > rails) return sign * foot;
        return sign * within(edge, foot + kSlotSide, static_cast<double>(fromEdge) / std::max(1, rails));
    }

    const TrapParameters* parameters_;
    double x_ = 0.0;
    double bottom_;
    std::vector<track::CrossSection> sections_;
};

double highestDrop(const TrapParameters& parameters) {
    return 0.5 * parameters.maxSegmentLength;
}

double farthestAside(const TrapParameters& parameters) {
    return parameters.segmentWidth / 6.0;
}

search::Dimension lengthOf(const char* key, const TrapParameters& parameters) {
    return {key, "mm", parameters.minSegmentLength / base::kMillimetre,
            parameters.maxSegmentLength / base::kMillimetre, kBits};
}

search::Dimension angleOf(const char* key, double low, double high) {
    search::Dimension dimension{key, "deg", low / base::kDegree, high / base::kDegree, kBits};
    dimension.isRelief = true;
    return dimension;
}

std::vector<search::Dimension> dimensionsOfGroove(const TrapParameters& parameters) {
    return {lengthOf("length", parameters), angleOf("fall", -kSteepestRise, kSteepestFall),
            angleOf("walls", 0.0, kSteepestWall), angleOf("inclination", -kMostInclined, kMostInclined)};
}

std::vector<track::CrossSection> buildGroove(const TrapParameters& parameters,
                                             const track::CrossSection& entry,
                                             std::span<const double> numbers) {
    Course course(parameters, entry);
    course.add(within(parameters.minSegmentLength, parameters.maxSegmentLength, numbers[0]),
               within(-kSteepestRise, kSteepestFall, numbers[1]),
               {within(0.0, kSteepestWall, numbers[2]), within(-kMostInclined, kMostInclined, numbers[3])});
    return course.take();
}

std::vector<double> layOutGroove(const TrapParameters& parameters) {
    return {restingLength(parameters)};
}

double longestGroove(const TrapParameters& parameters) {
    return parameters.maxSegmentLength;
}

std::vector<search::Dimension> dimensionsOfDrop(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double aside = kMillimetres * farthestAside(parameters);
    return {lengthOf("before, length", parameters),
            angleOf("before, fall", -kSteepestRise, kSteepestFall),
            angleOf("before, walls", 0.0, kSteepestWall),
            angleOf("before, inclination", -kMostInclined, kMostInclined),
            {"height", "mm", 0.0, kMillimetres * highestDrop(parameters), kBits},
            {"edge", "mm", kMillimetres * kShortestEdge, kMillimetres * kLongestEdge, kBits},
            angleOf("behind, walls", 0.0, kSteepestWall),
            {"behind, aside", "mm", -aside, aside, kBits},
            angleOf("behind, inclination", -kMostInclined, kMostInclined),
            lengthOf("behind, length", parameters),
            angleOf("behind, fall", -kSteepestRise, kSteepestFall)};
}

std::vector<track::CrossSection> buildDrop(const TrapParameters& parameters, const track::CrossSection& entry,
                                           std::span<const double> numbers) {
    const auto length = [&](double share) {
        return within(parameters.minSegmentLength, parameters.maxSegmentLength, share);
    };
    const double aside = farthestAside(parameters);
    const Form before{within(0.0, kSteepestWall, numbers[2]),
                      within(-kMostInclined, kMostInclined, numbers[3])};
    const Form behind{within(0.0, kSteepestWall, numbers[6]),
                      within(-kMostInclined, kMostInclined, numbers[8]), within(-aside, aside, numbers[7])};
    Course course(parameters, entry);
    course.add(length(numbers[0]), within(-kSteepestRise, kSteepestFall, numbers[1]), before);
    course.fallBy(within(0.0, highestDrop(parameters), numbers[4]),
                  within(kShortestEdge, kLongestEdge, numbers[5]), behind);
    course.add(length(numbers[9]), within(-kSteepestRise, kSteepestFall, numbers[10]), behind);
    course.rest();
    return course.take();
}

std::vector<double> layOutDrop(const TrapParameters& parameters) {
    const double length = restingLength(parameters);
    const double edge = within(kShortestEdge, kLongestEdge, 0.5);
    return {length, length + edge, 2.0 * length + edge, 2.5 * length + edge, 3.0 * length + edge};
}

double longestDrop(const TrapParameters& parameters) {
    return 2.0 * parameters.maxSegmentLength + kLongestEdge + restingLength(parameters);
}

/// How far a cut goes: beyond the groove's bottom, which is then cut away itself.
double deepestCut(const TrapParameters& parameters) {
    return 2.0 / 3.0 * parameters.segmentWidth;
}

/// A wall on one side of the bottom and a floor on the other, where it is cut away by `cut`. Angles: the wall
/// rises, the floor falls towards the cut edge.
Form makeLedge(double wall, double floor, double cut) {
    const double rise = std::tan(wall);
    const double drop = std::tan(floor);
    const double side = cut < 0.0 ? -1.0 : 1.0;
    return {std::atan(0.5 * (rise - drop)), side * std::atan(0.5 * (rise + drop)), 0.0, cut};
}

std::vector<search::Dimension> dimensionsOfCutOut(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double deepest = kMillimetres * deepestCut(parameters);
    search::Dimension depth{"depth", "mm", -deepest, deepest, kBits};
    depth.isRelief = true;  // from no cut on
    return {lengthOf("before, length", parameters),
            angleOf("before, fall", -kSteepestRise, kSteepestFall),
            angleOf("wall", 0.0, kSteepestLedgeWall),
            angleOf("floor", -kMostFloor, kMostFloor),
            depth,
            {"length", "mm", kMillimetres * kShortestEdge, kMillimetres * parameters.maxSegmentLength, kBits},
            angleOf("fall", -kSteepestRise, kSteepestFall)};
}

/// `step`: how much lower the track is behind the cut, or if negative from the cut's beginning on. [m]
/// Without one it is a cut-out. Behind the cut it is lower before it is wide again: both at once would leave
/// a blade between the step's face and the cut's, too thin to be printed.
std::vector<track::CrossSection> buildLedge(const TrapParameters& parameters,
                                            const track::CrossSection& entry, std::span<const double> numbers,
                                            std::optional<double> step) {
    const double deepest = deepestCut(parameters);
    const Form narrow =
        makeLedge(within(0.0, kSteepestLedgeWall, numbers[2]), within(-kMostFloor, kMostFloor, numbers[3]),
                  within(-deepest, deepest, numbers[4]));
    Form whole = narrow;
    whole.cut = 0.0;
    const double fall = within(-kSteepestRise, kSteepestFall, numbers[6]);
    Course course(parameters, entry);
    const auto addEdge = [&](double height, double length, const Form& form) {
        if (height > 0.0)
            course.fallBy(height, length, form);
        else
            course.add(length, fall, form);
    };
    course.add(within(parameters.minSegmentLength, parameters.maxSegmentLength, numbers[0]),
               within(-kSteepestRise, kSteepestFall, numbers[1]), whole);
    addEdge(-step.value_or(0.0), kShortestEdge, narrow);
    course.add(within(kShortestEdge, parameters.maxSegmentLength, numbers[5]), fall, narrow);
    if (step) addEdge(*step, 0.5 * kShortestEdge, narrow);
    course.add(step ? 0.5 * kShortestEdge : kShortestEdge, fall, whole);
    course.rest();
    return course.take();
}

std::vector<track::CrossSection> buildCutOut(const TrapParameters& parameters,
                                             const track::CrossSection& entry,
                                             std::span<const double> numbers) {
    return buildLedge(parameters, entry, numbers, std::nullopt);
}

std::vector<search::Dimension> dimensionsOfGap(const TrapParameters& parameters) {
    std::vector<search::Dimension> dimensions = dimensionsOfCutOut(parameters);
    const double highest = highestDrop(parameters) / base::kMillimetre;
    dimensions.push_back({"step", "mm", -highest, highest, kBits});
    dimensions.back().isRelief = true;  // from no step on
    return dimensions;
}

std::vector<track::CrossSection> buildGap(const TrapParameters& parameters, const track::CrossSection& entry,
                                          std::span<const double> numbers) {
    const double highest = highestDrop(parameters);
    return buildLedge(parameters, entry, numbers, within(-highest, highest, numbers[7]));
}

std::vector<double> layOutCutOut(const TrapParameters& parameters) {
    const double length = restingLength(parameters);
    const double cut = within(kShortestEdge, parameters.maxSegmentLength, 0.5);
    std::vector<double> places{length};
    for (const double next : {kShortestEdge, cut, kShortestEdge, 0.5 * length, 0.5 * length})
        places.push_back(places.back() + next);
    return places;
}

std::vector<double> layOutGap(const TrapParameters& parameters) {
    std::vector<double> places = layOutCutOut(parameters);
    places.insert(places.begin() + 3, places[3] - 0.5 * kShortestEdge);
    return places;
}

double longestCutOut(const TrapParameters& parameters) {
    return 2.0 * parameters.maxSegmentLength + 2.0 * kShortestEdge + restingLength(parameters);
}

/// How wide a slot can be, and how deep.
double widestSlot(const TrapParameters& parameters) {
    return std::min(parameters.maxSegmentLength, parameters.segmentWidth) / 3.0;
}

double deepestSlot(const TrapParameters& parameters) {
    return parameters.maxSegmentLength;
}

/// The same groove where its slot has no depth: the floor is as the rails are, so that nothing is left of it.
Form shut(Form form) {
    form.slot.depth = -0.5 * form.slot.width * std::tan(form.walls);
    return form;
}

/// Of the groove before the slot, of its opening and of its rails: what a slot and rails have in common.
std::vector<search::Dimension> dimensionsOfRails(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    const double longest = kMillimetres * parameters.maxSegmentLength;
    return {lengthOf("before, length", parameters),
            angleOf("fall", -kSteepestRise, kSteepestFall),
            angleOf("walls", 0.0, kSteepestWall),
            {"width", "mm", 0.0, kMillimetres * widestSlot(parameters), kBits},
            {"depth", "mm", 0.0, kMillimetres * deepestSlot(parameters), kBits},
            {"beginning", "mm", kMillimetres * kShortestEdge, longest, kBits},
            {"length", "mm", kMillimetres * parameters.minSegmentLength, 2.0 * longest, kBits}};
}

/// Rails that are open to their end.
struct OpenRails {
    Form form;
    double fall = 0.0;  // [rad]
};

OpenRails addRails(Course& course, const TrapParameters& parameters, std::span<const double> numbers) {
    const double longest = parameters.maxSegmentLength;
    OpenRails rails{{within(0.0, kSteepestWall, numbers[2])},
                    within(-kSteepestRise, kSteepestFall, numbers[1])};
    rails.form.slot = {within(0.0, widestSlot(parameters), numbers[3]),
                       within(0.0, deepestSlot(parameters), numbers[4])};
    course.add(within(parameters.minSegmentLength, longest, numbers[0]), rails.fall, shut(rails.form));
    course.add(within(kShortestEdge, longest, numbers[5]), rails.fall, rails.form);
    course.add(within(parameters.minSegmentLength, 2.0 * longest, numbers[6]), rails.fall, rails.form);
    return rails;
}

std::vector<double> layOutRails(const TrapParameters& parameters) {
    std::vector<double> places{restingLength(parameters)};
    for (const double next : {within(kShortestEdge, parameters.maxSegmentLength, 0.5),
                              within(parameters.minSegmentLength, 2.0 * parameters.maxSegmentLength, 0.5)})
        places.push_back(places.back() + next);
    return places;
}

double longestRails(const TrapParameters& parameters) {
    return 4.0 * parameters.maxSegmentLength;
}

std::vector<track::CrossSection> buildRails(const TrapParameters& parameters,
                                            const track::CrossSection& entry,
                                            std::span<const double> numbers) {
    Course course(parameters, entry);
    addRails(course, parameters, numbers);
    return course.take();
}

double widestRail(const TrapParameters& parameters) {
    return std::max(parameters.segmentWidth / 12.0, kThinnestRail);
}

std::vector<search::Dimension> dimensionsOfNarrowRails(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    std::vector<search::Dimension> dimensions = dimensionsOfRails(parameters);
    dimensions.push_back(lengthOf("narrowing", parameters));
    dimensions.push_back(
        {"rail", "mm", kMillimetres * kThinnestRail, kMillimetres * widestRail(parameters), kBits});
    dimensions.push_back(angleOf("roof", kLevelestRoof, kSteepestWall));
    dimensions.push_back(lengthOf("narrow, length", parameters));
    return dimensions;
}

std::vector<track::CrossSection> buildNarrowRails(const TrapParameters& parameters,
                                                  const track::CrossSection& entry,
                                                  std::span<const double> numbers) {
    Course course(parameters, entry);
    OpenRails rails = addRails(course, parameters, numbers);
    // Beside this walls come down, and what follows has none (track::PrintOutline).
    course.add(parameters.minSegmentLength, rails.fall, rails.form);
    const double strip = parameters.segmentWidth / parameters.pointsPerSection;
    const double widest = 0.5 * parameters.segmentWidth - strip - kSlotSide - 0.5 * rails.form.slot.width;
    rails.form.slot.rail = std::min(widest, within(kThinnestRail, widestRail(parameters), numbers[8]));
    rails.form.slot.roof = within(kLevelestRoof, kSteepestWall, numbers[9]);
    for (const double length : {numbers[7], numbers[10]})
        course.add(within(parameters.minSegmentLength, parameters.maxSegmentLength, length), rails.fall,
                   rails.form);
    return course.take();
}

std::vector<double> layOutNarrowRails(const TrapParameters& parameters) {
    std::vector<double> places = layOutRails(parameters);
    for (const double next :
         {parameters.minSegmentLength, restingLength(parameters), restingLength(parameters)})
        places.push_back(places.back() + next);
    return places;
}

double longestNarrowRails(const TrapParameters& parameters) {
    return longestRails(parameters) + parameters.minSegmentLength + 2.0 * parameters.maxSegmentLength;
}

std::vector<search::Dimension> dimensionsOfSlot(const TrapParameters& parameters) {
    constexpr double kMillimetres = 1.0 / base::kMillimetre;
    std::vector<search::Dimension> dimensions = dimensionsOfRails(parameters);
    dimensions.push_back(
        {"end", "mm", kMillimetres * kShortestEdge, kMillimetres * parameters.maxSegmentLength, kBits});
    dimensions.push_back({"step", "mm", 0.0, kMillimetres * deepestSlot(parameters), kBits});
    return dimensions;
}

std::vector<track::CrossSection> buildSlot(const TrapParameters& parameters, const track::CrossSection& entry,
                                           std::span<const double> numbers) {
    Course course(parameters, entry);
    const OpenRails rails = addRails(course, parameters, numbers);
    course.fallBy(within(0.0, deepestSlot(parameters), numbers[8]),
                  within(kShortestEdge, parameters.maxSegmentLength, numbers[7]), shut(rails.form));
    course.rest();
    return course.take();
}

std::vector<double> layOutSlot(const TrapParameters& parameters) {
    std::vector<double> places = layOutRails(parameters);
    for (const double next : {within(kShortestEdge, parameters.maxSegmentLength, 0.5),
                              0.5 * restingLength(parameters), 0.5 * restingLength(parameters)})
        places.push_back(places.back() + next);
    return places;
}

double longestSlot(const TrapParameters& parameters) {
    return longestRails(parameters) + parameters.maxSegmentLength + restingLength(parameters);
}

TrapKind openToTheEnd(TrapKind kind) {
    kind.leastPoints = kPointsOfSlot;
    kind.isLast = true;
    return kind;
}

}  // namespace

TrapKind groove() {
    return {"groove",
            "Groove",
            "Parts come to lie along the track: length, fall, walls and inclination.",
            &dimensionsOfGroove,
            &buildGroove,
            &layOutGroove,
            &longestGroove};
}

std::vector<double> restingGroove(const TrapParameters& parameters) {
    std::vector<double> numbers{1.0, (kRestingFall + kSteepestRise) / (kSteepestFall + kSteepestRise),
                                kRestingWall / kSteepestWall, 0.5};
    const std::vector<search::Dimension> dimensions = dimensionsOfGroove(parameters);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = search::roundToBits(numbers[i], dimensions[i].bits);
    return numbers;
}

TrapKind drop() {
    return {"drop",
            "Drop",
            "A groove that falls over a sharp edge into another: turns parts by which end is ahead.",
            &dimensionsOfDrop,
            &buildDrop,
            &layOutDrop,
            &longestDrop,
            nullptr,
            true};
}

TrapKind cutOut() {
    return {"cut-out",
            "Cut-out",
            "A ledge along a wall, cut away over a length: parts without support there fall off.",
            &dimensionsOfCutOut,
            &buildCutOut,
            &layOutCutOut,
            &longestCutOut,
            nullptr,
            true};
}

TrapKind gap() {
    return {"gap",
            "Gap",
            "A cut-out with a step behind it or at its beginning: tells a part's two ends apart.",
            &dimensionsOfGap,
            &buildGap,
            &layOutGap,
            &longestCutOut,
            nullptr,
            true};
}

TrapKind slot() {
    return {"slot",
            "Slot",
            "A slot along the groove's middle, in which parts hang by their thicker end.",
            &dimensionsOfSlot,
            &buildSlot,
            &layOutSlot,
            &longestSlot,
            nullptr,
            true,
            false,
            kPointsOfSlot};
}

TrapKind rails() {
    return openToTheEnd({"rails", "Rails",
                         "A slot that goes on to the track's end: parts leave hanging, their thicker end up.",
                         &dimensionsOfRails, &buildRails, &layOutRails, &longestRails});
}

TrapKind narrowRails() {
    return openToTheEnd({"narrow rails", "Narrow rails",
                         "Rails of which at the end only narrow ones are left: what does not hang falls off.",
                         &dimensionsOfNarrowRails, &buildNarrowRails, &layOutNarrowRails,
                         &longestNarrowRails});
}

}  // namespace trapwright::traps
