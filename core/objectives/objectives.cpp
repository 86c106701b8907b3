#include "core/objectives/objectives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/base/spelling.h"
#include "core/objectives/conveying_speed.h"
#include "core/objectives/disorder.h"
#include "core/objectives/paper_scores.h"
#include "core/objectives/printability.h"
#include "core/objectives/success_share.h"
#include "core/objectives/worst_case.h"
#include "core/stats/binomial.h"

namespace trapwright::objectives {

namespace {

const Score* findIn(std::span<const Score> scores, std::string_view key) {
    const auto found =
        std::find_if(scores.begin(), scores.end(), [&](const Score& score) { return score.key == key; });
    return found == scores.end() ? nullptr : &*found;
}

Score score(const Objective& objective, const Evaluation& evaluation) {
    const Measured measured = objective.measure(evaluation);
    return {std::string(objective.key), measured.value, measured.error};
}

}  // namespace

std::string Objective::title() const {
    return unit.empty() ? std::string(symbol) : fmt::format("{} [{}]", symbol, unit);
}

std::span<const Objective> allObjectives() {
    static const std::array kObjectives = {collisions(), distance(),       orientation(),  wanted(),
                                           disorder(),   sorting(),        successShare(), correctShare(),
                                           purity(),     yield(),          throughput(),   worstHalf(),
                                           corners(),    conveyingSpeed(), printability()};
    return kObjectives;
}

const Objective* findObjective(std::string_view key) {
    const auto all = allObjectives();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Objective& objective) { return objective.key == key; });
    return found == all.end() ? nullptr : &*found;
}

base::Result<ObjectiveList> readObjectives(std::string_view text) {
    ObjectiveList list;
    for (const std::string_view name : base::splitNames(text)) {
        const Objective* objective = findObjective(name);
        if (objective == nullptr) {
            std::string keys;
            for (const Objective& one : allObjectives())
                keys += (keys.empty() ? "" : ", ") + std::string(one.key);
            return base::Error{fmt::format(
                "There is no objective named \"{}\". The objectives are: {}. Write several with commas "
                "between them.",
                name, keys)};
        }
        if (std::find(list.begin(), list.end(), objective) != list.end())
            return base::Error{fmt::format("The objective {} is named twice; once is enough.", name)};
        list.push_back(objective);
    }
    return list;
}

std::string describeSum(const ObjectiveList& objectives) {
    std::string text;
    for (const Objective* objective : objectives)
        text += (text.empty() ? "" : " + ") + std::string(objective->symbol);
    return text;
}

std::string shown(const Objective& objective, double value, int leastDecimals) {
    const int decimals =
        objective.unit == "%" ? stats::countPercentDecimals(std::clamp(value, 0.0, 1.0)) : objective.decimals;
    // Adding 0 makes a -0 a 0.
    return fmt::format("{:.{}f}", value * objective.shownAs + 0.0, std::max(decimals, leastDecimals));
}

const Score* findScore(const Fitness& fitness, std::string_view key) {
    return findIn(fitness.scores, key);
}

std::vector<Score> listAttainable(const Task& task) {
    std::vector<Score> scores;
    for (const Objective& objective : allObjectives())
        if (objective.attainable != nullptr && (!objective.needsWanted || (task.isWanted && task.isResting)))
            scores.push_back({std::string(objective.key), objective.attainable(task)});
    return scores;
}

bool contains(const ObjectiveList& list, std::string_view key) {
    return std::ranges::find(list, key, &Objective::key) != list.end();
}

double calcTotal(std::span<const Score> scores, const ObjectiveList& summed) {
    double total = 0.0;
    bool isFirst = true;
    for (const Objective* objective : summed) {
        const Score* one = findIn(scores, objective->key);
        assert(one != nullptr);
        const double gain = objective->moreIsBetter ? one->value : -one->value;
        total = isFirst ? gain : total + gain;
        isFirst = false;
    }
    return total;
}

double calcTotalError(const Fitness& fitness, const ObjectiveList& summed) {
    double squares = 0.0;
    for (const Objective* objective : summed) {
        const Score* one = findScore(fitness, objective->key);
        if (one != nullptr) squares += one->error * one->error;
    }
    return std::sqrt(squares);
}

Fitness measureSum(const Evaluation& evaluation, const ObjectiveList& summed) {
    Fitness fitness;
    for (const Objective* objective : summed)
        fitness.scores.push_back(score(*objective, evaluation));
    fitness.total = calcTotal(fitness.scores, summed);
    return fitness;
}

Fitness measureAll(const Evaluation& evaluation, const ObjectiveList& summed) {
    return measureOthers(evaluation, measureSum(evaluation, summed));
}

Fitness measureOthers(const Evaluation& evaluation, const Fitness& summed) {
    Fitness fitness{summed.total, {}};
    for (const Objective& objective : allObjectives()) {
        if (objective.needsWanted && !evaluation.wanted) continue;
        const Score* known = findScore(summed, objective.key);
        if (known == nullptr && objective.applies != nullptr && !objective.applies(evaluation)) continue;
        fitness.scores.push_back(known != nullptr ? *known : score(objective, evaluation));
    }
    return fitness;
}

}  // namespace trapwright::objectives
