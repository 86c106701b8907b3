#pragma once

#include "core/objectives/objective.h"

namespace trapwright::objectives {

/// The mean speed along the track, from start to finish line, of the parts that finish [m/s]; 0 if none does.
Objective conveyingSpeed();

}  // namespace trapwright::objectives
