#pragma once

#include <QObject>
#include <QString>

#include "core/work/part_source.h"
#include "ui/session/newest_task.h"

namespace trapwright::session {

/// A part that is ready to be put into a study, and what was found and mended.
using ImportedPart = work::LoadedPart;

/// Imports part files in the background. The newest request wins: of those before it nothing is heard.
class PartImport : public QObject {
    Q_OBJECT

 public:
    explicit PartImport(QObject* parent = nullptr);

    /// Ends with one of the signals below.
    void start(const work::PartRequest& request);
    /// Nothing is heard of what was asked for so far.
    void cancel();
    [[nodiscard]] bool busy() const;

 signals:
    void finished(const trapwright::session::ImportedPart& part);
    /// The file does not say its unit, and none can be assumed: ask, and start again with one of these.
    void unitNeeded(const trapwright::work::PartRequest& request,
                    const std::vector<trapwright::work::UnitCandidate>& candidates);
    /// The mesh has holes that are not closed unasked: offer it, and start again with closeLargeHoles.
    void repairNeeded(const trapwright::work::PartRequest& request,
                      const trapwright::geometry::MeshReport& found, const QString& message);
    void failed(const trapwright::work::PartRequest& request, const QString& message);

 private:
    NewestTask task_;
};

}  // namespace trapwright::session
