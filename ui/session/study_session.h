#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/apply.h"
#include "core/calibration/half_stroke.h"
#include "core/calibration/measurement.h"
#include "core/drive/log_entry.h"
#include "core/store/study_file.h"
#include "core/study/physical_validation.h"
#include "core/study/pose_drops.h"
#include "core/study/records.h"
#include "core/study/selection.h"
#include "core/study/settings.h"
#include "core/trial/outcome.h"
#include "core/workflow/failure.h"
#include "core/workflow/study_trials.h"
#include "ui/session/environment.h"
#include "ui/session/part_import.h"
#include "ui/session/run_state.h"
#include "ui/session/study_ledger.h"

namespace trapwright::session {

struct OpenedStudy;
struct PartVersion;

/// Trials of an individual, and how each is counted.
struct ListedTrials {
    workflow::TrialsRequest request;
    int wanted = 0;                        // in the end
    std::vector<trial::Outcome> outcomes;  // slot i for trial i
    workflow::JudgedTrials judged;         // likewise
    trial::OutcomeMaker maker;             // of the outcomes
    bool stored = false;                   // in the study; else they were simulated again
};

/// Learning cut down to what a user waits for.
struct LearningDraft {
    study::EvolutionSettings evolution;
    double seconds = 0.0;  // of learning, estimated
};

/// A drop test that goes on.
struct DropProgress {
    study::DropSettings settings;
    study::DropResult sofar;
};

/// One open study. Lives in the GUI thread and never makes it wait: a thread of its own learns, selects and
/// validates and writes the file; another simulates trials and replays, also while the first one learns; a
/// third writes down what is noted of the feeder meanwhile; what the GUI reads comes through a second,
/// read-only StudyFile or from memory. Everything that is asked for is done in the background and told by a
/// signal. Deleting a session cancels what goes on, and takes less than a second.
class StudySession : public QObject {
    Q_OBJECT

 public:
    /// Makes a new study. An error if the path exists or cannot be written, or the part cannot be built.
    static base::Result<std::unique_ptr<StudySession>> create(const std::filesystem::path& path,
                                                              const study::Settings& settings,
                                                              const store::StoredPart& part,
                                                              const Environment& environment);
    /// The same with a part that is built already; its settings replace those of `settings`.
    static base::Result<std::unique_ptr<StudySession>> create(const std::filesystem::path& path,
                                                              const study::Settings& settings,
                                                              const ImportedPart& part,
                                                              const Environment& environment);
    /// Opens a study to look at it and to go on with it. An error if another process writes it. A large one
    /// takes a while: see StudyOpening.
    static base::Result<std::unique_ptr<StudySession>> open(const std::filesystem::path& path,
                                                            const Environment& environment);
    StudySession(OpenedStudy study, const Environment& environment);
    ~StudySession() override;

    [[nodiscard]] const std::filesystem::path& path() const;
    [[nodiscard]] const study::Settings& settings() const;
    /// Those that its settings can name.
    [[nodiscard]] const trial::EngineRegistry& engines() const;
    /// The user's own folder of materials (part::readMaterials).
    [[nodiscard]] const std::filesystem::path& ownMaterials() const;
    [[nodiscard]] std::shared_ptr<const part::Part> part() const;
    [[nodiscard]] const store::StoredPart& storedPart() const;
    /// What a perfect feeder would score with the part (objectives::listAttainable).
    [[nodiscard]] std::vector<objectives::Score> attainable() const;

    /// Of all generations that are saved, in their order.
    [[nodiscard]] const std::vector<study::GenerationSummary>& summaries() const;
    [[nodiscard]] const std::vector<study::Individual>& winners() const;
    /// In the order in which they were made.
    [[nodiscard]] const std::vector<study::CheckRecord>& checks() const;
    /// Oldest first.
    [[nodiscard]] const std::vector<study::SelectionRecord>& selections() const;
    [[nodiscard]] const std::vector<study::ValidationRecord>& validations() const;
    /// What is known of the success of an individual (study::findSuccess).
    [[nodiscard]] std::optional<study::TrackSuccess> findSuccess(const study::Individual& individual) const;
    /// Read from the file, unless it is the newest generation or a winner.
    [[nodiscard]] base::Result<study::GenerationRecord> loadGeneration(int index) const;
    [[nodiscard]] base::Result<study::Individual> loadWinner(int generation, int individual) const;

    /// The track that is exported and printed in the end: the user's choice, which is kept in the study, else
    /// the best of the last selection, else the best winner (study::findBestWinner). None without
    /// generations.
    [[nodiscard]] std::optional<study::Individual> chosen() const;
    void choose(const study::Individual& individual);

