#include "core/part/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace trapwright::part {

namespace {

using base::Error;
using nlohmann::json;

// --- the chunks of a GLB (section 4.4)

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kFileHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::uint32_t readWord(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

void appendWord(std::string& bytes, std::size_t word) {
    const auto value = static_cast<std::uint32_t>(word);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Chunks {
    std::string_view text;
    std::optional<std::string_view> binary;
};

base::Result<std::string_view> readChunk(std::string_view bytes, std::size_t at, const char* name) {
    const std::size_t length = readWord(bytes, at);
    if (length > bytes.size() - at - kChunkHeader)
        return Error{fmt::format("it was cut short: its {} chunk has {} bytes, but only {} follow", name,
                                 length, bytes.size() - at - kChunkHeader)};
    return bytes.substr(at + kChunkHeader, length);
}

base::Result<Chunks> splitChunks(std::string_view bytes) {
    if (bytes.size() < kFileHeader + kChunkHeader) return Error{"it was cut short in its header"};
    if (const std::uint32_t version = readWord(bytes, 4); version != 2)
        return Error{fmt::format("it is a GLB of version {}, and only version 2 is read", version)};
    if (const std::size_t length = readWord(bytes, 8); length > bytes.size())
        return Error{
            fmt::format("it was cut short: it says it has {} bytes, but it has {}", length, bytes.size())};
    if (readWord(bytes, kFileHeader + 4) != kJsonChunk) return Error{"its first chunk is not JSON"};
    const base::Result<std::string_view> text = readChunk(bytes, kFileHeader, "JSON");
    if (!text) return text.error();
    Chunks chunks{*text, std::nullopt};
    // Some exporters forget to pad the JSON, others to count the padding.
    const std::size_t end = kFileHeader + kChunkHeader + text->size();
    for (const std::size_t at : {end, (end + 3) / 4 * 4}) {
        if (at + kChunkHeader > bytes.size() || readWord(bytes, at + 4) != kBinaryChunk) continue;
        const base::Result<std::string_view> binary = readChunk(bytes, at, "binary");
        if (!binary) return binary.error();
        chunks.binary = *binary;
        break;
    }
    return chunks;
}

std::string joinChunks(std::string text, std::optional<std::string_view> binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t padded = binary ? (binary->size() + 3) / 4 * 4 : 0;
    std::string bytes(kMagic);
    appendWord(bytes, 2);
    appendWord(bytes, kFileHeader + kChunkHeader + text.size() + (binary ? kChunkHeader + padded : 0));
    appendWord(bytes, text.size());
    appendWord(bytes, kJsonChunk);
    bytes += text;
    if (!binary) return bytes;
    appendWord(bytes, padded);
    appendWord(bytes, kBinaryChunk);
    bytes += *binary;
    bytes.append(padded - binary->size(), '\0');
    return bytes;
}

// --- the JSON

/// What readers walk by recursion.
constexpr int kDeepestJson = 64;
constexpr std::size_t kDeepestNode = 256;

base::Result<json> parseText(std::string_view text) {
    const auto limitDepth = [](int depth, json::parse_event_t, json&) {
        if (depth > kDeepestJson) throw std::length_error("nested too deep");
        return true;
    };
    try {
        json document = json::parse(text.begin(), text.end(), limitDepth);
        if (!document.is_object()) return Error{"its JSON is not an object"};
        return document;
    } catch (const json::parse_error& failure) {
        return Error{fmt::format("its JSON is damaged or was cut short at byte {}", failure.byte)};
    } catch (const std::length_error&) {
        return Error{fmt::format("its JSON is nested deeper than {} levels", kDeepestJson)};
    }
}

/// A member that is a number of something: not negative, whole.
std::optional<std::size_t> findIndex(const json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::size_t>();
}

/// A member array of objects; empty where it is not there.
base::Result<std::vector<const json*>> listObjects(const json& owner, const char* name) {
    std::vector<const json*> objects;
    const auto found = owner.find(name);
    if (found == owner.end()) return objects;
    const Error broken{fmt::format("\"{}\" is not a list of objects", name)};
    if (!found->is_array()) return broken;
    for (const json& object : *found) {
        if (!object.is_object()) return broken;
        objects.push_back(&object);
    }
    return objects;
}

base::Status checkVersion(const json& document) {
    const auto asset = document.find("asset");
    if (asset == document.end() || !asset->is_object() || !asset->contains("version") ||
        !(*asset)["version"].is_string())
        return Error{"it is not glTF: it has no \"asset\" with a version"};
    const auto version = (*asset)["version"].get<std::string>();
    if (!version.starts_with("2"))
        return Error{fmt::format("it is glTF {}, and only glTF 2.0 is read", version.substr(0, 16))};
    const auto required = document.find("extensionsRequired");
    if (required == document.end() || !required->is_array()) return base::success();
    for (const json& name : *required) {
        for (const char* unread :
             {"EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization"})
            if (name == unread)
                return Error{
                    fmt::format("it needs the extension {}, which is not read: export it without", unread)};
    }
    return base::success();
}

/// Nodes are trees: without loops, without a node in two places, and not too deep to walk.
base::Result<std::vector<std::size_t>> findRoots(const std::vector<const json*>& nodes) {
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> parents(nodes.size(), kNone);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto children = nodes[i]->find("children");
        if (children == nodes[i]->end()) continue;
        if (!children->is_array()) return Error{fmt::format("node {} has children that are not a list", i)};
        for (const json& child : *children) {
            if (!child.is_number_unsigned() || child.get<std::size_t>() >= nodes.size())
                return Error{fmt::format("node {} has a child that is not there", i)};
            std::size_t& parent = parents[child.get<std::size_t>()];
            if (parent != kNone)
                return Error{fmt::format("node {} is the child of two nodes", child.get<std::size_t>())};
            parent = i;
        }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::size_t depth = 0;
        for (std::size_t at = i; parents[at] != kNone; at = parents[at])
            if (++depth > kDeepestNode)
                return Error{
                    fmt::format("node {} is below more than {} others, or below itself", i, kDeepestNode)};
        if (parents[i] == kNone) roots.push_back(i);
    }
    return roots;
}

constexpr std::size_t kFloat = 5126;  // accessors' component type (section 5.1.3)
constexpr std::array<std::size_t, 3> kIndexTypes = {5121, 5123, 5125};
enum Mode : std::size_t { triangles = 4, triangleStrip = 5, triangleFan = 6 };

/// The triangles that a primitive announces.
base::Result<std::size_t> countTriangles(const json& primitive, const std::vector<const json*>& accessors) {
    const auto findAccessor = [&](const json& owner, const char* name) -> const json* {
        const std::optional<std::size_t> index = findIndex(owner, name);
        return index && *index < accessors.size() ? accessors[*index] : nullptr;
    };
    const std::size_t mode =
        primitive.contains("mode") ? findIndex(primitive, "mode").value_or(99) : triangles;
    if (mode > triangleFan) return Error{"has a mode that is not known"};
    if (mode < triangles) return std::size_t{0};  // points and lines
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object() || !attributes->contains("POSITION"))
        return Error{"has no positions"};
    const json* corners = findAccessor(*attributes, "POSITION");
    if (corners == nullptr) return Error{"has positions that are not there"};
    if (findIndex(*corners, "componentType") != kFloat || corners->value("type", json()) != "VEC3")
        return Error{
            "has positions that are not three single-precision numbers (KHR_mesh_quantization is not read)"};
    if (primitive.contains("indices")) {
        corners = findAccessor(primitive, "indices");
        if (corners == nullptr) return Error{"has indices that are not there"};
        const std::size_t type = findIndex(*corners, "componentType").value_or(0);
        if (std::find(kIndexTypes.begin(), kIndexTypes.end(), type) == kIndexTypes.end())
            return Error{"has indices that are not whole numbers"};
    }
    const std::size_t count = findIndex(*corners, "count").value_or(0);
    if (count < 3 || (mode == triangles && count % 3 != 0))
        return Error{fmt::format("has {} corners, which do not make triangles", count)};
    return mode == triangles ? count / 3 : count - 2;
}

base::Result<std::size_t> countTriangles(const json& document) {
    const base::Result<std::vector<const json*>> accessors = listObjects(document, "accessors");
    if (!accessors) return accessors.error();
    const base::Result<std::vector<const json*>> meshes = listObjects(document, "meshes");
    if (!meshes) return meshes.error();
    std::size_t sum = 0;
    for (std::size_t i = 0; i < meshes->size(); ++i) {
        const base::Result<std::vector<const json*>> primitives = listObjects(*(*meshes)[i], "primitives");
        if (!primitives) return primitives.error();
        for (const json* primitive : *primitives) {
            const base::Result<std::size_t> count = countTriangles(*primitive, *accessors);
            if (!count) return Error{fmt::format("mesh {} {}", i, count.error().message)};
            sum += *count;
        }
    }
    if (sum == 0) return Error{"it has no triangles"};
    return sum;
}

/// A copy of an object with the named members only.
json keepMembers(const json& object, std::initializer_list<const char*> names) {
    json kept = json::object();
    for (const char* name : names)
        if (const auto found = object.find(name); found != object.end()) kept[name] = *found;
    return kept;
}

/// Only what places triangles: readers fail on skins, morph targets, animations and materials that we do not
/// look at.
json keepShape(const json& document) {
    json kept = keepMembers(document, {"asset", "scene", "scenes", "nodes", "meshes", "accessors",
                                       "bufferViews", "buffers", "extensionsUsed", "extensionsRequired"});
    kept["asset"] = keepMembers(document["asset"], {"version"});
    for (json& node : kept["nodes"])
        node = keepMembers(node, {"children", "mesh", "matrix", "translation", "rotation", "scale"});
    for (json& mesh : kept["meshes"]) {
        mesh = keepMembers(mesh, {"primitives"});
        for (json& primitive : mesh["primitives"]) {
            primitive = keepMembers(primitive, {"attributes", "indices", "mode", "extensions"});
            if (primitive.contains("attributes"))
                primitive["attributes"] = keepMembers(primitive["attributes"], {"POSITION"});
            if (primitive.contains("extensions") && primitive["extensions"].is_object())
                primitive["extensions"] =
                    keepMembers(primitive["extensions"], {"KHR_draco_mesh_compression"});
        }
    }
    return kept;
}

}  // namespace

