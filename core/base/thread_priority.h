#pragma once

namespace trapwright::base {

/// Steps from the ordinary priority to the lowest.
inline constexpr int kLowestPriority = 19;

/// Lowers the priority of the calling thread, and of those that it starts, by this many steps, at most to the
/// lowest. Each step leaves it about a fifth less of a processor that others want too, all together about a
/// hundredth; what nobody else wants it has as before. For good: the system lets no ordinary user take that
/// back. Where it cannot be done, nothing happens.
void lowerPriority(int steps = kLowestPriority);

}  // namespace trapwright::base
