#include "app/trapwright/work_failure.h"

namespace trapwright::app {

Failure toFailure(const work::Failure& failure) {
    switch (failure.kind) {
        case work::FailureKind::settings:
            return {ExitCode::usage, failure.message};
        case work::FailureKind::reading:
            return {ExitCode::badInput, failure.message};
        case work::FailureKind::saving:
            return {ExitCode::cannotWrite, failure.message};
        case work::FailureKind::notSolid:
            return {ExitCode::no, failure.message};
        case work::FailureKind::cancelled:
            return {ExitCode::interrupted, "Interrupted; nothing of it was kept."};
        case work::FailureKind::simulation:
            break;
    }
    return {ExitCode::fault, failure.message};
}

Failure toFailure(const work::Failure& failure, const store::StudyFile& file) {
    Failure told = toFailure(failure);
    if (failure.kind != work::FailureKind::saving || file.checkInPlace()) return told;
    const auto rescued = file.rescue();
    told.message += rescued ? " The copy is " + rescued->string() + "."
                            : " It could not be copied: " + rescued.error().message;
    return told;
}

}  // namespace trapwright::app
