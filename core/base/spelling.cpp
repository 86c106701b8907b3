#include "core/base/spelling.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace trapwright::base {

namespace {

char small(char letter) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

}  // namespace

std::size_t calcEditDistance(std::string_view a, std::string_view b) {
    // Three rows of the table are enough: a swap reaches back two.
    std::vector<std::size_t> beforeLast(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(beforeLast, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool equal = small(a[i - 1]) == small(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
            if (i > 1 && j > 1 && small(a[i - 1]) == small(b[j - 2]) && small(a[i - 2]) == small(b[j - 1]))
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::optional<std::string> findNearestName(std::string_view word, std::span<const std::string> names) {
    const auto nearest = std::ranges::min_element(
        names, {}, [word](const std::string& name) { return calcEditDistance(word, name); });
    if (nearest == names.end()) return std::nullopt;
    return *nearest;
}

std::string suggestName(std::string_view word, std::span<const std::string> names) {
    const auto nearest = findNearestName(word, names);
    if (!nearest) return {};
    const std::size_t slips = 1 + std::max(word.size(), nearest->size()) / 4;
    if (calcEditDistance(word, *nearest) <= slips) return "Did you mean \"" + *nearest + "\"?";
    return "The nearest is \"" + *nearest + "\".";
}

std::vector<std::string_view> splitNames(std::string_view list) {
    constexpr std::string_view kBlanks = " \t";
    std::vector<std::string_view> names;
    std::size_t begin = 0;
    while (begin <= list.size()) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        std::string_view name = list.substr(begin, end - begin);
        const std::size_t first = std::min(name.find_first_not_of(kBlanks), name.size());
        name.remove_prefix(first);
        name = name.substr(0, name.find_last_not_of(kBlanks) + 1);
        names.push_back(name);
        begin = end + 1;
    }
    return names;
}

}  // namespace trapwright::base
