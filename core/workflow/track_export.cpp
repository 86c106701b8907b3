#include "core/workflow/track_export.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "core/geometry/mesh_check.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"
#include "core/part/cad_export.h"

namespace trapwright::workflow {

namespace {

using geometry::TriangleMesh;
using Solids = std::span<const TriangleMesh>;

// Single precision coordinates, as STL has them, on a track of half a metre.
constexpr double kVolumeTolerance = 1e-4;
constexpr double kStepTolerance = 1e-6;  // STEP has all digits

Failure describeNoSolid(const std::filesystem::path& path, const std::string& what) {
    return Failure{FailureKind::notSolid,
                   fmt::format("{} is not one closed solid when read back ({}), so it was not kept.",
                               path.string(), what)};
}

bool isOfVolume(double volume, double expected, double tolerance) {
    return std::abs(volume - expected) <= tolerance * expected;
}

/// Adds a mesh that was read back to what is known of its file; an error if it is not what was written.
Result<ExportedFile> addRead(ExportedFile file, const TriangleMesh& mesh, const TriangleMesh& expected) {
    const geometry::MeshReport report = geometry::checkMesh(mesh, true);
    const double volume = geometry::checkMesh(expected).volume;
    if (!report.isSolid() || report.nonManifoldEdges > 0 ||
        !isOfVolume(report.volume, volume, kVolumeTolerance)) {
        return describeNoSolid(
            file.path, fmt::format("{} open, {} non-manifold and {} inconsistent edges, volume {:.1f} "
                                   "instead of {:.1f} cm^3",
                                   report.openEdges, report.nonManifoldEdges, report.inconsistentEdges,
                                   report.volume * 1e6, volume * 1e6));
    }
    file.faces += mesh.triangles.size();
    file.volume += report.volume;
    file.overlappingTriangles += report.overlappingTriangles;
    return file;
}

Failure describeUnreadable(const base::Error& error) {
    return Failure{FailureKind::saving, "Reading the file back: " + error.message};
}

Result<ExportedFile> readStl(const std::filesystem::path& path, const TriangleMesh& expected) {
    const auto mesh = geometry::readStl(path);
    if (!mesh) return describeUnreadable(mesh.error());
    ExportedFile file{path};
    file.size = geometry::calcBoundingBox(*mesh).size();
    return addRead(file, *mesh, expected);
}

Result<ExportedFile> readStep(const std::filesystem::path& path, const TriangleMesh& expected) {
    const auto contents = part::inspectStep(path);
    if (!contents) return describeUnreadable(contents.error());
    const double volume = geometry::checkMesh(expected).volume;
    if (!contents->valid || contents->solids != 1 || !isOfVolume(contents->volume, volume, kStepTolerance)) {
        return describeNoSolid(
            path, fmt::format("{} solids, {}, volume {:.3f} instead of {:.3f} cm^3", contents->solids,
                              contents->valid ? "valid" : "not valid", contents->volume * 1e6, volume * 1e6));
    }
    return ExportedFile{path, contents->size,  1, static_cast<std::size_t>(contents->faces),
                        true, contents->volume};
}

Result<ExportedFile> writePackage(const std::filesystem::path& path, Solids solids, const std::string& name) {
    if (const auto written = geometry::write3mf(path, solids, name); !written)
        return Failure{FailureKind::saving, written.error().message};
    const auto objects = geometry::read3mfObjects(path);
    if (!objects) return describeUnreadable(objects.error());
    if (objects->size() != solids.size())
        return describeNoSolid(path, fmt::format("{} objects instead of {}", objects->size(), solids.size()));
    ExportedFile file{path};
    file.solids = static_cast<int>(solids.size());
    geometry::Box box;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        auto added = addRead(file, (*objects)[i], solids[i]);
        if (!added) return added;
        file = *added;
        for (const base::Vec3& v : (*objects)[i].vertices)
            box.include(v);
    }
    file.size = box.size();
    return file;
}

Result<ExportedFile> writeDesign(const std::filesystem::path& path, const track::TrackFile& design) {
    if (const auto written = track::writeTrackFile(path, design); !written)
        return Failure{FailureKind::saving, written.error().message};
    const auto read = track::readTrackFile(path);
    if (!read) return describeUnreadable(read.error());
    ExportedFile file{path};
    file.size = geometry::calcBoundingBox(read->track.solid).size();
    return addRead(file, read->track.solid, design.track.solid);
}

Result<ExportedFile> writeOne(const std::filesystem::path& path, const std::string& extension,
                              const TriangleMesh& solid) {
    const bool isStl = extension == ".stl";
    const auto written = isStl ? geometry::writeStl(path, solid) : part::writeStepSolid(path, solid);
    if (!written) return Failure{FailureKind::saving, written.error().message};
    return isStl ? readStl(path, solid) : readStep(path, solid);
}

/// A folder beside the files that are to be written, where they are until all of them are whole. It ends with
/// this object.
class Workplace {
 public:
    explicit Workplace(const std::filesystem::path& target)
        : target_(target), folder_(target.string() + ".new-XXXXXX") {
        if (::mkdtemp(folder_.data()) == nullptr) reason_ = errno;
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    ~Workplace() {
        std::error_code ignored;
        if (reason_ == 0) std::filesystem::remove_all(folder_, ignored);
    }

    [[nodiscard]] base::Status check() const {
        return reason_ == 0 ? base::success() : describe(target_, reason_);
    }
    /// Where a file is while it is made.
    [[nodiscard]] std::filesystem::path placeFor(const std::filesystem::path& file) const {
        return folder_ / file.filename();
    }
    /// The failure as that of the file that was to be.
    [[nodiscard]] Failure translate(Failure failure) const {
        const std::string here = folder_ + "/";
        const std::string there = (target_.parent_path() / "").string();
        for (auto at = failure.message.find(here); at != std::string::npos; at = failure.message.find(here))
            failure.message.replace(at, here.size(), there);
        return failure;
    }
    /// Puts a file that is whole where it is to be.
    [[nodiscard]] base::Status handOver(const std::filesystem::path& file) const {
        std::error_code failure;
        std::filesystem::rename(placeFor(file), file, failure);
        return failure ? describe(file, failure.value()) : base::success();
    }

 private:
    static base::Error describe(const std::filesystem::path& file, int reason) {
        return {fmt::format("Cannot write {}: {}.", file.string(), std::generic_category().message(reason))};
    }

    std::filesystem::path target_;
    std::string folder_;
    int reason_ = 0;  // why there is none
};

}  // namespace

std::filesystem::path pieceFile(const std::filesystem::path& path, std::size_t piece, std::size_t pieces) {
    if (pieces == 1) return path;
    std::filesystem::path file = path;
    file.replace_filename(
        fmt::format("{}-{}-of-{}{}", path.stem().string(), piece + 1, pieces, path.extension().string()));
    return file;
}

Result<std::vector<ExportedFile>> exportTrack(const track::TrackFile& design, Solids solids,
                                              const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool isSingle = extension == ".3mf" || extension == ".json";
    if (!isSingle && extension != ".stl" && extension != ".step" && extension != ".stp") {
        return Failure{FailureKind::settings,
                       fmt::format("{}: tracks are exported as .stl, .3mf, .step or .json; end the name with "
                                   "one of them.",
                                   path.string())};
    }
    const Workplace workplace(path);
    if (const auto made = workplace.check(); !made) return Failure{FailureKind::saving, made.error().message};
    const std::size_t count = isSingle ? 1 : solids.size();
    std::vector<ExportedFile> files;
    for (std::size_t i = 0; i < count; ++i) {
        const std::filesystem::path file = workplace.placeFor(pieceFile(path, i, count));
        auto exported = extension == ".3mf"    ? writePackage(file, solids, design.about)
                        : extension == ".json" ? writeDesign(file, design)
                                               : writeOne(file, extension, solids[i]);
        if (!exported) return workplace.translate(exported.error());
        exported->path = pieceFile(path, i, count);
        files.push_back(std::move(*exported));
    }
    for (const ExportedFile& file : files) {
        if (const auto put = workplace.handOver(file.path); !put)
            return Failure{FailureKind::saving, put.error().message};
    }
    return files;
}

}  // namespace trapwright::workflow
