#pragma once

#include <QObject>
#include <filesystem>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "ui/session/environment.h"
#include "ui/session/newest_task.h"
#include "ui/session/study_session.h"

namespace trapwright::session {

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
