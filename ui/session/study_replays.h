#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/trial/outcome.h"
#include "core/workflow/study_trials.h"
#include "ui/session/study_runs.h"

namespace trapwright::session {

/// Trials of an individual, and how each is counted.
struct ListedTrials {
    workflow::TrialsRequest request;
    int wanted = 0;                        // in the end
    std::vector<trial::Outcome> outcomes;  // slot i for trial i
    workflow::JudgedTrials judged;         // likewise
    std::vector<trial::BoxPlace> places;   // of all that are wanted; none: they do not vary
    trial::OutcomeMaker maker;             // of the outcomes
    bool stored = false;                   // in the study; else they were simulated again
};

/// Trials of the individuals of the open study, as it holds them or made again, to be listed and replayed,
/// also while it learns. What cannot be done is told by StudySession::failed().
class StudyReplays : public QObject {
    Q_OBJECT

 public:
    StudyReplays(StudyState& state, const StudyRuns& runs);

    /// What the trials are of.
    [[nodiscard]] const StudyRuns& runs() const { return runs_; }
    [[nodiscard]] const StudyDesign& design() const { return runs_.design(); }

    /// The trials as the study holds them; if it does not, they are simulated again. Ends with trialsListed()
    /// or failed(); until then trialsArrived() tells the first ones. A replay need not wait for the last one.
    void requestTrials(const workflow::TrialsRequest& request);
    /// These trials by the conditions that they varied over. Ends with sliced() or failed().
    void requestSlices(const workflow::TrialsRequest& request);
    /// Simulates one of these trials again: its poses every `interval` seconds. Ends with replayed() or
    /// failed().
    void replay(const workflow::TrialsRequest& request, int trial, double interval);
    /// Nothing is heard of what requestTrials() and replay() were asked for so far.
    void cancelSimulations();

 signals:
    /// The first trials of those that are being simulated, and what they count as by what is known so far.
    void trialsArrived(const trapwright::session::ListedTrials& trials);
    void trialsListed(const trapwright::session::ListedTrials& trials);
    /// No conditions: all trials were alike, or the study does not hold how they ended.
    void sliced(const trapwright::workflow::TrialsRequest& request,
                const std::vector<trapwright::study::SlicedCondition>& conditions);
    /// `difference`: the trial is stored, and ended otherwise.
    void replayed(const trapwright::workflow::TrialsRequest& request, int trial,
                  const std::shared_ptr<const trapwright::trial::Trajectory>& trajectory,
                  const std::optional<trapwright::workflow::OutcomeDifference>& difference);

 private:
    struct Simulation;
    using Deliver = base::Result<std::function<void()>>;  // to be called in the GUI thread
    using Simulate = std::function<Deliver(const std::shared_ptr<const Simulation>&)>;

    [[nodiscard]] base::Result<std::shared_ptr<const workflow::StoredTrials>> findTrials(
        const workflow::TrialsRequest& request);
    void makeAgain(const QString& what, const workflow::TrialsRequest& request, unsigned threads,
                   Simulate simulate);
    Deliver listStored(const Simulation& simulation, ListedTrials trials);
    Deliver simulateSome(const std::shared_ptr<const Simulation>& simulation, ListedTrials trials);

    StudyState* const state_;
    const StudyRuns& runs_;
};

}  // namespace trapwright::session
