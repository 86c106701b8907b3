#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trapwright::base {

/// How many letters must be put in, left out, changed or swapped with their neighbour to get from one word to
/// the other, no place being touched twice (the restricted Damerau-Levenshtein distance; G. Navarro, "A
/// guided tour to approximate string matching", ACM Computing Surveys 33, 2001). Capitals count as small
/// letters.
std::size_t calcEditDistance(std::string_view a, std::string_view b);

/// The name with the smallest distance from the word, the first of equals. Empty where there are no names.
std::optional<std::string> findNearestName(std::string_view word, std::span<const std::string> names);

/// What to tell somebody who wrote a name that there is not: "Did you mean x?" where a name is near enough
/// for a slip of the hand, or else that x is the nearest. Empty where there are no names.
std::string suggestName(std::string_view word, std::span<const std::string> names);

/// The names of a list with commas between them, without the blanks around them; at least one, which may be
/// empty.
std::vector<std::string_view> splitNames(std::string_view list);

}  // namespace trapwright::base
