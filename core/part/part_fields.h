#pragma once

#include <algorithm>
#include <array>

#include "core/base/byte_archive.h"
#include "core/part/part.h"

/// What a part and its solids consist of, for base::ByteWriter and base::ByteReader; and whether what came
/// that way hangs together. What changes here changes the bytes of trial::encode, too: see its version.

namespace trapwright::geometry {

template <class Archive, base::OrConst<TriangleMesh> T>
void serialize(Archive& archive, T& mesh) {
    auto& [vertices, triangles] = mesh;
    archive(vertices, triangles);
}

template <class Archive, base::OrConst<MassProperties> T>
void serialize(Archive& archive, T& properties) {
    auto& [volume, area, mass, centre, inertia] = properties;
    archive(volume, area, mass, centre, inertia);
}

template <class Archive, base::OrConst<PolytopeFace> T>
void serialize(Archive& archive, T& face) {
    auto& [normal, offset, loop] = face;
    archive(normal, offset, loop);
}

template <class Archive, base::OrConst<PolytopeEdge> T>
void serialize(Archive& archive, T& edge) {
    auto& [from, to, left, right] = edge;
    archive(from, to, left, right);
}

template <class Archive, base::OrConst<ConvexPolytope> T>
void serialize(Archive& archive, T& polytope) {
    auto& [vertices, faces, edges] = polytope;
    archive(vertices, faces, edges);
}

}  // namespace trapwright::geometry

namespace trapwright::part {

template <class Archive, base::OrConst<SymmetryGroup> T>
void serialize(Archive& archive, T& group) {
    auto& [name, rotations, continuous, axis, flip, sphere] = group;
    archive(name, rotations, continuous, axis, flip, sphere);
}

template <class Archive, base::OrConst<StablePose> T>
void serialize(Archive& archive, T& pose) {
    auto& [rotation, height, probability, multiplicity] = pose;
    archive(rotation, height, probability, multiplicity);
}

template <class Archive, base::OrConst<Part> T>
void serialize(Archive& archive, T& part) {
    auto& [name, source, density, mesh, massProperties, hull, pieces, symmetry, stablePoses, boundingRadius] =
        part;
    archive(name, source, density, mesh, massProperties, hull, pieces, symmetry, stablePoses, boundingRadius);
}

/// Whether each of these indices is one of so many.
template <class Indices>
bool areBelow(const Indices& indices, std::size_t count) {
    return std::ranges::all_of(
        indices, [&](int index) { return index >= 0 && static_cast<std::size_t>(index) < count; });
}

/// Whether every corner of every triangle is one of the vertices.
inline bool isWhole(const geometry::TriangleMesh& mesh) {
    return std::ranges::all_of(mesh.triangles, [&](const geometry::Triangle& triangle) {
        return areBelow(triangle, mesh.vertices.size());
    });
}

/// The same of the faces, and whether every edge lies between two of them.
inline bool isWhole(const geometry::ConvexPolytope& polytope) {
    const auto knowsItsEnds = [&](const geometry::PolytopeEdge& edge) {
        return areBelow(std::array{edge.from, edge.to}, polytope.vertices.size()) &&
               areBelow(std::array{edge.left, edge.right}, polytope.faces.size());
    };
    return std::ranges::all_of(polytope.faces,
                               [&](const geometry::PolytopeFace& face) {
                                   return areBelow(face.loop, polytope.vertices.size());
                               }) &&
           std::ranges::all_of(polytope.edges, knowsItsEnds);
}

/// The same of all solids of a part.
inline bool isWhole(const Part& part) {
    return isWhole(part.mesh) && isWhole(part.hull) &&
           std::ranges::all_of(part.pieces, [](const auto& piece) { return isWhole(piece); });
}

}  // namespace trapwright::part
