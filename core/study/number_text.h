#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/math.h"

namespace trapwright::study {

/// The unit that a number has in files for people; in memory it is SI.
enum class FileUnit { none, millimetre, degree, millisecond, percent };

/// The shortest decimal text of an SI value in the file's unit, such that siValue gives the value back bit
/// for bit. Millimetres, milliseconds and per cent are exact because the decimal point is moved in the text
/// instead of multiplying; degrees are exact for every value that is (some double) * base::kDegree. The value
/// must be finite; zero has no sign.
std::string fileText(double value, FileUnit unit);

/// The SI value of a decimal text in the file's unit; none if the text is not one finite number.
std::optional<double> siValue(std::string_view text, FileUnit unit);

/// The rotation [w, x, y, z] of a file or as typed. People round: a length within 1 % of 1 is made 1. What
/// was written bit for bit stays so, and any other length is kept, for findProblems() to refuse.
base::Quaternion rotationOf(const std::array<double, 4>& numbers);

}  // namespace trapwright::study