base::Result<GltfDocument> checkGltf(std::string_view bytes) {
    GltfDocument result;
    result.isBinary = bytes.starts_with(kMagic);
    Chunks chunks{bytes, std::nullopt};
    if (result.isBinary) {
        const base::Result<Chunks> split = splitChunks(bytes);
        if (!split) return split.error();
        chunks = *split;
    }
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    if (chunks.text.starts_with(kMark)) chunks.text.remove_prefix(kMark.size());
    // Some pad with zeros what is to be padded with blanks.
    while (chunks.text.ends_with('\0'))
        chunks.text.remove_suffix(1);

    base::Result<json> document = parseText(chunks.text);
    if (!document) return document.error();
    if (const base::Status status = checkVersion(*document); !status) return status.error();
    const base::Result<std::vector<const json*>> nodes = listObjects(*document, "nodes");
    if (!nodes) return nodes.error();
    if (nodes->empty()) return Error{"it has no nodes, so nothing is placed in its scene"};
    const base::Result<std::vector<std::size_t>> roots = findRoots(*nodes);
    if (!roots) return roots.error();
    const base::Result<std::size_t> count = countTriangles(*document);
    if (!count) return count.error();
    result.triangles = *count;

    json shape = keepShape(*document);
    if (!shape.contains("scenes")) {
        shape["scenes"] = json::array({{{"nodes", *roots}}});
        shape["scene"] = 0;
    }
    std::string text = shape.dump();
    result.bytes = result.isBinary ? joinChunks(std::move(text), chunks.binary) : std::move(text);
    return result;
}

}  // namespace trapwright::part
