#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/stats/mean.h"

/// What is measured on the real feeder to set the simulation's parameters.
namespace trapwright::calibration {

enum class Method {
    tiltUntilSliding,  // static friction: a resting part begins to slide
    tiltWhileSliding,  // kinetic friction: a part that was nudged just goes on
    bounceHeight,      // restitution: drop height and height of the rebound
    bounceTime,        // restitution: times of two flights that follow each other
    conveyingSpeed     // half-stroke: time over a marked distance at several set-points
};

/// "tilt-until-sliding", ...: in files.
std::string nameOf(Method method);
std::optional<Method> methodOf(const std::string& name);

// One reading of a method, as it was taken.

struct Tilt {
    double angle = 0.0;  // at which the part slides [rad]

    friend bool operator==(const Tilt&, const Tilt&) = default;
};

struct BounceHeights {
    double drop = 0.0;     // [m]
    double rebound = 0.0;  // [m]

    friend bool operator==(const BounceHeights&, const BounceHeights&) = default;
};

/// From impact to impact.
struct BounceTimes {
    double flight = 0.0;  // after the first impact [s]
    double next = 0.0;    // after the second [s]

    friend bool operator==(const BounceTimes&, const BounceTimes&) = default;
};

struct TimedRun {
    double setPoint = 0.0;  // of the drive, share of full
    double distance = 0.0;  // along the track [m]
    double time = 0.0;      // [s]

    friend bool operator==(const TimedRun&, const TimedRun&) = default;
};

/// All readings of one measurement; which they are is the method's.
using Readings = std::variant<std::vector<Tilt>, std::vector<BounceHeights>, std::vector<BounceTimes>,
                              std::vector<TimedRun>>;

/// None yet, of this method.
Readings emptyReadings(Method method);
std::size_t countReadings(const Readings& readings);
/// The numbers of each reading, in the order of its struct, for files and tables.
std::vector<std::vector<double>> numbersOf(const Readings& readings);
/// Appends one of these numbers. There must be as many as its struct has; more are ignored.
void addReading(Readings& readings, std::span<const double> numbers);
void removeReading(Readings& readings, std::size_t index);

/// A value with its 95 % interval.
struct Estimate {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;

    friend bool operator==(const Estimate&, const Estimate&) = default;
};

/// One finished measurement, as it is kept in the study.
struct Calibration {
    int number = 0;  // from 0, in the study
    Method method = Method::tiltUntilSliding;
    Readings readings;       // of this method
    Estimate result;         // friction, restitution, or half-stroke at full set-point [m]
    double frequency = 0.0;  // conveyingSpeed: of the drive [Hz]
    std::string operatorName;
    std::string note;
    std::string time;  // UTC, "2026-03-31T12:00:00Z"

    friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// Friction coefficient: mean of the tangents of the angles [rad], in (0, pi / 2). Errors: fewer than two
/// readings, or one out of range.
base::Result<Estimate> estimateFriction(std::span<const Tilt> readings);

/// Newton's restitution from heights: mean of sqrt(rebound / drop). The part's own height does not count:
/// both are measured at the same point of it. Errors as above; a rebound must not be higher than its drop.
base::Result<Estimate> estimateRestitutionFromHeights(std::span<const BounceHeights> readings);

/// The same from the times between three impacts in a row: mean of next / flight, as a flight's time is
/// twice its take-off speed over gravity.
base::Result<Estimate> estimateRestitutionFromTimes(std::span<const BounceTimes> readings);

}  // namespace trapwright::calibration
