#pragma once

#include <string>

#include "core/study/records.h"
#include "core/study/validation.h"

namespace trapwright::study {

/// The paper's Tables 2 and 3 as text: per group of alike stable poses (counted from 1, as there) how often
/// parts land so, T, F and P in percent, the 95 % bounds of P (Clopper and Pearson's, never narrower than
/// stated), and how the failed ones failed; last the total, weighted (stats::estimateWeighted) and with all
/// trials alike. With `everyPose` a group's poses follow it one by one.
std::string formatValidation(const ValidationTable& table, bool everyPose = false);

/// The re-simulated winners, best first: rank, generation, individual, F_D, F_O, finished, success in percent
/// and its 95 % bounds.
std::string formatSelection(const SelectionRecord& record);

}  // namespace trapwright::study
