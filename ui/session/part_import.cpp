#include "ui/session/part_import.h"

namespace trapwright::session {

PartImport::PartImport(QObject* parent) : QObject(parent) {}

void PartImport::start(const work::PartRequest& request) {
    task_.start([this, request]() -> NewestTask::Deliver {
        auto loaded = work::importPart(request);
        if (loaded) return [this, part = std::move(*loaded)] { emit finished(part); };
        return [this, request, why = loaded.error()] {
            if (!why.candidates.empty()) {
                emit unitNeeded(request, why.candidates);
            } else if (why.mendable) {
                emit repairNeeded(request, *why.mendable, QString::fromStdString(why.failure.message));
            } else {
                emit failed(request, QString::fromStdString(why.failure.message));
            }
        };
    });
}

void PartImport::cancel() {
    task_.cancel();
}

bool PartImport::busy() const {
    return task_.busy();
}

}  // namespace trapwright::session
