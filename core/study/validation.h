#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/study/records.h"

namespace trapwright::study {

/// The paper's Tables 2 and 3 for one individual (section 6.2; decision 11): trials that start near each of
/// the part's stable poses with a random heading. The expected orientation is the mode of all final
/// orientations, unless one is given. Errors: settings or part that cannot be used, a part without stable
/// poses, genes, engine, cancelled.
base::Result<ValidationRecord> validate(const StudyInputs& inputs, const Winner& individual,
                                        const std::optional<base::Quaternion>& expected,
                                        base::RunControl control);

/// The sums of all rows; its pose is -1.
ValidationRow calcTotal(const ValidationRecord& record);

}  // namespace trapwright::study
