#pragma once

#include <cstddef>
#include <functional>

namespace trapwright::base {

/// Calls work(i, worker) once for every i in [0, count) on `threads` threads (the caller's is one of them),
/// and returns when all are done. worker is in [0, threads): two calls with the same worker never overlap, so
/// a worker may own scratch data. Which worker gets which i is not defined; results must not depend on it.
/// The first exception that work throws is rethrown here after all threads have stopped.
void parallelFor(std::size_t count, unsigned threads,
                 const std::function<void(std::size_t index, unsigned worker)>& work);

/// The number of processors, at least 1.
unsigned availableThreads();

/// Steps from the ordinary priority to the lowest.
inline constexpr int kLowestPriority = 19;

/// Lowers the priority of the calling thread, and of those that it starts, by this many steps, at most to the
/// lowest. Each step leaves it about a fifth less of a processor that others want too, all together about a
/// hundredth; what nobody else wants it has as before. For good: the system lets no ordinary user take that
/// back. Where it cannot be done, nothing happens.
void lowerPriority(int steps = kLowestPriority);
/// Whether the calling thread has the lowest one.
bool hasLowestPriority();

}  // namespace trapwright::base
