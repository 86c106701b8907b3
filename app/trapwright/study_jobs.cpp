#include "app/trapwright/study_jobs.h"

#include <algorithm>
#include <optional>

#include "app/trapwright/work_display.h"
#include "core/study/selection.h"
#include "core/study/validation.h"

namespace trapwright::app {

Failure describeRunFailure(const base::RunControl& control, const base::Error& error) {
    if (control.cancelled()) return {ExitCode::interrupted, "Interrupted; nothing of it was kept."};
    return {ExitCode::fault, error.message};
}

Attempt<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                              const Console& console) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    auto winners = file.loadWinners();
    if (!winners) return Failure{ExitCode::badInput, winners.error().message};
    if (winners->empty()) {
        return Failure{ExitCode::badInput,
                       "The study " + file.path().string() +
                           " has no generations to select from. Learn some first with evolve."};
    }
    const study::ValidationSettings& settings = inputs.settings.validation;
    const std::size_t candidates = study::rankWinners(*winners, settings.selectionWinners).size();

    base::RunControl control;
    auto record = [&] {
        const WorkDisplay display(
            console, watchTrials("Selection",
                                 static_cast<std::int64_t>(candidates) * settings.selectionTrials, control));
        return study::selectWinners(inputs, std::move(*winners), control);
    }();
    if (!record) return describeRunFailure(control, record.error());
    if (const auto saved = file.saveSelection(*record); !saved)
        return Failure{ExitCode::cannotWrite, saved.error().message};
    return std::move(*record);
}

Attempt<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                 const study::Winner& individual,
                                                 const std::optional<base::Quaternion>& expected,
                                                 const Console& console) {
    if (const auto checked = study::checkInputs(inputs); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    const auto poses = static_cast<std::int64_t>(inputs.part->stablePoses.size());
    base::RunControl control;
    auto record = [&] {
        const WorkDisplay display(
            console, watchTrials("Validation", poses * inputs.settings.validation.trialsPerPose, control));
        return study::validate(inputs, individual, expected, control);
    }();
    if (!record) return describeRunFailure(control, record.error());
    if (const auto saved = file.saveValidation(*record); !saved)
        return Failure{ExitCode::cannotWrite, saved.error().message};
    return std::move(*record);
}

}  // namespace trapwright::app
