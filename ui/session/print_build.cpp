#include "ui/session/print_build.h"

#include <algorithm>

#include "core/study/track_design.h"

namespace trapwright::session {

namespace {

constexpr double kGap = 20e-3;  // between pieces that are shown apart [m]

/// All pieces as one mesh, each moved by its shift.
std::shared_ptr<const geometry::TriangleMesh> gather(const std::vector<track::PrintPiece>& pieces,
                                                     const std::vector<base::Vec3>& shifts) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const int first = static_cast<int>(mesh->vertices.size());
        for (const base::Vec3& v : pieces[i].solid.vertices)
            mesh->vertices.push_back(v + shifts[i]);
        for (const geometry::Triangle& t : pieces[i].solid.triangles)
            mesh->triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return mesh;
}

base::Result<std::vector<track::PrintPiece>, track::PrintProblem> cut(const track::Track& track,
                                                                      const PrintRequest& request) {
    track::SplitOptions split = request.split;
    split.dowelWall = request.limits.thinnestWall;
    if (request.mode == SplitMode::whole) split.cuts.clear();
    if (request.mode == SplitMode::fit) {
        auto cuts = track::proposeCuts(track, request.options, split, request.space);
        if (!cuts) return cuts.error();
        split.cuts = std::move(*cuts);
    }
    return track::buildPrintPieces(track, request.options, split);
}

void addPieces(PrintedTrack& printed, const PrintRequest& request) {
    auto pieces = cut(printed.design.track, request);
    printed.together = printed.solid;
    printed.apart = printed.solid;
    if (pieces) {
        printed.pieces = std::move(*pieces);
        for (const track::PrintPiece& piece : printed.pieces)
            printed.fits.push_back(geometry::fitOnBed(piece.solid, request.space));
    } else {
        printed.splitProblem = pieces.error();
        printed.fits.push_back(geometry::fitOnBed(*printed.solid, request.space));
    }
    if (!printed.isCut()) return;
    const std::vector<base::Vec3> none(printed.pieces.size(), base::Vec3::Zero());
    printed.shifts = track::layApart(printed.design.track, printed.pieces, kGap);
    printed.together = gather(printed.pieces, none);
    printed.apart = gather(printed.pieces, printed.shifts);
}

}  // namespace

bool PrintedTrack::fitsPrinter() const {
    return std::all_of(fits.begin(), fits.end(), [](const geometry::BedFit& fit) { return fit.fits; });
}

PrintBuild::PrintBuild(QObject* parent) : QObject(parent) {}

void PrintBuild::build(const PrintRequest& request) {
    build_.start([this, request]() -> NewestTask::Deliver {
        const auto fail = [this](const std::string& option, const std::string& message) {
            return [this, option, message] {
                emit failed(QString::fromStdString(option), QString::fromStdString(message));
            };
        };
        auto track = study::decodeTrack(request.settings, request.design);
        if (!track) return fail({}, track.error().message);
        auto solid = track::buildPrintSolid(*track, request.options);
        if (!solid) return fail(solid.error().option, solid.error().message);
        const auto printed = std::make_shared<PrintedTrack>();
        printed->report = geometry::checkForPrinting(*solid, request.limits);
        printed->learnedFlaws = track::findPrintFlaws(*track, request.limits);
        printed->design = {request.about, std::move(*track), std::nullopt};
        printed->solid = std::make_shared<const geometry::TriangleMesh>(std::move(*solid));
        addPieces(*printed, request);
        return [this, printed] { emit built(printed); };
    });
}

void PrintBuild::cancel() {
    build_.cancel();
}

void PrintBuild::write(const std::shared_ptr<const PrintedTrack>& track, const std::filesystem::path& path) {
    write_.start([this, track, path]() -> NewestTask::Deliver {
        std::vector<geometry::TriangleMesh> solids;
        for (const track::PrintPiece& piece : track->pieces)
            solids.push_back(piece.solid);
        const auto files = workflow::exportTrack(track->design, solids, path);
        if (!files)
            return
                [this, message = files.error().message] { emit notWritten(QString::fromStdString(message)); };
        return [this, files = *files] { emit written(files); };
    });
}

bool PrintBuild::writing() const {
    return write_.busy();
}

}  // namespace trapwright::session
