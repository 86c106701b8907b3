#include "tests/fuzz/read_study.h"

#include <algorithm>
#include <optional>

#include "core/store/compare.h"
#include "core/store/study_file.h"
#include "core/study/physical_validation.h"
#include "core/study/track_design.h"
#include "tests/fuzz/scratch_folder.h"

namespace trapwright::fuzz {

namespace {

/// A value, or a refusal with a reason; true for a value.
template <class Value>
bool check(const base::Result<Value>& result) {
    if (!result) require(!result.error().message.empty(), "a refusal has a reason");
    return result.ok();
}

void readOutcomes(const base::Result<std::optional<store::PackedOutcomes>>& packed) {
    if (!check(packed) || !*packed) return;
    const auto outcomes = store::unpack(**packed);
    if (check(outcomes)) require(outcomes->size() == (*packed)->count, "all outcomes are there");
}

void readGenerations(const store::StudyFile& study) {
    const auto count = study.generationCount();
    if (!check(count)) return;
    // A damaged number could be anything.
    constexpr int kMost = 10;
    for (int i = 0; i < std::min(*count, kMost); ++i) {
        check(study.loadGeneration(i));
        check(study.loadIndividual({i, 0}));
        readOutcomes(study.loadLearningOutcomes({i, 0}));
    }
    check(study.loadSummaries());
    if (const auto state = study.loadLearningState(); check(state) && *state) {
        const auto settings = study.loadSettings();
        if (settings && study::findProblems(*settings).empty())
            check(study::makeSearch(*settings)->load((*state)->search));
    }
    check(study.loadWinners());
    check(study.loadUncheckedWinners());
}

}  // namespace

void readWholeStudy(const std::filesystem::path& path) {
    auto study = store::StudyFile::openReadOnly(path);
    if (!check(study)) {
        // It may be one of an older program, to be brought up to date.
        if (!check(store::StudyFile::open(path, "fuzz"))) return;
        study = store::StudyFile::openReadOnly(path);
        if (!check(study)) return;
    }
    if (const auto settings = study->loadSettings(); check(settings)) study::findProblems(*settings);
    if (const auto part = study->loadPart(); check(part)) {
        for (const geometry::Triangle& triangle : part->mesh.triangles) {
            for (const int corner : triangle) {
                require(corner >= 0 && static_cast<std::size_t>(corner) < part->mesh.vertices.size(),
                        "a triangle's corner is a vertex");
            }
        }
    }
    readGenerations(*study);
    check(study->loadChecks());
    check(study->loadSelections());
    check(study->loadValidations());
    readOutcomes(study->loadSelectionOutcomes(0, 0));
    readOutcomes(study->loadValidationOutcomes(0, 0));
    check(study->loadChosenWinner());
    if (const auto validations = study->loadPhysicalValidations(); check(validations)) {
        for (const study::PhysicalValidation& validation : *validations)
            study::orderOfTrials(validation.plan);
    }
    check(study->loadDropTests());
    check(study->loadDriveLog(-1e300, 1e300));
    check(study->loadCalibrations());
    check(store::findDifference(*study, *study));
    check(store::dumpChecks(*study));
}

}  // namespace trapwright::fuzz
