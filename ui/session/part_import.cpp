#include "ui/session/part_import.h"

#include "core/workflow/part_process.h"

namespace trapwright::session {

PartImport::PartImport(QObject* parent) : QObject(parent) {}

PartImport::~PartImport() {
    control_.cancel();
}

void PartImport::start(const workflow::PartRequest& request) {
    control_.cancel();
    control_ = {};
    task_.start([this, request, control = control_]() -> NewestTask::Deliver {
        const auto tellStage = [this, control](std::string_view stage) {
            const auto text = QString::fromUtf8(stage.data(), static_cast<qsizetype>(stage.size()));
            QMetaObject::invokeMethod(
                this,
                [this, control, text] {
                    if (!control.cancelled()) emit stageChanged(text);
                },
                Qt::QueuedConnection);
        };
        auto loaded = workflow::importPartApart(request, control, tellStage);
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
    control_.cancel();
    task_.cancel();
}

bool PartImport::busy() const {
    return task_.busy();
}

}  // namespace trapwright::session
