#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include "core/drive/drive.h"

namespace trapwright::fuzz {

/// Lives through an operator's day with a drive of which each answer is the fuzzer's: connects, tells it this
/// and that, and lets it go. Numbers that it tells must be numbers.
void driveThrough(drive::Drive& drive, FuzzedDataProvider& input);

}  // namespace trapwright::fuzz
