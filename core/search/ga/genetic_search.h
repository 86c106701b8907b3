#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/search/ga/genes.h"
#include "core/search/ga/population.h"
#include "core/search/methods.h"
#include "core/search/search.h"

namespace trapwright::search::ga {

/// p_x, p_dm and p_s, of each individual and of a generation; by gene these are of the points, and p_x and
/// p_dm of genes 2 and 3 follow.
MethodInfo describeGeneticSearch(StrategyScope scope);

/// The paper's self-adaptive genetic algorithm (sections 4 and 5). Numbers of points are its gene 1, all
/// others its gene 2. Traits are an individual's strategy values as they take effect; curves their geometric
/// means over the best kTopShare of a generation (Figure 7).
class GeneticSearch : public Search {
 public:
    GeneticSearch(DesignSpace space, const SearchParameters& parameters);

    /// The first individuals of generation 0 have these designs, as many as there are individuals at most,
    /// and the strategy values among their traits.
    void begin(std::span<const Proposal> proposals) override;
    std::vector<Proposal> ask() override;
    void tell(std::span<const Judgement> judgements) override;
    [[nodiscard]] std::vector<NamedNumber> report() const override;
    [[nodiscard]] std::string save() const override;
    base::Status load(std::string_view state) override;

 private:
    void takeStrategy(std::span<const NamedNumber> traits, Bits& strategy) const;
    [[nodiscard]] StrategyValues strategyOf(const Chromosome& chromosome) const;

    DesignSpace space_;
    ChromosomeLayout layout_;
    SearchParameters parameters_;
    std::vector<Proposal> first_;         // of begin()
    std::uint32_t generation_ = 0;        // of the next ask()
    std::vector<Chromosome> population_;  // the last that was told of; none at first
    std::vector<double> scores_;          // theirs
    std::vector<Chromosome> asked_;       // of ask(); empty if that is still to be called
};

/// What save() gives after a generation whose individuals had these scores: for studies of programs that kept
/// the genes instead. `generation` is the one that comes next.
std::string packState(std::uint32_t generation, std::span<const Chromosome> population,
                      std::span<const double> scores);

}  // namespace trapwright::search::ga
