#pragma once

#include <QElapsedTimer>
#include <QUndoStack>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/run_control.h"
#include "core/study/evaluator.h"
#include "core/workflow/estimate.h"
#include "core/workflow/study_trials.h"
#include "ui/session/environment.h"
#include "ui/session/study_opening.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_writing.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

// Inside ui/session only.

/// A part as a study has it.
struct PartVersion {
    std::shared_ptr<const store::StoredPart> stored;
    study::PartSettings settings;
    std::shared_ptr<const part::Part> part;
    study::TargetSettings target{};  // names poses of this part; known in commands of undo alone
};

/// Learning, selection or validation that goes on. Values without a word belong to the GUI thread.
struct Run {
    RunState kind = RunState::learning;
    QString what;                     // it is called in messages
    study::LearningControl learning;  // any thread
    base::RunControl trials;          // any thread; of all but the generations
    base::RunControl leaving;         // any thread; of a job, which goes on
    std::optional<FollowedJob> job;
    int firstGeneration = 0;
    std::optional<study::GenerationPlan> plan;
    std::int64_t total = 0;                       // of `trials`, once it is known
    std::shared_ptr<trial::RemadeTrials> remade;  // any thread
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
    /// The session ends.
    void leave() {
        leaving.cancel();
        if (kind != RunState::following) cancel();
    }
};

/// Trials that were asked for, and what the study holds of them.
struct FoundTrials {
    workflow::TrialsRequest request;
    std::shared_ptr<const workflow::StoredTrials> trials;
};

/// What happened on another thread, to be called in the GUI thread.
using Deliver = base::Result<std::function<void()>>;

/// The open study itself, which the session and its four parts share: what it holds, what goes on, its file
/// and its threads. Values without a word belong to the GUI thread.
struct StudyState : StudyRecords {
    /// `fail` tells the user (StudySession::failed).
    StudyState(OpenedStudy study, const Environment& environmentGiven,
               std::function<void(const QString& what, const QString& message)> failGiven);

    Environment environment;
    std::filesystem::path path;
    study::Settings settings;
    PartVersion part;
    std::vector<std::string> problems;
    std::vector<std::string> recommendations;
    std::optional<store::StudyFile> reader;
    QUndoStack undo;

    std::function<void(const QString& what, const QString& message)> fail;
    std::function<void()> simulationsChanged;  // more of them, or less

    std::shared_ptr<Run> run;                  // null while the thread that writes is idle
    unsigned threads = 0;                      // of the next run; 0: all processors
    int simulations = 0;                       // that are not done
    base::RunControl simulated;                // of those that are wanted
    std::shared_ptr<const FoundTrials> found;  // the last; null once something else may hold
    base::RunControl estimate;                 // of the last one
    base::RunControl proposing;                // likewise
    base::RunControl speedTable;               // likewise
    base::RunControl dropping;                 // likewise
    workflow::TrialCost trialCost;             // for these settings

    QObject receiver;  // of what other threads tell
    StudyWriter writer;
    std::unique_ptr<StudyLedger> ledger;
    std::unique_ptr<WorkThread> work;        // the thread that writes
    std::unique_ptr<WorkThread> simulating;  // the one that does not

    /// Ends all that goes on, and waits for it.
    void end();

    [[nodiscard]] bool locked() const { return !summaries.empty() || run != nullptr; }
    void findProblems();
    /// A trial costs something else from now on, or other work has its turn.
    void forgetCost() {
        trialCost = {};
        estimate.cancel();
    }
    /// Where the reader could not be opened again.
    [[nodiscard]] base::Error cannotRead() const;

    /// Has the ledger write this.
    void note(StudyLedger::Note note) { ledger->add(std::move(note)); }
    /// Saves the settings and the part that are not saved yet; on the thread that writes.
    void savePending();
    /// `simulate` works on the thread for it, after what was posted before. What it gives is called in the
    /// GUI thread; an error is told as the reason why `what` failed. Neither happens once it is cancelled.
    void postSimulation(const QString& what, const base::RunControl& control,
                        std::function<Deliver()> simulate);
    /// Has the GUI thread call `act`, unless the session is gone by then. For any thread.
    template <class Act>
    void tell(Act act) {
        QMetaObject::invokeMethod(&receiver, std::move(act), Qt::QueuedConnection);
    }

 private:
    void countSimulations(int change);
};

}  // namespace trapwright::session
