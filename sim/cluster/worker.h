#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"
#include "core/trial/engine_registry.h"
#include "sim/cluster/channel.h"
#include "sim/cluster/messages.h"

namespace trapwright::cluster {

/// What a rank waits for, at most. [s]
struct Patience {
    double pulse = 1.0;      // between two signs of life
    double silence = 15.0;   // rank 0 for another rank's
    double orphaned = 60.0;  // another rank for one of rank 0
    double meeting = 60.0;   // rank 0 until all ranks have said what they are
};

/// Has the native engine take this instruction set.
using UseInstructionSet = std::function<base::Status(const std::string&)>;

/// What every rank but 0 does: simulates what rank 0 asks for, until that says that the job is over. An error
/// if rank 0 is silent, or sends what cannot be.
base::Status work(Channel& channel, const trial::EngineRegistry& engines, const Hello& self,
                  const UseInstructionSet& useInstructionSet, const Patience& patience = {});

}  // namespace trapwright::cluster
