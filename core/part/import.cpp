#include "core/part/import.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>

#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"
#include "core/part/cad_import.h"
#include "core/part/gltf_import.h"
#include "core/part/units.h"

namespace trapwright::part {

namespace {

using base::Error;

using Reader = base::Result<FileMesh> (*)(const std::filesystem::path&);

base::Result<FileMesh> read3mf(const std::filesystem::path& path) {
    base::Result<geometry::PackagedMesh> package = geometry::read3mfWithUnit(path);
    if (!package) return package.error();
    for (base::Vec3& vertex : package->mesh.vertices)
        vertex /= package->unit;
    return FileMesh{std::move(package->mesh), findUnit(package->unit), {}};
}

template <base::Result<geometry::TriangleMesh> (*read)(const std::filesystem::path&)>
base::Result<FileMesh> readSurface(const std::filesystem::path& path) {
    base::Result<geometry::TriangleMesh> mesh = read(path);
    if (!mesh) return mesh.error();
    return FileMesh{std::move(*mesh), std::nullopt, {}};
}

struct Format {
    std::string_view extension;
    Reader read;
};

constexpr std::array<Format, 11> kFormats = {{{".stl", readSurface<geometry::readAnyStl>},
                                              {".obj", readSurface<geometry::readObj>},
                                              {".ply", readSurface<geometry::readPly>},
                                              {".off", readSurface<geometry::readOff>},
                                              {".3mf", read3mf},
                                              {".gltf", readGltfFile},
                                              {".glb", readGltfFile},
                                              {".step", readStepFile},
                                              {".stp", readStepFile},
                                              {".iges", readIgesFile},
                                              {".igs", readIgesFile}}};

base::Status checkFile(const std::filesystem::path& path) {
    std::error_code failure;
    const std::string name = path.string();
    if (!std::filesystem::exists(path, failure)) {
        return Error{fmt::format("{} does not exist. Check the path", name)};
    }
    if (!std::filesystem::is_regular_file(path, failure)) {
        return Error{fmt::format("{} is not a file. Name the part's file", name)};
    }
    const std::ifstream file(path, std::ios::binary);
    if (!file) return Error{fmt::format("{} cannot be opened for reading. Check its permissions", name)};
    if (std::filesystem::file_size(path, failure) == 0) {
        return Error{fmt::format("{} is empty. Copy or export it again", name)};
    }
    return base::success();
}

base::Result<Format> findFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const Format& format : kFormats) {
        if (format.extension == extension) return format;
    }
    return Error{fmt::format("{}: part files with the extension \"{}\" are not supported. Supported are {}",
                             path.string(), extension, fmt::join(supportedExtensions(), " "))};
}

base::Status checkMesh(const std::filesystem::path& path, const geometry::TriangleMesh& mesh) {
    if (mesh.triangles.empty()) {
        return Error{fmt::format("{} has no triangles. Export the part as a closed surface", path.string())};
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const int vertex : mesh.triangles[i]) {
            if (mesh.vertices[static_cast<std::size_t>(vertex)].allFinite()) continue;
            return Error{
                fmt::format("{}: triangle {} has a coordinate that is not a number. Export the part again",
                            path.string(), i + 1)};
        }
    }
    return base::success();
}

/// Settles the unit between the user, the file and the assumption, in this order.
base::Result<LengthUnit> chooseUnit(const std::filesystem::path& path, const FileMesh& file,
                                    const std::optional<std::string>& units, ImportedMesh& imported) {
    const double extent = geometry::calcBoundingBox(file.mesh).size().maxCoeff();
    if (units) {
        const std::optional<LengthUnit> asked = findUnit(*units);
        if (!asked) {
            return Error{fmt::format(
                "\"{}\" is not a unit of length that is known here. Known are um, mm, cm, m, inch "
                "and ft",
                *units)};
        }
        if (file.unit && file.unit->name != asked->name) {
            imported.notes.push_back(
                fmt::format("the file says {}, overridden with {} as asked", file.unit->name, asked->name));
        }
        imported.unitsFromFile = file.unit && file.unit->name == asked->name;
        return *asked;
    }
    if (file.unit) {
        imported.unitsFromFile = true;
        return *file.unit;
    }
    base::Result<LengthUnit> assumed = assumeUnit(extent);
    if (!assumed) return Error{fmt::format("{}: {}", path.string(), assumed.error().message)};
    imported.notes.push_back(
        fmt::format("assumed millimetres, as the file does not say its unit: the largest extent is {}. If "
                    "that is wrong, give its unit",
                    lengthText(extent * assumed->metres)));
    return assumed;
}

}  // namespace

std::vector<std::string> supportedExtensions() {
    std::vector<std::string> result;
    result.reserve(kFormats.size());
    for (const Format& format : kFormats)
        result.emplace_back(format.extension);
    return result;
}

base::Result<ImportedMesh> importMesh(const std::filesystem::path& path,
                                      const std::optional<std::string>& units) {
    if (const base::Status status = checkFile(path); !status) return status.error();
    const base::Result<Format> format = findFormat(path);
    if (!format) return format.error();
    base::Result<FileMesh> file = format->read(path);
    if (!file) return file.error();
    if (const base::Status status = checkMesh(path, file->mesh); !status) return status.error();

    ImportedMesh imported;
    const base::Result<LengthUnit> unit = chooseUnit(path, *file, units, imported);
    if (!unit) return unit.error();
    imported.units = unit->name;
    imported.notes.insert(imported.notes.begin(), file->notes.begin(), file->notes.end());
    imported.mesh = std::move(file->mesh);
    for (base::Vec3& vertex : imported.mesh.vertices)
        vertex *= unit->metres;
    return imported;
}

}  // namespace trapwright::part
