#include "ui/session/study_writer.h"

namespace trapwright::session {

void StudyWriter::setPending(const study::Settings& settings,
                             const std::shared_ptr<const store::StoredPart>& part) {
    const std::lock_guard lock(mutex_);
    settings_ = settings;
    if (part) part_ = part;
}

base::Status StudyWriter::savePending() {
    std::optional<study::Settings> settings;
    std::shared_ptr<const store::StoredPart> part;
    {
        const std::lock_guard lock(mutex_);
        settings.swap(settings_);
        part.swap(part_);
    }
    if (!settings) return base::success();
    auto saved = part ? file_.changePart(*part, *settings) : file_.changeSettings(*settings);
    if (!saved) {
        // Unless there are newer ones by now.
        const std::lock_guard lock(mutex_);
        if (!settings_) settings_ = std::move(settings);
        if (!part_) part_ = std::move(part);
    }
    return saved;
}

base::Status StudyWriter::moveTo(const std::filesystem::path& path, const std::string& program) {
    if (auto copied = file_.copyTo(path); !copied) return copied;
    auto opened = store::StudyFile::open(path, program);
    if (!opened) return opened.error();
    file_ = std::move(*opened);
    return base::success();
}

}  // namespace trapwright::session
