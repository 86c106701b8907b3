#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/store/study_file.h"

namespace trapwright::store {

/// Designs and scores of every individual as text, one line each, for `diff`: generation, individual, the
/// design as it is packed (search::packDesign) in hexadecimal, its traits to the last bit, F_C, F_D, F_O to
/// the last bit, overlaps, trials, finished, fell off, stuck, oriented
/// ("-": not counted). Two runs of the same study give the same lines. Each call of `write` gets the lines of
/// one generation.
base::Status dumpIndividuals(const StudyFile& study,
                             const std::function<void(std::string_view lines)>& write);

/// The checks of winners as text, one line each: generation, individual, trials; then of the learning engine
/// and of the reference the name, F_C, F_D, F_O to the last bit, finished, oriented.
base::Result<std::string> dumpChecks(const StudyFile& study);

/// Where the designs and scores of two studies first differ, in words; empty if they are the same. Wall times
/// and checks of winners do not count, nor does success where only one of them has counted it.
base::Result<std::string> findDifference(const StudyFile& a, const StudyFile& b);

}  // namespace trapwright::store
