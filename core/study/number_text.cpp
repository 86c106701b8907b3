#include "core/study/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/math.h"

namespace trapwright::study {

namespace {

constexpr int kMilliShift = 3;
constexpr int kPercentShift = 2;

/// digits[0].digits[1]... x 10^exponent, the shortest that gives the value back.
struct Decimal {
    bool negative = false;
    std::string digits;
    int exponent = 0;
};

Decimal shortestDecimal(double value) {
    std::array<char, 40> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value),
                                   std::chars_format::scientific)
                         .ptr;
    const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    const std::size_t mark = text.find('e');

    Decimal decimal;
    decimal.negative = value < 0.0;  // not of -0, which the neighbours of 0 degrees hold
    for (const char c : text.substr(0, mark)) {
        if (c != '.') decimal.digits += c;
    }
    std::string_view exponent = text.substr(mark + 1);
    if (exponent.front() == '+') exponent.remove_prefix(1);
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), decimal.exponent);
    return decimal;
}

std::string layOut(const Decimal& decimal) {
    std::string digits = decimal.digits;
    const int count = static_cast<int>(digits.size());
    std::string text(decimal.negative ? 1 : 0, '-');
    if (decimal.exponent < -6 || decimal.exponent > 15) {
        if (count > 1) digits.insert(1, 1, '.');
        return text.append(digits).append(1, 'e').append(std::to_string(decimal.exponent));
    }
    if (decimal.exponent < 0) {
        return text.append("0.").append(static_cast<std::size_t>(-decimal.exponent - 1), '0').append(digits);
    }
    const int whole = decimal.exponent + 1;
    if (count <= whole) return text.append(digits).append(static_cast<std::size_t>(whole - count), '0');
    digits.insert(static_cast<std::size_t>(whole), 1, '.');
    return text.append(digits);
}

std::string shiftedText(double value, int shift) {
    Decimal decimal = shortestDecimal(value);
    if (value != 0.0) decimal.exponent += shift;
    return layOut(decimal);
}

std::string degreeText(double radians) {
    // The degrees that were entered lie within a few units in the last place of the quotient: take the
    // shortest text of those that give the value back.
    constexpr int kReach = 4;
    const double middle = radians / base::kDegree;
    double candidate = middle;
    for (int i = 0; i < kReach; ++i)
        candidate = std::nextafter(candidate, -std::numeric_limits<double>::infinity());
    std::string best;
    for (int i = -kReach; i <= kReach; ++i) {
        if (candidate * base::kDegree == radians) {
            const std::string text = shiftedText(candidate, 0);
            if (best.empty() || text.size() < best.size()) best = text;
        }
        candidate = std::nextafter(candidate, std::numeric_limits<double>::infinity());
    }
    return best.empty() ? shiftedText(middle, 0) : best;
}

std::optional<double> parse(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace

std::string fileText(double value, FileUnit unit) {
    switch (unit) {
        case FileUnit::millimetre:
        case FileUnit::millisecond:
            return shiftedText(value, kMilliShift);
        case FileUnit::percent:
            return shiftedText(value, kPercentShift);
        case FileUnit::degree:
            return degreeText(value);
        case FileUnit::none:
            break;
    }
    return shiftedText(value, 0);
}

std::optional<double> siValue(std::string_view text, FileUnit unit) {
    if (unit == FileUnit::none) return parse(text);
    if (unit == FileUnit::degree) {
        const std::optional<double> degrees = parse(text);
        if (!degrees) return std::nullopt;
        return *degrees * base::kDegree;
    }

    // Move the decimal point through the exponent.
    const int shift = unit == FileUnit::percent ? kPercentShift : kMilliShift;
    const std::size_t mark = text.find_first_of("eE");
    int exponent = 0;
    if (mark != std::string_view::npos) {
        std::string_view digits = text.substr(mark + 1);
        if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
        if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    }
    return parse(std::string(text.substr(0, mark)) + "e" + std::to_string(exponent - shift));
}

base::Quaternion rotationOf(const std::array<double, 4>& numbers) {
    constexpr double kWritten = 1e-6;
    constexpr double kRounded = 1e-2;
    base::Quaternion rotation(numbers[0], numbers[1], numbers[2], numbers[3]);
    const double error = std::abs(rotation.norm() - 1.0);
    if (error > kWritten && error <= kRounded) rotation.normalize();
    return rotation;
}

}  // namespace trapwright::study
