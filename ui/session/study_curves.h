#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/study/comparison.h"
#include "core/study/records.h"
#include "core/study/settings.h"

namespace trapwright::session {

/// What charts show of a study that is not open here, to be compared with the one that is.
struct StoredCurves {
    study::ComparedStudy study;
    std::vector<study::CheckRecord> checks;
    std::vector<objectives::Score> attainable;  // objectives::listAttainable of the part
    std::optional<int> cornersFrom;             // findLaterCorners
};

/// The generation from which trials are in corners of the operating box; none: in all, or in none.
std::optional<int> findLaterCorners(const study::EvolutionSettings& settings);

/// Reads them from a study, which may be learning in another process. May be called on any thread.
base::Result<StoredCurves> loadCurves(const std::filesystem::path& study);

}  // namespace trapwright::session
