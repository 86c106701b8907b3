#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/part/part.h"
#include "core/store/study_file.h"
#include "core/study/records.h"
#include "core/study/settings.h"
#include "core/trial/batch.h"
#include "core/trial/outcome.h"

namespace trapwright::work {

enum class TrialKind { learning, selection, validation };

/// Which trials of a study are meant.
struct TrialsRequest {
    TrialKind kind = TrialKind::learning;
    study::Winner winner;  // or any other individual
    int pose = 0;          // of validation trials: index into the part's stable poses
    int count = 0;         // the first ones; 0: as many as the study holds
    std::string engine{};  // empty: the one that the study holds them of
};

/// How a trial is counted. A trial that ran out of time is stuck.
enum class TrialVerdict { finished, wrongOrientation, stuck, fellOff };

}  // namespace trapwright::work
