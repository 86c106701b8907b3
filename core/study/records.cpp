#include "core/study/records.h"

#include "core/search/pareto.h"

namespace trapwright::study {

GenerationSummary summarize(const GenerationRecord& record) {
    GenerationSummary summary{record.index, record.winner, record.statistics, record.seconds};
    for (const IndividualRecord& individual : record.individuals)
        summary.trials += individual.trials;
    summary.mendedFrom = record.mendedFrom;
    return summary;
}

std::vector<std::size_t> findParetoFront(std::span<const ScorePair> pairs, const objectives::Objective& first,
                                         const objectives::Objective& second, int least) {
    std::vector<std::size_t> compared;
    std::vector<search::TwoScores> points;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (pairs[i].trials < least) continue;
        compared.push_back(i);
        points.push_back({first.moreIsBetter ? pairs[i].first : -pairs[i].first,
                          second.moreIsBetter ? pairs[i].second : -pairs[i].second});
    }
    std::vector<std::size_t> front = search::findFront(points);
    for (std::size_t& i : front)
        i = compared[i];
    return front;
}

}  // namespace trapwright::study
