#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/trial/outcome.h"

namespace trapwright::sample {

// Changes of the outcomes in the file of a study that nobody has open.

/// Changes the stored trials of a generation; `trial` counts through all its individuals.
void changeOutcomes(const std::filesystem::path& path, int generation,
                    const std::function<void(std::size_t trial, trial::PartOutcome& outcome)>& change);
/// As if another program had made all of them.
void changeMaker(const std::filesystem::path& path, const trial::OutcomeMaker& maker);
/// As if they had never been stored.
void dropOutcomes(const std::filesystem::path& path);
/// Runs SQL on the file.
void alter(const std::filesystem::path& path, const std::string& sql);

}  // namespace trapwright::sample
