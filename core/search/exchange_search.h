#pragma once

#include <cstdint>
#include <limits>

#include "core/search/methods.h"
#include "core/search/search.h"

namespace trapwright::search {

MethodInfo describeExchangeSearch(ga::StrategyScope scope);

/// Goes on from one design, the parent, by exchanging a line of it or two (Dimension::line: a trap of a
/// chain, a cross-section) in each child. A line is exchanged for one like it, for another one of the same
/// design or of a known one, moved to another place, or drawn at random. The best child, if it is ahead of
/// the parent by more than the standard error of their difference on the same trials, is the parent from then
/// on; if by less, it is the challenger, and meets the parent again in the next generation, where half of the
/// children are its own. The best of thirty is ahead by luck nearly always, and what was lucky once is hardly
/// so twice. Meant for a race whose trials are the same for all designs of a generation
/// (evolution.commonRandomNumbers): what differs between two of them is then mostly the line that was
/// exchanged. Design i of generation g draws from (seed, g, i, transition).
class ExchangeSearch : public Search {
 public:
    ExchangeSearch(DesignSpace space, const SearchParameters& parameters);

    /// The first are in generation 0 as they are, the best first: it is the parent, which others have to be
    /// ahead of as in any generation. All are known from then on, so that their lines are exchanged for
    /// others. None: designs at random, from nearly level to rough unless a first generation at random is
    /// asked for; their best is the parent.
    void begin(std::span<const Proposal> proposals) override;
    std::vector<Proposal> ask() override;
    /// Who has fewer trials than the others is behind those who have all.
    void tell(std::span<const Judgement> judgements) override;
    /// gain: how much who took the parent's place was ahead of it in this generation, on the same trials,
    /// else 0; exchanges: how many did so far.
    [[nodiscard]] std::vector<NamedNumber> report() const override;
    [[nodiscard]] std::string save() const override;
    base::Status load(std::string_view state) override;

 private:
    /// Dimensions that are exchanged together: so many from a first one on.
    struct Line {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    [[nodiscard]] bool areAlike(const Line& a, const Line& b) const;
    [[nodiscard]] Design drawDesign(base::Random& random) const;
    void mutate(Design& design, const Line& line, base::Random& random) const;
    void redraw(Design& design, const Line& line, base::Random& random) const;
    void adopt(Design& design, std::size_t line, base::Random& random) const;
    void move(Design& design, std::size_t line, base::Random& random) const;
    [[nodiscard]] Design exchange(const Design& from, base::Random& random) const;

    DesignSpace space_;
    std::vector<Line> lines_;
    std::uint64_t seed_;
    int populationSize_;
    bool isGraded_;
    std::uint32_t generation_ = 0;  // of the next ask()
    std::vector<Design> known_;     // by Search::begin
    Design parent_;                 // empty before the first tell()
    Design challenger_;             // empty: none
    std::vector<Design> asked_;     // what tell() is about
    std::uint32_t exchanges_ = 0;   // of the parent
    double gain_ = 0.0;
};

}  // namespace trapwright::search
