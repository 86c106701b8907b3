#include "core/search/methods.h"

#include <algorithm>

#include "core/search/exchange_search.h"
#include "core/search/ga/genetic_search.h"
#include "core/search/random_search.h"

namespace trapwright::search {

namespace {

/// All that is known of a method, one for each, in the order of kMethods.
struct Entry {
    Method method;
    MethodInfo (*describe)(ga::StrategyScope scope);
    std::unique_ptr<Search> (*make)(DesignSpace space, const SearchParameters& parameters);
};

template <class Kind>
std::unique_ptr<Search> make(DesignSpace space, const SearchParameters& parameters) {
    return std::make_unique<Kind>(std::move(space), parameters);
}

constexpr std::array<Entry, kMethods.size()> kEntries = {
    {{Method::genetic, &ga::describeGeneticSearch, &make<ga::GeneticSearch>},
     {Method::random, &describeRandomSearch, &make<RandomSearch>},
     {Method::exchange, &describeExchangeSearch, &make<ExchangeSearch>}}};

const Entry& entryOf(Method method) {
    return *std::find_if(kEntries.begin(), kEntries.end(),
                         [&](const Entry& entry) { return entry.method == method; });
}

}  // namespace

std::optional<double> findNumber(std::span<const NamedNumber> numbers, std::string_view key) {
    const auto found = std::find_if(numbers.begin(), numbers.end(),
                                    [&](const NamedNumber& number) { return number.key == key; });
    if (found == numbers.end()) return std::nullopt;
    return found->value;
}

const MethodInfo& describeMethod(Method method, ga::StrategyScope scope) {
    using Scopes = std::array<MethodInfo, ga::kStrategyScopes.size()>;
    static const auto all = [] {
        std::array<Scopes, kEntries.size()> infos;
        for (std::size_t i = 0; i < kEntries.size(); ++i) {
            for (const auto& [name, one] : ga::kStrategyScopes)
                infos[i][static_cast<std::size_t>(one)] = kEntries[i].describe(one);
        }
        return infos;
    }();
    return all[static_cast<std::size_t>(&entryOf(method) - kEntries.data())][static_cast<std::size_t>(scope)];
}

const NumberInfo* findCurve(std::string_view key) {
    for (const auto& [name, method] : kMethods) {
        for (const auto& [scopeName, scope] : ga::kStrategyScopes) {
            for (const NumberInfo& curve : describeMethod(method, scope).curves)
                if (curve.key == key) return &curve;
        }
    }
    return nullptr;
}

std::unique_ptr<Search> makeSearch(Method method, DesignSpace space, const SearchParameters& parameters) {
    return entryOf(method).make(std::move(space), parameters);
}

}  // namespace trapwright::search
