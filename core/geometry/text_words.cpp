#include "core/geometry/text_words.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace trapwright::geometry {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

std::string_view withoutPlus(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return word;
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_(text) {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kMark)) rest_.remove_prefix(kMark.size());
}

std::optional<std::string_view> TextLines::next() {
    if (rest_.empty()) return std::nullopt;
    ++number_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1), rest_.size()));
    return line;
}

std::string_view takeWord(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    return word;
}

std::optional<double> parseReal(std::string_view word) {
    word = withoutPlus(word);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) return std::nullopt;
    // Too large or too small: strtod tells which.
    if (problem == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    return problem == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<int> parseWhole(std::string_view word) {
    word = withoutPlus(word);
    int value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size() || problem != std::errc()) return std::nullopt;
    return value;
}

std::string quoteWord(std::string_view word) {
    constexpr std::size_t kMost = 40;
    std::string text(word.substr(0, kMost));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return "\"" + text + "\"";
}

}  // namespace trapwright::geometry
