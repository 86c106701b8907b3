#pragma once

#include <cstdint>
#include <limits>

#include "core/search/methods.h"
#include "core/search/search.h"

namespace trapwright::search {

MethodInfo describeRandomSearch(ga::StrategyScope scope);

/// Designs at random, each number uniform and independent of all others: what any other search must beat for
/// the same number of trials. Design i of generation g draws from (seed, g, i, randomDesign).
class RandomSearch : public Search {
 public:
    RandomSearch(DesignSpace space, const SearchParameters& parameters);

    std::vector<Proposal> ask() override;
    void tell(std::span<const Judgement> judgements) override;
    /// best_so_far: the best score of all generations; median_score: of this one.
    [[nodiscard]] std::vector<NamedNumber> report() const override;
    [[nodiscard]] std::string save() const override;
    base::Status load(std::string_view state) override;

 private:
    DesignSpace space_;
    std::uint64_t seed_;
    int populationSize_;
    std::uint32_t generation_ = 0;  // of the next ask()
    double best_ = -std::numeric_limits<double>::infinity();
    double median_ = 0.0;
};

}  // namespace trapwright::search
