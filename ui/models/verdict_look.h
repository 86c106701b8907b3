#pragma once

#include <QColor>
#include <QIcon>
#include <QString>
#include <array>

#include "core/workflow/study_trials.h"

namespace trapwright::models {

inline constexpr std::array kVerdicts{trial::Verdict::success, trial::Verdict::wrongOrientation,
                                      trial::Verdict::stuck, trial::Verdict::fellOff};

/// How a verdict looks wherever it is shown: a word, a colour that reads on light and on dark, and a sign.
QString verdictText(trial::Verdict verdict);
/// The same where room is scarce: one or two short words.
QString verdictWord(trial::Verdict verdict);
QColor verdictColour(trial::Verdict verdict);
/// A tick, a turned arrow, a bar, a falling arrow, in the verdict's colour; drawn at any size.
QIcon verdictIcon(trial::Verdict verdict);

}  // namespace trapwright::models
