#include "core/part/mesh_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <exception>

namespace trapwright::part {

namespace {

using base::Error;

// Validation comes first: later steps abort the program on data that is not valid.
constexpr unsigned kSteps = aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType;

void appendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
                geometry::TriangleMesh& mesh) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    // A mirroring transform turns triangles inside out.
    const bool mirrored = aiMatrix3x3(transform).Determinant() < 0.0F;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
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
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        appendNode(scene, *node.mChildren[i], transform, mesh);
    }
}

}  // namespace

base::Result<FileMesh> readMeshFile(const std::filesystem::path& path) {
    FileMesh result;
    try {
        Assimp::Importer importer;
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        const aiScene* scene = importer.ReadFile(path.string(), kSteps);
        if (scene == nullptr || scene->mRootNode == nullptr) {
            return Error{fmt::format(
                "{} could not be read as a {} file: {}. Check that it is complete and of that format",
                path.string(), path.extension().string(), importer.GetErrorString())};
        }
        appendNode(*scene, *scene->mRootNode, aiMatrix4x4(), result.mesh);
        if (scene->mNumMeshes > 1) {
            result.notes.push_back(fmt::format("joined the {} meshes of the file", scene->mNumMeshes));
        }
    } catch (const std::exception& failure) {
        return Error{fmt::format("{} could not be read: {}", path.string(), failure.what())};
    }
    return result;
}

}  // namespace trapwright::part
