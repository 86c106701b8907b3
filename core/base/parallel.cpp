#include "core/base/parallel.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace trapwright::base {

void parallelFor(std::size_t count, unsigned threads,
                 const std::function<void(std::size_t index, unsigned worker)>& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto loop = [&](unsigned worker) {
        try {
            for (std::size_t i = next++; i < count && !failed; i = next++)
                work(i, worker);
        } catch (...) {
            const std::lock_guard lock(failureMutex);
            if (!failure) failure = std::current_exception();
            failed = true;
        }
    };

    const auto workers =
        static_cast<unsigned>(std::min<std::size_t>(std::max(threads, 1U), std::max<std::size_t>(count, 1)));
    {
        std::vector<std::jthread> pool;
        pool.reserve(workers - 1);
        for (unsigned worker = 1; worker < workers; ++worker)
            pool.emplace_back(loop, worker);
        loop(0);
    }
    if (failure) std::rethrow_exception(failure);
}

unsigned availableThreads() {
    return std::max(1U, std::thread::hardware_concurrency());
}

void lowerPriority(int steps) {
    // Linux keeps this by thread, whatever POSIX says; 0 is the calling one. Not SCHED_IDLE, by which a
    // thread may have to wait for seconds on a busy machine before it can even see that it is cancelled.
    const int present = ::getpriority(PRIO_PROCESS, 0);
    (void)::setpriority(PRIO_PROCESS, 0, std::min(present + steps, kLowestPriority));
}

bool hasLowestPriority() {
    return ::getpriority(PRIO_PROCESS, 0) >= kLowestPriority;
}

}  // namespace trapwright::base
