#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/part/part.h"
#include "core/store/study_file.h"
#include "core/study/settings.h"

namespace trapwright::workflow {

/// What a study is made with.
struct StudyDesign {
    study::Settings settings;
    store::StoredPart stored;
    std::shared_ptr<const part::Part> part;  // built of the stored one, with the same bits each time
};

/// Reads it from the study.
base::Result<StudyDesign> loadDesign(const store::StudyFile& file);

}  // namespace trapwright::workflow
