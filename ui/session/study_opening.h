#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/store/study_file.h"
#include "core/study/records.h"
#include "core/workflow/study_design.h"
#include "ui/session/environment.h"
#include "ui/session/study_session.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

/// What a session shows of a study without reading it again.
struct StudyRecords {
    std::vector<study::GenerationSummary> summaries;
    std::vector<study::Individual> winners;
    std::vector<study::CheckRecord> checks;
    std::vector<study::SelectionRecord> selections;
    std::vector<study::ValidationRecord> validations;
    std::vector<study::PhysicalValidation> physicalValidations;
    std::vector<calibration::Calibration> calibrations;
    std::vector<study::DropRecord> dropTests;
    std::optional<study::Individual> chosen;  // by the user
    std::vector<study::RobustnessRecord> robustness;
    std::vector<study::StreamsRecord> streams;
    study::KnownTracks known;  // of another study, to begin with
};

struct OpenedStudy {
    store::StudyFile file;    // open for writing
    store::StudyFile reader;  // the same study
    store::StudyFile ledger;  // likewise, opened beside `file`
    workflow::StudyDesign design;
    StudyRecords records;
};

/// Reads a study that is open for writing. May be called on any thread.
base::Result<OpenedStudy> readStudy(store::StudyFile file);

/// The same of a study that was just made of this design, whose part need not be built once more.
base::Result<OpenedStudy> readNewStudy(store::StudyFile file, workflow::StudyDesign design);

/// Opens studies in the background, which takes a while for large ones. The newest request wins: a study that
/// was asked for before it is closed again.
class StudyOpening {
 public:
    using Opened = std::function<void(base::Result<std::unique_ptr<StudySession>>)>;

    /// `opened` is called in the GUI thread with the study or the reason why it cannot be opened.
    void start(const std::filesystem::path& path, const Environment& environment, Opened opened);
    [[nodiscard]] bool busy() const { return task_.busy(); }

 private:
    NewestTask task_;
};

}  // namespace trapwright::session
