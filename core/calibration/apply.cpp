#include "core/calibration/apply.h"

#include <algorithm>
#include <initializer_list>

namespace trapwright::calibration {

namespace {

constexpr const char* kStaticFriction = "simulation.contact.staticFriction";
constexpr const char* kKineticFriction = "simulation.contact.kineticFriction";
constexpr const char* kRestitution = "simulation.contact.restitution";
constexpr const char* kHalfStroke = "simulation.drive.halfStroke_mm";

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

}  // namespace

std::vector<Change> findChanges(const Parameters& before, std::span<const Calibration> calibrations,
                                double setPoint) {
    std::vector<Change> changes;
    const auto add = [&](const char* key, double value, const Estimate& after) {
        if (value != after.value) changes.push_back({key, value, after});
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
    }
    if (const Calibration* bounce = findNewest(calibrations, {Method::bounceHeight, Method::bounceTime}))
        add(kRestitution, before.contact.restitution, bounce->result);
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
    }
    return after;
}

}  // namespace trapwright::calibration
