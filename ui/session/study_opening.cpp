#include "ui/session/study_opening.h"

#include <utility>

namespace trapwright::session {

namespace {

base::Result<std::optional<study::Individual>> readChosen(const store::StudyFile& file) {
    const auto place = file.loadChosenWinner();
    if (!place) return place.error();
    if (!*place) return std::optional<study::Individual>();
    auto record = file.loadIndividual(**place);
    if (!record) return record.error();
    return std::optional(study::Individual{**place, std::move(*record)});
}

}  // namespace

base::Result<OpenedStudy> readStudy(store::StudyFile file) {
    auto design = workflow::loadDesign(file);
    if (!design) return design.error();
    auto summaries = file.loadSummaries();
    if (!summaries) return summaries.error();
    auto winners = file.loadWinners();
    if (!winners) return winners.error();
    auto checks = file.loadChecks();
    if (!checks) return checks.error();
    auto selections = file.loadSelections();
    if (!selections) return selections.error();
    auto validations = file.loadValidations();
    if (!validations) return validations.error();
    auto physical = file.loadPhysicalValidations();
    if (!physical) return physical.error();
    auto calibrations = file.loadCalibrations();
    if (!calibrations) return calibrations.error();
    auto dropTests = file.loadDropTests();
    if (!dropTests) return dropTests.error();
    auto chosen = readChosen(file);
    if (!chosen) return chosen.error();
    auto robustness = file.loadRobustness();
    if (!robustness) return robustness.error();
    auto streams = file.loadStreams();
    if (!streams) return streams.error();
    auto known = file.loadKnownTracks();
    if (!known) return known.error();
    auto study = readNewStudy(std::move(file), std::move(*design));
    if (!study) return study;
    study->records = {std::move(*summaries),    std::move(*winners),     std::move(*checks),
                      std::move(*selections),   std::move(*validations), std::move(*physical),
                      std::move(*calibrations), std::move(*dropTests),   std::move(*chosen),
                      std::move(*robustness),   std::move(*streams),     std::move(*known)};
    return study;
}

base::Result<OpenedStudy> readNewStudy(store::StudyFile file, workflow::StudyDesign design) {
    auto reader = store::StudyFile::openReadOnly(file.path());
    if (!reader) return reader.error();
    auto ledger = file.openBeside();
    if (!ledger) return ledger.error();
    return OpenedStudy{std::move(file), std::move(*reader), std::move(*ledger), std::move(design), {}};
}

void StudyOpening::start(const std::filesystem::path& path, const Environment& environment, Opened opened) {
    task_.start([=, opened = std::move(opened)]() -> NewestTask::Deliver {
        auto file = store::StudyFile::open(path, environment.program);
        if (!file) return [opened, error = file.error()] { opened(error); };
        auto study = readStudy(std::move(*file));
        if (!study) return [opened, error = study.error()] { opened(error); };
        // A function that can be copied holds it until it is called, or closes it if it never is.
        const auto held = std::make_shared<OpenedStudy>(std::move(*study));
        return [opened, held, environment] {
            opened(std::make_unique<StudySession>(std::move(*held), environment));
        };
    });
}

}  // namespace trapwright::session
