#pragma once

#include <QColor>
#include <QIcon>
#include <QString>
#include <array>

#include "core/workflow/study_trials.h"

namespace trapwright::models {

inline constexpr std::array kVerdicts{workflow::TrialVerdict::success,
                                      workflow::TrialVerdict::wrongOrientation, workflow::TrialVerdict::stuck,
                                      workflow::TrialVerdict::fellOff};

/// How a verdict looks wherever it is shown: a word, a colour that reads on light and on dark, and a sign.
QString verdictText(workflow::TrialVerdict verdict);
/// The same where room is scarce: one or two short words.
QString verdictWord(workflow::TrialVerdict verdict);
QColor verdictColour(workflow::TrialVerdict verdict);
/// A tick, a turned arrow, a bar, a falling arrow, in the verdict's colour; drawn at any size.
QIcon verdictIcon(workflow::TrialVerdict verdict);

}  // namespace trapwright::models
