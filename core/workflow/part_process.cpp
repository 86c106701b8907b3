#include "core/workflow/part_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/geometry/convex_polytope.h"
#include "core/part/part.h"

// What goes from one process to the other: the fields of each type, once for both directions. cereal finds
// these functions by the types' namespaces.

namespace Eigen {

template <class Archive, class Scalar, int rows, int columns>
void serialize(Archive& archive, Matrix<Scalar, rows, columns>& matrix) {
    static_assert(rows > 0 && columns > 0, "of a fixed size");
    for (Index i = 0; i < matrix.size(); ++i)
        archive(matrix.data()[i]);
}

template <class Archive, class Scalar>
void serialize(Archive& archive, Quaternion<Scalar>& quaternion) {
    archive(quaternion.coeffs());
}

}  // namespace Eigen

namespace trapwright::geometry {

template <class Archive>
void serialize(Archive& archive, TriangleMesh& mesh) {
    archive(mesh.vertices, mesh.triangles);
}

template <class Archive>
void serialize(Archive& archive, MeshHole& hole) {
    archive(hole.centre, hole.perimeter, hole.edges);
}

template <class Archive>
void serialize(Archive& archive, MeshReport& report) {
    archive(report.nonFiniteVertices, report.duplicateVertices, report.degenerateTriangles,
            report.duplicateTriangles, report.inconsistentEdges, report.inconsistentPlace,
            report.nonManifoldEdges, report.openEdges, report.holes, report.shells, report.insideOutShells,
            report.overlappingTriangles, report.volume);
}

template <class Archive>
void serialize(Archive& archive, MassProperties& properties) {
    archive(properties.volume, properties.area, properties.mass, properties.centre, properties.inertia);
}

template <class Archive>
void serialize(Archive& archive, PolytopeFace& face) {
    archive(face.normal, face.offset, face.loop);
}

template <class Archive>
void serialize(Archive& archive, PolytopeEdge& edge) {
    archive(edge.from, edge.to, edge.left, edge.right);
}

template <class Archive>
void serialize(Archive& archive, ConvexPolytope& polytope) {
    archive(polytope.vertices, polytope.faces, polytope.edges);
}

}  // namespace trapwright::geometry

namespace trapwright::part {

template <class Archive>
void serialize(Archive& archive, SymmetryGroup& group) {
    archive(group.name, group.rotations, group.continuous, group.axis, group.flip, group.sphere);
}

template <class Archive>
void serialize(Archive& archive, StablePose& pose) {
    archive(pose.rotation, pose.height, pose.probability, pose.multiplicity);
}

template <class Archive>
void serialize(Archive& archive, Part& part) {
    archive(part.name, part.source, part.density, part.mesh, part.massProperties, part.hull, part.pieces,
            part.symmetry, part.stablePoses, part.boundingRadius);
}

template <class Archive>
void serialize(Archive& archive, PartOptions& options) {
    archive(options.name, options.source, options.density, options.symmetryTolerance, options.symmetry);
}

}  // namespace trapwright::part

namespace trapwright::study {

template <class Archive>
void serialize(Archive& archive, PartSettings& settings) {
    archive(settings.file, settings.units, settings.density, settings.symmetryTolerance, settings.symmetry,
            settings.material, settings.poseWeights, settings.droppedCounts);
}

}  // namespace trapwright::study

namespace trapwright::store {

template <class Archive>
void serialize(Archive& archive, StoredPart& stored) {
    archive(stored.mesh, stored.options);
}

}  // namespace trapwright::store

namespace trapwright::workflow {

template <class Archive>
void serialize(Archive& archive, UnitCandidate& candidate) {
    archive(candidate.name, candidate.size);
}

template <class Archive>
void serialize(Archive& archive, Failure& failure) {
    archive(failure.kind, failure.message);
}

template <class Archive>
void serialize(Archive& archive, PartFailure& why) {
    archive(why.failure, why.candidates, why.mendable);
}

/// Without the part, which is a pointer to what is constant.
template <class Archive>
void serialize(Archive& archive, LoadedPart& loaded) {
    archive(loaded.stored, loaded.settings, loaded.bundled, loaded.unitsFromFile, loaded.candidates,
            loaded.found, loaded.notes);
}

/// The folder that relative names in the request are meant from is the child's, too: it inherits it.
template <class Archive>
void serialize(Archive& archive, PartRequest& request) {
    std::string ownMaterials = request.ownMaterials.string();
    archive(request.part, request.units, request.density, request.materialName, request.material,
            ownMaterials, request.tolerance, request.symmetry, request.defaultDensity,
            request.closeLargeHoles);
    request.ownMaterials = ownMaterials;
}

namespace {

using Answer = base::Result<LoadedPart, PartFailure>;

template <class... Values>
std::string pack(Values&&... values) {
    std::ostringstream stream;
    cereal::BinaryOutputArchive archive(stream);
    archive(values...);
    return std::move(stream).str();
}

std::string packAnswer(Answer answer) {
    if (!answer) {
        PartFailure why = answer.error();
        return pack(false, why);
    }
    LoadedPart& loaded = *answer;
    part::Part built = *loaded.part;
    return pack(true, loaded, built);
}

bool allBelow(const auto& indices, std::size_t count) {
    return std::all_of(indices.begin(), indices.end(),
                       [&](int index) { return index >= 0 && static_cast<std::size_t>(index) < count; });
}

bool isWhole(const geometry::TriangleMesh& mesh) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const geometry::Triangle& triangle) {
        return allBelow(triangle, mesh.vertices.size());
    });
}

