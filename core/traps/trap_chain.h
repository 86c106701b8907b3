#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/traps/trap_kind.h"

namespace trapwright::traps {

/// Traps one after the other, at least one. A track is lead-in, chain, lead-out.
using TrapChain = std::vector<const TrapKind*>;

/// At most so many traps in a chain.
inline constexpr std::size_t kMostTraps = 100;

/// "groove, 6 x drop": keys of kinds with commas between them, each with how often it comes if more than
/// once. An error that lists the kinds, or tells that there are too many.
base::Result<TrapChain> readTraps(std::string_view text);

/// "Groove, 6 x drop": for people.
std::string describe(const TrapChain& chain);

/// The dimensions of all traps one after the other. Where there are several, each dimension's key begins with
/// its trap's number: "trap 2: height". Smooths each trap by its own kind.
search::DesignSpace designSpace(const TrapChain& chain, const TrapParameters& parameters);

/// The functional cross-sections of a design of that space; x is measured from the lead-in's end.
std::vector<track::CrossSection> build(const TrapChain& chain, const TrapParameters& parameters,
                                       const search::Design& design);
/// The same behind something else than the lead-in, which ends at x = 0 with this section.
std::vector<track::CrossSection> build(const TrapChain& chain, const TrapParameters& parameters,
                                       const search::Design& design, const track::CrossSection& before);

/// Where the cross-sections of a typical one are: x from the lead-in's end. [m]
std::vector<double> layOut(const TrapChain& chain, const TrapParameters& parameters);

/// A level one at x = 0, from edge to edge, as the lead-in's are.
track::CrossSection levelSection(const TrapParameters& parameters, double z);

/// z of the lowest point. [m]
double findLowest(const track::CrossSection& section);

/// The longest that it can be. [m]
double calcLongest(const TrapChain& chain, const TrapParameters& parameters);

}  // namespace trapwright::traps
