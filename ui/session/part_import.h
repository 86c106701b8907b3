#pragma once

#include <QObject>
#include <QString>

#include "core/base/run_control.h"
#include "core/workflow/part_source.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

/// A part that is ready to be put into a study, and what was found and mended.
using ImportedPart = workflow::LoadedPart;

/// Imports part files in the background, each in a process of its own, whatever it holds. The newest request
/// wins: those before it are stopped, and nothing is heard of them.
class PartImport : public QObject {
    Q_OBJECT

 public:
    explicit PartImport(QObject* parent = nullptr);
    ~PartImport() override;

    /// Ends with one of the signals below.
    void start(const workflow::PartRequest& request);
    /// Stops what was asked for so far; nothing is heard of it.
    void cancel();
    [[nodiscard]] bool busy() const;

 signals:
    /// What it does now, such as "reading the file".
    void stageChanged(const QString& stage);
    void finished(const trapwright::session::ImportedPart& part);
    /// The file does not say its unit, and none can be assumed: ask, and start again with one of these.
    void unitNeeded(const trapwright::workflow::PartRequest& request,
                    const std::vector<trapwright::workflow::UnitCandidate>& candidates);
    /// The mesh has holes that are not closed unasked: offer it, and start again with closeLargeHoles.
    void repairNeeded(const trapwright::workflow::PartRequest& request,
                      const trapwright::geometry::MeshReport& found, const QString& message);
    void failed(const trapwright::workflow::PartRequest& request, const QString& message);

 private:
    base::RunControl control_;  // of the newest request
    NewestTask task_;
};

}  // namespace trapwright::session
