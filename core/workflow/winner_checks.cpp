#include "core/workflow/winner_checks.h"

#include "core/study/reference_check.h"

namespace trapwright::workflow {

WinnerChecks::WinnerChecks(store::StudyFile& file, std::unique_ptr<study::BackgroundChecks> background)
    : file_(&file), background_(std::move(background)) {}

Result<std::unique_ptr<WinnerChecks>> WinnerChecks::start(store::StudyFile& file,
                                                          const study::StudyInputs& inputs,
                                                          const trial::EngineRegistry& engines,
                                                          const base::RunControl& control) {
    const trial::EngineKind* reference = engines.referenceFor(inputs.settings.simulation.engine);
    if (reference == nullptr) return std::unique_ptr<WinnerChecks>();
    auto unchecked = file.loadUncheckedWinners();
    if (!unchecked) return Failure{FailureKind::reading, unchecked.error().message};
    study::StudyInputs aside = inputs;
    const trial::EngineOptions options{1, 0.0, nullptr, inputs.remade};
    aside.engine = engines.make(engines.quick().name, options).value();

    auto background = std::make_unique<study::BackgroundChecks>(
        std::move(aside), engines.make(reference->name, options).value(), control);
    for (study::Individual& winner : *unchecked)
        background->add(std::move(winner));
    return std::unique_ptr<WinnerChecks>(new WinnerChecks(file, std::move(background)));
}

void WinnerChecks::add(const study::GenerationRecord& record) {
    const study::IndividualRecord& winner = record.individuals[static_cast<std::size_t>(record.winner)];
    if (winner.trials > 0) background_->add({{record.index, record.winner}, winner});
}

base::Status WinnerChecks::save(const CheckSaved& saved) {
    for (const study::CheckRecord& record : background_->takeFinished()) {
        if (auto status = file_->saveCheck(record); !status) return status;
        if (saved) saved(record);
    }
    return base::success();
}

base::Result<std::vector<study::Individual>> WinnerChecks::stop(const CheckSaved& saved) {
    std::vector<study::Individual> left = background_->stop();
    if (auto status = save(saved); !status) return status.error();
    return left;
}

std::int64_t countCheckTrials(const std::vector<study::Individual>& winners) {
    std::int64_t trials = 0;
    for (const study::Individual& winner : winners)
        trials += std::int64_t{2} * study::countCheckTrials(winner);
    return trials;
}

Result<std::monostate> checkWinners(store::StudyFile& file, const study::StudyInputs& inputs,
                                    const trial::EngineRegistry& engines,
                                    const std::vector<study::Individual>& winners, const CheckSaved& saved,
                                    const base::RunControl& control) {
    const trial::EngineKind* reference = engines.referenceFor(inputs.settings.simulation.engine);
    if (reference == nullptr || winners.empty()) return std::monostate{};
    const auto engine = engines.make(reference->name, {inputs.threads, 0.0, nullptr, inputs.remade}).value();
    for (const study::Individual& winner : winners) {
        const auto record = study::checkWinner(inputs, *engine, winner, control);
        if (control.cancelled())
            return Failure{FailureKind::cancelled, "The checks of winners were cancelled."};
        if (!record) return Failure{FailureKind::simulation, record.error().message};
        if (const auto status = file.saveCheck(*record); !status) return describeSaving(status.error());
        if (saved) saved(*record);
    }
    return std::monostate{};
}

}  // namespace trapwright::workflow
