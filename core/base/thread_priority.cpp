#include "core/base/thread_priority.h"

#include <sys/resource.h>

namespace trapwright::base {

void lowerPriority() {
    // Linux keeps this by thread, whatever POSIX says; 0 is the calling one. Not SCHED_IDLE, by which a
    // thread may have to wait for seconds on a busy machine before it can even see that it is cancelled.
    constexpr int kLowest = 19;
    (void)::setpriority(PRIO_PROCESS, 0, kLowest);
}

}  // namespace trapwright::base
