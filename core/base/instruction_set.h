#pragma once

#include <string>

namespace trapwright::base {

/// Which of this processor's instructions the system's mathematics takes, and so the last bits of a sine:
/// "FMA", "FMA4", "AVX" or "SSE2", as the GNU C library chooses; elsewhere the name of the architecture.
std::string mathInstructionSet();

}  // namespace trapwright::base
