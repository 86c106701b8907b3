#pragma once

#include <vector>

#include "sim/contact/impulse_solver.h"

namespace trapwright::contact {

/// Indices of at most `most` contacts that stand for all of them: of contacts with the same normal (a face
/// lying on a plane) the lowest and those that span the widest figure. All, in order, where there are few.
std::vector<int> thinOut(const std::vector<StepContact>& contacts, int most);

}  // namespace trapwright::contact
