#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace trapwright::trial {

/// What may differ from trial to trial because nobody knows it exactly: the sides of a study's operating box
/// (decisions.md#operating-box).
enum class Condition {
    friction,
    restitution,
    halfStroke,
    frequency,
    angle,
    part,
    startOffset,
    startSpeed,
    roughness
};
inline constexpr std::size_t kConditions = 9;

enum class BoxDistribution { uniform, normal };

/// What a study does not know exactly of its physics, about the values of its other settings: half of each
/// range. 0: known (decisions.md#operating-box).
struct OperatingBox {
    BoxDistribution distribution = BoxDistribution::uniform;  // normal: cut off at two standard deviations
    double friction = 0.2;                                    // of both coefficients
    double restitution = 0.2;
    double halfStroke = 0.12;   // as a share
    double frequency = 0.0;     // as a share
    double angle = 0.0;         // of the vibration [rad]
    double sizeBelow = 0.1e-3;  // what each extent of a part may be less than drawn [m]
    double sizeAbove = 0.1e-3;  // and more [m]
    double centre = 0.0;        // how far the centre of mass may be off, in each direction [m]
    double startOffset = 0.0;   // sideways, beside what starts vary by as it is [m]
    double startSpeed = 0.0;    // along the track at most; parts start at rest else [m/s]
    double roughness = 0.0;     // ContactParameters::roughness at most [rad]

    friend bool operator==(const OperatingBox&, const OperatingBox&) = default;
};

/// Where a trial is in the box: of each condition the share of its range that lies below, in [0, 1]. Of what
/// does not vary 0.5.
using BoxPlace = std::array<double, kConditions>;
inline constexpr BoxPlace kMiddle = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};

/// Whether all that varies is at an end of its range. (Of what varies no trial is in the middle by chance.)
bool isCorner(const BoxPlace& place);

/// A condition as people read it.
struct ConditionText {
    Condition condition = Condition::friction;
    std::string_view key;   // in JSON: "friction"
    std::string_view name;  // "Friction"
    std::string_view unit;  // "mm"; empty: none
    double shownAs = 1.0;   // in that unit, from SI
    int decimals = 2;
};

/// All of them, in the order of Condition.
std::span<const ConditionText> conditionTexts();

}  // namespace trapwright::trial
