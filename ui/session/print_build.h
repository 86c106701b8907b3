#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/bed_fit.h"
#include "core/geometry/print_check.h"
#include "core/search/design_space.h"
#include "core/study/settings.h"
#include "core/track/print_flaws.h"
#include "core/track/print_pieces.h"
#include "core/track/track_file.h"
#include "core/workflow/track_export.h"
#include "ui/session/work_thread.h"

namespace trapwright::session {

/// Into which pieces a track is cut.
enum class SplitMode {
    whole,
    fit,    // as few as fit into the printer
    chosen  // at SplitOptions::cuts
};

/// What shall be printed of which individual.
struct PrintRequest {
    study::TrackSettings settings;
    search::Design design;
    std::string about;  // where the track comes from, for the file
    track::PrintOptions options;
    geometry::PrintLimits limits;
    geometry::BuildSpace space;
    SplitMode mode = SplitMode::whole;
    track::SplitOptions split;
};

/// A track with its printable solid, and what a printer makes of it.
struct PrintedTrack {
    track::TrackFile design;
    std::shared_ptr<const geometry::TriangleMesh> solid;  // the whole
    geometry::PrintReport report;                         // of the whole
    track::PrintFlaws learnedFlaws;                       // of the track as it was learned
    std::vector<track::PrintPiece> pieces;  // one: it is not cut; none: it cannot be cut as it was asked for
    std::optional<track::PrintProblem> splitProblem;  // why not
    std::vector<geometry::BedFit> fits;               // of the pieces, or of the whole if there are none
    std::vector<base::Vec3> shifts;                   // of the pieces when they are shown apart [m]
    std::shared_ptr<const geometry::TriangleMesh> together;  // what is shown: the pieces in their places ...
    std::shared_ptr<const geometry::TriangleMesh> apart;     // ... and apart; the same if it is not cut

    [[nodiscard]] bool isCut() const { return pieces.size() > 1; }
    /// Whether each piece fits into the printer.
    [[nodiscard]] bool fitsPrinter() const;
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
    /// Writes its pieces as STL, 3MF or STEP by the name, reads them back and checks them
    /// (workflow::exportTrack).
    void write(const std::shared_ptr<const PrintedTrack>& track, const std::filesystem::path& path);
    [[nodiscard]] bool writing() const;

 signals:
    void built(const std::shared_ptr<const trapwright::session::PrintedTrack>& track);
    /// `option` as in track::PrintProblem.
    void failed(const QString& option, const QString& message);
    void written(const std::vector<trapwright::workflow::ExportedFile>& files);
    void notWritten(const QString& message);

 private:
    NewestTask build_;
    NewestTask write_;
};

}  // namespace trapwright::session
