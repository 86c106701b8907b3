#pragma once

#include <QtTest>
#include <filesystem>
#include <string>

#include "core/base/random.h"
#include "core/store/study_file.h"
#include "core/study/presets.h"

/// QVERIFY for a Result, with its message.
#define VERIFY_OK(result)                                                                                 \
    do {                                                                                                  \
        const auto& verifiedResult = (result);                                                            \
        QVERIFY2(verifiedResult.ok(), verifiedResult.ok() ? "" : verifiedResult.error().message.c_str()); \
    } while (false)

namespace trapwright::sample {

inline const std::string kProgram = "trapwright 0.0-test";

/// What schema version 7 added.
inline constexpr const char* kDropVersion7 = "DROP TABLE drop_pose; DROP TABLE drop_test;";

/// What schema version 6 added.
inline constexpr const char* kDropVersion6 =
    "ALTER TABLE physical_trial DROP COLUMN feeder; ALTER TABLE physical_trial DROP COLUMN drive; "
    "ALTER TABLE physical_trial DROP COLUMN half_stroke;";

/// What schema version 5 added.
inline constexpr const char* kDropVersion5 =
    "ALTER TABLE individual DROP COLUMN oriented; ALTER TABLE generation DROP COLUMN top_success;";

/// What schema version 4 added.
inline constexpr const char* kDropVersion4 =
    "DROP TABLE calibration_reading; DROP TABLE calibration; DROP TABLE drive_log; DROP TABLE "
    "physical_trial; "
    "DROP TABLE physical_pose; DROP TABLE physical_validation; DROP TABLE chosen_winner; "
    "ALTER TABLE part DROP COLUMN symmetry_counts;";

/// The message of a Result that must have failed, or a text that no message contains.
template <class T>
QString messageOf(const base::Result<T>& result) {
    return QString::fromStdString(result.ok() ? std::string("(no error)") : result.error().message);
}

inline study::Settings settings() {
    study::Settings settings = study::presetSettings("cuboid").value();
    settings.evolution.populationSize = 6;
    settings.evolution.seed = 0xFEDCBA9876543210ULL;
    return settings;
}

inline store::StoredPart part() {
    store::StoredPart part;
    part.mesh.vertices = {{0, 0, 0}, {0.1 + 0.2, 0, 0}, {0, 1.0 / 3.0, 0}, {0, 0, -1e-9}};
    part.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    part.options = {"tetrahedron", "/parts/tetra.stl", 1041.5, 0.0125, part::SymmetryUse::none};
    return part;
}

/// Numbers at random, in every field.
inline study::GenerationRecord generation(int index, int individuals = 6) {
    base::Random random({.seed = 77, .generation = static_cast<std::uint32_t>(index)});
    const auto count = [&](std::uint32_t limit) { return static_cast<int>(random.below(limit)); };
    const auto bits = [&](std::size_t size) {
        evolution::Bits gene(size);
        for (auto& bit : gene)
            bit = random.boolean() ? 1 : 0;
        return gene;
    };
    const auto fitness = [&] {
        return trial::Fitness{-random.uniform(), -random.normal(), random.uniform()};
    };

    study::GenerationRecord record;
    record.index = index;
    for (int i = 0; i < individuals; ++i) {
        record.individuals.push_back({{bits(800), bits(50), bits(60)},
                                      fitness(),
                                      count(9),
                                      9 + count(9),
                                      count(9),
                                      count(9),
                                      count(9),
                                      count(9)});
    }
    record.winner = count(static_cast<std::uint32_t>(individuals));
    record.statistics = {fitness(),
                         fitness(),
                         {random.uniform(), random.uniform(), random.uniform()},
                         record.individuals[static_cast<std::size_t>(record.winner)].success(),
                         random.uniform()};
    record.seconds = random.uniform();
    return record;
}

/// As a program that did not count success would have left it.
inline study::GenerationRecord generationWithoutSuccess(int index) {
    study::GenerationRecord record = generation(index);
    for (study::IndividualRecord& individual : record.individuals)
        individual.oriented.reset();
    record.statistics.success.reset();
    record.statistics.topSuccess.reset();
    return record;
}

inline bool equal(const study::GenerationRecord& a, const study::GenerationRecord& b) {
    return a.index == b.index && a.individuals == b.individuals && a.winner == b.winner &&
           a.statistics == b.statistics && a.seconds == b.seconds;
}

/// A new study at `path` with that many generations, closed again.
inline void write(const std::filesystem::path& path, int generations) {
    auto study = store::StudyFile::create(path, settings(), part(), kProgram);
    VERIFY_OK(study);
    for (int i = 0; i < generations; ++i)
        VERIFY_OK(study->saveGeneration(generation(i)));
}

}  // namespace trapwright::sample
