#include "core/workflow/compared_study.h"

#include <utility>

#include "core/study/selection.h"

namespace trapwright::workflow {

base::Result<study::ComparedStudy> loadCompared(const store::StudyFile& file, const std::string& name) {
    const auto settings = file.loadSettings();
    if (!settings) return settings.error();
    const auto part = file.loadPart();
    if (!part) return part.error();
    study::ComparedStudy compared;
    compared.name = name;
    compared.part = part->options.name;
    compared.seed = settings->evolution.seed;
    compared.fallsAreForgiven = study::forgivesFalls(settings->evolution);
    auto generations = file.loadSummaries();
    if (!generations) return generations.error();
    compared.generations = std::move(*generations);
    const auto winners = file.loadWinners();
    if (!winners) return winners.error();
    if (const auto* best = study::findBestWinner(*winners, compared.fallsAreForgiven)) compared.best = *best;
    const auto selections = file.loadSelections();
    if (!selections) return selections.error();
    if (!selections->empty() && !selections->back().entries.empty())
        compared.selected = selections->back().entries.front();
    return compared;
}

}  // namespace trapwright::workflow
