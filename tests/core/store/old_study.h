#pragma once

#include <filesystem>

namespace trapwright::sample {

/// Makes a study of sample_study.h, or one like it, what a program of an older schema version would have
/// left: what each version added is dropped again.
void makeOld(const std::filesystem::path& path, int version);

}  // namespace trapwright::sample
