#include "ui/session/study_ledger.h"

#include <future>
#include <utility>

namespace trapwright::session {

namespace {

base::Error cannotWrite() {
    return {"The study can no longer be written. Close it and open it again."};
}

}  // namespace

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
