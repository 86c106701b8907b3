#pragma once

#include <string>

#include "core/base/result.h"

namespace trapwright::workflow {

/// What a failure is about, for those who answer differently to each.
enum class FailureKind {
    settings,    // settings, part or names that cannot be used
    reading,     // a file that is missing, damaged or holds nothing to work with
    simulation,  // the engine failed
    saving,
    notSolid,  // a track cannot be printed: what was written is not closed, or its solid cannot be made
    cancelled  // nothing of it was kept
};

struct Failure {
    FailureKind kind = FailureKind::simulation;
    std::string message;  // as in base::Error
};

/// What is wrong where a study could not be saved in: it, if it was found damaged.
inline Failure describeSaving(const base::Error& error) {
    return {error.kind == base::ErrorKind::damaged ? FailureKind::reading : FailureKind::saving,
            error.message};
}

template <class T>
using Result = base::Result<T, Failure>;

}  // namespace trapwright::workflow
