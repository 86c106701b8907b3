#include "core/work/track_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"

namespace trapwright::work {

namespace {

// Single precision coordinates, as STL has them, on a track of half a metre.
constexpr double kVolumeTolerance = 1e-4;

/// What is to be written.
struct Contents {
    const track::TrackFile& design;
    const geometry::TriangleMesh& solid;
};

struct Format {
    base::Status (*write)(const std::filesystem::path&, const Contents&);
    base::Result<geometry::TriangleMesh> (*read)(const std::filesystem::path&);
    const geometry::TriangleMesh& (*written)(const Contents&);
};

const geometry::TriangleMesh& takeSolid(const Contents& contents) {
    return contents.solid;
}

Result<Format> findFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".stl") {
        return Format{[](const std::filesystem::path& file, const Contents& contents) {
                          return geometry::writeStl(file, contents.solid);
                      },
                      geometry::readStl, takeSolid};
    }
    if (extension == ".3mf") {
        return Format{[](const std::filesystem::path& file, const Contents& contents) {
                          return geometry::write3mf(file, contents.solid, contents.design.about);
                      },
                      geometry::read3mf, takeSolid};
    }
    if (extension == ".json") {
        return Format{[](const std::filesystem::path& file, const Contents& contents) {
                          return track::writeTrackFile(file, contents.design);
                      },
                      [](const std::filesystem::path& file) -> base::Result<geometry::TriangleMesh> {
                          auto design = track::readTrackFile(file);
                          if (!design) return design.error();
                          return std::move(design->track.solid);
                      },
                      [](const Contents& contents) -> const geometry::TriangleMesh& {
                          return contents.design.track.solid;
                      }};
    }
    return Failure{
        FailureKind::settings,
        fmt::format("{}: tracks are exported as .stl, .3mf or .json; end the name with one of them.",
                    path.string())};
}

}  // namespace

Result<ExportedFile> exportTrack(const track::TrackFile& design, const geometry::TriangleMesh& solid,
                                 const std::filesystem::path& path) {
    const Contents contents{design, solid};
    auto format = findFormat(path);
    if (!format) return format.error();
    if (const auto written = format->write(path, contents); !written)
        return Failure{FailureKind::saving, written.error().message};
    const auto mesh = format->read(path);
    if (!mesh) return Failure{FailureKind::saving, "Reading the file back: " + mesh.error().message};

    ExportedFile file{path, geometry::calcBoundingBox(*mesh).size(), mesh->triangles.size(),
                      geometry::checkMesh(*mesh, true)};
    const double volume = geometry::calcMassProperties(format->written(contents), 1.0).volume;
    if (file.report.isSolid() && file.report.nonManifoldEdges == 0 &&
        std::abs(file.report.volume - volume) <= kVolumeTolerance * volume)
        return file;
    std::error_code failure;
    std::filesystem::remove(path, failure);
    return Failure{
        FailureKind::notSolid,
        fmt::format("{} is not one closed solid when read back ({} open, {} non-manifold and {} inconsistent "
                    "edges, volume {:.1f} instead of {:.1f} cm^3), so it was removed.",
                    path.string(), file.report.openEdges, file.report.nonManifoldEdges,
                    file.report.inconsistentEdges, file.report.volume * 1e6, volume * 1e6)};
}

}  // namespace trapwright::work
