#include "core/store/packing.h"

#include "core/base/byte_archive.h"

namespace trapwright::store {

std::string packNumbers(std::span<const double> numbers) {
    base::ByteWriter writer;
    for (const double number : numbers)
        writer(number);
    return writer.bytes();
}

std::optional<std::vector<double>> unpackNumbers(std::string_view blob) {
    if (blob.size() % sizeof(double) != 0) return std::nullopt;
    base::ByteReader reader(blob);
    std::vector<double> numbers(blob.size() / sizeof(double));
    for (double& number : numbers)
        reader(number);
    return numbers;
}

std::string packVertices(const std::vector<base::Vec3>& vertices) {
    base::ByteWriter writer;
    for (const base::Vec3& vertex : vertices)
        writer(vertex);
    return writer.bytes();
}

std::optional<std::vector<base::Vec3>> unpackVertices(std::string_view blob) {
    constexpr std::size_t kSize = 3 * sizeof(double);
    if (blob.size() % kSize != 0) return std::nullopt;
    base::ByteReader reader(blob);
    std::vector<base::Vec3> vertices(blob.size() / kSize);
    for (base::Vec3& vertex : vertices)
        reader(vertex);
    return vertices;
}

std::string packTriangles(const std::vector<geometry::Triangle>& triangles) {
    base::ByteWriter writer;
    for (const geometry::Triangle& triangle : triangles) {
        for (const int index : triangle)
            writer(static_cast<std::uint32_t>(index));
    }
    return writer.bytes();
}

std::optional<std::vector<geometry::Triangle>> unpackTriangles(std::string_view blob,
                                                               std::size_t vertexCount) {
    constexpr std::size_t kSize = 3 * sizeof(std::uint32_t);
    if (blob.size() % kSize != 0) return std::nullopt;
    base::ByteReader reader(blob);
    std::vector<geometry::Triangle> triangles(blob.size() / kSize);
    for (geometry::Triangle& triangle : triangles) {
        for (int& index : triangle) {
            std::uint32_t read = 0;
            reader(read);
            if (read >= vertexCount) return std::nullopt;
            index = static_cast<int>(read);
        }
    }
    return triangles;
}

}  // namespace trapwright::store
