#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/trial/batch.h"
#include "core/trial/outcome.h"

/// Batches of trials and their outcomes as bytes, so that they can go to another process or machine and give
/// the same bits there. Parts go once for a study and a track once for an individual; a batch goes without
/// them, and who receives it puts them in again.
///
/// The bytes begin with a mark, their version and their kind. Decoding fails, with no more memory taken than
/// a small multiple of the bytes, if they are of another kind or of a program with another version, end
/// early, go on behind their end, or name what they do not hold (a vertex, a section). What decodes has the
/// same bytes again. Numbers are not looked at, least of all whether they are finite: see findProblem.
namespace trapwright::trial {

std::string encode(const part::Part& part);
std::string encode(const track::Track& track);
/// Without its track and its parts.
std::string encode(const TrialBatch& batch);
std::string encode(std::span<const Outcome> outcomes);

base::Result<part::Part> decodePart(std::string_view bytes);
base::Result<track::Track> decodeTrack(std::string_view bytes);
/// Its track is null, and it has no parts.
base::Result<TrialBatch> decodeBatch(std::string_view bytes);
base::Result<std::vector<Outcome>> decodeOutcomes(std::string_view bytes);

}  // namespace trapwright::trial
