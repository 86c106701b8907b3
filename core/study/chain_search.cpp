#include "core/study/chain_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <utility>

namespace trapwright::study {

namespace {

constexpr std::size_t kBeam = 60;       // chains that are followed up
constexpr std::size_t kBeamOfWay = 10;  // of these, in which parts lie one way more than any other
constexpr std::size_t kImproved = 5;    // chains of these whose traps are exchanged for better ones
constexpr std::size_t kSieves = 12;
constexpr double kTrialsOfPurity = 2000.0;
constexpr double kAlike = 0.02;  // traps that leave all but half of so many parts in the same ways

void sortByWorth(std::vector<Chain>& chains) {
    std::stable_sort(chains.begin(), chains.end(),
                     [](const Chain& a, const Chain& b) { return a.worth > b.worth; });
}

}  // namespace

WayMatrix calcChances(const ChainProblem& problem, const WayMatrix& counts) {
    constexpr double kUnseenStuck = 0.2;
    const std::size_t columns = problem.columns();
    const std::size_t stuck = problem.stuck();
    WayMatrix chances(columns, WayShares(columns, 0.0));
    for (std::size_t from = 0; from < problem.rows; ++from) {
        double sum = 0.0;
        for (std::size_t to = 0; to < columns; ++to) {
            double& chance = chances[from][to];
            chance = counts[from][to];
            if (to == stuck) chance += kUnseenStuck * problem.unseenTurns;
            if (to != from && to < stuck) chance += problem.unseenTurns / static_cast<double>(problem.ways);
            sum += chance;
        }
        for (double& chance : chances[from])
            chance /= sum;
    }
    if (problem.rows == problem.ways) chances[problem.ways] = chances[0];
    chances[stuck][stuck] = 1.0;
    chances[problem.fallen()][problem.fallen()] = 1.0;
    return chances;
}

WayShares pass(const WayShares& parts, const WayMatrix& chances) {
    WayShares after(parts.size(), 0.0);
    for (std::size_t from = 0; from < parts.size(); ++from) {
        if (parts[from] == 0.0) continue;
        for (std::size_t to = 0; to < parts.size(); ++to)
            after[to] += parts[from] * chances[from][to];
    }
    return after;
}

WayShares calcUnturned(const ChainProblem& problem) {
    return problem.then.empty() ? problem.arriving : pass(problem.arriving, problem.then);
}

std::optional<double> calcWantedUnturned(const ChainProblem& problem) {
    if (problem.wanted.empty()) return std::nullopt;
    const WayShares parts = calcUnturned(problem);
    return std::accumulate(problem.wanted.begin(), problem.wanted.end(), 0.0,
                           [&](double sum, std::size_t way) { return sum + parts[way]; });
}

double ChainSearch::worthOf(const WayShares& parts) const {
    return worthOfEnd(problem_.then.empty() ? parts : pass(parts, problem_.then));
}

double ChainSearch::worthOfEnd(const WayShares& parts) const {
    constexpr double kLeast = 1.0 / 256.0;
    const auto ways = std::span(parts).first(problem_.ways);
    double wanted = 0.0;
    for (const std::size_t way : problem_.wanted)
        wanted += ways[way];
    if (!problem_.forgivesFalls) {
        const double alike = problem_.wanted.empty()
                                 ? std::inner_product(ways.begin(), ways.end(), ways.begin(), 0.0)
                                 : wanted;
        return std::log2(alike + kLeast);
    }
    const double staying = 1.0 - parts[problem_.fallen()];
    if (staying < kLeast) return std::log2(kLeast);
    const double most = problem_.wanted.empty() ? *std::max_element(ways.begin(), ways.end()) : wanted;
    if (problem_.seeksPurity) {
        // As so many trials would tell them: few parts that arrive say little, however right they are.
        const double wrong = std::max(0.0, staying - most);
        const double nines = -std::log10((wrong * kTrialsOfPurity + 1.0) / (staying * kTrialsOfPurity + 2.0));
        const double right =
            problem_.seeksYield ? std::log10((most * kTrialsOfPurity + 1.0) / (kTrialsOfPurity + 2.0)) : most;
        return nines + problem_.rightAsNines * bitsOfHalving_ / objectives::kBitsOfHalving * right;
    }
    return std::log2(most / staying + kLeast) + bitsOfHalving_ * std::log2(staying);
}

WayShares ChainSearch::repeat(const KnownTrap& trap) const {
    WayShares parts = problem_.arriving;
    for (const std::size_t kind : problem_.places) {
        if (kind == trap.kind) parts = pass(parts, trap.chances);
    }
    return parts;
}

double ChainSearch::worthInChain(const KnownTrap& trap, const Chain& chain) const {
    double most = -1e300;
    WayShares before = problem_.arriving;
    for (std::size_t place = 0; place < problem_.places.size(); ++place) {
        if (problem_.places[place] == trap.kind)
            most = std::max(most, worthOf(passOn(pass(before, trap.chances), chain, place + 1)));
        before = pass(before, traps_[chain.traps[place]].chances);
    }
    return most;
}

std::vector<WayShares> ChainSearch::listComing(const Chain& chain) const {
    std::vector<WayShares> coming;
    WayShares parts = problem_.arriving;
    for (const std::size_t used : chain.traps) {
        const double moving = std::max(1e-9, 1.0 - parts[problem_.stuck()] - parts[problem_.fallen()]);
        WayShares& shares =
            coming.emplace_back(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(problem_.rows));
        for (double& share : shares)
            share /= moving;
        parts = pass(parts, traps_[used].chances);
    }
    return coming;
}

void ChainSearch::findSieves() {
    std::vector<std::pair<double, std::size_t>> worths;
    for (std::size_t i = 0; i < traps_.size(); ++i) {
        worths.emplace_back(-worthOf(repeat(traps_[i])), i);
    }
    std::sort(worths.begin(), worths.end());
    sieves_.clear();
    for (const auto& [worth, i] : worths) {
        if (sieves_.size() < kSieves) sieves_.push_back(i);
    }
}

void ChainSearch::findChains(std::size_t niches) {
    chains_ = searchBeam(beginChain(), kBeam);
    std::set<std::size_t> ways;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
        const bool isFirst = ways.size() < niches && ways.insert(wayOf(chains_[i])).second;
        if (isFirst || i < kImproved) exchangeTraps(chains_[i], beginChain());
    }
    sortByWorth(chains_);
    niches_.clear();
    ways.clear();
    for (const Chain& chain : chains_) {
        if (niches_.size() < niches && ways.insert(wayOf(chain)).second) niches_.push_back(chain);
    }
    used_.clear();
    for (const Chain& chain : niches_) {
        const std::set<std::size_t> traps(chain.traps.begin(), chain.traps.end());
        used_.insert(used_.end(), traps.begin(), traps.end());
    }
}

