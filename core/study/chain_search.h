#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/objectives/success_share.h"

namespace trapwright::study {

/// Chains of traps by arithmetic alone (learning.md). Parts in a groove lie in one of a few ways; what a trap
/// does is a matrix of the probabilities with which it takes each way to others, and what a chain does is the
/// product of its matrices.

/// What becomes of parts: shares or numbers in each way; in none of them (other); stuck; fallen.
using WayShares = std::vector<double>;
/// From each way, and from others where parts are tried from them, to where: numbers of trials. As
/// probabilities they have a row for each column, and rows sum up to 1.
using WayMatrix = std::vector<WayShares>;

/// A trap that is known by itself.
struct KnownTrap {
    std::size_t kind = 0;         // as ChainProblem::places counts them
    std::vector<double> numbers;  // its part of a design
    WayMatrix counts;
    WayMatrix chances;  // calcChances(counts)
    double fall = 0.0;  // of the track, from its beginning to its end [m]
};

/// A chain: traps of a ChainSearch, one for each place, and where parts are behind it.
struct Chain {
    std::vector<std::size_t> traps;
    WayShares parts;
    double worth = 0.0;  // minus bits, or nines (ChainSearch::worthOf)
    double fall = 0.0;   // of the track [m]
};

/// What chains are searched for.
struct ChainProblem {
    std::size_t ways = 0;
    std::size_t rows = 0;               // that traps are tried from: `ways`, or one more, the others
    WayShares arriving;                 // at the first trap
    std::vector<std::size_t> places;    // the kind of each trap, along the track
    double mostFall = 0.0;              // of a chain, so that it stays within the track's height [m]
    bool forgivesFalls = false;         // what falls off comes again
    bool seeksPurity = false;           // then: few wrong ones count by their nines, not by bits
    double rightAsNines = 1.0;          // then: what all right is worth besides
    bool seeksYield = false;            // then: or ten times as many right ones
    double unseenTurns = 1.0;           // trials from each way that are taken to end in others
    std::vector<std::size_t> wanted{};  // ways in which parts shall lie; none: in any one
    /// From each way to those in which parts lie behind what follows all chains: these count, and are what is
    /// wanted; others are no way of theirs. None: nothing follows.
    WayMatrix then{};

    [[nodiscard]] std::size_t stuck() const { return ways + 1; }
    [[nodiscard]] std::size_t fallen() const { return ways + 2; }
    [[nodiscard]] std::size_t columns() const { return ways + 3; }
};

/// Counts as probabilities. A few trials that none saw spoil what few trials make look perfect: parts may
/// always get stuck or be turned.
WayMatrix calcChances(const ChainProblem& problem, const WayMatrix& counts);

/// Where so many parts are behind what has these chances.
WayShares pass(const WayShares& parts, const WayMatrix& chances);
/// The ways in which parts would end if no trap of the chain did anything.
WayShares calcUnturned(const ChainProblem& problem);
/// The share of them that is wanted; none: nothing is, or no way.
std::optional<double> calcWantedUnturned(const ChainProblem& problem);

/// The traps that are known, and the best chains of them.
class ChainSearch {
 public:
    ChainSearch() = default;
    explicit ChainSearch(ChainProblem problem) : problem_(std::move(problem)) {}

    [[nodiscard]] const ChainProblem& problem() const { return problem_; }
    /// What halving the parts costs from now on; in bits, as objectives::kBitsOfHalving. Where purity is
    /// sought right parts count by as much more.
    void setBitsOfHalving(double bits) { bitsOfHalving_ = bits; }

    /// Whether right parts count by their logarithm from now on, where purity is sought.
    void seekYield(bool seeks) { problem_.seeksYield = seeks; }

    std::vector<KnownTrap>& traps() { return traps_; }
    [[nodiscard]] const std::vector<KnownTrap>& traps() const { return traps_; }
    /// The best chains that were found last, best first.
    [[nodiscard]] const std::vector<Chain>& chains() const { return chains_; }
    /// Of these the best for each of the ways that most parts can be brought to.
    [[nodiscard]] const std::vector<Chain>& niches() const { return niches_; }
    /// The traps of the niches, those of one after the other; what two have in common twice.
    [[nodiscard]] const std::vector<std::size_t>& used() const { return used_; }
    /// Those that would be worth most one after the other, at every place of their kind: what throws one way
    /// out and lets another pass does it better every time, even where the best chain of today uses others.
    [[nodiscard]] const std::vector<std::size_t>& sieves() const { return sieves_; }

    /// Minus the bits of objectives::sorting() where falls are forgiven, else of objectives::disorder();
    /// where ways are wanted, of the share that lies so. Where purity is sought as nines,
    /// objectives::purity() as 2000 parts would tell it, and the share of right ones of all or, where yield
    /// is sought, objectives::yield().
    [[nodiscard]] double worthOf(const WayShares& parts) const;
    /// Where parts are behind as many of these as there are places of their kind.
    [[nodiscard]] WayShares repeat(const KnownTrap& trap) const;
    /// Of a chain if this trap took the place that suits it most.
    [[nodiscard]] double worthInChain(const KnownTrap& trap, const Chain& chain) const;
    /// Of the parts that come to each trap of a chain, the shares that lie in each way.
    [[nodiscard]] std::vector<WayShares> listComing(const Chain& chain) const;

    void findSieves();
    /// Finds chains(), niches() of so many ways at most, and used(): a beam search from the first trap on,
    /// whose best chains, and the best for each of so many ways, then have traps exchanged.
    void findChains(std::size_t niches);
    /// The best chain that begins with this one; its parts, worth and fall are told from there on. None if
    /// none is low enough.
    [[nodiscard]] std::optional<Chain> complete(const Chain& begun) const;
    /// The chains, best first and `most` at most, that differ from a complete one in the trap behind those
    /// that `begun` has, and in what that does to its parts.
    [[nodiscard]] std::vector<Chain> exchangeNext(const Chain& begun, const Chain& complete,
                                                  std::size_t most) const;
    /// Where the parts of a chain are at its end if they are so before one of its places.
    [[nodiscard]] WayShares passOn(WayShares parts, const Chain& chain, std::size_t place) const;
    /// Keeps the first `sure` traps, those that are used or sieves, and so many of the latest.
    void forget(std::size_t sure, std::size_t latest);
    /// Gives away the traps that are used or sieves, and the first `sure` ones, and begins with nothing.
    std::vector<KnownTrap> leave(std::size_t sure);

 private:
    [[nodiscard]] double worthOfEnd(const WayShares& parts) const;
    [[nodiscard]] std::size_t wayOf(const Chain& chain) const;
    [[nodiscard]] Chain append(const Chain& chain, std::size_t index) const;
    [[nodiscard]] Chain beginChain() const;
    [[nodiscard]] std::vector<Chain> searchBeam(const Chain& begun, std::size_t width) const;
    void exchangeTraps(Chain& chain, const Chain& begun) const;

    ChainProblem problem_;
    double bitsOfHalving_ = objectives::kBitsOfHalving;
    std::vector<KnownTrap> traps_;
    std::vector<std::size_t> used_;
    std::vector<std::size_t> sieves_;
    std::vector<Chain> chains_;
    std::vector<Chain> niches_;
};

}  // namespace trapwright::study
