#pragma once

#include <QtTest>
#include <filesystem>
#include <string>

#include "core/base/random.h"
#include "core/store/study_file.h"
#include "core/study/presets.h"
#include "tests/core/objectives/paper_fitness.h"

/// QVERIFY for a Result, with its message.
#define VERIFY_OK(result)                                                                                 \
    do {                                                                                                  \
        const auto& verifiedResult = (result);                                                            \
        QVERIFY2(verifiedResult.ok(), verifiedResult.ok() ? "" : verifiedResult.error().message.c_str()); \
    } while (false)

namespace trapwright::sample {

inline const std::string kProgram = "trapwright 0.0-test";

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
    // As the genetic search has them: 85 numbers of 10 bits; p_dm above its floor, p_s below its limit.
    const auto share = [&](std::uint32_t largest) {
        return static_cast<double>(random.below(largest + 1)) / largest;
    };
    const auto design = [&] {
        search::Design numbers(85);
        for (double& number : numbers)
            number = share(1023);
        return numbers;
    };
    const auto traits = [&] {
        constexpr std::uint32_t kLargest = (1U << 20U) - 1;
        return std::vector<search::NamedNumber>{{"p_x", share(kLargest)},
                                                {"p_dm", std::max(share(kLargest), 0.0005)},
                                                {"p_s", share(kLargest) * 0.3}};
    };
    const auto fitness = [&] {
        objectives::Fitness made =
            testing::paperFitness(-random.uniform(), -random.normal(), random.uniform());
        for (objectives::Score& score : made.scores)
            score.error = random.uniform();
        return made;
    };

    study::GenerationRecord record;
    record.index = index;
    for (int i = 0; i < individuals; ++i) {
        record.individuals.push_back(
            {design(), traits(), fitness(), count(9), 9 + count(9), count(9), count(9), count(9), count(9)});
    }
    record.winner = count(static_cast<std::uint32_t>(individuals));
    objectives::Fitness topMean = fitness();
    for (objectives::Score& score : topMean.scores)
        score.error = 0.0;
    record.statistics = {record.individuals[static_cast<std::size_t>(record.winner)].fitness,
                         std::move(topMean),
                         {{"p_x", random.uniform()}, {"p_dm", random.uniform()}, {"p_s", random.uniform()}},
                         record.individuals[static_cast<std::size_t>(record.winner)].success(),
                         random.uniform()};
    record.seconds = random.uniform();
    record.searchState = "state " + std::to_string(index);
    return record;
}

/// As a program that knew no standard errors would have left it.
inline study::GenerationRecord generationWithoutErrors(int index) {
    study::GenerationRecord record = generation(index);
    for (study::IndividualRecord& individual : record.individuals)
        for (objectives::Score& score : individual.fitness.scores)
            score.error = 0.0;
    record.statistics.best = record.individuals[static_cast<std::size_t>(record.winner)].fitness;
    return record;
}

/// As one that did not count success, either, would have left it.
inline study::GenerationRecord generationWithoutSuccess(int index) {
    study::GenerationRecord record = generationWithoutErrors(index);
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
