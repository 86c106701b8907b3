#include "ui/session/study_curves.h"

#include "core/study/target.h"
#include "core/workflow/study_design.h"

namespace trapwright::session {

base::Result<StoredCurves> loadCurves(const std::filesystem::path& study) {
    const auto file = store::StudyFile::openReadOnly(study);
    if (!file) return file.error();
    const auto design = workflow::loadDesign(*file);
    if (!design) return design.error();
    auto summaries = file->loadSummaries();
    if (!summaries) return summaries.error();
    auto checks = file->loadChecks();
    if (!checks) return checks.error();
    return StoredCurves{study.stem().string(), std::move(*summaries), std::move(*checks),
                        objectives::listAttainable(study::makeTask(design->settings, *design->part)),
                        findLaterCorners(design->settings.evolution)};
}

std::optional<int> findLaterCorners(const study::EvolutionSettings& settings) {
    const int from = settings.cornersFrom;
    if (from == 0 || study::cornerShareIn(settings, from) == 0.0) return std::nullopt;
    return from;
}

}  // namespace trapwright::session
