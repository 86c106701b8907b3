#include "core/search/exchange_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/byte_archive.h"

namespace trapwright::search {

namespace {

constexpr std::uint8_t kStateVersion = 1;
constexpr std::size_t kMostKnown = 64;

// What a line is exchanged for, by their shares: the rest is drawn at random.
constexpr double kMutated = 0.5;
constexpr double kAdopted = 0.25;
constexpr double kMoved = 0.15;
constexpr double kTwice = 0.2;  // designs in which a second line is exchanged
constexpr int kTries = 20;      // to find something else

/// How much nearer to level than at random: from nearly level to rough (ga::gradePopulation).
double drawRelief(base::Random& random) {
    return std::exp(random.uniform(std::log(ga::kLeastRelief), 0.0));
}

}  // namespace

MethodInfo describeExchangeSearch(ga::StrategyScope /*scope*/) {
    return {
        {},
        {{"gain", "gain",
          "How much the track that is gone on from now was ahead of the one before it; 0: it is still the "
          "same, or one of the two left the race early.",
          "Fitness", false, 3},
         {"exchanges", "exchanges", "How often the track that is gone on from was replaced so far.",
          "Exchanges", false, 0}}};
}

ExchangeSearch::ExchangeSearch(DesignSpace space, const SearchParameters& parameters)
    : space_(std::move(space)),
      seed_(parameters.seed),
      populationSize_(parameters.populationSize),
      isGraded_(parameters.genetic.first != ga::FirstGeneration::random) {
    for (std::size_t i = 0; i < space_.dimensions.size(); ++i) {
        if (i == 0 || space_.dimensions[i].line != space_.dimensions[i - 1].line) lines_.push_back({i, 0});
        ++lines_.back().count;
    }
}

void ExchangeSearch::begin(std::span<const Proposal> proposals) {
    assert(generation_ == 0);
    for (const Proposal& proposal : proposals.first(std::min(proposals.size(), kMostKnown)))
        known_.push_back(proposal.design);
}

bool ExchangeSearch::areAlike(const Line& a, const Line& b) const {
    if (a.count != b.count) return false;
    for (std::size_t i = 0; i < a.count; ++i) {
        const Dimension& one = space_.dimensions[a.first + i];
        const Dimension& other = space_.dimensions[b.first + i];
        if (one.bits != other.bits || one.low != other.low || one.high != other.high ||
            one.unit != other.unit || one.isRelief != other.isRelief)
            return false;
    }
    return true;
}

Design ExchangeSearch::drawDesign(base::Random& random) const {
    const double relief = isGraded_ ? drawRelief(random) : 1.0;
    Design design;
    for (const Dimension& dimension : space_.dimensions) {
        const double drawn = random.uniform();
        design.push_back(
            roundToBits(dimension.isRelief ? 0.5 + relief * (drawn - 0.5) : drawn, dimension.bits));
    }
    return design;
}

void ExchangeSearch::mutate(Design& design, const Line& line, base::Random& random) const {
    mutateNumbers(std::span(design).subspan(line.first, line.count),
                  std::span(space_.dimensions).subspan(line.first, line.count), random);
}

/// Half of them nearer to level, as in a first generation.
void ExchangeSearch::redraw(Design& design, const Line& line, base::Random& random) const {
    const double relief = random.boolean() ? 1.0 : drawRelief(random);
    for (std::size_t i = line.first; i < line.first + line.count; ++i) {
        const Dimension& own = space_.dimensions[i];
        const double drawn = drawNumber(own, random);
        design[i] = own.isRelief ? roundToBits(0.5 + relief * (drawn - 0.5), own.bits) : drawn;
    }
}

/// One of any place of a design that is known, or of this one.
void ExchangeSearch::adopt(Design& design, std::size_t line, base::Random& random) const {
    const auto which = random.below(static_cast<std::uint32_t>(known_.size() + 1));
    const Design from = which < known_.size() ? known_[which] : design;
    const Line& to = lines_[line];
    const Line& other = lines_[random.below(static_cast<std::uint32_t>(lines_.size()))];
    if (!areAlike(to, other)) return;
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(other.first), other.count,
                design.begin() + static_cast<std::ptrdiff_t>(to.first));
}

/// To another place; those between move along.
void ExchangeSearch::move(Design& design, std::size_t line, base::Random& random) const {
    const std::size_t to = random.below(static_cast<std::uint32_t>(lines_.size()));
    const auto [low, high] = std::minmax(line, to);
    for (std::size_t i = low; i <= high; ++i) {
        if (!areAlike(lines_[i], lines_[line])) return;
    }
    const auto at = [&](std::size_t i) {
        return design.begin() +
               static_cast<std::ptrdiff_t>(i < lines_.size() ? lines_[i].first : space_.dimensions.size());
    };
    std::rotate(at(low), line < to ? at(low + 1) : at(high), at(high + 1));
}

