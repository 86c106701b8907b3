#include "core/workflow/study_design.h"

namespace trapwright::workflow {

base::Result<StudyDesign> loadDesign(const store::StudyFile& file) {
    auto settings = file.loadSettings();
    if (!settings) return settings.error();
    auto stored = file.loadPart();
    if (!stored) return stored.error();
    auto built = part::buildPart(stored->mesh, stored->options);
    if (!built)
        return base::Error{"The part of the study " + file.path().string() + ": " + built.error().message};
    return StudyDesign{std::move(*settings), std::move(*stored),
                       std::make_shared<const part::Part>(std::move(built->part))};
}

}  // namespace trapwright::workflow
