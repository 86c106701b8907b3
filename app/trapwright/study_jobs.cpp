#include "app/trapwright/study_jobs.h"

#include <nlohmann/json.hpp>

#include "app/trapwright/json_records.h"
#include "app/trapwright/work_display.h"
#include "core/study/selection.h"
#include "core/workflow/judging.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

Failure toFailure(const workflow::Failure& failure) {
    switch (failure.kind) {
        case workflow::FailureKind::settings:
            return {ExitCode::usage, failure.message};
        case workflow::FailureKind::reading:
            return {ExitCode::badInput, failure.message};
        case workflow::FailureKind::saving:
            return {ExitCode::cannotWrite, failure.message};
        case workflow::FailureKind::notSolid:
            return {ExitCode::no, failure.message};
        case workflow::FailureKind::cancelled:
            return {ExitCode::interrupted, "Interrupted; nothing of it was kept."};
        case workflow::FailureKind::simulation:
            break;
    }
    return {ExitCode::fault, failure.message};
}

Failure toFailure(const workflow::Failure& failure, const store::StudyFile& file) {
    Failure told = toFailure(failure);
    if (failure.kind != workflow::FailureKind::saving || file.checkInPlace()) return told;
    const auto rescued = file.rescue();
    told.message += rescued ? " The copy is " + rescued->string() + "."
                            : " It could not be copied: " + rescued.error().message;
    return told;
}

Failure describeRunFailure(const base::RunControl& control, const base::Error& error) {
    if (control.cancelled()) return {ExitCode::interrupted, "Interrupted; nothing of it was kept."};
    return {ExitCode::fault, error.message};
}

Attempt<ExitCode> addSlices(const OpenStudy& study, const workflow::TrialsRequest& request,
                            const Console& console, nlohmann::ordered_json& document) {
    const auto stored = workflow::findStoredTrials(study.file, study.settings, engines::registry(), request);
    if (!stored) return Failure{ExitCode::badInput, stored.error().message};
    const auto slices = workflow::sliceTrials(study.settings, study.part, request, *stored);
    if (!slices) return Failure{ExitCode::badInput, slices.error().message};
    if (slices->empty()) return ExitCode::ok;
    console.print('\n' + study::formatSlices(*slices));
    document["conditions"] = toJson(*slices);
    return ExitCode::ok;
}

void noteRemadeTrials(const study::StudyInputs& inputs, const Console& console) {
    if (inputs.remade && inputs.remade->count() > 0) console.note(trial::describe(inputs.remade->list()));
}

void addRemadeTrials(const study::StudyInputs& inputs, nlohmann::ordered_json& document) {
    if (!inputs.remade || inputs.remade->count() == 0) return;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const trial::RemadeTrial& one : inputs.remade->list())
        list.push_back(toJson(one));
    document["remade_trials"] = std::move(list);
}

Attempt<study::SelectionRecord> selectAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                              const Console& console) {
    auto candidates = workflow::findCandidates(file, inputs);
    if (!candidates) return toFailure(candidates.error());
    const auto trials =
        static_cast<std::int64_t>(candidates->size()) *
        (inputs.settings.validation.selectionTrials + study::countCornerTrials(inputs.settings));
    const base::RunControl control;
    auto record = [&] {
        const WorkDisplay display(console, watchTrials("Selection", trials, control));
        return workflow::selectAndSave(file, inputs, std::move(*candidates), control);
    }();
    if (!record) return toFailure(record.error(), file);
    noteRemadeTrials(inputs, console);
    return std::move(*record);
}

Attempt<study::ValidationRecord> validateAndSave(store::StudyFile& file, const study::StudyInputs& inputs,
                                                 const study::Individual& individual,
                                                 const std::optional<trial::Goal>& expected,
                                                 const Console& console) {
    const base::RunControl control;
    auto record = [&] {
        const WorkDisplay display(
            console, watchTrials("Validation", workflow::countValidationTrials(inputs), control));
        return workflow::validateAndSave(file, inputs, individual, expected, control);
    }();
    if (!record) return toFailure(record.error(), file);
    noteRemadeTrials(inputs, console);
    return std::move(*record);
}

}  // namespace trapwright::app
