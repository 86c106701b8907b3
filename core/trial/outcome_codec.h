#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/trial/outcome.h"

/// Outcomes as few bytes, for the file of a study: 40 to 45 a part. Every bit comes back of ending, farthest
/// pose and time. The initial pose is left out, since it follows from the part's start (startInTrack).
namespace trapwright::trial {

/// As many trials, and parts in them together, as are packed at most, so that whoever unpacks needs little
/// memory.
inline constexpr std::size_t kMostPacked = 16384;

/// How many of these, from the first one on, can be packed together. 0: the first has too many parts.
std::size_t countPackable(std::span<const Outcome> outcomes);

/// Outcomes that can be packed together.
std::string packOutcomes(std::span<const Outcome> outcomes);

/// `count` outcomes, each part with the identity for its initial pose. An error if the bytes are not that.
base::Result<std::vector<Outcome>> unpackOutcomes(std::string_view bytes, std::size_t count);

}  // namespace trapwright::trial
