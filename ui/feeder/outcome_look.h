#pragma once

#include "core/study/physical_validation.h"
#include "core/workflow/study_trials.h"

namespace trapwright::feeder {

/// The verdict of a simulated trial that an operator's outcome stands beside; for its word, colour and sign.
inline workflow::TrialVerdict verdictOf(study::PhysicalOutcome outcome) {
    switch (outcome) {
        case study::PhysicalOutcome::success:
            return workflow::TrialVerdict::success;
        case study::PhysicalOutcome::wrongOrientation:
            return workflow::TrialVerdict::wrongOrientation;
        case study::PhysicalOutcome::stuck:
            return workflow::TrialVerdict::stuck;
        case study::PhysicalOutcome::fellOff:
            return workflow::TrialVerdict::fellOff;
    }
    return workflow::TrialVerdict::stuck;
}

}  // namespace trapwright::feeder
