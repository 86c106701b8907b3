#pragma once

#include <span>

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

}  // namespace trapwright::models
