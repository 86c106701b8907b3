#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// Traps one after the other, at least one. A track is lead-in, chain, lead-out.
using TrapChain = std::vector<const TrapKind*>;

/// "step, free-form": keys of kinds with commas between them. An error that lists the kinds.
base::Result<TrapChain> readTraps(std::string_view text);

/// "Step, free form": for people.
std::string describe(const TrapChain& chain);

/// The dimensions of all traps one after the other. Where there are several, each dimension's key begins with
/// its trap's number: "trap 2: height". Smooths each trap by its own kind.
search::DesignSpace designSpace(const TrapChain& chain, const TrapParameters& parameters);

/// The functional cross-sections of a design of that space; x is measured from the lead-in's end.
std::vector<track::CrossSection> build(const TrapChain& chain, const TrapParameters& parameters,
                                       const search::Design& design);

/// Where the cross-sections of a typical one are: x from the lead-in's end. [m]
std::vector<double> layOut(const TrapChain& chain, const TrapParameters& parameters);

/// The longest that it can be. [m]
double calcLongest(const TrapChain& chain, const TrapParameters& parameters);

}  // namespace trapwright::traps
