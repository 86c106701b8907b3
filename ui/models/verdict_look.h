#pragma once

#include <QColor>
#include <QIcon>
#include <QString>
#include <array>

#include "core/work/study_trials.h"

namespace trapwright::models {

inline constexpr std::array kVerdicts{work::TrialVerdict::success, work::TrialVerdict::wrongOrientation,
                                      work::TrialVerdict::stuck, work::TrialVerdict::fellOff};

/// How a verdict looks wherever it is shown: a word, a colour that reads on light and on dark, and a sign.
QString verdictText(work::TrialVerdict verdict);
/// The same where room is scarce: one or two short words.
QString verdictWord(work::TrialVerdict verdict);
QColor verdictColour(work::TrialVerdict verdict);
/// A tick, a turned arrow, a bar, a falling arrow, in the verdict's colour; drawn at any size.
QIcon verdictIcon(work::TrialVerdict verdict);

}  // namespace trapwright::models
