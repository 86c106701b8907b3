#include "core/calibration/apply.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace trapwright::calibration {

namespace {

constexpr const char* kStaticFriction = "simulation.contact.staticFriction";
constexpr const char* kKineticFriction = "simulation.contact.kineticFriction";
constexpr const char* kRestitution = "simulation.contact.restitution";
constexpr const char* kHalfStroke = "simulation.drive.halfStroke_mm";
constexpr const char* kFrictionRange = "box.friction";
constexpr const char* kRestitutionRange = "box.restitution";

/// The newest measurement by one of these methods; null without one.
const Calibration* findNewest(std::span<const Calibration> calibrations,
                              std::initializer_list<Method> methods) {
    const Calibration* newest = nullptr;
    for (const Calibration& calibration : calibrations)
        if (std::find(methods.begin(), methods.end(), calibration.method) != methods.end())
            newest = &calibration;
    return newest;
}

Estimate scaled(const Estimate& estimate, double factor) {
    return {factor * estimate.value, factor * estimate.low, factor * estimate.high};
}

/// Half of the 95 % interval of one more reading: that of the mean of n is t s / sqrt(n), this t s sqrt(1 + 1
/// / n). Never less than what a gauge of angles or heights is wrong by itself.
double halfRange(const Calibration& calibration) {
    constexpr double kSurest = 0.02;
    const Estimate& mean = calibration.result;
    const double half = std::max(mean.value - mean.low, mean.high - mean.value);
    const auto readings = static_cast<double>(countReadings(calibration.readings));
    return std::max(kSurest, half * std::sqrt(readings + 1.0));
}

}  // namespace

std::vector<Change> findChanges(const Parameters& before, std::span<const Calibration> calibrations,
                                double setPoint) {
    std::vector<Change> changes;
    const auto add = [&](const char* key, double value, const Estimate& after) {
        if (value != after.value) changes.push_back({key, value, after});
    };
    const auto narrow = [&](const char* key, double range, double measured) {
        if (measured < range) changes.push_back({key, range, {measured, measured, measured}});
    };
    const Calibration* const resting = findNewest(calibrations, {Method::tiltUntilSliding});
    const Calibration* const sliding = findNewest(calibrations, {Method::tiltWhileSliding});
    if (resting != nullptr || sliding != nullptr) {
        Estimate kinetic = sliding != nullptr ? sliding->result : resting->result;
        Estimate still = resting != nullptr ? resting->result : kinetic;
        if (resting == nullptr && before.contact.staticFriction > kinetic.value) {
            still = {before.contact.staticFriction, before.contact.staticFriction,
                     before.contact.staticFriction};
        }
        if (kinetic.value > still.value) kinetic = still;
        add(kStaticFriction, before.contact.staticFriction, still);
        add(kKineticFriction, before.contact.kineticFriction, kinetic);
        // The box holds both coefficients: one that was not measured is as uncertain as before.
        if (resting != nullptr && sliding != nullptr)
            narrow(kFrictionRange, before.box.friction, std::max(halfRange(*resting), halfRange(*sliding)));
    }
    if (const Calibration* bounce = findNewest(calibrations, {Method::bounceHeight, Method::bounceTime})) {
        add(kRestitution, before.contact.restitution, bounce->result);
        narrow(kRestitutionRange, before.box.restitution, halfRange(*bounce));
    }
    if (const Calibration* speed = findNewest(calibrations, {Method::conveyingSpeed});
        speed != nullptr && setPoint > 0.0)
        add(kHalfStroke, before.drive.halfStroke, scaled(speed->result, setPoint));
    return changes;
}

Parameters applyChanges(const Parameters& before, std::span<const Change> changes) {
    Parameters after = before;
    for (const Change& change : changes) {
        if (change.key == kStaticFriction) after.contact.staticFriction = change.after.value;
        if (change.key == kKineticFriction) after.contact.kineticFriction = change.after.value;
        if (change.key == kRestitution) after.contact.restitution = change.after.value;
        if (change.key == kHalfStroke) after.drive.halfStroke = change.after.value;
        if (change.key == kFrictionRange) after.box.friction = change.after.value;
        if (change.key == kRestitutionRange) after.box.restitution = change.after.value;
    }
    return after;
}

}  // namespace trapwright::calibration