std::optional<Chain> ChainSearch::complete(const Chain& begun) const {
    std::vector<Chain> beam = searchBeam(begun, kBeam);
    if (beam.empty()) return std::nullopt;
    exchangeTraps(beam.front(), begun);
    return std::move(beam.front());
}

std::vector<Chain> ChainSearch::exchangeNext(const Chain& begun, const Chain& complete,
                                             std::size_t most) const {
    const std::size_t place = begun.traps.size();
    std::vector<Chain> all;
    for (std::size_t i = 0; i < traps_.size(); ++i) {
        const double fall = complete.fall - traps_[complete.traps[place]].fall + traps_[i].fall;
        if (traps_[i].kind != problem_.places[place] || fall > problem_.mostFall) continue;
        Chain chain{complete.traps, passOn(pass(begun.parts, traps_[i].chances), complete, place + 1), 0.0,
                    fall};
        chain.traps[place] = i;
        chain.worth = worthOf(chain.parts);
        all.push_back(std::move(chain));
    }
    sortByWorth(all);
    std::vector<Chain> chains;
    std::vector<WayShares> behind;  // the next place
    for (Chain& chain : all) {
        if (chains.size() == most) break;
        WayShares parts = pass(begun.parts, traps_[chain.traps[place]].chances);
        const bool isNew = std::ranges::none_of(behind, [&](const WayShares& other) {
            return std::transform_reduce(parts.begin(), parts.end(), other.begin(), 0.0, std::plus(),
                                         [](double a, double b) { return std::abs(a - b); }) < kAlike;
        });
        if (!isNew) continue;
        behind.push_back(std::move(parts));
        chains.push_back(std::move(chain));
    }
    return chains;
}

