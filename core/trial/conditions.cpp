#include "core/trial/conditions.h"

#include "core/base/math.h"

namespace trapwright::trial {

std::span<const ConditionText> conditionTexts() {
    static constexpr std::array<ConditionText, kConditions> kTexts = {{
        {Condition::friction, "friction", "Friction", "", 1.0, 2},
        {Condition::restitution, "restitution", "Restitution", "", 1.0, 2},
        {Condition::halfStroke, "half_stroke_mm", "Half-stroke", "mm", 1e3, 3},
        {Condition::frequency, "frequency_Hz", "Frequency", "Hz", 1.0, 1},
        {Condition::angle, "angle_deg", "Vibration angle", "deg", 1.0 / base::kDegree, 1},
        {Condition::part, "part_mm", "Part size", "mm", 1e3, 3},
        {Condition::startOffset, "start_offset_mm", "Start offset", "mm", 1e3, 1},
        {Condition::startSpeed, "start_speed_mm_s", "Start speed", "mm/s", 1e3, 0},
        {Condition::roughness, "roughness_deg", "Roughness", "deg", 1.0 / base::kDegree, 1},
    }};
    return kTexts;
}

bool isCorner(const BoxPlace& place) {
    bool somethingVaries = false;
    for (const double share : place) {
        if (share == 0.5) continue;
        if (share > 0.0 && share < 1.0) return false;
        somethingVaries = true;
    }
    return somethingVaries;
}

}  // namespace trapwright::trial
