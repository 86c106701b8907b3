#pragma once

#include <vector>

#include "ui/charts/sheet.h"
#include "ui/charts/study_curves.h"

/// What the charts of a learning run show: one study, or two to be compared.
namespace trapwright::charts {

ChartSheet successSheet(const std::vector<StudyCurves>& studies);
ChartSheet fitnessSheet(const std::vector<StudyCurves>& studies);
ChartSheet searchSheet(const std::vector<StudyCurves>& studies);
ChartSheet speedSheet(const std::vector<StudyCurves>& studies);
ChartSheet engineSheet(const std::vector<StudyCurves>& studies);

}  // namespace trapwright::charts
