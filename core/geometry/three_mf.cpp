#include "core/geometry/three_mf.h"

#include <Model/COM/NMR_DLLInterfaces.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "core/base/file.h"

namespace trapwright::geometry {

namespace {

/// A handle of lib3mf, released with its scope.
class Handle {
 public:
    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (object_ != nullptr) NMR::lib3mf_release(object_);
    }
    NMR::PLib3MFBase** out() { return &object_; }
    [[nodiscard]] NMR::PLib3MFBase* get() const { return object_; }

 private:
    NMR::PLib3MFBase* object_ = nullptr;
};

class PackageFailure : public std::exception {
 public:
    explicit PackageFailure(std::string text) : text_(std::move(text)) {}
    [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
    std::string text_;
};

void check(LIB3MFRESULT result, const Handle& object) {
    if (result == 0) return;
    DWORD code = 0;
    LPCSTR text = nullptr;
    if (object.get() != nullptr) NMR::lib3mf_getlasterror(object.get(), &code, &text);
    throw PackageFailure(
        "lib3mf: " + (text != nullptr && *text != '\0' ? std::string(text) : "unknown error") + " (" +
        std::to_string(code != 0 ? code : static_cast<DWORD>(result)) + ")");
}

// [m], in the order of lib3mf's MODELUNIT constants: micrometre, millimetre, centimetre, inch, foot, metre.
constexpr std::array<double, 6> kUnits = {1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1.0};

void addObject(const Handle& model, const TriangleMesh& mesh, const std::string& name) {
    std::vector<NMR::MODELMESHVERTEX> vertices(mesh.vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            vertices[i].m_fPosition[axis] = static_cast<float>(mesh.vertices[i][axis] / base::kMillimetre);
    const auto isBroken = [](const base::Vec3& v) { return !v.allFinite(); };
    if (std::any_of(mesh.vertices.begin(), mesh.vertices.end(), isBroken))
        throw PackageFailure("a coordinate is not a finite number");
    std::vector<NMR::MODELMESHTRIANGLE> triangles(mesh.triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            triangles[i].m_nIndices[k] = static_cast<DWORD>(mesh.triangles[i][k]);

    Handle object;
    Handle item;
    check(NMR::lib3mf_model_addmeshobject(model.get(), object.out()), model);
    check(NMR::lib3mf_object_setnameutf8(object.get(), name.c_str()), object);
    check(
        NMR::lib3mf_meshobject_setgeometry(object.get(), vertices.data(), static_cast<DWORD>(vertices.size()),
                                           triangles.data(), static_cast<DWORD>(triangles.size())),
        object);
    check(NMR::lib3mf_model_addbuilditem(model.get(), object.get(), nullptr, item.out()), model);
}

std::string packMeshes(std::span<const TriangleMesh> meshes, const std::string& name) {
    Handle model;
    Handle writer;
    check(NMR::lib3mf_createmodel(model.out()), model);
    check(NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER), model);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::string piece = ", piece " + std::to_string(i + 1) + " of " + std::to_string(meshes.size());
        addObject(model, meshes[i], meshes.size() == 1 ? name : name + piece);
    }
    check(NMR::lib3mf_model_querywriter(model.get(), "3mf", writer.out()), model);
    // Into memory, so that our own writer is the only one that meets full disks.
    ULONG64 size = 0;
    check(NMR::lib3mf_writer_getstreamsize(writer.get(), &size), writer);
    std::string bytes(size, '\0');
    check(NMR::lib3mf_writer_writetobuffer(writer.get(), reinterpret_cast<BYTE*>(bytes.data()), size),
          writer);
    return bytes;
}

void appendObject(const Handle& object, double unit, TriangleMesh& mesh) {
    DWORD vertexCount = 0;
    DWORD triangleCount = 0;
    check(NMR::lib3mf_meshobject_getvertexcount(object.get(), &vertexCount), object);
    check(NMR::lib3mf_meshobject_gettrianglecount(object.get(), &triangleCount), object);
    std::vector<NMR::MODELMESHVERTEX> vertices(vertexCount);
    std::vector<NMR::MODELMESHTRIANGLE> triangles(triangleCount);
    check(NMR::lib3mf_meshobject_getvertices(object.get(), vertices.data(), vertexCount, nullptr), object);
    check(NMR::lib3mf_meshobject_gettriangleindices(object.get(), triangles.data(), triangleCount, nullptr),
          object);
    const int first = static_cast<int>(mesh.vertices.size());
    for (const NMR::MODELMESHVERTEX& v : vertices)
        mesh.vertices.push_back(unit * base::Vec3(v.m_fPosition[0], v.m_fPosition[1], v.m_fPosition[2]));
    for (const NMR::MODELMESHTRIANGLE& t : triangles)
        mesh.triangles.push_back({first + static_cast<int>(t.m_nIndices[0]),
                                  first + static_cast<int>(t.m_nIndices[1]),
                                  first + static_cast<int>(t.m_nIndices[2])});
}

/// Reads a package into a model; its unit in metres.
double readModel(std::string bytes, Handle& model) {
    if (const base::Status status = checkPackageSize(bytes); !status)
        throw PackageFailure(status.error().message);
    Handle reader;
    check(NMR::lib3mf_createmodel(model.out()), model);
    check(NMR::lib3mf_model_queryreader(model.get(), "3mf", reader.out()), model);
    check(
        NMR::lib3mf_reader_readfrombuffer(reader.get(), reinterpret_cast<BYTE*>(bytes.data()), bytes.size()),
        reader);
    DWORD unit = NMR::MODELUNIT_MILLIMETER;
    check(NMR::lib3mf_model_getunit(model.get(), &unit), model);
    if (unit >= kUnits.size()) throw PackageFailure("lib3mf: unknown unit");
    return kUnits[unit];
}

std::vector<TriangleMesh> listObjects(const Handle& model, double unit) {
    Handle objects;
    check(NMR::lib3mf_model_getmeshobjects(model.get(), objects.out()), model);
    std::vector<TriangleMesh> meshes;
    while (true) {
        BOOL hasNext = 0;
        check(NMR::lib3mf_resourceiterator_movenext(objects.get(), &hasNext), objects);
        if (!hasNext) return meshes;
        Handle object;
        check(NMR::lib3mf_resourceiterator_getcurrent(objects.get(), object.out()), objects);
        appendObject(object, unit, meshes.emplace_back());
    }
}

PackagedMesh unpackMesh(std::string bytes) {
    Handle model;
    Handle merged;
    PackagedMesh result{{}, readModel(std::move(bytes), model)};
    // Resolves build items and components into one mesh object in its place.
    check(NMR::lib3mf_model_mergetomodel(model.get(), merged.out()), model);
    for (const TriangleMesh& mesh : listObjects(merged, result.unit)) {
        const int first = static_cast<int>(result.mesh.vertices.size());
        result.mesh.vertices.insert(result.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (const Triangle& t : mesh.triangles)
            result.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return result;
}

base::Error makeReadError(const std::filesystem::path& path, const char* reason) {
    return base::Error{"Cannot read " + path.string() + " as a 3MF file: " + reason + ". Export it again."};
}

using base::Error;

constexpr std::uint64_t kMost = 512ULL << 20U;  // [bytes]
// Deflate reaches 1030 to 1; models of one million equal numbers stay below 200.
constexpr std::uint64_t kMostRatio = 250;
constexpr std::uint64_t kRatioFrom = 16ULL << 20U;  // [bytes]

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

std::string formatMebibytes(std::uint64_t bytes) {
    return std::to_string(bytes >> 20U) + " MiB";
}

/// Unpacks one file into nothing, because the size in the directory is only its word.
base::Status checkFile(zip_t* archive, const zip_stat_t& entry) {
    const std::string name = std::string("its file \"") + entry.name + "\" ";
    const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive, entry.index, 0));
    if (!file) return Error{name + "cannot be unpacked: " + zip_strerror(archive)};
    std::array<char, 65536> block{};
    std::uint64_t size = 0;
    while (true) {
        const zip_int64_t read = zip_fread(file.get(), block.data(), block.size());
        if (read < 0) return Error{name + "is damaged: " + zip_file_strerror(file.get())};
        size += static_cast<std::uint64_t>(read);
        if (size > entry.size) return Error{name + "is larger than the package says"};
        if (read == 0) break;
    }
    if (size < entry.size) return Error{name + "is smaller than the package says: the package is damaged"};
    return base::success();
}

}  // namespace

base::Status write3mf(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                      const std::string& name) {
    const auto isEmpty = [](const TriangleMesh& mesh) { return mesh.triangles.empty(); };
    if (meshes.empty() || std::any_of(meshes.begin(), meshes.end(), isEmpty))
        return base::Error{"Cannot write " + path.string() + ": the mesh has no triangles."};
    try {
        return base::writeFile(path, packMeshes(meshes, name));
    } catch (const std::exception& failure) {
        return base::Error{"Cannot write " + path.string() + ": the mesh does not fit into a 3MF file, " +
                           failure.what() + ". Repair the mesh, or export an STL."};
    }
}

base::Result<PackagedMesh> read3mfWithUnit(const std::filesystem::path& path) {
    base::Result<std::string> bytes = base::readFile(path);
    if (!bytes) return bytes.error();
    try {
        PackagedMesh package = unpackMesh(std::move(*bytes));
        if (package.mesh.triangles.empty())
            return base::Error{"Cannot read " + path.string() +
                               ": its build holds no mesh. Export it again."};
        return package;
    } catch (const std::exception& failure) {
        return makeReadError(path, failure.what());
    }
}

base::Result<TriangleMesh> read3mf(const std::filesystem::path& path) {
    base::Result<PackagedMesh> package = read3mfWithUnit(path);
    if (!package) return package.error();
    return std::move(package->mesh);
}

base::Result<std::vector<TriangleMesh>> read3mfObjects(const std::filesystem::path& path) {
    base::Result<std::string> bytes = base::readFile(path);
    if (!bytes) return bytes.error();
    try {
        Handle model;
        const double unit = readModel(std::move(*bytes), model);
        return listObjects(model, unit);
    } catch (const std::exception& failure) {
        return makeReadError(path, failure.what());
    }
}

base::Status checkPackageSize(std::string_view package) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(package.data(), package.size(), 0, &error);
    const std::unique_ptr<zip_t, Discard> archive(
        source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive) {
        Error failure{std::string("it is not a zip package, or was cut short: ") +
                      zip_error_strerror(&error)};
        if (source != nullptr) zip_source_free(source);
        zip_error_fini(&error);
        return failure;
    }
    zip_error_fini(&error);

