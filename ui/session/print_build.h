#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <string>

#include "core/evolution/chromosome.h"
#include "core/geometry/print_check.h"
#include "core/study/settings.h"
#include "core/track/print_solid.h"
#include "core/track/track_file.h"
#include "core/work/track_export.h"
#include "ui/session/newest_task.h"

namespace trapwright::session {

/// What shall be printed of which individual.
struct PrintRequest {
    study::TrackSettings settings;
    evolution::Chromosome chromosome;
    std::string about;  // where the track comes from, for the file
    track::PrintOptions options;
    geometry::PrintLimits limits;
};

/// A track with its printable solid, and what a printer makes of it.
struct PrintedTrack {
    track::TrackFile design;
    std::shared_ptr<const geometry::TriangleMesh> solid;
    geometry::PrintReport report;
};

/// Builds printable solids and writes them, in the background. The newest request of each kind wins: of those
/// before it nothing is heard.
class PrintBuild : public QObject {
    Q_OBJECT

 public:
    explicit PrintBuild(QObject* parent = nullptr);

    void build(const PrintRequest& request);
    /// Nothing is heard any more of what build() was asked for.
    void cancel();
    /// Writes it as STL or 3MF by the name, reads it back and checks it (work::exportTrack).
    void write(const std::shared_ptr<const PrintedTrack>& track, const std::filesystem::path& path);
    [[nodiscard]] bool writing() const;

 signals:
    void built(const std::shared_ptr<const trapwright::session::PrintedTrack>& track);
    /// `option` as in track::PrintProblem.
    void failed(const QString& option, const QString& message);
    void written(const trapwright::work::ExportedFile& file);
    void notWritten(const QString& message);

 private:
    NewestTask build_;
    NewestTask write_;
};

}  // namespace trapwright::session
