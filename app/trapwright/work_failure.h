#pragma once

#include "app/trapwright/exit_codes.h"
#include "core/work/failure.h"

namespace trapwright::app {

/// The same failure with the status that it ends the program with.
Failure toFailure(const work::Failure& failure);

}  // namespace trapwright::app
