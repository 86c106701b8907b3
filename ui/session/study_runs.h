#pragma once

#include <QObject>
#include <QTimer>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/study/records.h"
#include "core/study/robustness.h"
#include "core/study/selection.h"
#include "core/study/settings.h"
#include "core/study/stream.h"
#include "core/trial/remade_trials.h"
#include "core/workflow/cluster_job.h"
#include "core/workflow/failure.h"
#include "core/workflow/judging.h"
#include "core/workflow/learning.h"
#include "core/workflow/proposal.h"

namespace trapwright::session {

class StudyDesign;
struct Run;
struct StudyState;

/// What a study is doing.
enum class RunState {
    idle,
    learning,
    following,                // a job that learns the study on a cluster; it goes on without us
    paused,                   // in the middle of a generation; nothing is lost
    stoppingAfterGeneration,  // as soon as the present generation is saved
    stopping,                 // at once; what is not complete is dropped
    selecting,
    validating,
    measuring,  // how robust a track is
    streaming,  // parts that follow each other on a track
    mending,    // a track for the printer
    simulating  // trials or a replay, while nothing else goes on
};

/// Whether it simulates tracks that are there, rather than learn new ones: what is not complete is lost when
/// it stops, and there is no generation to wait for.
bool isJudging(RunState state);

/// The job that is followed.
struct FollowedJob {
    std::string id;                // the batch system's; empty: it was queued elsewhere, if at all
    workflow::JobStatus status{};  // as it said last

    friend bool operator==(const FollowedJob&, const FollowedJob&) = default;
};

/// How far learning, selection, validation or a measurement has come.
struct RunProgress {
    int generation = 0;       // the present one, from 0
    int generations = 0;      // of the whole run; 0 unless it learns
    int individualsDone = 0;  // of the present generation
    int individuals = 0;
    std::int64_t trialsDone = 0;  // of the present generation; of all when it does something else
    std::int64_t trials = 0;
    double trialsPerSecond = 0.0;            // since the run began, pauses left out
    bool isPlanning = false;                 // what learning begins with
    std::optional<double> wantedUnturned{};  // study::GenerationPlan's
    double secondsLeft = 0.0;                // 0 while unknown
    std::optional<FollowedJob> job{};
};

/// Learning cut down to what a user waits for.
struct LearningDraft {
    study::EvolutionSettings evolution;
    double seconds = 0.0;  // of learning, estimated
};

/// Learning, selection and validation of the open study, measurements of robustness, streams and mending, one
/// at a time, and what they find out. What cannot be done is told by StudySession::failed().
class StudyRuns : public QObject {
    Q_OBJECT

 public:
    StudyRuns(StudyState& state, const StudyDesign& design);

    /// What is learned by.
    [[nodiscard]] const StudyDesign& design() const { return design_; }

    /// Of all generations that are saved, in their order.
    [[nodiscard]] const std::vector<study::GenerationSummary>& summaries() const;
    [[nodiscard]] const std::vector<study::Individual>& winners() const;
    /// In the order in which they were made.
    [[nodiscard]] const std::vector<study::CheckRecord>& checks() const;
    /// Oldest first.
    [[nodiscard]] const std::vector<study::SelectionRecord>& selections() const;
    [[nodiscard]] const std::vector<study::ValidationRecord>& validations() const;
    /// The last one of this individual; null: it was never measured.
    [[nodiscard]] const study::RobustnessRecord* findRobustness(const study::IndividualId& individual) const;
    /// Of each track that was measured the last one.
    [[nodiscard]] const std::vector<study::RobustnessRecord>& robustness() const;
    /// Streams on the track of this individual, the last ones; null: there were none.
    [[nodiscard]] const study::StreamsRecord* findStreams(const study::IndividualId& individual) const;
    /// Those of the last selection, best first, whose robustness is not known in the present operating box.
    [[nodiscard]] std::vector<study::IndividualId> listUnmeasured() const;
    /// Of the winners (study::findBestWinner); null if there are none.
    [[nodiscard]] const study::Individual* bestWinner() const;
    /// What is known of the success of an individual (study::findSuccess).
    [[nodiscard]] std::optional<study::TrackSuccess> findSuccess(const study::Individual& individual) const;
    /// Read from the file, unless it is the newest generation or a winner.
    [[nodiscard]] base::Result<study::GenerationRecord> loadGeneration(int index) const;
    [[nodiscard]] base::Result<study::Individual> loadIndividual(const study::IndividualId& id) const;

    /// What the individuals of a generation are mended from (study::judgeVariants); none: they were learned.
    [[nodiscard]] std::optional<study::IndividualId> mendedFrom(int generation) const;

    /// The track that is exported and printed in the end: the user's choice, which is kept in the study, else
    /// the best of the last selection, else the best winner. None without generations.
    [[nodiscard]] std::optional<study::Individual> chosen() const;
    void choose(const study::Individual& individual);

    [[nodiscard]] RunState state() const;
    [[nodiscard]] RunProgress progress() const;
    /// Trials of this run, or of the last one, that an engine could not finish.
    [[nodiscard]] std::vector<trial::RemadeTrial> remadeTrials() const;
    /// Threads that the next run uses; 0: all processors.
    [[nodiscard]] unsigned threads() const;
    void setThreads(unsigned threads);