Design ExchangeSearch::exchange(const Design& from, base::Random& random) const {
    Design design = from;
    for (int tried = 0; tried < kTries && design == from; ++tried) {
        const int times = random.uniform() < kTwice ? 2 : 1;
        for (int time = 0; time < times; ++time) {
            const std::size_t line = random.below(static_cast<std::uint32_t>(lines_.size()));
            const double what = random.uniform();
            if (what < kMutated) {
                mutate(design, lines_[line], random);
            } else if (what < kMutated + kAdopted) {
                adopt(design, line, random);
            } else if (what < kMutated + kAdopted + kMoved) {
                move(design, line, random);
            } else {
                redraw(design, lines_[line], random);
            }
        }
    }
    return design;
}

std::vector<Proposal> ExchangeSearch::ask() {
    asked_.clear();
    if (generation_ > 0) asked_.push_back(parent_);
    if (!challenger_.empty()) asked_.push_back(challenger_);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(populationSize_); ++i) {
        base::Random random({seed_, generation_, i, 0, base::Purpose::transition});
        if (i < asked_.size()) continue;
        if (generation_ > 0) {
            asked_.push_back(exchange(i % 2 == 1 && !challenger_.empty() ? challenger_ : parent_, random));
        } else if (known_.empty()) {
            asked_.push_back(drawDesign(random));
        } else {
            asked_.push_back(i < known_.size() ? known_[i] : exchange(known_[i % known_.size()], random));
        }
    }
    std::vector<Proposal> proposals;
    for (const Design& design : asked_)
        proposals.push_back({design});
    return proposals;
}

void ExchangeSearch::tell(std::span<const Judgement> judgements) {
    assert(judgements.size() == asked_.size());
    const auto rank = [&](std::size_t i) { return std::pair(judgements[i].trials, judgements[i].score); };
    std::size_t best = 0;
    for (std::size_t i = 1; i < judgements.size(); ++i) {
        if (rank(i) > rank(best)) best = i;
    }
    gain_ = 0.0;
    if (generation_ == 0) parent_ = asked_[known_.empty() ? best : 0];
    if (generation_ > 0 || !known_.empty()) {
        std::size_t parent = 0;
        // Of other trials, a score can be another one by itself: of few, nobody is known to be pure.
        const auto areOnSameTrials = [&](std::size_t i) {
            return judgements[i].trials == judgements[parent].trials;
        };
        const auto replaceBy = [&](std::size_t i) {
            if (areOnSameTrials(i)) gain_ += judgements[i].score - judgements[parent].score;
            ++exchanges_;
            parent_ = asked_[i];
            parent = i;
        };
        if (!challenger_.empty() && rank(1) > rank(0)) replaceBy(1);
        challenger_.clear();
        if (rank(best) > rank(parent)) {
            const double error = std::hypot(judgements[best].error, judgements[parent].error);
            if (areOnSameTrials(best) && judgements[best].score - judgements[parent].score > error) {
                replaceBy(best);
            } else {
                challenger_ = asked_[best];
            }
        }
    }
    // A state may be of any generation.
    if (generation_ < std::numeric_limits<std::uint32_t>::max()) ++generation_;
}

std::vector<NamedNumber> ExchangeSearch::report() const {
    return {{"gain", gain_}, {"exchanges", static_cast<double>(exchanges_)}};
}

std::string ExchangeSearch::save() const {
    std::vector<std::string> known;
    for (const Design& design : known_)
        known.push_back(packDesign(design));
    base::ByteWriter writer;
    writer(kStateVersion, generation_, exchanges_, packDesign(parent_), packDesign(challenger_), known);
    return writer.bytes();
}

base::Status ExchangeSearch::load(std::string_view state) {
    base::ByteReader reader(state);
    std::uint8_t version = 0;
    std::uint32_t generation = 0;
    std::uint32_t exchanges = 0;
    std::string parent;
    std::string challenger;
    std::vector<std::string> known;
    reader(version, generation, exchanges, parent, challenger, known);
    const base::Error wrong{"This is not the state of a search by exchanges in this design space."};
    if (!reader.finished() || version != kStateVersion) return wrong;
    known.push_back(parent);
    known.push_back(challenger);
    std::vector<Design> designs;
    for (const std::string& bytes : known) {
        auto design = unpackDesign(bytes);
        if (!design || (!design->empty() && !space_.check(*design))) return wrong;
        designs.push_back(std::move(*design));
    }
    Design second = std::move(designs.back());
    designs.pop_back();
    Design first = std::move(designs.back());
    designs.pop_back();
    const bool hasEmpty = std::ranges::any_of(designs, &Design::empty);
    if (hasEmpty || (generation > 0) == first.empty() || (first.empty() && !second.empty())) return wrong;
    generation_ = generation;
    exchanges_ = exchanges;
    parent_ = std::move(first);
    challenger_ = std::move(second);
    known_ = std::move(designs);
    return base::success();
}

}  // namespace trapwright::search
