#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trapwright::geometry {

/// The lines of a text, whichever of "\n", "\r\n" and "\r" ends them; without a byte order mark.
class TextLines {
 public:
    explicit TextLines(std::string_view text);

    /// The next line without its end; none behind the last.
    std::optional<std::string_view> next();
    /// Of the line last given, from 1.
    [[nodiscard]] std::size_t number() const { return number_; }
    /// What is behind the line last given.
    [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Takes the first word, between blanks and ends of lines, off a text; empty where there is none.
std::string_view takeWord(std::string_view& text);

/// A whole word as a number: "nan" and "inf" are some, "1e999" is infinite, "12mm" is none.
std::optional<double> parseReal(std::string_view word);

/// A whole word as a whole number of the size of int.
std::optional<int> parseWhole(std::string_view word);

/// A word as a message can show it: in quotes, the first 40 characters, what is not ASCII as "?".
std::string quoteWord(std::string_view word);

}  // namespace trapwright::geometry
