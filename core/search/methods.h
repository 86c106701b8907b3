#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/search/ga/population.h"
#include "core/search/search.h"

namespace trapwright::search {

/// The ways of searching that there are. A new one is its own file, its line in kMethods, its entry in
/// methods.cpp.
enum class Method { genetic, random, exchange };

/// The methods by the names that they have in files and on the command line.
inline constexpr std::array<std::pair<std::string_view, Method>, 3> kMethods = {
    {{"genetic", Method::genetic}, {"random", Method::random}, {"exchange", Method::exchange}}};

/// What is to be known of a method without a search.
struct MethodInfo {
    std::vector<NumberInfo> traits;  // of each design
    std::vector<NumberInfo> curves;  // of each generation
};

/// The genetic algorithm tells of its strategy values, by their scope; other methods have none.
const MethodInfo& describeMethod(Method method, ga::StrategyScope scope = ga::StrategyScope::individual);

/// The trait or curve of that name, whichever method has it; null if none has.
const NumberInfo* findCurve(std::string_view key);

/// What searches are made with; each takes what it needs.
struct SearchParameters {
    std::uint64_t seed = 1;
    int populationSize = 100;  // designs a generation
    ga::GenerationParameters genetic;
};

std::unique_ptr<Search> makeSearch(Method method, DesignSpace space, const SearchParameters& parameters);

}  // namespace trapwright::search