bool isWhole(const geometry::ConvexPolytope& polytope) {
    return std::all_of(polytope.faces.begin(), polytope.faces.end(),
                       [&](const geometry::PolytopeFace& face) {
                           return allBelow(face.loop, polytope.vertices.size());
                       }) &&
           std::all_of(polytope.edges.begin(), polytope.edges.end(), [&](const geometry::PolytopeEdge& edge) {
               return allBelow(std::array{edge.from, edge.to}, polytope.vertices.size()) &&
                      allBelow(std::array{edge.left, edge.right}, polytope.faces.size());
           });
}

/// A process whose memory was damaged may answer anything.
bool isWhole(const LoadedPart& loaded) {
    const part::Part& part = *loaded.part;
    return isWhole(loaded.stored.mesh) && isWhole(part.mesh) && isWhole(part.hull) && !part.pieces.empty() &&
           std::all_of(part.pieces.begin(), part.pieces.end(),
                       [](const geometry::ConvexPolytope& piece) { return isWhole(piece); }) &&
           !part.symmetry.rotations.empty() && !part.stablePoses.empty() &&
           std::isfinite(part.boundingRadius);
}

/// Nothing if it is not an answer.
std::optional<Answer> unpackAnswer(const std::string& bytes) {
    try {
        std::istringstream stream(bytes);
        cereal::BinaryInputArchive archive(stream);
        bool loadedIt = false;
        archive(loadedIt);
        if (!loadedIt) {
            PartFailure why;
            archive(why);
            return Answer(std::move(why));
        }
        LoadedPart loaded;
        part::Part built;
        archive(loaded, built);
        loaded.part = std::make_shared<const part::Part>(std::move(built));
        if (!isWhole(loaded)) return std::nullopt;
        return Answer(std::move(loaded));
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::string describeCrash(const base::ChildOutcome& outcome) {
    const char* name = outcome.signal != 0 ? ::sigabbrev_np(outcome.signal) : nullptr;
    return name != nullptr ? fmt::format(" (SIG{})", name) : "";
}

PartFailure describe(const PartRequest& request, const base::ChildLimits& limits,
                     const base::ChildOutcome& outcome) {
    const std::string during = outcome.stage.empty() ? "" : fmt::format(" while {}", outcome.stage);
    const char* advice =
        "The file may be damaged: open it in the program that it comes from, and export it again, as STEP or "
        "STL";
    switch (outcome.end) {
        case base::ChildEnd::cancelled:
            return {{FailureKind::cancelled, fmt::format("The import of {} was stopped.", request.part)}};
        case base::ChildEnd::outOfTime:
            return {{FailureKind::reading,
                     fmt::format("{} was not imported within {} s{}. {} with less detail.", request.part,
                                 std::chrono::duration_cast<std::chrono::seconds>(limits.time).count(),
                                 during, advice)}};
        case base::ChildEnd::outOfMemory:
            return {{FailureKind::reading,
                     fmt::format("{} takes more than {:.1f} GB of memory{}. {} with less detail.",
                                 request.part, static_cast<double>(limits.memory) * 1e-9, during, advice)}};
        case base::ChildEnd::crashed:
        case base::ChildEnd::finished:
            break;
    }
    return {{FailureKind::reading, fmt::format("{} cannot be imported: the reader broke down{}{}. {}.",
                                               request.part, during, describeCrash(outcome), advice)}};
}

}  // namespace

Answer importPartApart(const PartRequest& request, const base::RunControl& control,
                       const std::function<void(std::string_view)>& tellStage,
                       const base::ChildLimits& limits) {
    const auto program = base::findOwnProgram("trapwright-import");
    if (!program) return PartFailure{{FailureKind::reading, program.error().message}};
    PartRequest asked = request;
    const auto outcome = base::runChild(*program, pack(asked), limits, control, tellStage);
    if (!outcome) return PartFailure{{FailureKind::reading, outcome.error().message}};
    if (outcome->end == base::ChildEnd::finished) {
        if (std::optional<Answer> answer = unpackAnswer(outcome->result)) return std::move(*answer);
    }
    return describe(request, limits, *outcome);
}

int serveImport(int count, char** arguments) {
    const auto duty = base::ChildDuty::begin(count, arguments);
    if (!duty) {
        std::fputs((duty.error().message + "\n").c_str(), stderr);
        return 2;
    }
    PartRequest request;
    try {
        std::istringstream stream(duty->request());
        cereal::BinaryInputArchive archive(stream);
        archive(request);
    } catch (const std::exception&) {
        return 2;
    }
    const std::string answer =
        packAnswer(importPart(request, [&](std::string_view stage) { duty->tellStage(stage); }));
    return duty->answer(answer) ? 0 : 1;
}

}  // namespace trapwright::workflow
