#include "core/base/thread_priority.h"

#include <sys/resource.h>

#include <algorithm>

namespace trapwright::base {

void lowerPriority(int steps) {
    // Linux keeps this by thread, whatever POSIX says; 0 is the calling one. Not SCHED_IDLE, by which a
    // thread may have to wait for seconds on a busy machine before it can even see that it is cancelled.
    const int present = ::getpriority(PRIO_PROCESS, 0);
    (void)::setpriority(PRIO_PROCESS, 0, std::min(present + steps, kLowestPriority));
}

}  // namespace trapwright::base
