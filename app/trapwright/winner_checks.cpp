#include "app/trapwright/winner_checks.h"

#include <fmt/format.h>

#include "app/trapwright/engines.h"
#include "app/trapwright/study_engines.h"
#include "app/trapwright/study_jobs.h"
#include "core/study/reference_check.h"

namespace trapwright::app {

namespace {

/// The reference's scores below those of the generation's line, and how they differ from the learning
/// engine's on the same trials. Adding 0 makes a -0 a 0.
std::string describeCheck(const study::CheckRecord& record) {
    const study::EngineScore& reference = record.reference;
    const study::EngineScore& learning = record.learning;
    const double percent = 100.0 / record.trials;
    return fmt::format(
        "{:>10} {:>8.3f} {:>6.0f} {:>7.3f} {:>7.3f} {:>9}   {} less {}: F_D {:+.3f}, F_O {:+.3f}, success "
        "{:.0f} % less {:.0f} %\n",
        fmt::format("check {}", record.generation), reference.fitness.total(),
        reference.fitness.collision + 0.0, reference.fitness.distance, reference.fitness.orientation,
        fmt::format("{}/{}", reference.finished, record.trials), reference.engine, learning.engine,
        reference.fitness.distance - learning.fitness.distance,
        reference.fitness.orientation - learning.fitness.orientation, percent * reference.oriented,
        percent * learning.oriented);
}

}  // namespace

WinnerChecks::WinnerChecks(store::StudyFile& file, study::StudyInputs inputs,
                           std::shared_ptr<const trial::Engine> reference)
    : file_(&file), inputs_(std::move(inputs)), reference_(std::move(reference)) {}

Attempt<std::unique_ptr<WinnerChecks>> WinnerChecks::start(store::StudyFile& file,
                                                           const study::StudyInputs& inputs) {
    const std::string& setting = inputs.settings.simulation.engine;
    const auto reference = referenceFor(setting);
    if (!reference) return std::unique_ptr<WinnerChecks>();
    auto unchecked = file.loadUncheckedWinners();
    if (!unchecked) return Failure{ExitCode::badInput, unchecked.error().message};
    auto widely = makeEngine(*reference, {inputs.threads, 0.0});
    if (!widely) return widely.failure();
    auto aside = makeEngine(*reference, {1, 0.0});
    if (!aside) return aside.failure();
    study::StudyInputs asideInputs = inputs;
    auto learning = makeEngine(engineFor(setting, EngineUse::learning), {1, 0.0});
    if (!learning) return learning.failure();
    asideInputs.engine = std::move(*learning);

    std::unique_ptr<WinnerChecks> checks(new WinnerChecks(file, inputs, std::move(*widely)));
    checks->background_ =
        std::make_unique<study::BackgroundChecks>(std::move(asideInputs), std::move(*aside));
    for (study::Winner& winner : *unchecked)
        checks->background_->add(std::move(winner));
    return checks;
}

void WinnerChecks::add(const study::GenerationRecord& record) {
    const study::IndividualRecord& winner = record.individuals[static_cast<std::size_t>(record.winner)];
    if (winner.trials > 0) background_->add({record.index, record.winner, winner});
}

base::Status WinnerChecks::save(WorkDisplay& display) {
    for (const study::CheckRecord& record : background_->takeFinished())
        if (auto saved = saveOne(record, display); !saved) return saved;
    return base::success();
}

base::Status WinnerChecks::stop(WorkDisplay& display) {
    left_ = background_->stop();
    return save(display);
}

Attempt<bool> WinnerChecks::finish(const Console& console) {
    if (left_.empty()) return true;
    std::int64_t trials = 0;
    for (const study::Winner& winner : left_)
        trials += std::int64_t{2} * study::countCheckTrials(winner);
    base::RunControl control;
    WorkDisplay display(console, watchTrials("Checking winners", trials, control));
    for (const study::Winner& winner : left_) {
        const auto record = study::checkWinner(inputs_, *reference_, winner, control);
        if (control.cancelled()) return false;
        if (!record) return Failure{ExitCode::fault, record.error().message};
        if (const auto saved = saveOne(*record, display); !saved)
            return Failure{ExitCode::cannotWrite, saved.error().message};
    }
    return true;
}

base::Status WinnerChecks::saveOne(const study::CheckRecord& record, WorkDisplay& display) {
    if (auto saved = file_->saveCheck(record); !saved) return saved;
    display.print(describeCheck(record));
    return base::success();
}

}  // namespace trapwright::app
