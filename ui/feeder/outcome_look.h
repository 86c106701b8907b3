#pragma once

#include "core/study/physical_validation.h"
#include "core/work/study_trials.h"

namespace trapwright::feeder {

/// The verdict of a simulated trial that an operator's outcome stands beside; for its word, colour and sign.
inline work::TrialVerdict verdictOf(study::PhysicalOutcome outcome) {
    switch (outcome) {
        case study::PhysicalOutcome::success:
            return work::TrialVerdict::success;
        case study::PhysicalOutcome::wrongOrientation:
            return work::TrialVerdict::wrongOrientation;
        case study::PhysicalOutcome::stuck:
            return work::TrialVerdict::stuck;
        case study::PhysicalOutcome::fellOff:
            return work::TrialVerdict::fellOff;
    }
    return work::TrialVerdict::stuck;
}

}  // namespace trapwright::feeder
