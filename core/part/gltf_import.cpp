#include "core/part/gltf_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <deque>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/file.h"
#include "core/part/gltf_document.h"

namespace trapwright::part {

namespace {

namespace fs = std::filesystem;
using base::Error;

// Validation comes first: later steps abort the program on data that is not valid.
constexpr unsigned kSteps = aiProcess_ValidateDataStructure | aiProcess_SortByPType;
// A node that places a large mesh can stand in a file a thousand times.
constexpr std::size_t kMostTriangles = 20'000'000;

/// "my%20cube.bin" as the file is called.
std::string decodePercent(std::string_view text) {
    const auto digit = [](char c) {
        const std::string_view digits = "0123456789abcdef";
        return digits.find(static_cast<char>(c >= 'A' && c <= 'F' ? c + 32 : c));
    };
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) < 16 && digit(text[i + 2]) < 16) {
            result += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

/// What assimp may open: the part's file, from memory, and regular files in its folder.
class PartFolder : public Assimp::IOSystem {
 public:
    PartFolder(const fs::path& folder, std::string name, std::string bytes)
        : folder_(fs::weakly_canonical(folder)), name_(std::move(name)) {
        files_.push_back(std::move(bytes));
    }

    [[nodiscard]] bool Exists(const char* file) const override { return file == name_; }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    void Close(Assimp::IOStream* stream) override { delete stream; }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
        if (file == name_) return makeStream(files_.front());
        const base::Result<fs::path> place = findPlace(file);
        if (!place) return refuse(place.error());
        base::Result<std::string> bytes = base::readFile(*place);
        if (!bytes) return refuse(bytes.error());
        files_.push_back(std::move(*bytes));
        return makeStream(files_.back());
    }

    /// Why the first file that was refused was.
    [[nodiscard]] const std::optional<Error>& refusal() const { return refusal_; }

 private:
    static Assimp::IOStream* makeStream(const std::string& bytes) {
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }

    Assimp::IOStream* refuse(Error error) {
        if (!refusal_) refusal_ = std::move(error);
        return nullptr;
    }

    [[nodiscard]] base::Result<fs::path> findPlace(const std::string& file) const {
        std::error_code failure;
        fs::path place = fs::weakly_canonical(file, failure);
        if (failure || !fs::exists(place, failure))
            place = fs::weakly_canonical(decodePercent(file), failure);
        const fs::path relative = place.lexically_relative(folder_);
        if (relative.empty() || *relative.begin() == "..")
            return Error{
                fmt::format("its data are in {}, outside the part's folder {}, and only files in that "
                            "folder are read. Copy the file there or export the part as .glb",
                            place.string(), folder_.string())};
        if (!fs::exists(place, failure))
            return Error{
                fmt::format("its data are in {}, which does not exist. Copy the file there or export "
                            "the part as .glb",
                            place.string())};
        if (!fs::is_regular_file(place, failure))
            return Error{fmt::format(
                "its data are in {}, which is not a regular file. Export the part as .glb", place.string())};
        return place;
    }

    fs::path folder_;
    std::string name_;
    std::deque<std::string> files_;  // streams look into them
    std::optional<Error> refusal_;
};

/// Adds a node and all below it; false where there are more triangles than a part can have.
bool appendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
                geometry::TriangleMesh& mesh) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    // A mirroring transform turns triangles inside out.
    const bool mirrored = aiMatrix3x3(transform).Determinant() < 0.0F;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
        if (mesh.triangles.size() + part.mNumFaces > kMostTriangles) return false;
        const int first = static_cast<int>(mesh.vertices.size());
        for (unsigned v = 0; v < part.mNumVertices; ++v) {
            const aiVector3D point = transform * part.mVertices[v];
            mesh.vertices.emplace_back(point.x, point.y, point.z);
        }
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            const aiFace& face = part.mFaces[f];
            if (face.mNumIndices != 3) continue;
            const auto corner = [&](int k) { return first + static_cast<int>(face.mIndices[k]); };
            mesh.triangles.push_back({corner(0), corner(mirrored ? 2 : 1), corner(mirrored ? 1 : 2)});
        }
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (!appendNode(scene, *node.mChildren[i], transform, mesh)) return false;
    return true;
}

std::size_t countTriangles(const aiScene& scene) {
    std::size_t count = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i)
        if (scene.mMeshes[i]->mPrimitiveTypes == aiPrimitiveType_TRIANGLE)
            count += scene.mMeshes[i]->mNumFaces;
    return count;
}

Error makeError(const fs::path& path, std::string_view what) {
    while (what.ends_with('.'))
        what.remove_suffix(1);
    return Error{fmt::format("Cannot read {} as a glTF file: {}. Export it again.", path.string(), what)};
}

}  // namespace

base::Result<FileMesh> readGltfFile(const fs::path& path) {
    const base::Result<std::string> bytes = base::readFile(path);
    if (!bytes) return bytes.error();
    FileMesh result;
    try {
        base::Result<GltfDocument> document = checkGltf(*bytes);
        if (!document) return makeError(path, document.error().message);
        const fs::path folder = fs::absolute(path).parent_path();
        // Assimp tells the two kinds by the extension alone.
        const std::string name = folder / (document->isBinary ? "part.glb" : "part.gltf");

        Assimp::Importer importer;
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        auto* files = new PartFolder(folder, name, std::move(document->bytes));
        importer.SetIOHandler(files);  // and owns it
        const aiScene* scene = importer.ReadFile(name, kSteps);
        if (scene == nullptr || scene->mRootNode == nullptr) {
            if (files->refusal())
                return Error{fmt::format("Cannot read {}: {}.", path.string(), files->refusal()->message)};
            return makeError(path, importer.GetErrorString());
        }
        if (const std::size_t count = countTriangles(*scene); count < document->triangles)
            return makeError(path, fmt::format("{} of its {} triangles have a vertex that is not there",
                                               document->triangles - count, document->triangles));
        if (!appendNode(*scene, *scene->mRootNode, aiMatrix4x4(), result.mesh))
            return makeError(path, fmt::format("it has more than {} triangles", kMostTriangles));
        if (scene->mNumMeshes > 1)
            result.notes.push_back(fmt::format("joined the {} meshes of the file", scene->mNumMeshes));
    } catch (const std::exception& failure) {
        return makeError(path, failure.what());
    }
    result.unit = LengthUnit{"m", 1.0};  // section 3.4: all linear distances are metres
    return result;
}

}  // namespace trapwright::part
