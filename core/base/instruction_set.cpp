#include "core/base/instruction_set.h"

#include <sys/utsname.h>

namespace trapwright::base {

std::string mathInstructionSet() {
#if defined(__x86_64__)
    // In the order of sysdeps/x86_64/fpu/multiarch of the GNU C library.
    if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) return "FMA";
    if (__builtin_cpu_supports("fma4") != 0) return "FMA4";
    if (__builtin_cpu_supports("avx") != 0) return "AVX";
    return "SSE2";
#else
    utsname system{};
    return ::uname(&system) == 0 ? system.machine : "unknown";
#endif
}

}  // namespace trapwright::base
