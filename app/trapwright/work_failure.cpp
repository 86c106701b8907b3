#include "app/trapwright/work_failure.h"

namespace trapwright::app {

Failure toFailure(const workflow::Failure& failure) {
    switch (failure.kind) {
        case workflow::FailureKind::settings:
            return {ExitCode::usage, failure.message};
        case workflow::FailureKind::reading:
            return {ExitCode::badInput, failure.message};
        case workflow::FailureKind::saving:
            return {ExitCode::cannotWrite, failure.message};
        case workflow::FailureKind::notSolid:
            return {ExitCode::no, failure.message};
        case workflow::FailureKind::cancelled:
            return {ExitCode::interrupted, "Interrupted; nothing of it was kept."};
        case workflow::FailureKind::simulation:
            break;
    }
    return {ExitCode::fault, failure.message};
}

Failure toFailure(const workflow::Failure& failure, const store::StudyFile& file) {
    Failure told = toFailure(failure);
    if (failure.kind != workflow::FailureKind::saving || file.checkInPlace()) return told;
    const auto rescued = file.rescue();
    told.message += rescued ? " The copy is " + rescued->string() + "."
                            : " It could not be copied: " + rescued.error().message;
    return told;
}

}  // namespace trapwright::app
