#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace trapwright::part {

/// A length unit that a part file may be in.
struct LengthUnit {
    std::string name;  // um, mm, cm, m, inch or ft
    double metres;     // one unit in metres
};

/// The unit with this name; also knows the spellings of the file formats and of users (millimeter, MM, in,
/// micron ...). Empty for an unknown one.
std::optional<LengthUnit> findUnit(std::string_view name);

/// The unit of this length. Empty if it is none of ours. [m]
std::optional<LengthUnit> findUnit(double metres);

/// What a file without a unit is taken to be, from its largest extent in file units: millimetres if that
/// makes a part of 1 to 100 mm. Error otherwise: names the candidates with the size that the part would have
/// under each.
base::Result<LengthUnit> assumeUnit(double largestExtent);

/// A length for people, in the unit that reads best ("12 mm", "0.305 m").
std::string lengthText(double metres);

}  // namespace trapwright::part
