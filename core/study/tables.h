#pragma once

#include <string>

#include "core/study/records.h"

namespace trapwright::study {

/// The paper's Tables 2 and 3 as text: per stable pose (counted from 1, as there) T, F and P in percent, the
/// 95 % bounds of P, and how the failed ones failed; last
/// the total.
std::string formatValidation(const ValidationRecord& record);

/// The re-simulated winners, best first: rank, generation, individual, F_D, F_O, finished, success in percent
/// and its 95 % bounds.
std::string formatSelection(const SelectionRecord& record);

}  // namespace trapwright::study
