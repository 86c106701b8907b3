#include "ui/session/opened_study.h"

#include <utility>

namespace trapwright::session {

base::Result<OpenedStudy> readStudy(store::StudyFile file) {
    auto design = work::loadDesign(file);
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
    auto reader = store::StudyFile::openReadOnly(file.path());
    if (!reader) return reader.error();
    return OpenedStudy{std::move(file),        std::move(*reader),     std::move(*design),
                       std::move(*summaries),  std::move(*winners),    std::move(*checks),
                       std::move(*selections), std::move(*validations)};
}

base::Result<OpenedStudy> readNewStudy(store::StudyFile file, work::StudyDesign design) {
    auto reader = store::StudyFile::openReadOnly(file.path());
    if (!reader) return reader.error();
    return OpenedStudy{std::move(file), std::move(*reader), std::move(design), {}, {}, {}, {}, {}};
}

}  // namespace trapwright::session
