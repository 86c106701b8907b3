#pragma once

#include <string>

#include "core/base/result.h"
#include "core/trial/batch.h"

namespace trapwright::peers {

/// The part, free, above the surface of the track as an MJCF document: SI units, the track at rest. `step`
/// [s]. An error if the surface overhangs, because the track is taken apart into upright prisms.
base::Result<std::string> writeMujocoModel(const trial::TrialBatch& batch, const part::Part& part,
                                           double step);

}  // namespace trapwright::peers
