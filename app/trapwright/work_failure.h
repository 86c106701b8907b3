#pragma once

#include "app/trapwright/exit_codes.h"
#include "core/store/study_file.h"
#include "core/workflow/failure.h"

namespace trapwright::app {

/// The same failure with the status that it ends the program with.
Failure toFailure(const workflow::Failure& failure);
/// The same of a failure while this study was worked on. If its file is gone, a copy is made of what it held,
/// and the message tells where.
Failure toFailure(const workflow::Failure& failure, const store::StudyFile& file);

}  // namespace trapwright::app
