#include "core/traps/groove.h"

#include <algorithm>
#include <cmath>

namespace trapwright::traps {

namespace {

constexpr double kSteepestWall = 42.0 * base::kDegree;
constexpr double kMostInclined = 45.0 * base::kDegree;  // across the track
constexpr double kSteepestRise = 6.0 * base::kDegree;   // along the track: what parts still climb
constexpr double kSteepestFall = 22.0 * base::kDegree;
constexpr double kShortestEdge = 0.5e-3;  // along the track, because sections must follow each other [m]
constexpr double kLongestEdge = 6e-3;     // [m]
// Of each number: 0.2 mm, 0.7 degrees. Finer ones would have a mutated bit change nothing that a part feels.
constexpr int kBits = 7;

double within(double low, double high, double share) {
    return low + (high - low) * share;
}

/// A groove's cross-section.
struct Form {
    double walls = kRestingWall;  // how steep both are [rad]
    double inclined = 0.0;        // as a whole, positive: down towards the outer edge [rad]
    double middle = 0.0;          // y of its bottom [m]
};

/// Sections one after the other, each a groove whose bottom is where the one before leaves it.
class Course {
 public:
    Course(const TrapParameters& parameters, double entry) : parameters_(&parameters), bottom_(entry) {}

    /// Goes on for a length (of the track, along x) that falls by an angle, to a groove of this form.
    void add(double length, double fall, const Form& form) {
        x_ += length;
        bottom_ = std::clamp(bottom_ - length * std::tan(fall), 0.0, parameters_->segmentHeight);
        track::CrossSection section{x_, {}};
        const double wall = std::tan(form.walls);
        const double slope = -std::tan(form.inclined);
        for (int j = 0; j < parameters_->pointsPerSection; ++j) {
            const double y = placeOf(j, form.middle);
            const double across = y - form.middle;
            const double z = bottom_ + wall * std::abs(across) + slope * across;
            section.points.emplace_back(y, std::clamp(z, 0.0, parameters_->segmentHeight));
        }
        sections_.push_back(std::move(section));
    }

    void fallBy(double height, double length, const Form& form) {
        add(length, std::atan2(height, length), form);
    }

    std::vector<track::CrossSection> take() { return std::move(sections_); }

 private:
    /// y of a section's point. Two points cannot shape a groove: they are the track's edges.
    [[nodiscard]] double placeOf(int point, double middle) const {
        const double half = 0.5 * parameters_->segmentWidth;
        const int last = parameters_->pointsPerSection - 1;
        const int lowest = parameters_->pointsPerSection / 2;
        if (last < 2) return point == 0 ? -half : half;
        if (point <= lowest) return within(-half, middle, static_cast<double>(point) / lowest);
        return within(middle, half, static_cast<double>(point - lowest) / (last - lowest));
    }

    const TrapParameters* parameters_;
    double x_ = 0.0;
    double bottom_;
    std::vector<track::CrossSection> sections_;
};

double restingLength(const TrapParameters& parameters) {
    return 0.5 * (parameters.minSegmentLength + parameters.maxSegmentLength);
}

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
    return {key, "deg", low / base::kDegree, high / base::kDegree, kBits};
}

std::vector<search::Dimension> dimensionsOfGroove(const TrapParameters& parameters) {
    return {lengthOf("length", parameters), angleOf("fall", -kSteepestRise, kSteepestFall),
            angleOf("walls", 0.0, kSteepestWall), angleOf("inclination", -kMostInclined, kMostInclined)};
}

std::vector<track::CrossSection> buildGroove(const TrapParameters& parameters, double entry,
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

std::vector<track::CrossSection> buildDrop(const TrapParameters& parameters, double entry,
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
    // The first half turns the surface, the second one is the groove to lie down in.
    course.add(0.5 * restingLength(parameters), kRestingFall, {});
    course.add(0.5 * restingLength(parameters), kRestingFall, {});
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

TrapKind drop() {
    return {"drop",
            "Drop",
            "A groove that falls over a sharp edge into another: turns parts by which end is ahead.",
            &dimensionsOfDrop,
            &buildDrop,
            &layOutDrop,
            &longestDrop};
}

}  // namespace trapwright::traps
