#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/measurement.h"
#include "core/drive/log_entry.h"
#include "core/geometry/triangle_mesh.h"
#include "core/part/part_builder.h"
#include "core/study/physical_validation.h"
#include "core/study/pose_drops.h"
#include "core/study/records.h"
#include "core/study/robustness.h"
#include "core/study/settings.h"
#include "core/study/stream.h"

namespace trapwright::store {

class FileLock;

/// The part of a study as it was imported. part::buildPart(mesh, options) gives the same part bit for bit
/// each time; who learns or replays must take the part from there.
struct StoredPart {
    geometry::TriangleMesh mesh;  // [m]
    part::PartOptions options;    // name, original file, density, symmetry tolerance
};

/// Outcomes as they lie in the file; unpacking them takes a while, and any thread can do it.
struct PackedOutcomes {
    struct Piece {
        std::size_t count = 0;
        std::string bytes;  // core/trial/outcome_codec.h
    };

    trial::OutcomeMaker maker;
    std::vector<Piece> pieces;
    std::size_t before = 0;       // in the first piece, that are not meant
    std::size_t count = 0;        // that are
    std::filesystem::path study;  // for messages
};

/// Their initial poses are left out. An error if they are damaged.
base::Result<std::vector<trial::Outcome>> unpack(const PackedOutcomes& packed);

/// What takeGenerations() added.
struct TakenGenerations {
    std::vector<study::GenerationRecord> generations;
    std::vector<study::CheckRecord> checks;
};

/// One design task in one SQLite file (`.trap`): settings, part, every generation and individual, selections
/// and validations, simulated and on the real feeder.
///
/// At most one StudyFile, and those that were opened beside it, can have a study open for writing, in all
/// processes; any number can read it meanwhile and see each generation as soon as it is saved, whole or not
/// at all. What was saved stays, whatever happens to the process or the disk afterwards. All errors name the
/// file and say what to do. An object is used by one thread at a time.
class StudyFile {
 public:
    /// Makes a new study and opens it for writing. Nothing is left behind on failure. An error if the path
    /// exists. `program` is this program's name and version; it is noted in the file and beside everything
    /// that is saved.
    static base::Result<StudyFile> create(const std::filesystem::path& path, const study::Settings& settings,
                                          const StoredPart& part, const std::string& program);
    /// Opens a study to go on with it. An error if another has it open for writing, or if it cannot be
    /// written.
    static base::Result<StudyFile> open(const std::filesystem::path& path, const std::string& program);
    static base::Result<StudyFile> openReadOnly(const std::filesystem::path& path);
    /// The study that this object has open for writing, once more, for another thread, which then need not
    /// wait while this one learns.
    [[nodiscard]] base::Result<StudyFile> openBeside() const;

    StudyFile(StudyFile&&) noexcept;
    StudyFile& operator=(StudyFile&&) noexcept;
    ~StudyFile();

    [[nodiscard]] const std::filesystem::path& path() const;
    [[nodiscard]] bool writable() const;

    [[nodiscard]] base::Result<study::Settings> loadSettings() const;
    [[nodiscard]] base::Result<StoredPart> loadPart() const;
    /// Replaces the settings. Once a generation is saved only the number of generations and what concerns
    /// selection and validation may change, because the stored scores belong to the rest.
    base::Status changeSettings(const study::Settings& settings);
    /// Replaces the part, and the settings with it, which tell where it comes from. An error once a
    /// generation is saved.
    base::Status changePart(const StoredPart& part, const study::Settings& settings);

    /// Copies all that is saved to a new study. Nothing is left behind on failure. An error if the path
    /// exists.
    base::Status copyTo(const std::filesystem::path& path) const;

    /// An error if the path does not lead to the open file any more, because that was deleted or replaced
    /// meanwhile. All that saves is an error then, and rescue() keeps what there is.
    [[nodiscard]] base::Status checkInPlace() const;
    /// Copies all that is saved to a new study beside the path, "cuboid-rescued.trap". Its path.
    [[nodiscard]] base::Result<std::filesystem::path> rescue() const;

    /// Adds the next generation (index = generationCount) in one transaction.
    base::Status saveGeneration(const study::GenerationRecord& record);
    /// Adds what `from` has and this study has not: generations with their trials, in one transaction, and
    /// checks of winners. `from` is a copy of this study that was learned on elsewhere; it may grow
    /// meanwhile. An error if it is not: another part, settings that its scores do not belong to, or other
    /// generations.
    base::Result<TakenGenerations> takeGenerations(const StudyFile& from);
    [[nodiscard]] base::Result<int> generationCount() const;
    /// Where learning goes on; none if there is no generation.
    [[nodiscard]] base::Result<std::optional<study::LearningState>> loadLearningState() const;
    [[nodiscard]] base::Result<study::GenerationRecord> loadGeneration(int index) const;
    [[nodiscard]] base::Result<study::IndividualRecord> loadIndividual(const study::IndividualId& id) const;
    /// Winner, curves and time of every generation from `first` on: all that a chart needs.
    [[nodiscard]] base::Result<std::vector<study::GenerationSummary>> loadSummaries(int first = 0) const;
    /// Two scores of every individual that was simulated and has both, by generation and individual; of the
    /// objectives with these keys. No key need be known.
    [[nodiscard]] base::Result<std::vector<study::ScorePair>> loadScorePairs(const std::string& first,
                                                                             const std::string& second) const;
    /// The winner of every generation, in their order.
    [[nodiscard]] base::Result<std::vector<study::Individual>> loadWinners() const;

