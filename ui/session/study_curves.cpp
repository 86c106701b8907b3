#include "ui/session/study_curves.h"

#include "core/study/target.h"
#include "core/workflow/compared_study.h"
#include "core/workflow/study_design.h"

namespace trapwright::session {

base::Result<StoredCurves> loadCurves(const std::filesystem::path& study) {
    const auto file = store::StudyFile::openReadOnly(study);
    if (!file) return file.error();
    const auto design = workflow::loadDesign(*file);
    if (!design) return design.error();
    auto compared = workflow::loadCompared(*file, study.stem().string());
    if (!compared) return compared.error();
    auto checks = file->loadChecks();
    if (!checks) return checks.error();
    return StoredCurves{std::move(*compared), std::move(*checks),
                        objectives::listAttainable(study::makeTask(design->settings, *design->part)),
                        findLaterCorners(design->settings.evolution)};
}

std::optional<int> findLaterCorners(const study::EvolutionSettings& settings) {
    const int from = settings.cornersFrom;
    if (from == 0 || study::cornerShareIn(settings, from) == 0.0) return std::nullopt;
    return from;
}

}  // namespace trapwright::session
