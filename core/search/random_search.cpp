#include "core/search/random_search.h"

#include <algorithm>
#include <cmath>

#include "core/base/byte_archive.h"
#include "core/stats/samples.h"

namespace trapwright::search {

namespace {

constexpr std::uint8_t kStateVersion = 1;

}  // namespace

MethodInfo describeRandomSearch(ga::StrategyScope /*scope*/) {
    return {{},
            {{"best_so_far", "best so far", "The best fitness of all generations up to here.", "Fitness",
              false, 3},
             {"median_score", "median", "The median fitness of the generation.", "Fitness", false, 3}}};
}

RandomSearch::RandomSearch(DesignSpace space, const SearchParameters& parameters)
    : space_(std::move(space)), seed_(parameters.seed), populationSize_(parameters.populationSize) {}

std::vector<Proposal> RandomSearch::ask() {
    std::vector<Proposal> proposals(static_cast<std::size_t>(populationSize_));
    for (std::uint32_t i = 0; i < proposals.size(); ++i) {
        base::Random random({seed_, generation_, i, 0, base::Purpose::randomDesign});
        Design& design = proposals[i].design;
        design.reserve(space_.dimensions.size());
        for (const Dimension& dimension : space_.dimensions) {
            if (dimension.bits == 0) {
                design.push_back(random.uniform());
            } else {
                const std::uint32_t count = std::uint32_t{1} << static_cast<unsigned>(dimension.bits);
                design.push_back(static_cast<double>(random.below(count)) / (count - 1));
            }
        }
    }
    return proposals;
}

void RandomSearch::tell(std::span<const Judgement> judgements) {
    std::vector<double> scores;
    for (const Judgement& judgement : judgements)
        scores.push_back(judgement.score);
    best_ = std::max(best_, *std::max_element(scores.begin(), scores.end()));
    median_ = stats::medianOf(scores);
    ++generation_;
}

std::vector<NamedNumber> RandomSearch::report() const {
    return {{"best_so_far", best_}, {"median_score", median_}};
}

std::string RandomSearch::save() const {
    base::ByteWriter writer;
    writer(kStateVersion, generation_, best_);
    return writer.bytes();
}

base::Status RandomSearch::load(std::string_view state) {
    base::ByteReader reader(state);
    std::uint8_t version = 0;
    std::uint32_t generation = 0;
    double best = 0.0;
    reader(version, generation, best);
    if (!reader.finished() || version != kStateVersion || std::isnan(best))
        return base::Error{"This is not the state of a random search."};
    generation_ = generation;
    best_ = best;
    return base::success();
}

}  // namespace trapwright::search
