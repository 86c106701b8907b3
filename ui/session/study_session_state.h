#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QUndoStack>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/study/learning_control.h"
#include "ui/session/design_commands.h"
#include "ui/session/opened_study.h"
#include "ui/session/study_session.h"
#include "ui/session/study_writer.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

// Inside ui/session only.

/// Learning, selection or validation that goes on. Values without a word belong to the GUI thread.
struct StudySession::Run {
    RunState kind = RunState::learning;
    QString what;                     // it is called in messages
    study::LearningControl learning;  // any thread
    base::RunControl trials;          // any thread; of all but the generations
    std::optional<study::GenerationPlan> plan;
    std::int64_t total = 0;  // of `trials`, once it is known
    QElapsedTimer clock;
    qint64 before = 0;  // the last pause [ms]
    bool paused = false;

    [[nodiscard]] double seconds() const {
        return 1e-3 * static_cast<double>(before + (paused ? 0 : clock.elapsed()));
    }
    void cancel() {
        learning.run.cancel();
        learning.checks.cancel();
        trials.cancel();
    }
};

/// Trials that are listed or made again. Values that any thread may read.
struct StudySession::Simulation {
    study::Settings settings;
    std::shared_ptr<const part::Part> part;
    std::shared_ptr<const workflow::StoredTrials> stored;
    trial::TrialBatch batch;
    std::optional<trial::MadeOutcomes> kept;  // in the study, of all trials of the batch
    std::shared_ptr<const trial::Engine> engine;
    trial::OutcomeMaker maker;  // of what is simulated now
    base::RunControl control;
};

/// Trials that were asked for, and what the study holds of them.
struct StudySession::FoundTrials {
    workflow::TrialsRequest request;
    std::shared_ptr<const workflow::StoredTrials> trials;
};

struct StudySession::State {
    State(OpenedStudy study, const Environment& environmentGiven,
          std::function<void(const std::string&)> cannotNote);

    Environment environment;
    std::filesystem::path path;
    study::Settings settings;
    PartVersion part;
    std::vector<study::GenerationSummary> summaries;
    std::vector<study::Individual> winners;
    std::shared_ptr<const study::GenerationRecord> newest;  // that was saved since the study was opened
    std::vector<study::CheckRecord> checks;
    std::vector<study::SelectionRecord> selections;
    std::vector<study::ValidationRecord> validations;
    std::vector<study::PhysicalValidation> physicalValidations;
    std::vector<calibration::Calibration> calibrations;
    std::vector<study::DropRecord> dropTests;
    std::optional<study::Individual> chosen;  // by the user
    std::vector<std::string> problems;
    std::vector<std::string> recommendations;
    std::optional<store::StudyFile> reader;
    QUndoStack undo;
    unsigned threads = 0;

    RunState activity = RunState::idle;  // of the thread that writes
    RunState told = RunState::idle;      // by stateChanged()
    std::shared_ptr<Run> run;            // null while that thread is idle
    QTimer tick;
    int simulations = 0;                       // that are not done
    base::RunControl simulated;                // of those that are wanted
    std::shared_ptr<const FoundTrials> found;  // the last; null once something else may hold
    base::RunControl estimate;                 // of the last one
    base::RunControl speedTable;               // likewise
    base::RunControl dropping;                 // likewise
    std::optional<DropProgress> drops;         // that goes on
    double secondsPerTrial = 0.0;              // while learning; 0: not known for these settings

    StudyWriter writer;
    std::unique_ptr<StudyLedger> ledger;
    NewestTask partBuilding;
    std::unique_ptr<WorkThread> work;        // the thread that writes
    std::unique_ptr<WorkThread> simulating;  // the one that does not

    void findProblems();
    /// A trial costs something else from now on, or other work has its turn.
    void forgetCost() {
        secondsPerTrial = 0.0;
        estimate.cancel();
    }
    /// Where the reader could not be opened again.
    [[nodiscard]] base::Error cannotRead() const;
    /// Called on any thread; throws nothing.
    [[nodiscard]] static base::Result<study::StudyInputs> makeInputs(const Environment& environment,
                                                                     const study::Settings& settings,
                                                                     std::shared_ptr<const part::Part> part,
                                                                     trial::EngineUse use, unsigned threads);
};

/// Has the GUI thread call `act`, unless the session is gone by then.
template <class Act>
void tell(StudySession* session, Act act) {
    QMetaObject::invokeMethod(session, std::move(act), Qt::QueuedConnection);
}

}  // namespace trapwright::session
