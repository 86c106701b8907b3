#include "core/part/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace trapwright::part {

namespace {

struct Spelling {
    std::string_view text;  // lower case
    std::string_view name;
};

constexpr std::array<std::pair<std::string_view, double>, 6> kUnits = {
    {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"inch", 0.0254}, {"ft", 0.3048}}};

constexpr std::array<Spelling, 23> kSpellings = {
    {{"um", "um"},         {"micron", "um"},      {"micrometre", "um"},
     {"micrometer", "um"}, {"mm", "mm"},          {"millimetre", "mm"},
     {"millimeter", "mm"}, {"millimetres", "mm"}, {"millimeters", "mm"},
     {"cm", "cm"},         {"centimetre", "cm"},  {"centimeter", "cm"},
     {"m", "m"},           {"metre", "m"},        {"meter", "m"},
     {"metres", "m"},      {"meters", "m"},       {"inch", "inch"},
     {"in", "inch"},       {"inches", "inch"},    {"ft", "ft"},
     {"foot", "ft"},       {"feet", "ft"}}};

// The parts that bowl feeders handle.
constexpr double kSmallestPlausible = 1e-3;   // [m]
constexpr double kLargestPlausible = 100e-3;  // [m]

}  // namespace

std::optional<LengthUnit> findUnit(std::string_view name) {
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const Spelling& spelling : kSpellings) {
        if (spelling.text != lower) continue;
        for (const auto& [unit, metres] : kUnits) {
            if (unit == spelling.name) return LengthUnit{std::string(unit), metres};
        }
    }
    return std::nullopt;
}

std::optional<LengthUnit> findUnit(double metres) {
    for (const auto& [unit, length] : kUnits) {
        if (std::abs(metres / length - 1.0) < 1e-9) return LengthUnit{std::string(unit), length};
    }
    return std::nullopt;
}

base::Result<LengthUnit> assumeUnit(double largestExtent) {
    const double asMillimetres = largestExtent * 1e-3;
    if (asMillimetres >= kSmallestPlausible && asMillimetres <= kLargestPlausible) {
        return LengthUnit{"mm", 1e-3};
    }
    std::string candidates;
    for (const auto& [unit, metres] : kUnits) {
        if (unit == "ft") continue;
        candidates +=
            fmt::format("{}{}: {}", candidates.empty() ? "" : ", ", unit, lengthText(largestExtent * metres));
    }
    return base::Error{
        fmt::format("the format does not say in which unit the file is, and {:.6g} units would not be a "
                    "plausible part in "
                    "millimetres. The largest extent would be, by unit: {}. Say which it is with --units",
                    largestExtent, candidates)};
}

std::string lengthText(double metres) {
    if (metres >= 1.0) return fmt::format("{:.4g} m", metres);
    if (metres >= 1e-4) return fmt::format("{:.4g} mm", metres * 1e3);
    return fmt::format("{:.3g} um", metres * 1e6);
}

}  // namespace trapwright::part
