#pragma once

#include <string>

#include "core/base/result.h"
#include "core/store/study_file.h"
#include "core/study/comparison.h"

namespace trapwright::workflow {

/// What of a study is compared with others, which call it by this name.
base::Result<study::ComparedStudy> loadCompared(const store::StudyFile& file, const std::string& name);

}  // namespace trapwright::workflow