    /// Validations on the real feeder, oldest first; number = place in the list. What is added here and below
    /// is saved at once by a thread of its own, also while the study learns. What cannot be saved is told by
    /// failed(), kept, and tried again with the next record and on closing.
    [[nodiscard]] const std::vector<study::PhysicalValidation>& physicalValidations() const;
    /// Begins one, without trials; its number, program and time are set here. Returns the number.
    int startPhysicalValidation(study::PhysicalValidation validation);
    /// Adds the next trial of the plan; its number, pose and, if it has none, time are set here. Nothing
    /// happens if the plan is done.
    void addPhysicalTrial(int validation, study::PhysicalTrial trial);
    /// Takes the last trial back, if there is one.
    void undoPhysicalTrial(int validation);

    /// Adds to the log of the drive. Best some at a time, as every call is synced to the disk.
    void appendDriveLog(std::vector<drive::LogEntry> entries);
    /// What was logged in [from, to) [s since 1970, UTC] and is saved.
    [[nodiscard]] base::Result<std::vector<drive::LogEntry>> loadDriveLog(double from, double to) const;

    /// Measurements on the real feeder, oldest first.
    [[nodiscard]] const std::vector<calibration::Calibration>& calibrations() const;
    /// Its number and, if it has none, time are set here.
    void addCalibration(calibration::Calibration calibration);
    /// What the newest measurements would change in the settings, for a feeder driven at `setPoint` (share of
    /// full; 0: leaves the half-stroke alone).
    [[nodiscard]] std::vector<calibration::Change> calibrationChanges(double setPoint) const;
    /// Simulates how quickly the part is conveyed at which half-stroke, with the friction and restitution
    /// that were measured. Ends with speedTableReady() or failed().
    void requestSpeedTable();
    /// The settings with these changes: for changeSettings(), or for a fork where the study is locked.
    [[nodiscard]] study::Settings calibratedSettings(std::span<const calibration::Change> changes) const;

    /// What keeps the study from learning, as sentences (study::findProblems and findPartProblems).
    [[nodiscard]] const std::vector<std::string>& problems() const;
    [[nodiscard]] const std::vector<std::string>& recommendations() const;

    /// Whether scores exist or are being made: then only the number of generations and what concerns
    /// selection and validation may change. For all else the study is forked.
    [[nodiscard]] bool locked() const;
    /// Every change of settings and part. Cleared when learning begins, because the scores belong to what was
    /// set then.
    [[nodiscard]] QUndoStack* undoStack();
    /// Changes the settings, without those of the part, as one command named `what`, and saves them. Changes
    /// of the same name that follow one another within a second become one command. A changed number of
    /// generations holds for a run that goes on. failed() if it is not allowed.
    void changeSettings(const study::Settings& settings, const QString& what);
    /// Changes the part likewise; it is built in the background first.
    void changePart(const store::StoredPart& part, const study::PartSettings& settings, const QString& what);
    /// The same with a part that is built already.
    void changePart(const ImportedPart& part, const QString& what);

    [[nodiscard]] RunState state() const;
    [[nodiscard]] RunProgress progress() const;
    /// Threads that the next run uses; 0: all processors.
    [[nodiscard]] unsigned threads() const;
    void setThreads(unsigned threads);

    /// Learns on from the last generation, and after the last one checks the winners that are left. failed()
    /// if the study has problems or something else goes on.
    void startLearning();
    /// Learning, selection and validation stand still; nothing is lost.
    void pause();
    void resume();
    void stopAfterGeneration();
    /// Ends learning, selection or validation at once.
    void stopNow();

    /// The highest winners with many trials each, into selections().
    void startSelection();
    /// The table of one individual, into validations(). `expected`: the orientation that counts as success,
    /// if not the most frequent one.
    void startValidation(const study::Individual& winner,
                         const std::optional<base::Quaternion>& expected = std::nullopt);
    /// Drops the part (study::simulateDrops) with the engine that judges. Others have their turn meanwhile,
    /// and it goes on while the study learns. Ends with dropsChanged(), after which the test is in dropTest()
    /// and saved, or with failed().
    void startDrops(const study::DropSettings& settings);
    void cancelDrops();
    /// Has totals weighted by the estimates or by the last drop test (study::poseWeights), as a command of
    /// the undo stack. While the test counts, a new one takes its place.
    void countPosesBy(study::PoseWeights weights);
    /// What is dropped just now.
    [[nodiscard]] std::optional<DropProgress> drops() const;
    /// The last drop test of the part as it is; none without one.
    [[nodiscard]] std::optional<study::DropRecord> dropTest() const;
    /// The trials as the study holds them; if it does not, they are simulated again. Ends with trialsListed()
    /// or failed(); until then trialsArrived() tells the first ones. A replay need not wait for the last one.
    void requestTrials(const workflow::TrialsRequest& request);
    /// Simulates one of these trials again: its poses every `interval` seconds. Ends with replayed() or
    /// failed().
    void replay(const workflow::TrialsRequest& request, int trial, double interval);
    /// Nothing is heard of what requestTrials() and replay() were asked for so far.
    void cancelSimulations();
    /// Times trials on this machine for a second or so, then tells by estimated() how long the run will take
    /// from here. Does nothing while something goes on or the study has problems; what begins meanwhile ends
    /// it. What is known then holds for any number of individuals, trials and generations.
    void requestEstimate();
    /// The last estimate [s]; 0 if there is none for the present settings, or nothing is left.
    [[nodiscard]] double estimatedSeconds() const;
    /// What can be learned in less than ten minutes (workflow::draftEvolution). None before the estimate,
    /// once there are generations, or where nothing useful fits.
    [[nodiscard]] std::optional<LearningDraft> draft() const;