    /// Adds the check of a generation's winner, in a transaction of its own. An error if the generation has
    /// one already.
    base::Status saveCheck(const study::CheckRecord& record);
    /// All checks, in the order of their generations.
    [[nodiscard]] base::Result<std::vector<study::CheckRecord>> loadChecks() const;
    /// The winners that were simulated and have no check, in the order of their generations.
    [[nodiscard]] base::Result<std::vector<study::Individual>> loadUncheckedWinners() const;

    base::Status saveSelection(const study::SelectionRecord& record);
    /// All selections, oldest first.
    [[nodiscard]] base::Result<std::vector<study::SelectionRecord>> loadSelections() const;
    base::Status saveValidation(const study::ValidationRecord& record);
    /// All validations, oldest first.
    [[nodiscard]] base::Result<std::vector<study::ValidationRecord>> loadValidations() const;

    /// How robust an individual's track is; replaces what was known of it.
    base::Status saveRobustness(const study::RobustnessRecord& record);
    /// Of all individuals, by their numbers.
    [[nodiscard]] base::Result<std::vector<study::RobustnessRecord>> loadRobustness() const;

    /// What streams on an individual's track come to; replaces what the study held of that.
    base::Status saveStreams(const study::StreamsRecord& record);
    /// By generation and individual.
    [[nodiscard]] base::Result<std::vector<study::StreamsRecord>> loadStreams() const;

    /// The trials that an individual was learned by; none if they were not stored, as by programs up to
    /// schema version 9.
    [[nodiscard]] base::Result<std::optional<PackedOutcomes>> loadLearningOutcomes(
        const study::IndividualId& id) const;
    /// The same of an entry of a selection, both by their places in loadSelections().
    [[nodiscard]] base::Result<std::optional<PackedOutcomes>> loadSelectionOutcomes(int selection,
                                                                                    int entry) const;
    /// The same of a validation by its place, and of one of its poses.
    [[nodiscard]] base::Result<std::optional<PackedOutcomes>> loadValidationOutcomes(int validation,
                                                                                     int pose) const;

    /// Remembers which individual is the final track; none: nobody has chosen.
    base::Status chooseWinner(const std::optional<study::IndividualId>& winner);
    [[nodiscard]] base::Result<std::optional<study::IndividualId>> loadChosenWinner() const;

    /// Adds the next validation on the real feeder (number = how many there are), with its trials.
    base::Status addPhysicalValidation(const study::PhysicalValidation& validation);
    /// Adds the next trial of a validation, in a transaction of its own. An error if its number is another.
    base::Status addPhysicalTrial(int validation, const study::PhysicalTrial& trial);
    /// Takes the last trial back. An error if there is none.
    base::Status removeLastPhysicalTrial(int validation);
    /// Oldest first.
    [[nodiscard]] base::Result<std::vector<study::PhysicalValidation>> loadPhysicalValidations() const;

    /// Keeps tracks of another study instead of those that there were, and the settings with them (the first
    /// generation may begin with these tracks from now on). An error if there are generations.
    base::Status saveKnownTracks(const study::KnownTracks& tracks, const study::Settings& settings);
    /// None: without designs.
    [[nodiscard]] base::Result<study::KnownTracks> loadKnownTracks() const;

    /// Adds a drop test, with the current time if it has none.
    base::Status addDropTest(const study::DropRecord& record);
    /// Oldest first, also those of a part that has been changed since (study::holdsFor).
    [[nodiscard]] base::Result<std::vector<study::DropRecord>> loadDropTests() const;

    /// Adds to the log of the drive, in one transaction.
    base::Status appendDriveLog(std::span<const drive::LogEntry> entries);
    /// What was logged in [from, to) [s since 1970, UTC], in the order in which it was added.
    [[nodiscard]] base::Result<std::vector<drive::LogEntry>> loadDriveLog(double from, double to) const;

    /// Adds the next measurement (number = how many there are).
    base::Status addCalibration(const calibration::Calibration& calibration);
    /// Oldest first.
    [[nodiscard]] base::Result<std::vector<calibration::Calibration>> loadCalibrations() const;

 private:
    struct State;
    /// Within the caller's transaction. Throws SQLite::Exception.
    void writeGeneration(const study::GenerationRecord& record);
    explicit StudyFile(std::unique_ptr<State> state);
    /// For writing, with the lock beside it.
    static base::Result<StudyFile> openLocked(const std::filesystem::path& path, const std::string& program,
                                              FileLock lock);
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::store
