#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/store/study_file.h"
#include "core/study/settings.h"
#include "ui/session/environment.h"
#include "ui/session/part_import.h"

namespace trapwright::session {

class StudyDesign;
class StudyFeeder;
class StudyReplays;
class StudyRuns;
struct OpenedStudy;
struct StudyState;

/// What of a study's tracks a new one has that is made of it.
enum class Fork {
    settingsAlone,
    knownTracks,  // its first generation begins with them
    trapBehind    // traps that throw out what lies wrong are learned behind the chosen one
};

/// One open study. Lives in the GUI thread and never makes it wait: a thread of its own learns, selects and
/// validates and writes the file; another simulates trials and replays, also while the first one learns; a
/// third writes down what is noted of the feeder meanwhile; what the GUI reads comes through a second,
/// read-only StudyFile or from memory. Everything that is asked for is done in the background and told by a
/// signal. Deleting a session cancels what goes on, and takes less than a second.
///
/// What it holds and does is in four parts, which live as long as it does. Who needs one of them shall know
/// that one only.
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

    /// Settings, part, drop test, and every change of them.
    [[nodiscard]] StudyDesign& design() { return *design_; }
    [[nodiscard]] const StudyDesign& design() const { return *design_; }
    /// Learning, selection and validation, and what they found.
    [[nodiscard]] StudyRuns& runs() { return *runs_; }
    [[nodiscard]] const StudyRuns& runs() const { return *runs_; }
    /// Trials of an individual, to be looked at.
    [[nodiscard]] StudyReplays& replays() { return *replays_; }
    [[nodiscard]] const StudyReplays& replays() const { return *replays_; }
    /// What is noted and measured at the real feeder.
    [[nodiscard]] StudyFeeder& feeder() { return *feeder_; }
    [[nodiscard]] const StudyFeeder& feeder() const { return *feeder_; }

    /// Whether the study's file is where it was. If it was deleted or replaced, nothing more can be saved in
    /// it, and saveAs() keeps what there is.
    [[nodiscard]] bool isInPlace() const;
    /// Copies the study to a new file and goes on with that one. An error if something goes on, or if the
    /// path exists.
    base::Status saveAs(const std::filesystem::path& path);
    /// A new study with the same part and settings, or what of them the kind changes, and no generations. An
    /// error if it is made of tracks and there are none.
    [[nodiscard]] base::Result<std::unique_ptr<StudySession>> fork(const std::filesystem::path& path,
                                                                   Fork kind = Fork::settingsAlone) const;

    /// Disconnects this one from all signals of the session and of its parts.
    void leave(const QObject* listener) const;

 signals:
    void pathChanged();
    /// `what` could not be done (a short phrase), and why and what to do: also where it was asked of one of
    /// the parts.
    void failed(const QString& what, const QString& message);

 private:
    std::unique_ptr<StudyState> state_;  // first: all parts use it
    std::unique_ptr<StudyDesign> design_;
    std::unique_ptr<StudyRuns> runs_;
    std::unique_ptr<StudyReplays> replays_;
    std::unique_ptr<StudyFeeder> feeder_;
};

}  // namespace trapwright::session
