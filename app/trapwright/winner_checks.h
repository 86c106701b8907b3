#pragma once

#include <memory>
#include <vector>

#include "app/trapwright/console.h"
#include "app/trapwright/work_display.h"
#include "core/store/study_file.h"
#include "core/study/background_checks.h"
#include "core/study/evaluator.h"

namespace trapwright::app {

/// The reference checks of a learning run: in the background while it learns, with all threads afterwards.
/// Used by the thread that learns, which alone saves in the file.
class WinnerChecks {
 public:
    /// Begins with the winners in the file that have no check yet. Null if the study's engine setting has no
    /// reference. Refers to `file`.
    static Attempt<std::unique_ptr<WinnerChecks>> start(store::StudyFile& file,
                                                        const study::StudyInputs& inputs);

    /// Has the generation's winner checked, if it was simulated.
    void add(const study::GenerationRecord& record);
    /// Saves the checks that have been finished since the last call, and prints a line for each.
    base::Status save(WorkDisplay& display);
    /// Ends the work in the background, and saves what it finished.
    base::Status stop(WorkDisplay& display);
    /// After stop(): makes the checks that are left with all threads, shows the progress, and saves each.
    /// False if Ctrl-C ended it; the rest stays to be done.
    Attempt<bool> finish(const Console& console);

 private:
    WinnerChecks(store::StudyFile& file, study::StudyInputs inputs,
                 std::shared_ptr<const trial::Engine> reference);
    base::Status saveOne(const study::CheckRecord& record, WorkDisplay& display);

    store::StudyFile* file_;
    study::StudyInputs inputs_;                       // with all threads
    std::shared_ptr<const trial::Engine> reference_;  // likewise
    std::unique_ptr<study::BackgroundChecks> background_;
    std::vector<study::Winner> left_;
};

}  // namespace trapwright::app
