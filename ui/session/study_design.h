#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/store/study_file.h"
#include "core/study/pose_drops.h"
#include "core/study/settings.h"
#include "core/trial/engine_registry.h"
#include "ui/session/part_import.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

struct PartVersion;
struct StudyState;

/// A drop test that goes on.
struct DropProgress {
    study::DropSettings settings;
    study::DropResult sofar;
};

/// The design of the open study (workflow::StudyDesign): its settings and its part, every change of them and
/// its undoing, what speaks against learning with them, and the drop test of the part, by whose counts its
/// poses may be weighted. What cannot be done is told by StudySession::failed().
class StudyDesign : public QObject {
    Q_OBJECT

 public:
    explicit StudyDesign(StudyState& state);

    [[nodiscard]] const study::Settings& settings() const;
    /// Those that its settings can name.
    [[nodiscard]] const trial::EngineRegistry& engines() const;
    /// The user's own folder of materials (part::readMaterials).
    [[nodiscard]] const std::filesystem::path& ownMaterials() const;
    [[nodiscard]] std::shared_ptr<const part::Part> part() const;
    [[nodiscard]] const store::StoredPart& storedPart() const;
    /// What a perfect feeder would score with the part (objectives::listAttainable).
    [[nodiscard]] std::vector<objectives::Score> attainable() const;

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

 signals:
    void settingsChanged();
    void partChanged();
    /// Some more were dropped, or the test ended or was cancelled.
    void dropsChanged();

 private:
    struct Dropping;

    void pushPart(const PartVersion& version, const QString& what);
    void applySettings(const study::Settings& settings);
    void applyPart(const PartVersion& version);
    void saveDesign(const std::shared_ptr<const store::StoredPart>& part);
    void dropSome(const std::shared_ptr<const Dropping>& dropping);
    void finishDrops(const Dropping& dropping);

    StudyState* const state_;
    std::optional<DropProgress> drops_;  // that goes on
    NewestTask partBuilding_;
};

}  // namespace trapwright::session
