#include "ui/session/study_writing.h"

#include <future>

namespace trapwright::session {

namespace {

base::Error cannotWrite() {
    return {"The study can no longer be written. Close it and open it again."};
}

}  // namespace

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

StudyLedger::StudyLedger(std::optional<store::StudyFile> file,
                         std::function<void(const std::string& message)> failed)
    : file_(std::move(file)), failed_(std::move(failed)), thread_(std::make_unique<WorkThread>()) {}

StudyLedger::~StudyLedger() {
    thread_->post([this] { (void)write(); });
    thread_.reset();
}

void StudyLedger::add(Note note) {
    thread_->post([this, note = std::move(note)]() mutable {
        left_.push_back(std::move(note));
        (void)write();
    });
}

base::Status StudyLedger::finish() {
    std::promise<base::Status> written;
    thread_->post([&] { written.set_value(write()); });
    return written.get_future().get();
}

void StudyLedger::moveTo(std::optional<store::StudyFile> file) {
    // Waits for the thread: whoever has moved the study may rely on it that the old file is closed
    // afterwards.
    std::promise<void> moved;
    thread_->post([&] {
        file_ = std::move(file);
        moved.set_value();
        (void)write();
    });
    moved.get_future().get();
}

base::Status StudyLedger::write() {
    while (!left_.empty()) {
        base::Status status = file_ ? left_.front()(*file_) : cannotWrite();
        if (!status) {
            if (!std::exchange(failing_, true)) failed_(status.error().message);
            return status;
        }
        left_.pop_front();
    }
    failing_ = false;
    return base::success();
}

}  // namespace trapwright::session