void ChainSearch::forget(std::size_t sure, std::size_t latest) {
    std::vector<KnownTrap> kept;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < traps_.size(); ++i) {
        const bool isUsed = std::find(used_.begin(), used_.end(), i) != used_.end();
        const bool isSieve = std::find(sieves_.begin(), sieves_.end(), i) != sieves_.end();
        if (!isUsed && !isSieve && i >= sure && i + latest < traps_.size()) continue;
        if (isUsed) used.push_back(kept.size());
        kept.push_back(std::move(traps_[i]));
    }
    traps_ = std::move(kept);
    used_ = std::move(used);
    findSieves();
}

std::vector<KnownTrap> ChainSearch::leave(std::size_t sure) {
    std::set<std::size_t> kept(used_.begin(), used_.end());
    kept.insert(sieves_.begin(), sieves_.end());
    for (std::size_t i = 0; i < std::min(sure, traps_.size()); ++i)
        kept.insert(i);
    std::vector<KnownTrap> given;
    given.reserve(kept.size());
    for (const std::size_t i : kept)
        given.push_back(std::move(traps_[i]));
    traps_.clear();
    used_.clear();
    sieves_.clear();
    chains_.clear();
    niches_.clear();
    return given;
}

/// The way in which most parts lie behind it.
std::size_t ChainSearch::wayOf(const Chain& chain) const {
    const auto ways = std::span(chain.parts).first(problem_.ways);
    return static_cast<std::size_t>(std::max_element(ways.begin(), ways.end()) - ways.begin());
}

WayShares ChainSearch::passOn(WayShares parts, const Chain& chain, std::size_t place) const {
    for (; place < problem_.places.size(); ++place)
        parts = pass(parts, traps_[chain.traps[place]].chances);
    return parts;
}

Chain ChainSearch::append(const Chain& chain, std::size_t index) const {
    const KnownTrap& trap = traps_[index];
    Chain longer{chain.traps, pass(chain.parts, trap.chances), 0.0, chain.fall + trap.fall};
    longer.traps.push_back(index);
    longer.worth = worthOf(longer.parts);
    return longer;
}

Chain ChainSearch::beginChain() const {
    return {{}, problem_.arriving, worthOf(problem_.arriving), 0.0};
}

/// The best chains that begin so if so many are followed up at each place.
std::vector<Chain> ChainSearch::searchBeam(const Chain& begun, std::size_t width) const {
    std::vector<Chain> beam{begun};
    for (std::size_t place = begun.traps.size(); place < problem_.places.size(); ++place) {
        const std::size_t kind = problem_.places[place];
        std::vector<Chain> next;
        for (const Chain& chain : beam) {
            for (std::size_t i = 0; i < traps_.size(); ++i) {
                const KnownTrap& trap = traps_[i];
                if (trap.kind != kind || chain.fall + trap.fall > problem_.mostFall) continue;
                next.push_back(append(chain, i));
            }
        }
        sortByWorth(next);
        beam.clear();
        std::vector<std::size_t> ofWay(problem_.ways, 0);
        for (Chain& chain : next) {
            if (beam.size() == width) break;
            std::size_t& alike = ofWay[wayOf(chain)];
            // Chains of the same worth are the same traps in another order.
            constexpr double kSame = 1e-9;
            if (alike == kBeamOfWay || (!beam.empty() && beam.back().worth - chain.worth <= kSame)) continue;
            ++alike;
            beam.push_back(std::move(chain));
        }
    }
    return beam;
}

/// Exchanges the one trap behind those that it begins with for the one other that makes a chain worth most,
/// as long as it gains.
void ChainSearch::exchangeTraps(Chain& chain, const Chain& begun) const {
    constexpr double kGain = 1e-6;
    const std::vector<std::size_t>& places = problem_.places;
    for (bool gained = true; gained;) {
        gained = false;
        Chain best = chain;
        WayShares before = begun.parts;
        for (std::size_t place = begun.traps.size(); place < places.size(); ++place) {
            const KnownTrap& current = traps_[chain.traps[place]];
            for (std::size_t i = 0; i < traps_.size(); ++i) {
                const double fall = chain.fall - current.fall + traps_[i].fall;
                if (traps_[i].kind != places[place] || fall > problem_.mostFall) continue;
                WayShares parts = passOn(pass(before, traps_[i].chances), chain, place + 1);
                const double worth = worthOf(parts);
                if (worth <= best.worth + kGain) continue;
                best = {chain.traps, std::move(parts), worth, fall};
                best.traps[place] = i;
                gained = true;
            }
            before = pass(before, current.chances);
        }
        chain = std::move(best);
    }
}

}  // namespace trapwright::study
