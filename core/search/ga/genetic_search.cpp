#include "core/search/ga/genetic_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>

#include "core/base/byte_archive.h"
#include "core/search/ranking.h"

namespace trapwright::search::ga {

namespace {

constexpr std::uint8_t kStateVersion = 1;
constexpr std::uint32_t kMostIndividuals = 10'000'000;

std::vector<NamedNumber> listed(const StrategyValues& values, StrategyScope scope) {
    std::vector<NamedNumber> numbers = {
        {"p_x", values.points.crossover}, {"p_dm", values.points.mutation}, {"p_s", values.smoothing}};
    if (scope == StrategyScope::individual) return numbers;
    numbers.push_back({"p_x2", values.singles.crossover});
    numbers.push_back({"p_dm2", values.singles.mutation});
    numbers.push_back({"p_x3", values.strategy.crossover});
    numbers.push_back({"p_dm3", values.strategy.mutation});
    return numbers;
}

}  // namespace

MethodInfo describeGeneticSearch(StrategyScope scope) {
    const std::string axis = "Probability, mean of top 30 %";
    MethodInfo info{
        {{"p_x", "crossover p_x", "Crossover rate of this individual."},
         {"p_dm", "mutation p_dm", "Dynamic mutation rate of this individual, not below its floor."},
         {"p_s", "smoothing p_s", "Smoothing rate of this individual, scaled to its limit."}},
        {{"p_x", "crossover p_x",
          "How often a child changes the parent that it copies: geometric mean of the top 30 %.", axis, true},
         {"p_dm", "mutation p_dm",
          "How often points of the surface are changed at random: geometric mean of the top 30 %.", axis,
          true},
         {"p_s", "smoothing p_s",
          "How often points of the surface are smoothed away: geometric mean of the top 30 %.", axis, true}}};
    if (scope == StrategyScope::individual) return info;
    // The three above are those of the points.
    for (const auto& [number, of, title] : {std::tuple("2", "single numbers", "Single numbers"),
                                            std::tuple("3", "strategy values", "Strategy values")}) {
        const std::string crossover = fmt::format("p_x{}", number);
        const std::string mutation = fmt::format("p_dm{}", number);
        const std::string crossoverName = fmt::format("crossover {}, {}", crossover, of);
        const std::string mutationName = fmt::format("mutation {}, {}", mutation, of);
        const std::string axisOf = fmt::format("{}, probability, mean of top 30 %", title);
        info.traits.push_back(
            {crossover, crossoverName, fmt::format("Crossover rate of this individual's {}.", of)});
        info.traits.push_back(
            {mutation, mutationName,
             fmt::format("Dynamic mutation rate of this individual's {}, not below its floor.", of)});
        info.curves.push_back({crossover, crossoverName,
                               fmt::format("How often a child changes the parent that it copies {} of: "
                                           "geometric mean of the top 30 %.",
                                           of),
                               axisOf, true});
        info.curves.push_back(
            {mutation, mutationName,
             fmt::format("How often {} are changed at random: geometric mean of the top 30 %.", of), axisOf,
             true});
    }
    return info;
}

GeneticSearch::GeneticSearch(DesignSpace space, const SearchParameters& parameters)
    : space_(std::move(space)), layout_(layOut(space_, parameters.genetic.scope)), parameters_(parameters) {}

void GeneticSearch::begin(std::span<const Proposal> proposals) {
    first_.assign(proposals.begin(), proposals.end());
}

std::vector<Proposal> GeneticSearch::ask() {
    if (asked_.empty()) {
        const Smooth smooth = [this](Chromosome child, double probability, base::Random& random) {
            if (space_.smooth)
                encodeDesign(space_.smooth(decodeDesign(child, space_), probability, random), space_, child);
            return child;
        };
        if (population_.empty()) {
            asked_ = createPopulation(layout_, parameters_.populationSize, parameters_.seed);
            if (parameters_.genetic.first != FirstGeneration::random)
                gradePopulation(asked_, space_, parameters_.seed);
            for (std::size_t i = 0; i < std::min(first_.size(), asked_.size()); ++i) {
                encodeDesign(first_[i].design, space_, asked_[i]);
                takeStrategy(first_[i].traits, asked_[i].strategy);
            }
        } else {
            asked_ = nextGeneration(population_, scores_, layout_, parameters_.genetic, smooth,
                                    parameters_.seed, generation_);
        }
    }
    std::vector<Proposal> proposals;
    proposals.reserve(asked_.size());
    for (const Chromosome& chromosome : asked_)
        proposals.push_back(
            {decodeDesign(chromosome, space_), listed(strategyOf(chromosome), layout_.scope)});
    return proposals;
}

void GeneticSearch::tell(std::span<const Judgement> judgements) {
    assert(judgements.size() == asked_.size());
    population_ = std::move(asked_);
    asked_.clear();
    scores_.clear();
    for (const Judgement& judgement : judgements)
        scores_.push_back(judgement.score);
    ++generation_;
}

std::vector<NamedNumber> GeneticSearch::report() const {
    std::vector<StrategyValues> best;
    for (const std::size_t i : findTop(scores_))
        best.push_back(strategyOf(population_[i]));
    return listed(calcGeometricMean(best), layout_.scope);
}

std::string GeneticSearch::save() const {
    return packState(generation_, population_, scores_);
}

base::Status GeneticSearch::load(std::string_view state) {
    const base::Error strange{"This is not the state of a genetic search."};
    base::ByteReader reader(state);
    std::uint8_t version = 0;
    std::uint32_t generation = 0;
    std::uint32_t count = 0;
    reader(version, generation, count);
    if (reader.failed() || version != kStateVersion || count == 0 || count > kMostIndividuals) return strange;
    std::vector<Chromosome> population;
    std::vector<double> scores;
    for (std::uint32_t i = 0; i < count && !reader.failed(); ++i) {
        Chromosome chromosome;
        for (Bits* gene : {&chromosome.points, &chromosome.singles, &chromosome.strategy}) {
            auto bits = getBits(reader);
            if (!bits) return strange;
            *gene = std::move(*bits);
        }
        if (!fits(chromosome, layout_)) {
            return base::Error{fmt::format(
                "The search's last individuals have genes of {}, {} and {} bits, which is not what "
                "these settings need. Use the settings that the study was learned with.",
                chromosome.points.size(), chromosome.singles.size(), chromosome.strategy.size())};
        }
        population.push_back(std::move(chromosome));
        reader(scores.emplace_back());
        if (std::isnan(scores.back())) return strange;
    }
    if (!reader.finished()) return strange;
    generation_ = generation;
    population_ = std::move(population);
    scores_ = std::move(scores);
    asked_.clear();
    return base::success();
}

void GeneticSearch::takeStrategy(std::span<const NamedNumber> traits, Bits& strategy) const {
    // In the order of decodeStrategy.
    constexpr std::array kKeys = {"p_x", "p_dm", "p_s", "p_x2", "p_dm2", "p_x3", "p_dm3"};
    std::vector<double> values = decodeGray(strategy, kStrategyBits);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::optional<double> known = findNumber(traits, kKeys[i]);
        if (!known) continue;
        // As limitStrategy() scaled it.
        const double limit = parameters_.genetic.transition.smoothingLimit;
        const bool isSmoothing = i == 2;
        if (!isSmoothing) values[i] = std::clamp(*known, 0.0, 1.0);
        if (isSmoothing && limit > 0.0) values[i] = std::clamp(*known / limit, 0.0, 1.0);
    }
    strategy = encodeGray(values, kStrategyBits);
}

StrategyValues GeneticSearch::strategyOf(const Chromosome& chromosome) const {
    return limitStrategy(decodeStrategy(chromosome.strategy), parameters_.genetic.transition);
}

std::string packState(std::uint32_t generation, std::span<const Chromosome> population,
                      std::span<const double> scores) {
    base::ByteWriter writer;
    writer(kStateVersion, generation, static_cast<std::uint32_t>(population.size()));
    for (std::size_t i = 0; i < population.size(); ++i) {
        for (const Bits* gene : {&population[i].points, &population[i].singles, &population[i].strategy})
            writer.appendBytes(packBits(*gene));
        writer(scores[i]);
    }
    return writer.bytes();
}

}  // namespace trapwright::search::ga
