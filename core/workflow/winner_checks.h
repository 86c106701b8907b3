#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/base/run_control.h"
#include "core/store/study_file.h"
#include "core/study/evaluator.h"
#include "core/study/reference_check.h"
#include "core/trial/engine_registry.h"
#include "core/workflow/failure.h"

namespace trapwright::workflow {

/// Told of each check that is in the file. May be empty.
using CheckSaved = std::function<void(const study::CheckRecord&)>;

/// The reference checks beside a learning run. Used by the thread that learns, which alone saves in the file.
class WinnerChecks {
 public:
    /// Begins with the winners in the file that have no check yet. Null if the study's engine setting has no
    /// reference. Refers to `file`.
    static Result<std::unique_ptr<WinnerChecks>> start(store::StudyFile& file,
                                                       const study::StudyInputs& inputs,
                                                       const trial::EngineRegistry& engines,
                                                       const base::RunControl& control);

    /// Has the generation's winner checked, if it was simulated.
    void add(const study::GenerationRecord& record);
    /// Saves the checks that have been finished since the last call.
    base::Status save(const CheckSaved& saved);
    /// Ends the work, and saves what it finished. The winners that are left.
    base::Result<std::vector<study::Individual>> stop(const CheckSaved& saved);

 private:
    WinnerChecks(store::StudyFile& file, std::unique_ptr<study::BackgroundChecks> background);

    store::StudyFile* file_;
    std::unique_ptr<study::BackgroundChecks> background_;
};

/// Trials, in both engines together, that checks of these winners take.
std::int64_t countCheckTrials(const std::vector<study::Individual>& winners);

/// Checks these winners with all threads of the inputs and saves each check. Winners that are left when it is
/// cancelled or fails stay to be done. The study's engine setting has a reference.
Result<std::monostate> checkWinners(store::StudyFile& file, const study::StudyInputs& inputs,
                                    const trial::EngineRegistry& engines,
                                    const std::vector<study::Individual>& winners, const CheckSaved& saved,
                                    const base::RunControl& control);

}  // namespace trapwright::workflow
