#pragma once

#include <QByteArray>
#include <QByteArrayList>
#include <QtEndian>
#include <array>
#include <cstdint>

/// A cube of 10 file units in the formats and flavours that exporters write.
namespace mesh_files {

inline QByteArray vertices(const char* before, const char* behind) {
    QByteArray text;
    for (int i = 0; i < 8; ++i)
        text += before + QByteArray::number(i % 2 * 10) + ' ' + QByteArray::number(i / 2 % 2 * 10) + ' ' +
                QByteArray::number(i / 4 * 10) + behind + '\n';
    return text;
}

constexpr std::array<std::array<int, 4>, 6> kSides = {
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

/// Each side as a line: its corners counted from `first`, with `behindCorner` after each.
inline QByteArray sides(const char* before, int first, const char* behindCorner, const char* behind) {
    QByteArray text;
    for (const auto& side : kSides) {
        text += before;
        for (const int corner : side)
            text += ' ' + QByteArray::number(corner + first) + behindCorner;
        text += QByteArray(behind) + '\n';
    }
    return text;
}

inline QByteArray obj() {
    return vertices("v ", "") + sides("f", 1, "", "");
}

inline QByteArray off() {
    return "OFF\n8 6 12\n" + vertices("", "") + sides("4", 0, "", "");
}

inline QByteArray plyHeader(const char* format, const QByteArray& vertexExtra, const QByteArray& faceExtra) {
    return QByteArray("ply\nformat ") + format +
           " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n" + vertexExtra +
           "element face 6\nproperty list uchar int vertex_indices\n" + faceExtra;
}

inline QByteArray ply() {
    return plyHeader("ascii", "", "") + "end_header\n" + vertices("", "") + sides("4", 0, "", "");
}

template <class T>
void append(QByteArray& bytes, T value, bool bigEndian) {
    std::array<char, sizeof(T)> raw{};
    if (bigEndian)
        qToBigEndian(value, raw.data());
    else
        qToLittleEndian(value, raw.data());
    bytes.append(raw.data(), sizeof(T));
}

/// With a colour and a list more than is needed, and an element of neither vertices nor faces.
inline QByteArray binaryPly(bool bigEndian) {
    QByteArray bytes = plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian",
                                 "property uchar red\n", "property list ushort double uv\n") +
                       "element edge 2\nproperty short a\nproperty uint b\nend_header\n";
    for (int i = 0; i < 8; ++i) {
        for (const int coordinate : {i % 2 * 10, i / 2 % 2 * 10, i / 4 * 10})
            append(bytes, static_cast<float>(coordinate), bigEndian);
        append<std::uint8_t>(bytes, 200, bigEndian);
    }
    for (const auto& side : kSides) {
        append<std::uint8_t>(bytes, 4, bigEndian);
        for (const int corner : side)
            append<std::int32_t>(bytes, corner, bigEndian);
        append<std::uint16_t>(bytes, 1, bigEndian);
        append(bytes, 0.5, bigEndian);
    }
    return bytes + QByteArray(12, '\1');
}

inline QByteArray stl() {
    QByteArray text = "solid cube\n";
    for (const auto& side : kSides)
        for (const std::array<int, 3>& pick : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            text += "facet normal 0 0 0\n outer loop\n";
            for (const int k : pick)
                text +=
                    "  vertex " + vertices("", "").split('\n').at(side[static_cast<std::size_t>(k)]) + '\n';
            text += " endloop\nendfacet\n";
        }
    return text + "endsolid cube\n";
}

inline QByteArray binaryStl(const QByteArray& header) {
    QByteArray bytes = header.leftJustified(80, '\0', true);
    append<std::uint32_t>(bytes, 12, false);
    for (const auto& side : kSides)
        for (const std::array<int, 3>& pick : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            for (int i = 0; i < 3; ++i)
                append(bytes, 0.0F, false);
            for (const int k : pick) {
                const int corner = side[static_cast<std::size_t>(k)];
                for (const int coordinate : {corner % 2 * 10, corner / 2 % 2 * 10, corner / 4 * 10})
                    append(bytes, static_cast<float>(coordinate), false);
            }
            append<std::uint16_t>(bytes, 0, false);
        }
    return bytes;
}

/// Positions, then the corners of 12 triangles of one byte each.
inline QByteArray gltfBuffer() {
    QByteArray buffer;
    for (int i = 0; i < 8; ++i)
        for (const int coordinate : {i % 2 * 10, i / 2 % 2 * 10, i / 4 * 10})
            append(buffer, static_cast<float>(coordinate) / 1000.0F, false);
    for (const auto& side : kSides)
        for (const std::size_t k : {0, 1, 2, 0, 2, 3})
            append(buffer, static_cast<std::uint8_t>(side[k]), false);
    return buffer;
}

/// `buffer`: the members of the buffer before its length. `more`: members of the document.
inline QByteArray gltf(const QByteArray& buffer, const QByteArray& more = R"(,"scenes":[{"nodes":[0]}])") {
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "accessors":[
        {"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[0.01,0.01,0.01]},
        {"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"}],
      "bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36}],
      "buffers":[{)" +
           buffer + R"("byteLength":132}])" + more + "}";
}

inline QByteArray embeddedGltf() {
    return gltf(R"("uri":"data:application/octet-stream;base64,)" + gltfBuffer().toBase64() + "\",");
}

/// As binary; `aligned` pads both chunks to four bytes, as the format asks for.
inline QByteArray glb(bool aligned) {
    QByteArray text = gltf("");
    QByteArray buffer = gltfBuffer();
    while (text.size() % 4 != (aligned ? 0 : 1))
        text += ' ';
    QByteArray bytes = "glTF";
    append<std::uint32_t>(bytes, 2, false);
    append<std::uint32_t>(bytes, static_cast<std::uint32_t>(28 + text.size() + buffer.size()), false);
    append<std::uint32_t>(bytes, static_cast<std::uint32_t>(text.size()), false);
    bytes += "JSON" + text;
    append<std::uint32_t>(bytes, static_cast<std::uint32_t>(buffer.size()), false);
    return bytes + QByteArray("BIN\0", 4) + buffer;
}

}  // namespace mesh_files
