#include "core/store/compare.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/store/packing.h"

namespace trapwright::store {

namespace {

std::string hexadecimal(const std::string& blob) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const char c : blob) {
        const auto byte = static_cast<unsigned char>(c);
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

/// The shortest decimal that gives the value back.
std::string exactText(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

/// Each score with its standard error.
std::string scoresText(const objectives::Fitness& fitness) {
    std::string text;
    for (const objectives::Score& score : fitness.scores)
        text += " " + exactText(score.value) + " " + exactText(score.error);
    return text;
}

std::string lineOf(int generation, std::size_t number, const study::IndividualRecord& record) {
    std::string line = std::to_string(generation) + " " + std::to_string(number);
    line += " " + hexadecimal(search::packDesign(record.design));
    for (const search::NamedNumber& trait : record.traits)
        line += " " + exactText(trait.value);
    line += scoresText(record.fitness);
    for (const int count : {record.overlaps, record.trials, record.finished, record.fellOff, record.stuck}) {
        line += " " + std::to_string(count);
    }
    return line + " " + (record.oriented ? std::to_string(*record.oriented) : "-") + "\n";
}

/// Whether the scores are the same, as far as both programs measured them.
bool areAlike(const objectives::Fitness& a, const objectives::Fitness& b) {
    return a.total == b.total && std::ranges::all_of(a.scores, [&](const objectives::Score& own) {
               const objectives::Score* other = objectives::findScore(b, own.key);
               if (other == nullptr) return true;
               const bool bothKnow = own.error != 0.0 && other->error != 0.0;
               return own.value == other->value && (own.error == other->error || !bothKnow);
           });
}

/// Whether designs and scores are the same; success as far as both have counted it.
bool areAlike(const study::IndividualRecord& a, study::IndividualRecord b) {
    if (!a.oriented || !b.oriented) b.oriented = a.oriented;
    if (!areAlike(a.fitness, b.fitness)) return false;
    b.fitness = a.fitness;
    return a == b;
}

bool areAlike(const study::GenerationStatistics& a, study::GenerationStatistics b) {
    if (!a.success || !b.success) b.success = a.success;
    if (!a.topSuccess || !b.topSuccess) b.topSuccess = a.topSuccess;
    if (!areAlike(a.best, b.best) || !areAlike(a.topMean, b.topMean)) return false;
    b.best = a.best;
    b.topMean = a.topMean;
    return a == b;
}

}  // namespace

base::Status dumpIndividuals(const StudyFile& study,
                             const std::function<void(std::string_view lines)>& write) {
    const auto count = study.generationCount();
    if (!count) return count.error();
    for (int index = 0; index < *count; ++index) {
        const auto generation = study.loadGeneration(index);
        if (!generation) return generation.error();
        std::string lines;
        for (std::size_t i = 0; i < generation->individuals.size(); ++i) {
            lines += lineOf(index, i, generation->individuals[i]);
        }
        write(lines);
    }
    return base::success();
}

base::Result<std::string> dumpChecks(const StudyFile& study) {
    const auto checks = study.loadChecks();
    if (!checks) return checks.error();
    std::string lines;
    for (const study::CheckRecord& check : *checks) {
        lines += std::to_string(check.generation) + " " + std::to_string(check.individual) + " " +
                 std::to_string(check.trials);
        for (const study::EngineScore* score : {&check.learning, &check.reference}) {
            lines += " " + score->engine;
            lines += scoresText(score->fitness);
            lines += " " + std::to_string(score->finished) + " " + std::to_string(score->oriented);
        }
        lines += "\n";
    }
    return lines;
}

base::Result<std::string> findDifference(const StudyFile& a, const StudyFile& b) {
    const auto countA = a.generationCount();
    const auto countB = b.generationCount();
    if (!countA) return countA.error();
    if (!countB) return countB.error();
    for (int index = 0; index < std::min(*countA, *countB); ++index) {
        const auto generationA = a.loadGeneration(index);
        const auto generationB = b.loadGeneration(index);
        if (!generationA) return generationA.error();
        if (!generationB) return generationB.error();
        const std::string place = "generation " + std::to_string(index);
        const auto& individualsA = generationA->individuals;
        const auto& individualsB = generationB->individuals;
        if (individualsA.size() != individualsB.size()) {
            return place + " has " + std::to_string(individualsA.size()) + " individuals in one and " +
                   std::to_string(individualsB.size()) + " in the other";
        }
        for (std::size_t i = 0; i < individualsA.size(); ++i) {
            if (areAlike(individualsA[i], individualsB[i])) continue;
            const bool sameDesign = individualsA[i].design == individualsB[i].design &&
                                    individualsA[i].traits == individualsB[i].traits;
            return place + ", individual " + std::to_string(i) + ": " +
                   (sameDesign ? "the scores differ" : "the designs differ");
        }
        if (generationA->winner != generationB->winner ||
            !areAlike(generationA->statistics, generationB->statistics)) {
            return place + ": the winner or the statistics differ";
        }
    }
    if (*countA != *countB) {
        return "one has " + std::to_string(*countA) + " generations, the other " + std::to_string(*countB);
    }
    return std::string();
}

}  // namespace trapwright::store
