#include "core/workflow/judging.h"

#include <algorithm>

#include "core/study/planning.h"
#include "core/study/selection.h"
#include "core/study/track_design.h"
#include "core/study/validation.h"

namespace trapwright::workflow {

namespace {

Failure describeFailure(const base::RunControl& control, const base::Error& error) {
    if (control.cancelled()) return {FailureKind::cancelled, "Cancelled; nothing of it was kept."};
    return {FailureKind::simulation, error.message};
}

}  // namespace

Result<std::vector<study::Individual>> findCandidates(const store::StudyFile& file,
                                                      const study::StudyInputs& inputs) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto winners = file.loadWinners();
    if (!winners) return Failure{FailureKind::reading, winners.error().message};
    if (winners->empty()) {
        return Failure{FailureKind::reading,
                       "The study " + file.path().string() +
                           " has no generations to select from. Learn some first with evolve."};
    }
    const int count = inputs.settings.validation.selectionWinners;
    if (!study::isPlanned(inputs.settings.evolution)) return study::rankWinners(std::move(*winners), count);
    constexpr study::IndividualId kBestPlanned{0, 0};
    auto planned = file.loadIndividual(kBestPlanned);
    if (!planned) return Failure{FailureKind::reading, planned.error().message};
    std::vector<study::Individual> candidates =
        study::rankWinners(std::move(*winners), std::max(1, count - 1));
    const bool isKnown = std::any_of(candidates.begin(), candidates.end(), [&](const auto& candidate) {
        return candidate.record.design == planned->design;
    });
    if (!isKnown && static_cast<int>(candidates.size()) < count)
        candidates.push_back({kBestPlanned, std::move(*planned)});
    return candidates;
}

Result<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                             std::vector<study::Individual> candidates,
                                             const base::RunControl& control) {
    auto record = study::selectWinners(inputs, std::move(candidates), control);
    if (!record) return describeFailure(control, record.error());
    if (const auto saved = file.saveSelection(*record); !saved) return describeSaving(saved.error());
    record->made = {};
    return std::move(*record);
}

std::int64_t countValidationTrials(const study::StudyInputs& inputs) {
    return static_cast<std::int64_t>(inputs.part->stablePoses.size()) *
           inputs.settings.validation.trialsPerPose;
}

Result<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                const study::Individual& individual,
                                                const std::optional<trial::Goal>& expected,
                                                const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto record = study::validate(inputs, individual, expected, control);
    if (!record) return describeFailure(control, record.error());
    if (const auto saved = file.saveValidation(*record); !saved) return describeSaving(saved.error());
    record->made = {};
    return std::move(*record);
}

Result<study::RobustnessRecord> measureAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                               const study::Individual& individual,
                                               const std::optional<trial::Goal>& goal,
                                               const study::RobustnessPlan& plan,
                                               const base::RunControl& control) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{FailureKind::settings, checked.error().message};
    auto track = study::decodeTrack(inputs.settings.track, individual.record.design);
    if (!track) return Failure{FailureKind::settings, track.error().message};
    auto robustness = study::measureRobustness(
        inputs, std::make_shared<const track::Track>(std::move(*track)), goal, plan, control);
    if (!robustness) return describeFailure(control, robustness.error());
    study::RobustnessRecord record{{individual.generation, individual.individual},
                                   inputs.engine->name(),
                                   inputs.settings.box,
                                   std::move(*robustness)};
    if (const auto saved = file.saveRobustness(record); !saved) return describeSaving(saved.error());
    return record;
}

}  // namespace trapwright::workflow