    /// Learns on from the last generation, and after the last one checks the winners that are left. failed()
    /// if the study has problems or something else goes on.
    void startLearning();
    /// Learns as a job of a cluster: writes it beside the study, queues it where there is an sbatch, and has
    /// what it learns come home while it does; told by jobWritten(). Stopping stops the job; a session that
    /// ends leaves it.
    void startJob(const workflow::JobPlan& plan);
    /// What a job has learned comes home, and what it learns yet if it was queued from here.
    void followJob(const workflow::ClusterJob& job);
    /// The newest job of this study, as it lies beside it; none, or none that can be read.
    [[nodiscard]] std::optional<workflow::ClusterJob> lastJob() const;
    /// Follows the newest job if it was left while it went on.
    void followLastJob();
    /// What goes on stands still; nothing is lost. A job does not.
    void pause();
    void resume();
    void stopAfterGeneration();
    /// Ends what goes on at once.
    void stopNow();

    /// The highest winners with many trials each, into selections().
    void startSelection();
    /// The table of one individual, into validations(). `expected`: the orientation that counts as success,
    /// if not the most frequent one.
    void startValidation(const study::Individual& winner,
                         const std::optional<trial::Goal>& expected = std::nullopt);

    /// How these tracks do all over the operating box (study::measureRobustness), one after the other, in the
    /// engine that learns, which is the quick one, told by robustnessMeasured() of each.
    /// `goal`: what counts as success, if not what the study wants or the most frequent orientation.
    void startRobustness(const std::vector<study::Individual>& tracks, const study::RobustnessPlan& plan = {},
                         const std::optional<trial::Goal>& goal = std::nullopt);

    /// Streams of parts on this track at these inflows (study::measureStreams), in the engine that learns,
    /// told by streamsMeasured(). `goal`: as startRobustness().
    void startStreams(const study::Individual& track, const std::vector<double>& inflows,
                      const std::optional<trial::Goal>& goal = std::nullopt);

    /// Mends this track for the printer in the engine that learns (workflow::mendAndSave), into the
    /// generations and into selections(); then the best variant is chosen(), told by mended().
    void startMending(const study::Individual& track, const study::MendingPlan& plan);

    /// Times trials on this machine for a second or so, then tells by estimated() how long the run will take
    /// from here. Does nothing while something goes on or the study has problems; what begins meanwhile ends
    /// it. What is known then holds for any number of individuals, trials and generations.
    void requestEstimate();
    /// The last estimate [s]; 0 if there is none for the present settings, or nothing is left.
    [[nodiscard]] double estimatedSeconds() const;
    /// How long so many trials take in the engine that learns, by its rate in the last generations [s]; 0
    /// while there are none.
    [[nodiscard]] double secondsFor(std::int64_t trials) const;
    /// Trials per second in the last generations since this one (the median); 0 while there are none.
    [[nodiscard]] double lateRate(int since = 0) const;
    /// What can be learned in less than ten minutes (workflow::fitEvolution). None before the estimate,
    /// once there are generations, or where nothing useful fits.
    [[nodiscard]] std::optional<LearningDraft> draft() const;

    /// What the part suggests to learn in so many seconds (workflow::proposeSettings), told by proposed()
    /// some seconds later, or failed(). Does nothing while something goes on.
    void requestProposal(double seconds);

 signals:
    void stateChanged(trapwright::session::RunState state);
    void progressed(const trapwright::session::RunProgress& progress);
    /// Its id is empty where it could not be queued from here.
    void jobWritten(const trapwright::workflow::ClusterJob& job);
    void jobChanged(const trapwright::session::FollowedJob& job);
    void generationSaved(int generation);
    void checkSaved(int generation);
    void selectionSaved();
    void validationSaved();
    /// Of one of so many that are measured one after the other.
    void robustnessMeasured(int tracks);
    void streamsMeasured();
    void mended(const trapwright::workflow::MendingReport& report);
    void chosenChanged();
    /// 0: the estimate before does not hold any more.
    void estimated(double seconds);
    void proposed(const trapwright::workflow::Proposal& proposal);

 private:
    void startRun(RunState kind, const QString& what,
                  std::function<std::optional<workflow::Failure>(Run&)> work);
    void endRun(const std::optional<workflow::Failure>& failure);
    std::optional<workflow::Failure> learn(Run& run, const study::Settings& settings,
                                           const std::shared_ptr<const part::Part>& part, unsigned threads);
    std::optional<workflow::Failure> follow(Run& run, const workflow::ClusterJob& job);
    void tellJob(const FollowedJob& job);
    [[nodiscard]] workflow::LearnEvents learnEvents();
    /// For any thread: a generation is in the file.
    void tellGeneration(const study::GenerationRecord& record);
    void goOn();
    void setActivity(RunState activity);
    void tellState();

    StudyState* const state_;
    const StudyDesign& design_;
    RunState activity_ = RunState::idle;                     // of the thread that writes
    RunState told_ = RunState::idle;                         // by stateChanged()
    std::shared_ptr<const study::GenerationRecord> newest_;  // that was saved since the study was opened
    std::shared_ptr<trial::RemadeTrials> remade_;            // null before the first run
    QTimer tick_;
};

}  // namespace trapwright::session
