#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/study/settings.h"

namespace trapwright::study {

/// The names that presetSettings knows.
std::span<const std::string_view> presetNames();

/// The paper's Table 1 with the drive of its section 6: "cuboid" and "cone".
base::Result<Settings> presetSettings(const std::string& name);

/// Changes settings to the paper's own choices where the defaults go past it: free points, plain angle, p_s
/// up to 1, no floor under p_dm, overlapping tracks simulated, all trials for every individual, each with its
/// own random numbers and as patient as in validation, every trial by Simbody, a bowl of 175 mm.
Settings paperMode(Settings settings);

/// The numbers of one pair of materials and where they come from.
struct ContactPreset {
    std::string_view name;  // "abs-on-printed-plastic"
    trial::ContactParameters contact;
    double density = 0.0;     // of the part's material [kg/m^3]
    std::string_view source;  // a reference, or "assumed"
};

/// All pairs of materials that can be chosen by name.
std::span<const ContactPreset> contactPresets();

/// The pair of that name; an error that lists the names otherwise.
base::Result<ContactPreset> findContactPreset(std::string_view name);

}  // namespace trapwright::study
