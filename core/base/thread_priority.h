#pragma once

namespace trapwright::base {

/// Gives the calling thread, and those that it starts, the lowest ordinary priority: all of a processor that
/// nobody else wants, and about a hundredth of one where all are busy. For good: the system lets no ordinary
/// user take that back. Where it cannot be done, nothing happens.
void lowerPriority();

}  // namespace trapwright::base
