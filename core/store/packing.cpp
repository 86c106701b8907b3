#include "core/store/packing.h"

#include <bit>
#include <cstdint>

namespace trapwright::store {

namespace {

constexpr std::size_t kBitsPerByte = 8;

template <class Word>
void append(std::string& blob, Word word) {
    for (std::size_t i = 0; i < sizeof(Word); ++i)
        blob += static_cast<char>((word >> (kBitsPerByte * i)) & 0xFFU);
}

template <class Word>
Word wordAt(std::string_view blob, std::size_t offset) {
    Word word = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
        word |= static_cast<Word>(static_cast<unsigned char>(blob[offset + i])) << (kBitsPerByte * i);
    }
    return word;
}

}  // namespace

std::string packBits(const evolution::Bits& bits) {
    std::string blob;
    append(blob, static_cast<std::uint32_t>(bits.size()));
    const std::size_t header = blob.size();
    blob.resize(header + (bits.size() + kBitsPerByte - 1) / kBitsPerByte, '\0');
    for (std::size_t i = 0; i < bits.size(); ++i) {
        if (bits[i] != 0) blob[header + i / kBitsPerByte] |= static_cast<char>(1U << (i % kBitsPerByte));
    }
    return blob;
}

std::optional<evolution::Bits> unpackBits(std::string_view blob) {
    constexpr std::size_t kHeader = sizeof(std::uint32_t);
    if (blob.size() < kHeader) return std::nullopt;
    const std::size_t count = wordAt<std::uint32_t>(blob, 0);
    if (blob.size() != kHeader + (count + kBitsPerByte - 1) / kBitsPerByte) return std::nullopt;
    evolution::Bits bits(count);
    for (std::size_t i = 0; i < count; ++i) {
        bits[i] = (static_cast<unsigned char>(blob[kHeader + i / kBitsPerByte]) >> (i % kBitsPerByte)) & 1U;
    }
    return bits;
}

std::string packVertices(const std::vector<base::Vec3>& vertices) {
    std::string blob;
    blob.reserve(vertices.size() * 3 * sizeof(double));
    for (const base::Vec3& vertex : vertices) {
        for (int k = 0; k < 3; ++k)
            append(blob, std::bit_cast<std::uint64_t>(vertex[k]));
    }
    return blob;
}

std::optional<std::vector<base::Vec3>> unpackVertices(std::string_view blob) {
    constexpr std::size_t kSize = 3 * sizeof(double);
    if (blob.size() % kSize != 0) return std::nullopt;
    std::vector<base::Vec3> vertices(blob.size() / kSize);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            vertices[i][static_cast<Eigen::Index>(k)] =
                std::bit_cast<double>(wordAt<std::uint64_t>(blob, i * kSize + k * sizeof(double)));
        }
    }
    return vertices;
}

std::string packTriangles(const std::vector<geometry::Triangle>& triangles) {
    std::string blob;
    blob.reserve(triangles.size() * 3 * sizeof(std::uint32_t));
    for (const geometry::Triangle& triangle : triangles) {
        for (const int index : triangle)
            append(blob, static_cast<std::uint32_t>(index));
    }
    return blob;
}

std::optional<std::vector<geometry::Triangle>> unpackTriangles(std::string_view blob,
                                                               std::size_t vertexCount) {
    constexpr std::size_t kSize = 3 * sizeof(std::uint32_t);
    if (blob.size() % kSize != 0) return std::nullopt;
    std::vector<geometry::Triangle> triangles(blob.size() / kSize);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto index = wordAt<std::uint32_t>(blob, i * kSize + k * sizeof(std::uint32_t));
            if (index >= vertexCount) return std::nullopt;
            triangles[i][k] = static_cast<int>(index);
        }
    }
    return triangles;
}

}  // namespace trapwright::store
