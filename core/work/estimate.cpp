#include "core/work/estimate.h"

#include <algorithm>
#include <chrono>

#include "core/evolution/population.h"
#include "core/study/track_design.h"

namespace trapwright::work {

base::Result<double> estimateLearning(const study::StudyInputs& inputs, double budget,
                                      const base::RunControl& control) {
    using Clock = std::chrono::steady_clock;
    if (const auto checked = study::checkInputs(inputs); !checked) return checked.error();
    const study::EvolutionSettings& evolution = inputs.settings.evolution;
    const auto population = evolution::createPopulation(study::chromosomeLayout(inputs.settings.track),
                                                        evolution.populationSize, evolution.seed);
    // The more at once, the better all threads are used, as they will be by a whole generation.
    std::size_t count = std::min<std::size_t>(population.size(), std::size_t{2} * inputs.threads);
    while (true) {
        const Clock::time_point begin = Clock::now();
        const auto some = study::evaluateGeneration(
            inputs, 0, std::span(population).first(count), [](const study::GenerationPlan&) {}, control);
        if (!some) return some.error();
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        if (2.0 * seconds >= budget || count == population.size())
            return seconds / static_cast<double>(count) * evolution.populationSize * evolution.generations;
        // As many as should take what is left; the next pass is the last or nearly so.
        const double factor = std::clamp(budget / std::max(seconds, 1e-3), 2.0, 16.0);
        count = std::min(population.size(), static_cast<std::size_t>(factor * static_cast<double>(count)));
    }
}

}  // namespace trapwright::work
