#include "app/trapwright/track_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"

namespace trapwright::app {

namespace {

// Single precision coordinates, as STL has them, on a track of half a metre.
constexpr double kVolumeTolerance = 1e-4;

struct Format {
    base::Status (*write)(const std::filesystem::path&, const track::TrackFile&);
    base::Result<geometry::TriangleMesh> (*read)(const std::filesystem::path&);
};

Attempt<Format> findFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".stl") {
        return Format{[](const std::filesystem::path& file, const track::TrackFile& design) {
                          return geometry::writeStl(file, design.track.solid);
                      },
                      geometry::readStl};
    }
    if (extension == ".3mf") {
        return Format{[](const std::filesystem::path& file, const track::TrackFile& design) {
                          return geometry::write3mf(file, design.track.solid, design.about);
                      },
                      geometry::read3mf};
    }
    if (extension == ".json") {
        return Format{track::writeTrackFile,
                      [](const std::filesystem::path& file) -> base::Result<geometry::TriangleMesh> {
                          auto design = track::readTrackFile(file);
                          if (!design) return design.error();
                          return std::move(design->track.solid);
                      }};
    }
    return Failure{
        ExitCode::usage,
        fmt::format("{}: tracks are exported as .stl, .3mf or .json; end the name with one of them.",
                    path.string())};
}

}  // namespace

Attempt<ExportedFile> exportTrack(const track::TrackFile& design, const std::filesystem::path& path) {
    auto format = findFormat(path);
    if (!format) return format.failure();
    if (const auto written = format->write(path, design); !written)
        return Failure{ExitCode::cannotWrite, written.error().message};
    const auto mesh = format->read(path);
    if (!mesh) return Failure{ExitCode::cannotWrite, "Reading the file back: " + mesh.error().message};

    ExportedFile file{path, geometry::calcBoundingBox(*mesh).size(), mesh->triangles.size(),
                      geometry::checkMesh(*mesh, true)};
    const double volume = geometry::calcMassProperties(design.track.solid, 1.0).volume;
    if (file.report.isSolid() && std::abs(file.report.volume - volume) <= kVolumeTolerance * volume)
        return file;
    std::error_code failure;
    std::filesystem::remove(path, failure);
    return Failure{
        ExitCode::no,
        fmt::format("{} is not one closed solid when read back ({} open, {} non-manifold and {} inconsistent "
                    "edges, volume {:.1f} instead of {:.1f} cm^3), so it was removed.",
                    path.string(), file.report.openEdges, file.report.nonManifoldEdges,
                    file.report.inconsistentEdges, file.report.volume * 1e6, volume * 1e6)};
}

std::string describeExport(const ExportedFile& file) {
    std::string text =
        fmt::format("Wrote {}: {:.1f} x {:.1f} x {:.1f} mm, {} triangles, {:.1f} cm^3, closed and manifold\n",
                    file.path.string(), file.size.x() * 1e3, file.size.y() * 1e3, file.size.z() * 1e3,
                    file.triangles, file.report.volume * 1e6);
    if (file.report.overlappingTriangles > 0) {
        text += fmt::format(
            "{} of its triangles cross others: the surface overhangs itself there. Look at it before you "
            "print it.\n",
            file.report.overlappingTriangles);
    }
    return text;
}

}  // namespace trapwright::app