    const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0));
    if (count == 0) return Error{"it is a package with nothing in it"};
    constexpr zip_uint64_t kNeeded = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_NAME | ZIP_STAT_INDEX;
    std::uint64_t unpacked = 0;
    for (zip_uint64_t i = 0; i < count; ++i) {
        zip_stat_t entry;
        if (zip_stat_index(archive.get(), i, 0, &entry) != 0 || (entry.valid & kNeeded) != kNeeded)
            return Error{"its directory is damaged"};
        // Not their sum first: it could overflow.
        if (entry.size > kMost - unpacked)
            return Error{"it unpacks to more than " + formatMebibytes(kMost) + ", the most that is read"};
        unpacked += entry.size;
        if (entry.size > kRatioFrom && entry.size / kMostRatio > entry.comp_size)
            return Error{std::string("its file \"") + entry.name + "\" unpacks from " +
                         std::to_string(entry.comp_size) + " bytes to " + formatMebibytes(entry.size) +
                         ", which no model does"};
    }
    for (zip_uint64_t i = 0; i < count; ++i) {
        zip_stat_t entry;
        zip_stat_index(archive.get(), i, 0, &entry);
        if (base::Status status = checkFile(archive.get(), entry); !status) return status;
    }
    return base::success();
}

}  // namespace trapwright::geometry