    /// Whether the study's file is where it was. If it was deleted or replaced, nothing more can be saved in
    /// it, and saveAs() keeps what there is.
    [[nodiscard]] bool isInPlace() const;
    /// Copies the study to a new file and goes on with that one. An error if something goes on, or if the
    /// path exists.
    base::Status saveAs(const std::filesystem::path& path);
    /// A new study with the same part and settings and no generations.
    [[nodiscard]] base::Result<std::unique_ptr<StudySession>> fork(const std::filesystem::path& path) const;

 signals:
    void settingsChanged();
    void partChanged();
    void pathChanged();
    void stateChanged(trapwright::session::RunState state);
    void progressed(const trapwright::session::RunProgress& progress);
    void generationSaved(int generation);
    void checkSaved(int generation);
    void selectionSaved();
    void validationSaved();
    void chosenChanged();
    /// Some more were dropped, or the test ended or was cancelled.
    void dropsChanged();
    /// It was begun, or has a trial more or less.
    void physicalValidationChanged(int validation);
    void calibrationAdded(int calibration);
    void speedTableReady(const trapwright::calibration::SpeedTable& table);
    /// The first trials of those that are being simulated, and what they count as by what is known so far.
    void trialsArrived(const trapwright::session::ListedTrials& trials);
    void trialsListed(const trapwright::session::ListedTrials& trials);
    /// `difference`: the trial is stored, and ended otherwise.
    void replayed(const trapwright::workflow::TrialsRequest& request, int trial,
                  const std::shared_ptr<const trapwright::trial::Trajectory>& trajectory,
                  const std::optional<trapwright::workflow::OutcomeDifference>& difference);
    /// 0: the estimate before does not hold any more.
    void estimated(double seconds);
    /// `what` could not be done (a short phrase), and why and what to do.
    void failed(const QString& what, const QString& message);

 private:
    struct State;
    struct Run;
    struct Dropping;

    void dropSome(const std::shared_ptr<const Dropping>& dropping);
    void finishDrops(const Dropping& dropping);
    void pushPart(const PartVersion& version, const QString& what);
    void applySettings(const study::Settings& settings);
    void applyPart(const PartVersion& version);
    void saveDesign(const std::shared_ptr<const store::StoredPart>& part);
    void savePending();
    void note(StudyLedger::Note note);
    void tellNotNoted(const std::string& message);

    void startRun(RunState kind, const QString& what,
                  std::function<std::optional<workflow::Failure>(Run&)> work);
    void endRun(const std::optional<workflow::Failure>& failure);
    std::optional<workflow::Failure> learn(Run& run, const study::Settings& settings,
                                           const std::shared_ptr<const part::Part>& part, unsigned threads);
    void goOn();
    void setActivity(RunState activity);
    void tellState();

    struct Simulation;
    struct FoundTrials;
    using Deliver = base::Result<std::function<void()>>;  // to be called in the GUI thread
    using Simulate = std::function<Deliver(const std::shared_ptr<const Simulation>&)>;
    [[nodiscard]] base::Result<std::shared_ptr<const workflow::StoredTrials>> findTrials(
        const workflow::TrialsRequest& request);
    void makeAgain(const QString& what, const workflow::TrialsRequest& request, unsigned threads,
                   Simulate simulate);
    Deliver listStored(const Simulation& simulation, ListedTrials trials);
    Deliver simulateSome(const std::shared_ptr<const Simulation>& simulation, ListedTrials trials);
    void postSimulation(const QString& what, const base::RunControl& control,
                        std::function<Deliver()> simulate);
    void countSimulations(int change);

    std::unique_ptr<State> state_;
};

}  // namespace trapwright::session
