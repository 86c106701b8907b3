#include "core/workflow/part_process.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/byte_archive.h"
#include "core/part/part_fields.h"

// What goes from one process to the other, beside the part itself (core/part/part_fields.h).

namespace trapwright::geometry {

template <class Archive, base::OrConst<MeshHole> T>
void serialize(Archive& archive, T& hole) {
    auto& [centre, perimeter, edges] = hole;
    archive(centre, perimeter, edges);
}

template <class Archive, base::OrConst<MeshReport> T>
void serialize(Archive& archive, T& report) {
    auto& [nonFiniteVertices, duplicateVertices, degenerateTriangles, duplicateTriangles, inconsistentEdges,
           inconsistentPlace, nonManifoldEdges, openEdges, holes, shells, insideOutShells,
           overlappingTriangles, volume] = report;
    archive(nonFiniteVertices, duplicateVertices, degenerateTriangles, duplicateTriangles, inconsistentEdges,
            inconsistentPlace, nonManifoldEdges, openEdges, holes, shells, insideOutShells,
            overlappingTriangles, volume);
}

}  // namespace trapwright::geometry

namespace trapwright::part {

constexpr SymmetryUse lastOf(SymmetryUse /*unused*/) {
    return SymmetryUse::none;
}

template <class Archive, base::OrConst<PartOptions> T>
void serialize(Archive& archive, T& options) {
    auto& [name, source, density, symmetryTolerance, symmetry] = options;
    archive(name, source, density, symmetryTolerance, symmetry);
}

}  // namespace trapwright::part

namespace trapwright::study {

constexpr PoseWeights lastOf(PoseWeights /*unused*/) {
    return PoseWeights::dropped;
}

template <class Archive, base::OrConst<PartSettings> T>
void serialize(Archive& archive, T& settings) {
    auto& [file, units, density, symmetryTolerance, symmetry, material, poseWeights, droppedCounts] =
        settings;
    archive(file, units, density, symmetryTolerance, symmetry, material, poseWeights, droppedCounts);
}

}  // namespace trapwright::study

namespace trapwright::store {

template <class Archive, base::OrConst<StoredPart> T>
void serialize(Archive& archive, T& stored) {
    auto& [mesh, options] = stored;
    archive(mesh, options);
}

}  // namespace trapwright::store

namespace trapwright::workflow {

constexpr FailureKind lastOf(FailureKind /*unused*/) {
    return FailureKind::cancelled;
}

template <class Archive, base::OrConst<UnitCandidate> T>
void serialize(Archive& archive, T& candidate) {
    auto& [name, size] = candidate;
    archive(name, size);
}

template <class Archive, base::OrConst<Failure> T>
void serialize(Archive& archive, T& failure) {
    auto& [kind, message] = failure;
    archive(kind, message);
}

template <class Archive, base::OrConst<PartFailure> T>
void serialize(Archive& archive, T& why) {
    auto& [failure, candidates, mendable] = why;
    archive(failure, candidates, mendable);
}

/// Without the part, which is a pointer to what is constant.
template <class Archive, base::OrConst<LoadedPart> T>
void serialize(Archive& archive, T& loaded) {
    auto& [stored, settings, part, bundled, unitsFromFile, candidates, found, notes] = loaded;
    archive(stored, settings, bundled, unitsFromFile, candidates, found, notes);
}

/// The folder that relative names in the request are meant from is the child's, too: it inherits it.
template <class Archive, base::OrConst<PartRequest> T>
void serialize(Archive& archive, T& request) {
    auto& [part, units, density, materialName, material, ownMaterials, tolerance, symmetry, defaultDensity,
           closeLargeHoles] = request;
    std::string ownFolder = ownMaterials.string();
    archive(part, units, density, materialName, material, ownFolder, tolerance, symmetry, defaultDensity,
            closeLargeHoles);
    if constexpr (!std::is_const_v<T>) ownMaterials = ownFolder;
}

namespace {

using Answer = base::Result<LoadedPart, PartFailure>;

template <class... Values>
std::string pack(const Values&... values) {
    base::ByteWriter archive;
    archive(values...);
    return std::move(archive).bytes();
}

std::string packAnswer(const Answer& answer) {
    return answer ? pack(true, *answer, *answer->part) : pack(false, answer.error());
}

/// A process whose memory was damaged may answer anything.
bool isWhole(const LoadedPart& loaded) {
    const part::Part& part = *loaded.part;
    return part::isWhole(loaded.stored.mesh) && part::isWhole(part) && !part.pieces.empty() &&
           !part.symmetry.rotations.empty() && !part.stablePoses.empty() &&
           std::isfinite(part.boundingRadius);
}

/// Nothing if it is not an answer.
std::optional<Answer> unpackAnswer(const std::string& bytes) {
    base::ByteReader archive(bytes);
    bool loadedIt = false;
    archive(loadedIt);
    if (!loadedIt) {
        PartFailure why;
        archive(why);
        if (!archive.finished()) return std::nullopt;
        return Answer(std::move(why));
    }
    LoadedPart loaded;
    part::Part built;
    archive(loaded, built);
    loaded.part = std::make_shared<const part::Part>(std::move(built));
    if (!archive.finished() || !isWhole(loaded)) return std::nullopt;
    return Answer(std::move(loaded));
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
    const auto outcome = base::runChild(*program, pack(request), limits, control, tellStage);
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
    base::ByteReader archive(duty->request());
    archive(request);
    if (!archive.finished()) return 2;
    const std::string answer =
        packAnswer(importPart(request, [&](std::string_view stage) { duty->tellStage(stage); }));
    return duty->answer(answer) ? 0 : 1;
}

}  // namespace trapwright::workflow
