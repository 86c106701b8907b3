#pragma once

#include <span>
#include <vector>

#include "core/objectives/objectives.h"
#include "core/search/search.h"
#include "ui/models/numbers.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

/// The column of a number that the search knows of each row: a trait, or a curve. Empty where a row has it
/// not.
template <class Row>
Column<Row> numberColumn(const search::NumberInfo& info,
                         std::span<const search::NamedNumber> (*numbersOf)(const Row&)) {
    const auto find = [key = info.key, numbersOf](const Row& row) {
        return search::findNumber(numbersOf(row), key);
    };
    return {QString::fromStdString(info.key), QString::fromStdString(info.help),
            [find](const Row& row) {
                const auto number = find(row);
                return number ? QVariant(*number) : QVariant();
            },
            [find, decimals = info.decimals](const Row& row) {
                const auto number = find(row);
                return number ? fixed(*number, decimals) : QString();
            }};
}

/// The objectives that get a column, those for everybody or those for who looks into the algorithm; not
/// success, which tables show with its bounds. `isNoisy`: only those that differ from trials to trials.
inline objectives::ObjectiveList scoredObjectives(bool isDetail, bool isNoisy = false) {
    objectives::ObjectiveList list;
    for (const objectives::Objective& objective : objectives::allObjectives()) {
        if (objective.isDetail == isDetail && !objective.isSuccess && (objective.isNoisy || !isNoisy))
            list.push_back(&objective);
    }
    return list;
}

/// "-0.500", in the objective's unit, without it; a dash where it was not measured.
inline QString scoreText(const objectives::Objective& objective, const objectives::Score* score) {
    return score == nullptr ? QStringLiteral("–")
                            : fixed(score->value * objective.shownAs, objective.decimals);
}

/// The column of an objective's score, in people's unit; a dash where a row has none.
template <class Row>
Column<Row> scoreColumn(const objectives::Objective& objective,
                        const objectives::Fitness& (*fitnessOf)(const Row&)) {
    const auto find = [&objective, fitnessOf](const Row& row) {
        return objectives::findScore(fitnessOf(row), objective.key);
    };
    // What is counted in its own symbol's unit says so in its name already.
    return {
        QString::fromStdString(objective.decimals == 0 ? std::string(objective.symbol) : objective.title()),
        QString::fromUtf8(objective.help.data(), static_cast<qsizetype>(objective.help.size())),
        [find, &objective](const Row& row) {
            const objectives::Score* score = find(row);
            return score != nullptr ? QVariant(score->value * objective.shownAs) : QVariant();
        },
        [find, &objective](const Row& row) { return scoreText(objective, find(row)); }};
}

}  // namespace trapwright::models
