#include "ui/session/study_opening.h"

#include "ui/session/opened_study.h"

namespace trapwright::session {

void StudyOpening::start(const std::filesystem::path& path, const Environment& environment, Opened opened) {
    task_.start([=, opened = std::move(opened)]() -> NewestTask::Deliver {
        auto file = store::StudyFile::open(path, environment.program);
        if (!file) return [opened, error = file.error()] { opened(error); };
        auto study = readStudy(std::move(*file));
        if (!study) return [opened, error = study.error()] { opened(error); };
        // A function that can be copied holds it until it is called, or closes it if it never is.
        const auto held = std::make_shared<OpenedStudy>(std::move(*study));
        return [opened, held, environment] {
            opened(std::make_unique<StudySession>(std::move(*held), environment));
        };
    });
}

}  // namespace trapwright::session
