#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include "core/store/study_file.h"
#include "core/study/settings.h"
#include "core/work/part_source.h"
#include "ui/session/newest_task.h"

namespace trapwright::session {

/// A part that is ready to be put into a study.
struct ImportedPart {
    store::StoredPart stored;      // as it is kept
    study::PartSettings settings;  // as its settings tell it
    std::shared_ptr<const part::Part> part;
    work::PartReport report;  // what was found and mended, and the units that it could be in
};

/// Imports part files in the background. The newest request wins: of those before it nothing is heard.
class PartImport : public QObject {
    Q_OBJECT

 public:
    explicit PartImport(QObject* parent = nullptr);

    void import(const work::PartRequest& request);
    /// Nothing is heard of what was asked for so far.
    void cancel();
    [[nodiscard]] bool busy() const;

 signals:
    void finished(const trapwright::session::ImportedPart& part);
    /// The file does not say its unit and no assumption is safe: ask, and import again with one of these.
    void unitNeeded(const trapwright::work::PartRequest& request,
                    const std::vector<trapwright::work::UnitCandidate>& candidates);
    void failed(const trapwright::work::PartRequest& request, const QString& message);

 private:
    NewestTask task_;
};

}  // namespace trapwright::session
